"""A long draft is read beside what goes on; what is typed meanwhile is not lost. The lesson is written by the test."""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from pathlib import Path
from typing import Any

from station.app.editor.draft_journal import DraftJournal
from station.app.editor.open_draft import LONG, DraftFile, OpenDraft
from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.editing.edit_history import EditHistory
from station.drills.editing.lesson_edits import LineAt, SetStroke, SetText

BARS = 200
TEXT = f'title = "T"\ntempo_bpm = 120\n\n[grid]\nsnare = "{"| o--- ---- o--- ---- " * BARS}|"\n'
SNARE = LineAt(0, Piece.SNARE)


class Later(Executor):
    """Does what it was given when the test says so."""

    def __init__(self) -> None:
        self.waiting: list[Callable[[], None]] = []

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:  # noqa: ANN401
        future: Future[Any] = Future()
        self.waiting.append(lambda: future.set_result(fn(*args, **kwargs)))
        return future


def _draft(folder: Path, reader: Executor | None) -> OpenDraft:
    journal = DraftJournal(folder, None, TEXT)
    return OpenDraft(DraftFile("t"), EditHistory(TEXT), journal, lambda _: None, reader=reader)


def _strokes(draft: OpenDraft) -> int:
    assert draft.lesson is not None
    return len(draft.lesson.score)


def test_grids_are_seen_at_once_and_the_lesson_when_it_has_been_read(tmp_path: Path) -> None:
    reader = Later()
    draft = _draft(tmp_path, reader)
    assert len(TEXT) > LONG
    draft.change(SetStroke(SNARE, 100, PPQ, "o"))
    draft.change(SetStroke(SNARE, 100, 3 * PPQ, "o"))
    cells = draft.now.page.grids[0].lines[0].bars[100].cells
    assert [cell.letter for cell in cells].count("o") == 4
    assert (_strokes(draft), draft.advance()) == (2 * BARS, False)
    reader.waiting.pop()()
    assert draft.advance()
    assert _strokes(draft) == 2 * BARS + 1, "as it was when it was read"
    reader.waiting.pop()()
    assert draft.advance()
    assert (_strokes(draft), reader.waiting, draft.advance()) == (2 * BARS + 2, [], False)


def test_a_fault_is_told_when_it_has_been_read_and_goes_when_it_is_mended(tmp_path: Path) -> None:
    reader = Later()
    draft = _draft(tmp_path, reader)
    draft.change(SetText(TEXT.replace("snare", "snair")))
    reader.waiting.pop()()
    assert draft.advance()
    assert draft.now.faults
    assert _strokes(draft) == 2 * BARS, "what could be read last goes on"
    draft.undo()
    reader.waiting.pop()()
    assert draft.advance()
    assert (draft.now.faults, draft.now.text) == ((), TEXT)


def test_without_a_reader_all_is_read_at_once(tmp_path: Path) -> None:
    draft = _draft(tmp_path, None)
    draft.change(SetStroke(SNARE, 100, PPQ, "o"))
    assert _strokes(draft) == 2 * BARS + 1
