"""The editor without a window: what is opened, written, played, kept and saved. Texts are written by hand."""

from pathlib import Path

import pytest

from station.app.actions.editor_actions import (
    CloseEditor,
    CutSelection,
    DuplicateBars,
    Edit,
    NewLesson,
    OpenEditor,
    PasteBars,
    PutCursor,
    ResumeDraft,
    SaveLesson,
    SelectBars,
    Undo,
    WriteLetter,
)
from station.app.catalog import Catalog
from station.app.editor.draft_files import DraftFiles
from station.app.editor.lesson_editor import LessonEditor
from station.app.sessions.demo_drummer import DemonstratedLesson
from station.app.sessions.demo_player import DemoPlayer
from station.app.settings.settings_store import SettingsStore
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.settings import Settings, save_settings
from station.core.units import PPQ
from station.drills.editing.draft_records import change_record, start_record
from station.drills.editing.grid_cursor import BarRange, Cursor
from station.drills.editing.lesson_edits import LineAt, SetText
from station.drills.editing.text_change import change_between
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.motion.kit.kit import load_kit

HIHAT, SNARE, KICK = (LineAt(0, piece) for piece in (Piece.HIHAT, Piece.SNARE, Piece.KICK))


class Rehearsal:
    """The part of the sessions that the editor needs: a real player, and what was asked of it."""

    def __init__(self) -> None:
        self.player = DemoPlayer(lambda _: None, DemonstratedLesson(find_lesson("rock-1"), load_kit()))
        self.asked: list[tuple[Lesson | None, tuple[int, int] | None]] = []

    def rehearse(self, lesson: Lesson | None, bars: tuple[int, int] | None) -> None:
        self.asked.append((lesson, bars))


class Desk:
    def __init__(self, folder: Path) -> None:
        store = SettingsStore(save_settings(Settings(sessions=str(folder)), folder / "settings.toml"))
        self.said: list[str] = []
        self.lessons = store.now.own_lessons_dir
        self.files = DraftFiles(Catalog(store, find_lesson("rock-1"), self.said.append), store, self.said.append)
        self.sessions = Rehearsal()
        self.editor = LessonEditor(self.files, self.sessions, self.said.append)  # type: ignore[arg-type]

    @property
    def text(self) -> str:
        view = self.editor.view()
        assert view is not None
        return view.text


@pytest.fixture
def desk(tmp_path: Path) -> Desk:
    return Desk(tmp_path)


def test_a_shipped_lesson_is_edited_as_a_copy_that_plays_at_once(desk: Desk) -> None:
    desk.editor.act(OpenEditor("rock-1"))
    assert "a copy of" in desk.said[-1]
    desk.editor.act(PutCursor(Cursor(0, 0, PPQ, KICK)))
    desk.editor.act(WriteLetter("o"))
    before, after = (lesson for lesson, _ in desk.sessions.asked)
    assert before is not None
    assert after is not None
    assert len(after.score) == len(before.score) + 1
    desk.editor.act(SaveLesson())
    (path,) = desk.lessons.glob("*.toml")
    assert path.read_text(encoding="utf-8") == desk.text
    assert find_lesson("rock-1").text == before.text


def test_faults_keep_the_last_good_music_and_are_undone(desk: Desk) -> None:
    desk.editor.act(OpenEditor("rock-1"))
    good = desk.text
    desk.editor.act(Edit(SetText(good.replace("snare", "snair"))))
    view = desk.editor.view()
    assert view is not None
    assert not view.is_sound
    assert view.faults[0].line > 0
    assert view.lesson is desk.sessions.asked[-1][0], "what was heard goes on"
    desk.editor.act(Undo())
    assert desk.text == good


def test_selected_bars_are_repeated_copied_and_pasted(desk: Desk) -> None:
    desk.editor.act(OpenEditor("rock-1"))
    desk.editor.act(SelectBars(BarRange(0, 1, 1)))
    assert desk.sessions.asked[-1][1] == (2, 2)
    with pytest.raises(BadInput, match="nothing is copied"):
        desk.editor.act(PasteBars())
    desk.editor.act(DuplicateBars())
    view = desk.editor.view()
    assert view is not None
    assert view.page.grids[0].bar_count == 3


def test_what_was_cut_is_pasted_as_it_was_into_another_lesson_too(desk: Desk) -> None:
    desk.editor.act(OpenEditor("rock-1"))
    desk.editor.act(DuplicateBars())
    desk.editor.act(CutSelection())
    view = desk.editor.view()
    assert view is not None
    strokes = [cell.letter for line in view.page.grids[0].lines for cell in line.bars[0].cells if cell.letter != "-"]
    count = view.page.grids[0].bar_count
    desk.editor.act(NewLesson())
    desk.editor.act(PasteBars(inserts=True))
    after = desk.editor.view()
    assert after is not None
    lines = after.page.grids[0].lines
    assert [cell.letter for line in lines for cell in line.bars[0].cells if cell.letter != "-"] == strokes
    assert (count, after.page.grids[0].bar_count) == (2, 2)


