"""The panel that exports the chosen bars in any format, and what was played as MIDI."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.file_actions import CancelFilm, Export, ExportTake
from station.app.export import FILM, LESSON, LOOP, SHEET, ExportedFile
from station.app.music_files.part_export import WRITTEN
from station.app.window_state import State
from station.gui import theme
from station.gui.widgets.flow_row import FlowRow
from station.music.formats.music_format import Feature, MusicFormat

EXPORT = "Export"
ABOUT = "The chosen bars as a music file of any kind, for your teacher, to print, as a video or a GIF"
HELP = (
    "The bars that the player repeats are written at the lesson's own tempo: a lesson file that a teacher can read and"
    " change, and this station opens; a sheet of notes to print; a video of the drummer with the notes and a click; a"
    " GIF of the same that plays for ever and makes no sound; and a music file for any other program: what its format"
    " has no word for is said below. What you played last can be written as MIDI too. The files lie in the folder"
    " take-along beside your sessions, a take's beside its recording."
)
LESSON_LABEL, SHEET_LABEL = "Lesson file##take", "Sheet (PDF)##take"
FILM_LABEL, LOOP_LABEL, CANCEL_LABEL = "Video##take", "GIF##take", "Cancel##take"
PLAYED_LABEL = "What you played, as MIDI##take"
_FILES = (
    (LESSON, LESSON_LABEL, "A text that a teacher can read and change, and that this station opens"),
    (SHEET, SHEET_LABEL, "The notes on paper, for the music stand: A4, with a key of what is used"),
)
_FILMS = (
    (FILM, FILM_LABEL, "The drummer, the notes and the click as MP4; it is filmed while you go on"),
    (LOOP, LOOP_LABEL, "The drummer and the notes, over and over, for a message; bars of 60 s at most"),
)
_HIGH = 40
"""Design pixels of a button."""


def music_label(form: MusicFormat) -> str:
    """The button that writes a format."""
    return f"{form.name[:1].upper()}{form.name[1:]}##take{form.endings[0]}"


class ExportPanel:
    """A button for each kind of file, and what has come of it."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        lesson, (first, last) = state.player.lesson, state.export_bars
        theme.heading(lesson.title, 20)
        theme.soft(f"bars {first + 1} to {last + 1}" if first != last else f"bar {first + 1}")
        for ending, label, tip in _FILES:
            self._button(label, tip, Export(ending))
        self._films(state)
        theme.part("Music files")
        self._music()
        imgui.begin_disabled(state.played is None)
        if imgui.button(PLAYED_LABEL, imgui.ImVec2(-1, theme.points(_HIGH))) and state.played is not None:
            self._dispatch(ExportTake(state.played))
        imgui.end_disabled()
        theme.tooltip("Your last take, or the session whose result is shown, stroke by stroke, beside its recording")
        if state.export.is_writing:
            theme.soft("Writing…")
        elif state.export.written is not None:
            _told(state.export.written)

    def _films(self, state: State) -> None:
        if not state.export.is_filming:
            for ending, label, tip in _FILMS:
                self._button(label, tip, Export(ending))
            return
        self._button(CANCEL_LABEL, "Give it up; nothing is left of it", CancelFilm())
        theme.soft("It is being filmed; you may go on.")

    def _music(self) -> None:
        row = FlowRow()
        for form in WRITTEN:
            label = music_label(form)
            width = imgui.calc_text_size(label, True).x + 2 * imgui.get_style().frame_padding.x
            row.place(width)
            if imgui.button(label):
                self._dispatch(Export(form.endings[0]))
            theme.tooltip(_limits(form))

    def _button(self, label: str, tip: str, action: Action) -> None:
        if imgui.button(label, imgui.ImVec2(-1, theme.points(_HIGH))):
            self._dispatch(action)
        theme.tooltip(tip)


def _limits(form: MusicFormat) -> str:
    """What a format is called and what it has no word for."""
    missing = [feature for feature in Feature if feature not in (form.keeps or {})]
    words = f"No word for: {', '.join(missing)}" if missing else "Keeps nearly all of a lesson"
    return f"{form.name} ({', '.join(form.endings)}). {words}"


def _told(written: ExportedFile) -> None:
    """Where the last file is, and what it has not."""
    theme.soft(f"Kept in {written.path}")
    for line in written.lost:
        imgui.bullet()
        imgui.same_line()
        imgui.text_wrapped(line)
