"""The panel that exports the chosen bars: as MIDI, as a lesson file, as a sheet, as a video, as a GIF."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.file_actions import CancelFilm, Export, ExportKind
from station.app.window_state import State
from station.gui import theme

EXPORT = "Export"
ABOUT = "The chosen bars as MIDI, as a file for your teacher, as a sheet to print, as a video or a GIF"
HELP = (
    "The bars that the player repeats are written at the lesson's own tempo: MIDI for any other program; a lesson file"
    " that a teacher can read and change, and this station opens; a sheet of notes to print; a video of the drummer"
    " with the notes and a click; a GIF of the same that plays for ever and makes no sound. The files lie in the folder"
    " take-along beside your sessions."
)
MIDI_LABEL, LESSON_LABEL, SHEET_LABEL = "MIDI file##take", "Lesson file##take", "Sheet (PDF)##take"
FILM_LABEL, LOOP_LABEL, CANCEL_LABEL = "Video##take", "GIF##take", "Cancel##take"
_FILES = {
    ExportKind.MIDI: (MIDI_LABEL, "The notes for any other program"),
    ExportKind.LESSON: (LESSON_LABEL, "A text that a teacher can read and change, and that this station opens"),
    ExportKind.SHEET: (SHEET_LABEL, "The notes on paper, for the music stand: A4, with a key of what is used"),
}
_FILMS = {
    ExportKind.FILM: (FILM_LABEL, "The drummer, the notes and the click as MP4; it is filmed while you go on"),
    ExportKind.LOOP: (LOOP_LABEL, "The drummer and the notes, over and over, for a message; bars of 60 s at most"),
}


class ExportPanel:
    """A button for each kind of file, and what has come of the video."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        lesson, (first, last) = state.player.lesson, state.export_bars
        theme.heading(lesson.title, 20)
        theme.soft(f"bars {first + 1} to {last + 1}" if first != last else f"bar {first + 1}")
        for kind, (label, tip) in _FILES.items():
            self._button(label, tip, Export(kind))
        if not state.is_filming:
            for kind, (label, tip) in _FILMS.items():
                self._button(label, tip, Export(kind))
            return
        self._button(CANCEL_LABEL, "Give it up; nothing is left of it", CancelFilm())
        theme.soft("It is being filmed; you may go on.")

    def _button(self, label: str, tip: str, action: Action) -> None:
        if imgui.button(label, imgui.ImVec2(-1, theme.points(40))):
            self._dispatch(action)
        theme.tooltip(tip)
