"""Exports some bars of a lesson: MIDI, a lesson file for the teacher, a sheet to print, a video or a GIF.

Files lie in the student's own folder, `take-along`. A video takes its time: another process films it (`station
animate`) in a folder that goes with it, so that the window goes on and a cancelled video leaves nothing.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import assert_never

from station.app.actions.file_actions import CancelFilm, Export, ExportKind, FileAction, FilmTake
from station.app.view_settings import ViewSettings
from station.core.errors import DeviceError, StationError
from station.core.files import growing, write_whole
from station.core.settings import Settings
from station.drills.lesson import BarCue, Lesson
from station.drills.writing.lesson_text import show, with_value
from station.drills.writing.lesson_writer import write_lesson
from station.practice.records.session_files import folder_name
from station.scenes.sheets import lesson_labels, pdf_of

FOLDER = "take-along"
_PAPER = "a4"
FILM, LOOP = ".mp4", ".gif"
ANIMATE = (sys.executable, "-m", "station.cli.command_line", "animate")
_SAID = "said"
"""What the film's process says, in the folder that goes with it."""
_BACKGROUND = 10
"""How nice the film is to a drummer who plays meanwhile (our choice: it gets what is left)."""

Bars = tuple[int, int]
"""First and last bar of the lesson, from 0."""


class Exporter:
    """Writes the files; one video at a time, which `animate` (the first words of a command line) films."""

    def __init__(self, animate: Sequence[str] = ANIMATE) -> None:
        self._animate = animate
        self._scratch: tempfile.TemporaryDirectory[str] | None = None
        self.process: subprocess.Popen[bytes] | None = None
        self._made = Path()
        self.path: Path | None = None
        """The video or GIF that is filmed now."""

    def act(
        self, action: FileAction, lesson: Lesson, bars: Bars, settings: Settings, view_settings: ViewSettings
    ) -> str:
        """Write the bars of a lesson, or film; returns what to show, empty for nothing. Raises `StationError`."""
        match action:
            case Export(ExportKind.FILM):
                self.film(lesson, bars, settings, film_words(view_settings, settings, lesson.cues), FILM)
                return ""
            case Export(ExportKind.LOOP):
                self.film(lesson, bars, settings, film_words(view_settings, settings, lesson.cues), LOOP)
                return ""
            case Export(kind):
                write = {ExportKind.MIDI: self.midi, ExportKind.LESSON: self.lesson, ExportKind.SHEET: self.sheet}[kind]
                return f"kept in {write(lesson, bars, settings)}"
            case FilmTake(capture):
                self.film_take(capture, film_words(view_settings, settings))
                return "the video is being filmed; you may go on (Export cancels it)"
            case CancelFilm():
                self.cancel()
                return ""
            case _:
                assert_never(action)

    def midi(self, lesson: Lesson, bars: Bars, settings: Settings) -> Path:
        """The bars as a MIDI file; raises `DeviceError`."""
        from station.music.formats.smf.track_writer import write_score  # with mido: the window would open later

        path = _place(lesson, bars, settings, ".mid")
        write_score(lesson.score.bars(*bars), path)
        return path

    def lesson(self, lesson: Lesson, bars: Bars, settings: Settings) -> Path:
        """The lesson as a file that repeats the bars; raises `BadInput` for what no file can say, `DeviceError`."""
        path = _place(lesson, bars, settings, ".toml")
        write_whole(path, lesson_file_of(lesson, bars).encode())
        return path

    def sheet(self, lesson: Lesson, bars: Bars, settings: Settings) -> Path:
        """The bars as notation on paper, repeated; raises `DeviceError`."""
        path = _place(lesson, bars, settings, ".pdf")
        words = lesson_labels(replace(lesson, loop=bars), bars)
        write_whole(path, pdf_of(lesson.played_once, bars, words, _PAPER))
        return path

    def film(
        self, lesson: Lesson, bars: Bars, settings: Settings, words: Sequence[str] = (), ending: str = FILM
    ) -> None:
        """Begin a `FILM` or a `LOOP` of the bars, as further `words` of the command say; raises as `lesson` does."""
        span = ("--start-bar", str(bars[0] + 1), "--end-bar", str(bars[1] + 1))
        click = ("--click",) if ending == FILM else ()
        path = _place(lesson, bars, settings, ending)
        scratch = self._scratch_folder()
        source = scratch / f"{folder_name(lesson.name)}.toml"
        try:
            write_whole(source, (lesson.text or write_lesson(lesson)).encode())
        except StationError:
            self._end()
            raise
        self._begin(source, path, (*span, *click, *words))

    def film_take(self, capture: Path, words: Sequence[str] = ()) -> None:
        """Begin a video, beside a take's capture, of the drummer who plays it; raises `DeviceError`."""
        self._scratch_folder()
        self._begin(capture, capture.with_suffix(FILM), words)

    def _scratch_folder(self) -> Path:
        """A folder that goes with the film; raises `DeviceError` while there is one."""
        if self.process is not None:
            raise DeviceError("one video at a time: wait for it, or cancel it")
        self._scratch = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # who helps to draw may end later
        return Path(self._scratch.name)

    def _begin(self, source: Path, path: Path, words: Sequence[str]) -> None:
        """Let another process film `source`; the film takes its place at `path` when it is whole.

        It says what went wrong to a file: a pipe would fill, and last as long as anyone whom it has let draw.
        """
        assert self._scratch is not None, "it has a folder to film into"
        self._made = Path(self._scratch.name) / f"film{path.suffix}"
        try:
            with self._made.with_name(_SAID).open("wb") as said:
                self.process = subprocess.Popen(
                    [*self._animate, str(source), "--out", str(self._made), *words],
                    stdout=subprocess.DEVNULL,
                    stderr=said,
                )
        except OSError as fault:
            raise DeviceError(f"no video can be made: {fault.strerror or fault}") from fault
        finally:
            if self.process is None:
                self._end()
        self.path = path
        with suppress(OSError, AttributeError):  # there is no such thing on every system
            os.setpriority(os.PRIO_PROCESS, self.process.pid, _BACKGROUND)

    def news(self) -> str | None:
        """What has come of the video since it was last asked: where it is, or why there is none; None meanwhile."""
        if self.process is None or self.process.poll() is None:
            return None
        message = (
            self._kept() if self.process.returncode == 0 else f"no video: {_last_line(self._made.with_name(_SAID))}"
        )
        self._end()
        return message

    def _kept(self) -> str:
        assert self.path is not None, "a video has its place from the beginning"
        try:
            with growing(self.path) as part:
                shutil.copyfile(self._made, part)
        except DeviceError as fault:
            return f"no video: {fault}"
        return f"kept in {self.path}"

    def cancel(self) -> None:
        """Give the video up; nothing of it is left."""
        if self.process is None:
            return
        self.process.kill()
        self.process.wait()
        self._end()

    def _end(self) -> None:
        self.process = self.path = None
        if self._scratch is not None:
            self._scratch.cleanup()
            self._scratch = None


