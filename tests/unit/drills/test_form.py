"""What is played when: form, variations and endings; the order and the ticks worked out by hand."""

import time

import pytest

from station.core.pieces import Limb, Piece
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson
from tests.unit.drills.reading import QUARTER, WHOLE, faults

HEAD = 'title = "T"\ntempo_bpm = 60\n'
A, B = '[[grid]]\nname = "A"\nsnare = "o---"\n', '[[grid]]\nname = "B"\nkick = "--o-"\n'


def lesson(text: str) -> Lesson:
    reading = parse_lesson(HEAD + text, "test.toml", "test")
    assert reading.faults == []
    assert reading.lesson
    return reading.lesson


def bars_of(text: str) -> list[tuple[str, int, int]]:
    return [(s.name, s.first_bar + 1, s.last_bar + 1) for s in lesson(text).sections]


def ticks_of(text: str, piece: Piece = Piece.SNARE) -> list[int]:
    notes = lesson(text).score.notes
    return [int(tick) for tick in notes["tick"][notes["piece"] == piece]]


@pytest.mark.parametrize("form", ['["A", "B", "A", "A"]', '"A, B, A, A"', '" A,B ,A,A"'])
def test_the_form_says_what_is_played_when(form: str) -> None:
    text = f"form = {form}\n{A}{B}"
    assert bars_of(text) == [("A", 1, 1), ("B", 2, 2), ("A", 3, 3), ("A", 4, 4)]
    assert ticks_of(text) == [0, 2 * WHOLE, 3 * WHOLE]
    assert ticks_of(text, Piece.KICK) == [WHOLE + 2 * QUARTER]


def test_without_a_form_each_grid_is_played_as_often_as_it_says() -> None:
    assert bars_of(A + "times = 3\n" + B) == [("A", 1, 3), ("B", 4, 4)]


def test_the_loop_counts_bars_as_they_are_played() -> None:
    text = f'form = "A, B, A"\nloop = [2, 3]\n{A}{B}'
    assert lesson(text).loop_score.notes["piece"].tolist() == [Piece.KICK, Piece.SNARE]


# --- endings ----------------------------------------------------------------------------------------------------------

FIRST = '[[grid]]\nending = 1\nsnare = "-o--"\n'
SECOND = '[[grid]]\nending = 2\nname = "way out"\nsnare = "--o- | ---o"\n'


def test_endings_are_played_after_their_repetitions() -> None:
    """Bars: A, first ending, A, second ending (two bars), B."""
    text = A + FIRST + SECOND + B
    assert bars_of(text) == [("A", 1, 1), ("A, ending 1", 2, 2), ("A", 3, 3), ("way out", 4, 5), ("B", 6, 6)]
    assert ticks_of(text) == [
        0,
        WHOLE + QUARTER,
        2 * WHOLE,
        3 * WHOLE + 2 * QUARTER,
        4 * WHOLE + 3 * QUARTER,
    ]


def test_an_ending_may_serve_several_repetitions_and_others_have_none() -> None:
    """A, ending, A, A, ending, A: the third bar from the end has no ending after it."""
    text = A + "times = 4\n" + FIRST.replace("ending = 1", "ending = [1, 3]")
    assert ticks_of(text) == [0, WHOLE + QUARTER, 2 * WHOLE, 3 * WHOLE, 4 * WHOLE + QUARTER, 5 * WHOLE]


def test_endings_without_a_name_tell_which_they_are() -> None:
    text = A + "times = 4\n" + FIRST.replace("ending = 1", "ending = [1, 3]") + FIRST.replace("= 1", "= 2")
    assert [name for name, _, _ in bars_of(text)] == [
        *("A", "A, ending 1 and 3", "A", "A, ending 2"),
        *("A", "A, ending 1 and 3", "A"),
    ]


def test_the_form_plays_a_grid_with_its_endings() -> None:
    assert len(ticks_of(f'form = "A, B, A"\n{A}{FIRST}{B}')) == 2 * 2


