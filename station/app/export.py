"""Exports some bars of a lesson: any format of music, a lesson file for the teacher, a sheet, a video or a GIF.

Files lie in the student's own folder, `take-along`. A video takes its time: another process films it (`station
animate`) in a folder that goes with it, so that the window goes on and a cancelled video leaves nothing. Sheets
and music files are written by another process too.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import assert_never

from station.app.actions.file_actions import CancelFilm, Export, ExportTake, FileAction, FilmTake
from station.app.music_files.named_parts import load_part
from station.app.music_files.part_export import bars_of, write_part
from station.app.settings.view_settings import ViewSettings
from station.app.worker_process import StartWork, Work, WorkerProcess
from station.core.disk.file_names import folder_name
from station.core.disk.files import growing, write_whole
from station.core.errors import DeviceError, StationError
from station.core.settings import Settings
from station.core.toml.toml_edits import with_value
from station.drills.lesson import BarCue, Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_text import plain, show
from station.drills.writing.lesson_writer import write_lesson
from station.practice.history.session_files import student_folder

FOLDER = "take-along"
_PAPER = "a4"
FILM, LOOP, LESSON, SHEET, _TAKE, PAGE = ".mp4", ".gif", ".toml", ".pdf", ".mid", ".html"
ANIMATE = (sys.executable, "-m", "station.cli.command_line", "animate")
JUDGE_AGAIN = (sys.executable, "-m", "station.cli.command_line", "battle", "--judge-again")
_BACKGROUND = 10
"""How nice the film is to a drummer who plays meanwhile (our choice: it gets what is left)."""
_SAID = "said"
"""What the film's process says, in the folder that goes with it."""

Bars = tuple[int, int]
"""First and last bar of the lesson, from 0."""


@dataclass(frozen=True, slots=True)
class ExportedFile:
    """A music file or a sheet that was written, and what the music has that the file has not, a line each."""

    path: Path
    lost: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ExportView:
    """What the page shows: whether a file `is_written` now, and a film; and the file that was written last."""

    is_writing: bool = False
    is_filming: bool = False
    written: ExportedFile | None = None