def lesson_file_of(lesson: Lesson, bars: Bars) -> str:
    """The text of a lesson that repeats these bars: its own, or one written anew where it came from no file."""
    if not lesson.text:
        return write_lesson(replace(lesson, loop=bars))
    return show(with_value(lesson.text, "loop", [bar + 1 for bar in bars]))


def _place(lesson: Lesson, bars: Bars, settings: Settings, ending: str) -> Path:
    """Where the file goes; raises `DeviceError` where there can be no folder."""
    folder = settings.sessions_dir / folder_name(settings.student) / FOLDER
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise DeviceError(f"{folder}: no folder can be made: {fault.strerror or fault}") from fault
    return folder / f"{folder_name(lesson.name)}_{bars[0] + 1}-{bars[1] + 1}{ending}"


def film_words(view_settings: ViewSettings, settings: Settings, cues: Sequence[BarCue] = ()) -> tuple[str, ...]:
    """How `station animate` is to film what is seen in the window.

    Views and styles that a lesson's `cues` ask for come before the user's own.
    """
    words = ["--quality", "low"]
    words += [] if any(cue.camera for cue in cues) else ["--view", view_settings.view.name.lower()]
    words += [] if any(cue.style for cue in cues) else ["--style", settings.style]
    words += ["--drummer", settings.figure] if settings.figure else []
    words += ["--drums", settings.stands] if settings.stands else []
    words += ["--mirror"] if view_settings.mirrored else []
    words += ["--hands", settings.hands] if settings.hands else []
    return tuple(words)


def _last_line(said: Path) -> str:
    lines = said.read_text(encoding="locale", errors="replace").strip().splitlines()
    return lines[-1] if lines else "the film ended without a word"
