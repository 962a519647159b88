"""The panel of what can be taken along: the chosen bars as MIDI, as a lesson file, as a sheet, as a video, as a GIF."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from imgui_bundle import imgui

from station.app.export import FILM, LOOP, Bars, Exporter
from station.app.view_settings import ViewSettings
from station.core.settings import Settings
from station.drills.lesson import Lesson
from station.gui import theme

TAKE_ALONG = "Take along"
ABOUT = "The chosen bars as MIDI, as a file for your teacher, as a sheet to print, as a video or a GIF"
HELP = (
    "The bars that the player repeats are written at the lesson's own tempo: MIDI for any other program; a lesson file"
    " that a teacher can read and change, and this station opens; a sheet of notes to print; a video of the drummer"
    " with the notes and a click; a GIF of the same that plays for ever and makes no sound. The files lie in the folder"
    " take-along beside your sessions."
)
MIDI_LABEL, LESSON_LABEL, SHEET_LABEL = "MIDI file##take", "Lesson file##take", "Sheet (PDF)##take"
FILM_LABEL, LOOP_LABEL, CANCEL_LABEL = "Video##take", "GIF##take", "Cancel##take"


@dataclass(frozen=True, slots=True)
class ExportActions:
    """What the panel asks: what is `chosen`, a lesson and its bars from 0, by which `settings`, how it is seen.

    `tried` does something or says why it could not, `tell` says a line.
    """

    chosen: Callable[[], tuple[Lesson, Bars]]
    settings: Callable[[], Settings]
    look: Callable[[], ViewSettings]
    tried: Callable[[Callable[[], object]], None]
    tell: Callable[[str], None]


class ExportPanel:
    """Three buttons, and what has come of the video."""

    def __init__(self, actions: ExportActions, files: Exporter) -> None:
        self._actions = actions
        self.files = files

    def gui(self) -> None:
        """Draw the panel and do what the user does in it."""
        lesson, (first, last) = self._actions.chosen()
        theme.heading(lesson.title, 20)
        theme.soft(f"bars {first + 1} to {last + 1}" if first != last else f"bar {first + 1}")
        if self._button(MIDI_LABEL, "The notes for any other program"):
            self._write(self.files.midi)
        if self._button(LESSON_LABEL, "A text that a teacher can read and change, and that this station opens"):
            self._write(self.files.lesson)
        if self._button(SHEET_LABEL, "The notes on paper, for the music stand: A4, with a key of what is used"):
            self._write(self.files.sheet)
        if self.files.path is None:
            if self._button(FILM_LABEL, "The drummer, the notes and the click as MP4; it is filmed while you go on"):
                self._actions.tried(lambda: self._film(FILM))
            if self._button(
                LOOP_LABEL, "The drummer and the notes, over and over, for a message; bars of 60 s at most"
            ):
                self._actions.tried(lambda: self._film(LOOP))
            return
        if self._button(CANCEL_LABEL, "Give it up; nothing is left of it"):
            self.files.cancel()
        theme.soft("It is being filmed; you may go on.")

    @staticmethod
    def _button(label: str, told: str) -> bool:
        pressed = imgui.button(label, imgui.ImVec2(-1, theme.points(40)))
        theme.tooltip(told)
        return bool(pressed)

    def _write(self, make: Callable[[Lesson, Bars, Settings], Path]) -> None:
        actions = self._actions
        actions.tried(lambda: actions.tell(f"kept in {make(*actions.chosen(), actions.settings())}"))

    def _film(self, ending: str) -> None:
        settings = self._actions.settings()
        self.files.film(*self._actions.chosen(), settings, film_words(self._actions.look(), settings), ending)

    def film_take(self, capture: Path) -> None:
        """Film a take beside its capture."""
        settings = self._actions.settings()
        words = film_words(self._actions.look(), settings)

        def begin() -> None:
            self.files.film_take(capture, words)
            self._actions.tell(f"the video is being filmed; you may go on ({TAKE_ALONG} cancels it)")

        self._actions.tried(begin)

    def advance(self) -> None:
        """Say what has come of a video; once a frame, whether the panel is open or not."""
        told = self.files.news()
        if told is not None:
            self._actions.tell(told)


def film_words(look: ViewSettings, settings: Settings) -> tuple[str, ...]:
    """How `station animate` is to film what is seen in the window."""
    words = ["--quality", "low", "--view", look.view.name.lower()]
    words += ["--style", settings.style, "--figure", settings.figure]
    words += ["--mirror"] if look.mirrored else []
    words += ["--hands", settings.hands] if settings.hands else []
    return tuple(words)