class Exporter:
    """Writes the files; one video at a time, which `animate` (the first words of a command line) films.

    `battle` is that of a battle's film; `start` begins the writing of music and sheets, one at a time too.
    """

    def __init__(
        self, animate: Sequence[str] = ANIMATE, start: StartWork = WorkerProcess, battle: Sequence[str] = JUDGE_AGAIN
    ) -> None:
        self._animate, self._battle, self._start = animate, battle, start
        self._work: Work[ExportedFile] | None = None
        self._written: ExportedFile | None = None
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
            case Export(ending):
                return self._export(ending, lesson, bars, settings, view_settings)
            case ExportTake(capture):
                self._write(write_take, str(capture), capture.with_suffix(_TAKE))
                return ""
            case FilmTake(capture):
                self.film_take(capture, film_words(view_settings, settings))
                return "the video is being filmed; you may go on (Export cancels it)"
            case CancelFilm():
                self.cancel()
                return ""
            case _:
                assert_never(action)

    def _export(self, ending: str, lesson: Lesson, bars: Bars, settings: Settings, view_settings: ViewSettings) -> str:
        if ending in (FILM, LOOP):
            self.film(lesson, bars, settings, film_words(view_settings, settings, lesson.cues), ending)
        elif ending == LESSON:
            return f"kept in {self.lesson(lesson, bars, settings)}"
        else:
            self.music(lesson, bars, settings, ending)
        return ""

    def music(self, lesson: Lesson, bars: Bars, settings: Settings, ending: str) -> None:
        """Begin to write the bars as a music file or, where it ends in .pdf, as notes on paper.

        Raises `BadInput` for a lesson that no file can say, `DeviceError`.
        """
        path = _place(lesson, bars, settings, ending)
        self._write(write_bars, lesson.name, lesson.text or write_lesson(lesson), bars, path)

    def _write(self, do: Callable[..., ExportedFile], *words: object) -> None:
        """Raises `DeviceError` while something is being written."""
        if self._work is not None:
            raise DeviceError("one file at a time: this one is written in a moment")
        self._work = self._start(do, *words)

    def lesson(self, lesson: Lesson, bars: Bars, settings: Settings) -> Path:
        """The lesson as a file that repeats the bars; raises `BadInput` for what no file can say, `DeviceError`."""
        path = _place(lesson, bars, settings, LESSON)
        write_whole(path, lesson_file_of(lesson, bars).encode())
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

    def film_battle(self, folder: Path) -> None:
        """Begin a video, in a battle's folder, of all that was played in it; raises `DeviceError`."""
        self._scratch_folder()
        self._begin(folder, folder / f"battle{FILM}", (), (self._battle, "--film"))

    def _scratch_folder(self) -> Path:
        """A folder that goes with the film; raises `DeviceError` while there is one."""
        if self.process is not None:
            raise DeviceError("one video at a time: wait for it, or cancel it")
        self._scratch = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)  # who helps to draw may end later
        return Path(self._scratch.name)

    def _begin(
        self, source: Path, path: Path, words: Sequence[str], films: tuple[Sequence[str], str] | None = None
    ) -> None:
        """Let another process film `source`; the film takes its place at `path` when it is whole.

        `films` is the command that does, and its option for the file, where it is not the usual one.
        It says what went wrong to a file: a pipe would fill, and last as long as anyone whom it has let draw.
        """
        assert self._scratch is not None, "it has a folder to film into"
        self._made = Path(self._scratch.name) / f"film{path.suffix}"
        command, out = films or (self._animate, "--out")
        try:
            with self._made.with_name(_SAID).open("wb") as said:
                self.process = subprocess.Popen(
                    [*command, str(source), out, str(self._made), *words],
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

    def view(self) -> ExportView:
        """What is shown."""
        return ExportView(self._work is not None, self.path is not None, self._written)

    def written(self) -> str | None:
        """Where the file is that was written since it was last asked, None for none; raises `StationError`."""
        if self._work is None:
            return None
        try:
            found = self._work.result()
        except StationError:
            self._end_writing()
            raise
        if found is None:
            return None
        self._end_writing()
        self._written = found
        return f"kept in {found.path}{f'; {len(found.lost)} lost: see Export' if found.lost else ''}"

    def _end_writing(self) -> None:
        if self._work is not None:
            self._work.end()
        self._work = None

    def close(self) -> None:
        """Give up what is being filmed and written."""
        self.cancel()
        self._end_writing()

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


def write_bars(name: str, text: str, bars: Bars, out: Path) -> ExportedFile:
    """Write bars of the lesson that `text` is, as `out` ends; raises `StationError`."""
    lesson = parse_lesson(text, name, name).lesson
    assert lesson is not None, "it was read before"
    if out.suffix != SHEET:
        return ExportedFile(out, write_part(bars_of(lesson, bars), out))
    from station.scenes.sheets import lesson_labels, pdf_of

    words = lesson_labels(replace(lesson, loop=bars), bars)
    write_whole(out, pdf_of(lesson.played_once, bars, words, _PAPER))
    return ExportedFile(out)


def write_take(capture: str, out: Path) -> ExportedFile:
    """Write what was played as a music file; raises `StationError`."""
    return ExportedFile(out, write_part(load_part(capture), out))


def lesson_file_of(lesson: Lesson, bars: Bars) -> str:
    """The text of a lesson that repeats these bars: its own, or one written anew where it came from no file."""
    if not lesson.text:
        return write_lesson(replace(lesson, loop=bars))
    return show(with_value(plain(lesson.text), ("loop",), [bar + 1 for bar in bars]))


def _place(lesson: Lesson, bars: Bars, settings: Settings, ending: str) -> Path:
    """Where the file goes; raises `DeviceError` where there can be no folder."""
    return take_along_folder(settings) / f"{folder_name(lesson.name)}_{bars[0] + 1}-{bars[1] + 1}{ending}"


def take_along_folder(settings: Settings) -> Path:
    """What the student takes along; raises `DeviceError` where there can be no folder."""
    folder = student_folder(settings.sessions_dir, settings.student) / FOLDER
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise DeviceError(f"{folder}: no folder can be made: {fault.strerror or fault}") from fault
    return folder


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
