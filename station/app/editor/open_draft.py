"""A lesson that is open in the editor: its history, its journal, its file. Every change is in the journal at once."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import dataclass, replace
from pathlib import Path

from station.app.editor.draft_journal import DraftJournal
from station.app.editor.read_draft import ReadDraft, read_draft
from station.core.disk.files import write_whole
from station.core.errors import BadInput, DeviceError
from station.drills.editing.edit_history import EditHistory
from station.drills.editing.edit_lesson import edited
from station.drills.editing.edit_words import edit_words
from station.drills.editing.lesson_edits import LessonEdit
from station.drills.editing.page_reader import page_of

LONG = 3_000
"""A text of so many characters, some 45 bars of three lines, takes longer to read than a frame may (30 ms for 50)."""


def text_bytes(text: str, name: str) -> bytes:
    """The text as it stands in a file; raises `BadInput` of `name` where a letter of it is half a letter."""
    try:
        return text.encode()
    except UnicodeEncodeError as fault:
        place = f"line {text.count(chr(10), 0, fault.start) + 1}"
        raise BadInput(name, place, f"U+{ord(text[fault.start]):04X} is no letter that a file can hold") from None


@dataclass(frozen=True, slots=True)
class DraftFile:
    """What is edited: the `name` that its lesson has, and its file, None where it has none yet."""

    name: str
    path: Path | None = None


class OpenDraft:
    """The draft of `file`, which holds the text `saved`; None where there is none, or nobody knows.

    Faults of the journal go to `notify`.

    `now` is what the text means, `lesson` of it or of the last text that could be read. A long text is read by the
    `reader`, if there is one, beside what goes on: its grids are seen at once, its lesson and faults a little later.
    """

    def __init__(
        self,
        file: DraftFile,
        history: EditHistory,
        journal: DraftJournal,
        notify: Callable[[str], None],
        saved: str | None = None,
        reader: Executor | None = None,
    ) -> None:
        self.file, self.history = file, history
        self._journal, self._notify, self._reader = journal, notify, reader
        self._coming: Future[ReadDraft] | None = None
        self._saved = saved
        self.now: ReadDraft = read_draft(history.text, file.name)
        self.lesson = self.now.lesson

    @property
    def is_saved(self) -> bool:
        """Whether its file, if it has one, holds what stands here."""
        return self.history.text == self._saved

    @property
    def is_touched(self) -> bool:
        """Whether anything was done that a user would miss."""
        return not self.is_saved and (self.history.undo_name is not None or self.file.path is not None)

    def change(self, edit: LessonEdit, joins: bool = False) -> None:
        """Make an edit; raises `BadInput` for what cannot be done, and then all stays as it was."""
        text = edited(self.history.text, edit, self.file.name)
        self._take(self.history.edited(text, edit_words(edit), joins))

    def undo(self) -> None:
        """Take the last change back."""
        self._take(self.history.undone())

    def redo(self) -> None:
        """Do again what was taken back."""
        self._take(self.history.redone())

    def _take(self, history: EditHistory) -> None:
        if history is self.history:
            return
        self.history = history
        self._read()
        try:
            self._journal.note(history.text, history.undo_name or "undo")
        except DeviceError as fault:
            self._notify(str(fault))

    # --- reading -----------------------------------------------------------------------------------------------------

    def _read(self) -> None:
        """Find out what the text means now."""
        text = self.history.text
        if self._reader is None or len(text) < LONG:
            self._coming = None
            self._understand(read_draft(text, self.file.name))
            return
        self.now = replace(self.now, text=text, page=page_of(text))
        if self._coming is None:
            self._coming = self._reader.submit(read_draft, text, self.file.name)

    def _understand(self, read: ReadDraft) -> None:
        self.now = read
        self.lesson = read.lesson or self.lesson

    def advance(self) -> bool:
        """Take what has been read beside what goes on; returns whether that is news."""
        if self._coming is None or not self._coming.done():
            return False
        read, self._coming = self._coming.result(), None
        if read.text == self.history.text:
            self._understand(read)
        else:  # somebody wrote on meanwhile
            self._understand(replace(read, text=self.now.text, page=self.now.page))
            self._read()
        return True

    def read_on(self) -> None:
        """Wait until all is read."""
        while self._coming is not None:
            self._coming.result()
            self.advance()

    # --- its file ----------------------------------------------------------------------------------------------------

    def save(self, file: DraftFile) -> None:
        """Write the text whole to `file`, which is its own from now on; raises `StationError`."""
        assert file.path is not None, "where a draft is saved has been said"
        self.read_on()
        write_whole(file.path, text_bytes(self.history.text, file.name))
        if file.name != self.file.name:
            self._understand(read_draft(self.history.text, file.name))
        self.file, self._saved = file, self.history.text
        self._journal.saved(self.history.text, file.path)

    def discard(self) -> None:
        """Nobody wants what was not saved."""
        self._journal.discard()

    def close(self) -> None:
        """Leave it; what was not saved is kept for the next time."""
        self._journal.close()
