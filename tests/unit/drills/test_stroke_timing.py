"""`[grid.timing]`: how a groove was played, in milliseconds; onsets by hand, at 120 beats a minute 500 ms apart."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.pieces import Limb, Ornament, Piece
from station.core.units import NS_PER_MS, PPQ
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.drills.writing.lesson_text import show
from station.drills.writing.lesson_writer import as_written
from station.practice.session.plan import PlanOptions, plan_practice

HEAD = 'title = "T"\ntempo_bpm = 120\n'


def _lesson(text: str) -> Lesson:
    found = parse_lesson(HEAD + text, "t.toml", "t")
    assert found.lesson is not None, [str(fault) for fault in found.faults]
    return found.lesson


def _faults(text: str) -> list[str]:
    return [str(fault) for fault in parse_lesson(HEAD + text, "t.toml", "t").faults]


def _onsets_ms(lesson: Lesson, piece: Piece = Piece.SNARE) -> list[float]:
    score = lesson.score
    return [float(ns) / NS_PER_MS for ns in score.onset_ns[score.notes["piece"] == piece]]


def test_a_stroke_sounds_so_much_later_than_its_cell_or_earlier() -> None:
    lesson = _lesson('[grid]\nsnare = "o-oo"\ntiming.snare = [-20, 0, 7.5]\n')
    assert _onsets_ms(lesson) == [-20, 1000, 1507.5]
    assert [note.tick for note in lesson.score] == [0, 2 * PPQ, 3 * PPQ]  # notation keeps its place


def test_a_bar_that_repeats_another_has_a_timing_of_its_own() -> None:
    lesson = _lesson('[grid]\nsnare = "| o-o- | % |"\n[grid.timing]\nsnare = [1, 2, 3, 4]\n')
    assert _onsets_ms(lesson) == [1, 1002, 2003, 3004]


def test_every_repetition_of_a_grid_is_played_alike() -> None:
    lesson = _lesson('[grid]\ntimes = 2\nsnare = "o---"\ntiming.snare = [-5]\n')
    assert _onsets_ms(lesson) == [-5, 1995]


def test_grace_strokes_and_diddles_move_with_their_letter() -> None:
    lesson = _lesson('[grid]\nsnare = "-ft-"\ntiming.snare = [10, -10]\n')
    assert _onsets_ms(lesson) == [480, 510, 990, 1240]  # the flam 30 ms before its note, the diddle in its cell of 500
    assert [note.ornament for note in lesson.score][2:] == [Ornament.DIDDLE] * 2


def test_lines_of_limbs_and_other_names_of_a_line() -> None:
    lesson = _lesson(
        '[grid]\nleft_hand.snare = "o---"\ncrash = "-x--"\nkick = "--o-"\n'
        "[grid.timing]\nleft_hand.snare = [3]\ncrash_1 = [4]\nright_foot.kick = [5]\n"
    )
    assert [(note.piece, note.late_ms) for note in lesson.score] == [
        (Piece.SNARE, 3),
        (Piece.CRASH_1, 4),
        (Piece.KICK, 5),
    ]
    assert lesson.score[0].limb is Limb.LEFT_HAND


@pytest.mark.parametrize(
    ("timing", "fault"),
    [
        ("timing.snare = [1]", "line 5, column 16: grid.timing.snare: 1 number, but snare has 2 strokes"),
        ("timing.snare = [1, 2, 3]", "line 5, column 23: grid.timing.snare: 3 numbers, but snare has 2 strokes"),
        ("timing.snare = [1, 61]", "line 5, column 20: grid.timing.snare: expected a number from -60 to 60, found 61"),
        ("timing.snare = [1, nan]", "line 5, column 20: grid.timing.snare: expected a number from -60 to 60"),
        ("timing.snare = 3", "line 5, column 16: grid.timing.snare: expected milliseconds such as [0, -12, 8]"),
        ("timing.kick = [1]", "line 5, column 1: the grid has no line kick whose timing this could be"),
        ("timing.left_hand.snare = [1, 2]", "line 5, column 1: the grid has no line left_hand.snare"),
        ("timing.snair = [1, 2]", "line 5, column 1: no such line: snair; did you mean snare"),
        ("timing = 3", "line 5, column 10"),
    ],
)
def test_faults_have_their_line_and_column(timing: str, fault: str) -> None:
    (told,) = _faults(f'[grid]\nsnare = "o-o-"\n{timing}\n')
    assert told.startswith(f"t.toml: {fault}")


def test_a_line_with_a_fault_is_not_counted() -> None:
    (told,) = _faults('[grid]\nsnare = "o-?-"\ntiming.snare = [1]\n')
    assert "?" in told


def test_a_variation_takes_timing_over_with_its_line() -> None:
    text = """[[grid]]