def test_what_is_not_saved_is_kept_and_found_again(desk: Desk) -> None:
    desk.editor.act(NewLesson())
    desk.editor.act(WriteLetter("o"))
    text = desk.text
    desk.editor.act(CloseEditor())
    assert not desk.editor.is_open
    (left,) = desk.files.left
    desk.editor.act(ResumeDraft(left.path))
    assert desk.text == text
    desk.editor.act(SaveLesson("mine"))
    assert (desk.lessons / "mine.toml").read_text(encoding="utf-8") == text
    desk.editor.act(CloseEditor())
    assert desk.files.left == ()


def test_a_new_lesson_is_blank_until_something_stands_in_it(desk: Desk) -> None:
    """Then an empty bar is a fault: it was emptied, or other words were written."""
    desk.editor.act(NewLesson())
    blank = desk.editor.view()
    assert blank is not None
    assert blank.is_blank
    for edit in (WriteLetter("o"), Edit(SetText(blank.text.replace("New lesson", "Mine")))):
        desk.editor.act(edit)
        view = desk.editor.view()
        assert view is not None
        assert not view.is_blank


def test_a_letter_that_a_line_lacks_is_refused_in_a_sentence(desk: Desk) -> None:
    desk.editor.act(NewLesson())
    before = desk.text
    with pytest.raises(BadInput, match="no letter of this line"):
        desk.editor.act(WriteLetter("k"))
    assert desk.text == before


def test_strokes_under_hands_that_are_said_keep_the_lesson_sound(desk: Desk) -> None:
    desk.editor.act(NewLesson())
    hands = 'title = "H"\n\n[grid]\nhihat    = "| x-x- |"\nsnare    = "| -o-- |"\nsticking = "| RLR- |"\n'
    desk.editor.act(Edit(SetText(hands)))
    for tick, line, letter in ((0, SNARE, "o"), (PPQ, SNARE, "-"), (2 * PPQ, HIHAT, "-"), (3 * PPQ, SNARE, "o")):
        desk.editor.act(PutCursor(Cursor(0, 0, tick, line)))
        desk.editor.act(WriteLetter(letter))
        view = desk.editor.view()
        assert view is not None
        assert view.is_sound, (letter, view.text, view.faults)


def test_a_fault_that_remains_marks_its_cell(desk: Desk) -> None:
    desk.editor.act(NewLesson())
    desk.editor.act(Edit(SetText('title = "H"\n\n[grid]\nhihat = "| x--- |"\nride = "| x--- |"\n')))
    desk.editor.act(PutCursor(Cursor(0, 0, 0, SNARE)))
    desk.editor.act(WriteLetter("o"))
    view = desk.editor.view()
    assert view is not None
    assert [(cell.at.bar, cell.at.tick) for cell in view.fault_cells] == [(0, 0)]


def _left(desk: Desk, lesson: str, base: str, text: str) -> Path:
    """A journal that a crash left, of the file that it calls `lesson`."""
    path = desk.lessons / ".drafts" / "left.journal"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(start_record(lesson, base) + change_record(change_between(base, text), "stroke"))
    return path


def test_a_draft_that_was_left_is_not_taken_for_saved(desk: Desk) -> None:
    desk.lessons.mkdir(parents=True)
    file = desk.lessons / "mine.toml"
    file.write_text("title = 'A'\n", encoding="utf-8")
    desk.editor.act(ResumeDraft(_left(desk, str(file), "title = 'A'\n", "title = 'B'\n")))
    view = desk.editor.view()
    assert view is not None
    assert not view.is_saved
    desk.editor.act(SaveLesson(""))
    assert file.read_text(encoding="utf-8") == "title = 'B'\n"


@pytest.mark.parametrize("lesson", ["outside.txt", "../../outside.toml", "a\0b.toml", "x" * 5000 + ".toml"])
def test_a_journal_from_elsewhere_writes_over_nothing(desk: Desk, tmp_path: Path, lesson: str) -> None:
    victim = tmp_path / "outside.toml"
    victim.write_text("kept", encoding="utf-8")
    desk.editor.act(ResumeDraft(_left(desk, str(tmp_path / lesson), "title = 'A'\n", "title = 'B'\n")))
    desk.editor.act(SaveLesson(""))
    assert victim.read_text(encoding="utf-8") == "kept"
    (saved,) = desk.lessons.glob("*.toml")
    assert saved.read_text(encoding="utf-8") == "title = 'B'\n"


def test_half_a_letter_is_refused_with_its_line(desk: Desk) -> None:
    desk.editor.act(ResumeDraft(_left(desk, "", "title = 'A'\n", "title = 'A'\n# \ud800\n")))
    with pytest.raises(BadInput, match=r"line 2: U\+D800"):
        desk.editor.act(SaveLesson("mine"))
    assert list(desk.lessons.glob("*.toml")) == []
