"""The history against a plain list of texts, which keeps everything and knows nothing of changes."""

import tracemalloc
from random import Random

from station.core.pieces import Limb, Piece
from station.drills.editing.edit_history import EditHistory
from station.drills.editing.edit_words import edit_words
from station.drills.editing.lesson_edits import (
    AddBars,
    CopyBars,
    CutBeat,
    LineAt,
    PlayIn,
    RemoveLine,
    SetKey,
    SetSign,
    SetStroke,
    SetText,
    TextLine,
)
from station.drills.editing.text_change import TextChange, change_between

LESSON = 'title = "Grüße"\n\n[grid]\n' + "".join(f'line_{i} = "| o--- o--- o--- o--- |"\n' for i in range(500))


def _edited(text: str, random: Random) -> str:
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(["", "x", "o" * 40, "é\n"]) + text[at + random.randrange(6) :]


def test_a_change_is_what_lies_between_the_common_ends() -> None:
    assert change_between("o---o---", "o-x-o---") == TextChange(2, "-", "x")
    assert change_between("abc", "abc") == TextChange(3, "", "")
    assert change_between("aa", "aaa") == TextChange(2, "", "a")  # the end never reaches over the beginning
    assert change_between("", "new") == TextChange(0, "", "new")


def test_any_change_leads_there_and_back() -> None:
    random = Random(5)
    for _ in range(300):
        before = "".join(random.choice("ab") for _ in range(random.randrange(12)))
        after = "".join(random.choice("ab") for _ in range(random.randrange(12)))
        change = change_between(before, after)
        assert change.applied(before) == after
        assert change.undone.applied(after) == before


def test_a_change_fits_its_own_text_alone() -> None:
    assert not TextChange(2, "x", "").fits("ab")
    assert not TextChange(9, "", "x").fits("ab")
    assert not TextChange(-1, "b", "x").fits("ab")
    assert TextChange(2, "", "x").fits("ab")


def test_undo_and_redo_walk_over_every_text() -> None:
    random, texts = Random(1), [LESSON]
    history = EditHistory(LESSON)
    for i in range(300):
        text = texts[-1] if not i % 50 else LESSON[: random.randrange(9)] if not i % 7 else _edited(texts[-1], random)
        history = history.edited(text, f"step {i}")
        texts += [text] * (text != texts[-1])
    for _ in range(2):
        for text in reversed(texts[:-1]):
            history = history.undone()
            assert history.text == text
        assert history.undo_name is None
        assert history.undone() is history
        for text in texts[1:]:
            history = history.redone()
            assert history.text == text
        assert history.redo_name is None
        assert history.redone() is history


def test_each_step_has_its_name_and_an_edit_forgets_what_was_undone() -> None:
    one = EditHistory("a").edited("ab", "first").edited("abc", "second")
    assert (one.undo_name, one.redo_name) == ("second", None)
    back = one.undone()
    assert (back.text, back.undo_name, back.redo_name) == ("ab", "first", "second")
    other = back.edited("abx", "third")
    assert (other.undo_name, other.redo_name) == ("third", None)
    assert other.undone().undone().text == "a"
    assert one.text == "abc"  # a value: what was, stays


def test_steps_of_one_name_join_where_they_are_asked_to() -> None:
    typed = EditHistory("").edited("t", "typed", joins=True).edited("ti", "typed", joins=True)
    assert typed.undone().text == ""
    assert typed.edited("tie", "typed").undone().text == "ti"
    assert typed.edited("tie", "other", joins=True).undone().text == "ti"
    after_undo = EditHistory("").edited("a", "typed").edited("ab", "typed").undone()
    assert after_undo.edited("ax", "typed", joins=True).undone().text == "a"  # what was undone is no beginning


def test_a_step_takes_little_memory() -> None:
    """2,000 steps of a lesson of 20 kB, a tenth of which write all of it anew: 100,000 must stay below 200 MB."""
    assert len(LESSON) > 17_000
    random, text, history = Random(2), LESSON, EditHistory(LESSON)
    tracemalloc.start()
    for i in range(2000):
        text = (
            text.replace("o", "x") if i % 20 == 10 else text.replace("x", "o") if i % 20 == 0 else _edited(text, random)
        )
        history = history.edited(text, f"stroke on snare, bar {i}")
    used, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert history.text == text
    assert used / 2000 < 2000


def test_an_edit_is_called_what_a_drummer_would_call_it() -> None:
    snare = LineAt(0, Piece.SNARE)
    assert edit_words(SetStroke(snare, 1, 480, "o")) == "stroke on snare, bar 2"
    assert edit_words(SetStroke(snare, 0, 0, "-")) == "stroke erased on snare, bar 1"
    assert edit_words(SetSign(0, TextLine.STICKING, 0, 0, "R")) == "sticking R, bar 1"
    assert edit_words(CutBeat(0, 2, 1, 3)) == "beat 2 in 3, bar 3"
    assert edit_words(RemoveLine(LineAt(0, Piece.HIHAT, Limb.LEFT_HAND), 0)) == "line of hi-hat, left hand removed"
    assert edit_words(AddBars(0, 1)) == "bar 2 added"
    assert edit_words(CopyBars(0, 0, 1, 0, 2)) == "bars 1 to 2 copied"
    assert edit_words(SetKey(("grid", 1, "times"), 3)) == "times set"
    assert edit_words(SetKey(("goals", "level"), None)) == "level removed"
    assert edit_words(PlayIn(0, 0, 3, ())) == "played in, bars 1 to 4"
    assert edit_words(SetText("x")) == "typed"
