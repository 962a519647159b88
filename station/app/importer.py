"""Imports what the user names or drops on the window, one after the other, each read by a process of its own."""

from dataclasses import dataclass
from pathlib import Path
from typing import assert_never

from station.app.actions.file_actions import CancelImport, Import, ImportAction
from station.app.music_files.lesson_import import KeptLesson
from station.app.settings.settings_store import SettingsStore
from station.app.teacher_desk.incoming import KeptParcel, keep_incoming
from station.app.worker_process import StartWork, Work, WorkerProcess
from station.core.errors import StationError
from station.music.formats.groovescribe.groove_formats import is_groove_url

_MOST_WAITING = 50
"""So many files at once (our choice: an album or two; a whole library is the command line's affair)."""


Kept = KeptLesson | KeptParcel
"""What was kept: a lesson, or what teacher and student send each other."""


@dataclass(frozen=True, slots=True)
class ImportView:
    """What the page shows: what is read now, `source`, in short ("" for nothing) and how many wait.

    `kept` is the last one that was kept, `fault` why the one after it was not.
    """

    source: str = ""
    waiting: int = 0
    kept: Kept | None = None
    fault: str = ""


class Importer:
    """Lessons go to the folder that the settings of `store` name; `start` begins the reading."""

    def __init__(self, store: SettingsStore, start: StartWork = WorkerProcess) -> None:
        self._store, self._start = store, start
        self._sources: list[str] = []
        self._work: Work[Kept] | None = None
        self._kept: Kept | None = None
        self._fault = ""

    def view(self) -> ImportView:
        """What is shown."""
        source = _short(self._sources[0]) if self._sources else ""
        return ImportView(source, max(len(self._sources) - 1, 0), self._kept, self._fault)

    def act(self, action: ImportAction) -> str:
        """Do what the user asks; returns a line for them, "" for none."""
        match action:
            case Import(source):
                if len(self._sources) >= _MOST_WAITING:
                    return f"{_MOST_WAITING} files at once: drop the rest when these are read"
                self._sources.append(source)
                return f"reading {_short(source)}…"
            case CancelImport():
                self.close()
                return "nothing was imported"
            case _:
                assert_never(action)

    def advance(self) -> Kept | None:
        """Move on; returns what was kept since the last call. Raises `StationError` for what was not."""
        if self._work is None and self._sources:
            self._begin()
        if self._work is None:
            return None
        try:
            found = self._work.result()
        except StationError as fault:
            self._fault = str(fault)
            self._next()
            raise
        if found is not None:
            self._kept, self._fault = found, ""
            self._next()
        return found

    def _begin(self) -> None:
        try:
            self._work = self._start(keep_incoming, self._sources[0], self._store.now)
        except StationError:
            self._sources.clear()
            raise

    def _next(self) -> None:
        if self._work is not None:
            self._work.end()
        self._work = None
        self._sources = self._sources[1:]

    def close(self) -> None:
        """End what is read; what waits is dropped."""
        self._next()
        self._sources.clear()


def lessons_of(kept: Kept) -> tuple[Path, ...]:
    """The lessons that are listed after it was kept, the first of which is shown."""
    return kept.lessons if isinstance(kept, KeptParcel) else (kept.path,)


def _short(source: str) -> str:
    return "the link" if is_groove_url(source) else Path(source).name


def told(kept: Kept) -> str:
    """A line about what was kept."""
    if isinstance(kept, KeptParcel):
        return kept.told
    bars = f"{kept.bars} bar{'' if kept.bars == 1 else 's'}"
    lost = f", {len(kept.lost)} lost: see Import" if kept.lost else ""
    return f"{kept.title}: {bars}{lost}" if kept.is_new else f"{kept.title} is among your lessons already"