name = "A"
snare = "o-o-"
kick = "-o-o"
[grid.timing]
snare = [1, 2]
kick = [3, 4]
[[grid]]
like = "A"
snare = "o---"
[[grid]]
like = "A"
timing.kick = [7, 8]
"""
    lesson = _lesson(text)
    assert _onsets_ms(lesson) == [1, 1002, 2000, 4001, 5002]
    assert _onsets_ms(lesson, Piece.KICK) == [503, 1504, 2503, 3504, 4507, 5508]


def test_what_a_variation_says_of_a_line_that_it_took_over_is_told_there() -> None:
    text = '[[grid]]\nname = "A"\nsnare = "o-o-"\n[[grid]]\nlike = "A"\ntiming.snare = [7]\n'
    (told,) = _faults(text)
    assert told.startswith("t.toml: line 8, column 16: ")


def test_a_lesson_without_text_is_written_with_its_timing() -> None:
    text = '[grid]\nhihat = "| x-x- | xxxx |"\nleft_hand.snare = "| -o-f | % |"\n'
    timing = "[grid.timing]\nhihat = [0, 0, 1, -2, 3, -4]\nleft_hand.snare = [-20.5, 0, 1.3, 2]\n"
    lesson = _lesson((text + timing).replace("xxxx", "x-x-").replace("1, -2, 3, -4", "1, -2"))
    again = as_written(replace(lesson, text=""))
    assert again.score.onset_ns.tolist() == lesson.score.onset_ns.tolist()
    assert "timing.left_hand.snare = [-20.5, 0, 1.3, 2]" in again.text or "timing.snare" in again.text


def test_show_leaves_timing_as_it_is() -> None:
    text = f'{HEAD}\n[grid]\nsnare = "o-o-"\n[grid.timing]\nsnare = [ 1,2 ] # late\n'
    assert "snare = [ 1,2 ] # late" in show(text)
    assert show(show(text)) == show(text)


# --- practised --------------------------------------------------------------------------------------------------------


def test_timing_stays_in_milliseconds_at_every_speed_and_in_every_pass() -> None:
    """The first stroke 20 ms early, at half the speed, over two passes of a bar that lasts four seconds then."""
    lesson = _lesson('[grid]\nsnare = "o-o-"\ntiming.snare = [-20, 5]\n')
    plan = plan_practice(lesson, PlanOptions(tempo_bpm=60.0, loops=2, guide=True, demonstrations=1, click=None))
    assert (plan.score.onset_ns / NS_PER_MS).tolist() == [-20, 2005, 3980, 6005]
    strokes = plan.cues[plan.cues["bus"] == 1]
    at_ms = ((strokes["at_ns"] - plan.passes_start_ns) / NS_PER_MS).tolist()
    assert at_ms[-4:] == [-20, 2005, 3980, 6005]


def test_bars_and_repetitions_keep_it() -> None:
    score = _lesson('[grid]\nsnare = "| o-o- | o--- |"\ntiming.snare = [0, 0, -20]\n').score
    assert (score.bars(1, 1).onset_ns / NS_PER_MS).tolist() == [-20]  # an early first stroke belongs to its own bar
    assert (score.repeated(2).onset_ns / NS_PER_MS).tolist() == [0, 1000, 1980, 4000, 5000, 5980]
    assert (score.at_speed(2.0).onset_ns / NS_PER_MS).tolist() == [0, 500, 980]
    assert (score.on_the_grid.onset_ns / NS_PER_MS).tolist() == [0, 1000, 2000]
    assert np.array_equal(score.on_the_grid.notes["tick"], score.notes["tick"])
