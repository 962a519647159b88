"""The autosave of a lesson that is edited: each change goes to the system at once, and to the disk within a second.

Whoever kills the program loses nothing that was told here; whoever pulls the plug loses a second at most. The journal
lies in a hidden folder beside the teacher's lessons and is gone once the lesson is saved. Each editor has a file of its
own and holds it locked, so that two windows on one lesson do not meet; what no window holds was left by a crash.
"""

import os
import secrets
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Event, Thread

from station.core.disk.file_lock import lock
from station.core.disk.file_names import folder_name
from station.core.disk.files import read_regular
from station.core.errors import DeviceError, StationError
from station.core.join_timeout import ends_within
from station.drills.editing.draft_records import DraftRecords, change_record, read_records, start_record
from station.drills.editing.text_change import change_between

DRAFTS = ".drafts"
"""The folder of journals, in that of the teacher's own lessons."""
SUFFIX = ".journal"
SYNC_S = 1.0
"""A power cut costs no more than that (the part's own demand: a second)."""
MAX_GROWTH = 4 * 2**20
"""A journal that has grown by so much begins anew with the text as it stands: some 20,000 edits (our choice)."""
LARGEST = 64 * 2**20
"""A larger file is no journal of ours: what it begins with and `MAX_GROWTH` are far below (our choice)."""
_PATIENCE_S = 5.0
"""How long the end waits for a slow disk (our choice)."""


class DraftJournal:
    """The journal of one editor, in `folder`: of `lesson`, None for one without a file, that begins with `text`.

    There is a file from the first change on, until `saved` or `discard`.
    """

    def __init__(self, folder: Path, lesson: Path | None, text: str) -> None:
        self._folder = folder
        self._lesson = "" if lesson is None else str(lesson)
        self._base = self._text = text
        self._file: _OpenJournal | None = None

    @classmethod
    def resumed(cls, path: Path) -> "tuple[DraftJournal, DraftRecords] | None":
        """Go on with the draft that a crash left at `path`; None where another window has it, or it is gone.

        Raises `DeviceError` where the torn end of it cannot be taken away.
        """
        descriptor = _locked(path)
        if descriptor is None:
            return None
        draft = _read(path)
        if draft is None:
            os.close(descriptor)
            return None
        journal = cls(path.parent, Path(draft.lesson) if draft.lesson else None, draft.base)
        journal._text = draft.text
        journal._file = _OpenJournal(path, descriptor, draft.good_bytes)
        journal._file.cut()
        return journal, draft

    @property
    def path(self) -> Path | None:
        """Where it lies, None before the first change."""
        return None if self._file is None else self._file.path

    def note(self, text: str, name: str) -> None:
        """Keep that the lesson's text is now `text`, by a change called `name`.

        Raises `DeviceError` (disk full, no permission); the next `note` tries again, and what was kept stays kept.
        """
        if text == self._text:
            return
        if self._file is None or self._file.grown > MAX_GROWTH:
            self._begin()
        assert self._file is not None, "it has just begun"
        self._file.write(change_record(change_between(self._text, text), name))
        self._text = text

    def saved(self, text: str, lesson: Path | None = None) -> None:
        """The lesson is on the disk as `text`, at `lesson` where that is new: there is nothing to rescue any more."""
        self._lesson = self._lesson if lesson is None else str(lesson)
        self._base = self._text = text
        self._end(keep=False)

    def discard(self) -> None:
        """Nobody wants the draft."""
        self.saved(self._base)

    def close(self) -> None:
        """End here and leave the draft for later; one whose text is as it began is gone."""
        self._end(keep=self._text != self._base)

    def _begin(self) -> None:
        """A new file that begins with what the editing began with and has what was changed since."""
        stem = folder_name(Path(self._lesson).stem)
        new = _OpenJournal.made(self._folder / f"{stem}-{secrets.token_hex(4)}{SUFFIX}")
        try:
            new.write(start_record(self._lesson, self._base))
            if self._text != self._base:
                new.write(change_record(change_between(self._base, self._text), "as it stood"))
        except DeviceError:
            new.end(keep=False)
            raise
        new.grown = 0
        self._end(keep=False)
        self._file = new

    def _end(self, keep: bool) -> None:
        if self._file is not None:
            self._file.end(keep)
        self._file = None