def test_an_ending_of_an_unnamed_grid_has_no_name() -> None:
    assert bars_of(A.replace('name = "A"\n', "") + FIRST) == [("", 1, 1), ("", 2, 2)]


# --- variations -------------------------------------------------------------------------------------------------------

MODEL = """
[[grid]]
name = "A"
times = 2
tempo_bpm = 90
hihat = "xxxx"
snare = "-o-o"
right_hand.ride = "x---"
left_hand.tom_1 = "--o-"
"""


def test_a_variation_has_all_that_it_does_not_say() -> None:
    variation = '[[grid]]\nname = "A2"\nlike = "A"\nhihat = "----"\nright_hand.ride = "---x"\nkick = "o---"\n'
    found = lesson(MODEL + '[[grid]]\nname = "slow"\ntempo_bpm = 50\nsnare = "o"\n' + variation)
    assert [(s.name, s.first_bar + 1, s.last_bar + 1) for s in found.sections] == [
        ("A", 1, 2),
        ("slow", 3, 3),
        ("A2", 4, 5),
    ]
    bar = found.score.bars(3, 3)
    strokes = sorted((int(n.tick) // QUARTER, n.piece, n.limb) for n in bar)
    assert strokes == sorted(
        [
            (0, Piece.KICK, Limb.RIGHT_FOOT),
            (1, Piece.SNARE, Limb.UNKNOWN),
            (2, Piece.TOM_1, Limb.LEFT_HAND),
            (3, Piece.SNARE, Limb.UNKNOWN),
            (3, Piece.RIDE, Limb.RIGHT_HAND),
        ]
    )
    assert round(bar.tempo_map.bpm_at(0)) == 90  # as its model, not as the grid before it


def test_a_line_takes_the_place_of_its_model_by_whatever_name() -> None:
    text = '[[grid]]\nname = "A"\ncrash_1 = "x---"\n[[grid]]\nlike = "A"\ncrash = "--x-"\n'
    assert ticks_of(text, Piece.CRASH_1) == [0, WHOLE + 2 * QUARTER]


@pytest.mark.parametrize(
    ("model", "own", "limbs"),
    [
        ('hihat = "x---"', 'left_hand.hihat = "--x-"', [Limb.LEFT_HAND]),
        ('right_hand.hihat = "x---"\nleft_hand.hihat = "-x--"', 'hihat = "--x-"', [Limb.UNKNOWN]),
        ('right_hand.hihat = "x---"\nleft_hand.hihat = "-x--"', 'left_hand.hihat = "--x-"', None),
    ],
)
def test_a_line_of_a_limb_takes_the_place_of_its_pieces_line(model: str, own: str, limbs: list[Limb] | None) -> None:
    """The last keeps what the right hand does: the left hand's line alone is another."""
    found = lesson(f'[[grid]]\nname = "A"\n{model}\n[[grid]]\nlike = "A"\n{own}\n').score.bars(1, 1).notes
    expected = [(2, limb) for limb in limbs] if limbs else [(0, Limb.RIGHT_HAND), (2, Limb.LEFT_HAND)]
    assert [(int(n["tick"]) // QUARTER, n["limb"]) for n in found] == expected


def test_of_two_grids_with_one_name_nothing_else_is_told() -> None:
    (found,) = faults(HEAD + 'form = "A"\n' + A + A)
    assert (found.line, found.column) == (8, 8)
    assert "two grids are called A" in found.text


def test_a_variation_of_a_variation() -> None:
    text = A + '[[grid]]\nname = "B"\nlike = "A"\nkick = "-o--"\n[[grid]]\nlike = "B"\nsnare = "--o-"\n'
    assert ticks_of(text) == [0, WHOLE, 2 * WHOLE + 2 * QUARTER]
    assert ticks_of(text, Piece.KICK) == [WHOLE + QUARTER, 2 * WHOLE + QUARTER]


def test_an_ending_may_be_like_another_grid() -> None:
    assert ticks_of(A + '[[grid]]\nending = 1\nlike = "A"\nkick = "o"\n') == [0, WHOLE]


def test_endings_are_not_taken_over() -> None:
    assert ticks_of(A + FIRST + SECOND + '[[grid]]\nlike = "A"\n')[-1] == 5 * WHOLE


def test_a_fault_of_the_model_is_told_once_and_at_home() -> None:
    text = HEAD + A.replace("o---", "oq--") + '[[grid]]\nlike = "A"\nkick = "o---"\n[[grid]]\nlike = "A"\n'
    assert [(f.line, f.column) for f in faults(text)] == [(5, 11)]


def test_what_only_the_variation_makes_wrong_is_told_at_like() -> None:
    text = HEAD + A + '[[grid]]\nlike = "A"\nmeter = "3/4"\nkick = "o--"\n'
    (found,) = faults(text)
    assert (found.line, found.column) == (7, 8)
    assert "snare, as in A: " in found.text
    assert "3/4" in found.text


def test_an_unplayable_letter_is_blamed_once_however_often_it_is_played() -> None:
    grid = '[[grid]]\nname = "A"\ntimes = 3\nhihat = "x"\nsnare = "o"\ntom_1 = "o"\n'
    (found,) = faults(HEAD + 'form = "A, A, B"\n' + grid + '[[grid]]\nname = "B"\nlike = "A"\nkick = "o"\n')
    assert (found.line, found.column) == (9, 10)
    assert "3 hands needed at once" in found.text


@pytest.mark.parametrize(
    ("form", "played"),
    [
        ("A x3, B", "A1-3 B4-4"),
        ("(A, B) x2, A", "A1-1 B2-2 A3-3 B4-4 A5-5"),
        ("B, (A x2, B x2) x2", "B1-1 A2-3 B4-5 A6-7 B8-9"),
        ("(A, B)", "A1-1 B2-2"),
        ("A × 2, B", "A1-2 B3-3"),
    ],
)
def test_an_entry_or_a_group_may_be_played_several_times(form: str, played: str) -> None:
    sections = bars_of(f'form = "{form}"\n{A}{B}')
    assert " ".join(f"{name}{first}-{last}" for name, first, last in sections) == played


def test_a_grid_that_is_called_so_is_meant() -> None:
    text = 'form = "A, A x2, (A)"\n' + A + B.replace('"B"', '"A x2"') + B.replace('"B"', '"(A)"')
    assert [name for name, _, _ in bars_of(text)] == ["A", "A x2", "(A)"]


# --- faults -----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ('form = "A, C"\n' + A + B, 3, 12, "no such grid: C"),
        ('form = ["A", "Bb", "B"]\n' + A + B, 3, 14, "no such grid: Bb; did you mean B?"),
        ('form = "A, , B"\n' + A + B, 3, 8, "expected one line of text"),
        ("form = []\n" + A, 3, 8, "0 entries; expected 1 to 1000"),
        ('form = "A x0"\n' + A, 3, 8, "0 entries; expected 1 to 1000"),
        ('form = "(A, A x40) x40"\n' + A, 3, 8, "1640 entries; expected 1 to 1000"),
        ('form = "(A, B"\n' + A + B, 3, 8, "( before A is never closed"),
        ('form = "(A, C x2) x2"\n' + A + B, 3, 13, "no such grid: C"),
        ("form = 3\n" + A, 3, 8, 'expected a list such as ["A", "A", "B"], or "A, A, B", found 3'),
        ('form = ["A"]\n' + A + B, 8, 8, "never played; expected B in form"),
        ('form = ["A"]\n' + A + '[[grid]]\nsnare = "o"\n', 7, 1, "never played, for it has no name"),
        ('form = ["A", "B"]\n' + A + '[[grid]]\nname = "B"\nending = 1\nsnare = "o"\n', 3, 14, "B is an ending"),
        ('form = "A"\n[grid]\nsnare = "o"\n', 3, 9, "no grid has a name; expected name = …"),
        (A + A, 7, 8, "two grids are called A; expected another name"),
        ('[grid]\nending = 1\nsnare = "o"\n', 4, 10, "no grid before this one that it could end"),
        (A + FIRST + FIRST, 10, 10, "repetition 1 has an ending already"),
        (A + FIRST.replace("1", "[1, 1]"), 7, 10, "repetition 1 has an ending already"),
        (A + FIRST.replace("1", "[]"), 7, 10, "belongs to no repetition"),
        (A + FIRST.replace("1", "0"), 7, 10, "ending: expected a whole number from 1 to 100"),
        (A + FIRST.replace("1", '"1"'), 7, 10, "ending: expected a whole number from 1 to 100"),
        (A + "times = 2\n" + FIRST.replace("1", "3"), 8, 10, "played 2 times; there is no repetition 3"),
        (A + '[[grid]]\nlike = "B"\n' + B, 7, 8, "no such grid above: B; there is A"),
        (A + '[[grid]]\nname = "C"\nlike = "C"\n', 8, 8, "no such grid above: C"),
        ('[[grid]]\nlike = "A"\n', 4, 8, "no grid above has a name"),
        (A + "like = 7\n", 6, 8, "like: expected text in quotes"),
        (A + '[[grid]]\nendig = 1\nsnare = "o"\n', 7, 1, "no such line: endig; did you mean ending?"),
    ],
)
def test_faults_of_the_form(text: str, line: int, column: int, words: str) -> None:
    found = faults(HEAD + text)
    assert [(f.line, f.column) for f in found] == [(line, column)], found
    assert words in found[0].text


BAR, REST = "o" * 16, "-" * 256
ENDLESS = {
    "form": 'form = "' + ", ".join(["A"] * 1000) + f'"\n[[grid]]\nname = "A"\ntimes = 100\nsnare = "{BAR}"\n',
    "grids": "".join(f'[[grid]]\nname = "{i}"\ntimes = 100\nsnare = "-"\nkick = "-o--"\n' for i in range(100)),
    "variations": A + "".join(f'[[grid]]\nlike = "A"\ntimes = 100\nkick = "{BAR}"\n' for _ in range(100)),
    "lines": "".join("[[grid]]\n" + "".join(f'tom_{n} = "{REST} | %51"\n' for n in (1, 2, 3, 4)) for _ in range(38)),
    "cycles": "[[grid]]\nbars = 100\n" + f'[[grid.cycle]]\nmeter = "4/4"\nsnare = "{REST}"\n' * 100,
    "endings": A + "".join(f'[[grid]]\nending = {i}\ntimes = 100\nkick = "{BAR}"\n' for i in range(1, 101)),
}


@pytest.mark.parametrize("what", ENDLESS)
def test_more_than_anyone_practises_is_refused_at_once(what: str) -> None:
    """Less than a second of the processor's time, and of a slow one's three."""
    began_s = time.process_time()
    found = faults('title = "T"\ntempo_bpm = 20\n' + ENDLESS[what])
    assert "; a lesson has at most " in " ".join(f.text for f in found)
    assert time.process_time() - began_s < 3


def test_each_bar_knows_its_part_where_the_parts_have_names() -> None:
    """A, its two endings (the second of two bars, with a name of its own), B."""
    parts = lesson(A + FIRST + SECOND + B).part_of_bar
    assert parts == {0: "A", 1: "A, ending 1", 2: "A", 3: "way out", 4: "way out", 5: "B"}
    assert lesson(A + "times = 3\n").part_of_bar == {}
    assert lesson(A + '[[grid]]\nkick = "o"\n').part_of_bar == {0: "A"}