class _OpenJournal:
    """A locked file of `size` bytes that grows at its end, and the thread that has the disk keep up."""

    def __init__(self, path: Path, descriptor: int, size: int) -> None:
        self.path, self.grown = path, 0
        self._descriptor, self._size = descriptor, size
        self._written, self._closing = Event(), Event()
        self._fault: OSError | None = None
        self._thread = Thread(target=self._keep_up, name="draft journal", daemon=True)
        self._thread.start()

    @classmethod
    def made(cls, path: Path) -> "_OpenJournal":
        """A new one; raises `DeviceError`."""
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_APPEND | _BINARY, 0o600)
        except OSError as fault:
            raise _not_kept(path, fault) from fault
        lock(descriptor)  # a file system without locks: the file's own name still keeps two windows apart
        return cls(path, descriptor, 0)

    def write(self, record: bytes) -> None:
        """Hand a whole record to the system; raises `DeviceError` and leaves the file without it."""
        try:
            if self._fault is not None:
                raise self._fault
            if os.write(self._descriptor, record) < len(record):
                raise OSError(0, "the disk is full")
        except OSError as fault:
            self._fault = None
            self.cut()
            raise _not_kept(self.path, fault) from fault
        self._size += len(record)
        self.grown += len(record)
        self._written.set()

    def cut(self) -> None:
        """Take away what stands after the last whole record; raises `DeviceError`."""
        try:
            os.ftruncate(self._descriptor, self._size)
        except OSError as fault:
            raise _not_kept(self.path, fault) from fault

    def end(self, keep: bool) -> None:
        """Close it, and take the file away unless it is to be kept."""
        self._closing.set()
        self._written.set()
        if ends_within(self._thread, _PATIENCE_S):  # else the thread still needs the descriptor
            os.close(self._descriptor)
        if not keep:
            with suppress(OSError):
                self.path.unlink(missing_ok=True)

    def _keep_up(self) -> None:
        """In a thread of its own: have the disk take what was written, at most once in `SYNC_S`."""
        while not self._closing.is_set():
            self._written.wait()
            self._written.clear()
            try:
                os.fsync(self._descriptor)
            except OSError as fault:
                self._fault = fault
            self._closing.wait(SYNC_S)


_BINARY = getattr(os, "O_BINARY", 0)  # Windows would make two bytes of a line's end


# --- what a crash has left -------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class LeftDraft:
    """A draft that no window holds, and its journal."""

    path: Path
    draft: DraftRecords


def left_drafts(folder: Path) -> list[LeftDraft]:
    """The drafts in `folder` that a crash left, the newest first, none that another window edits."""
    found: list[tuple[float, LeftDraft]] = []
    for path in folder.glob(f"*{SUFFIX}"):
        descriptor = _locked(path)
        if descriptor is None:
            continue
        with suppress(OSError):
            draft = _read(path)
            if draft is not None and draft.text != draft.base:
                found.append((path.stat().st_mtime, LeftDraft(path, draft)))
        os.close(descriptor)
    return [left for _, left in sorted(found, key=lambda pair: pair[0], reverse=True)]


def drop_draft(path: Path) -> None:
    """Take away the journal of a draft that nobody wants, unless a window holds it."""
    descriptor = _locked(path)
    if descriptor is not None:
        os.close(descriptor)
        with suppress(OSError):
            path.unlink(missing_ok=True)


def _locked(path: Path) -> int | None:
    """An open descriptor of the journal at `path`, locked for us; None where another program has it or it is gone."""
    try:
        descriptor = os.open(path, os.O_RDWR | os.O_APPEND | _BINARY)
    except OSError:
        return None
    if lock(descriptor) and path.exists():  # whoever held it until now may have taken it away
        return descriptor
    os.close(descriptor)
    return None


def _read(path: Path) -> DraftRecords | None:
    try:
        return read_records(read_regular(path, LARGEST))
    except StationError:
        return None


def _not_kept(path: Path, fault: OSError) -> DeviceError:
    return DeviceError(f"{path}: the draft cannot be kept: {fault.strerror or fault}")
