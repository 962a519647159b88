"""The forty rudiments at three levels against the PAS chart, typed in from it and not from the table.

`PAS` has a round led by the right hand: small letters are grace strokes, `>` follows an accent. Behind it stands the
time from each main stroke to the next, as a multiple of the shortest; the last one's may be longer, a rest follows.
Grace strokes take no time of their own.
"""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.rudiments import RUDIMENTS, ChartStroke, find_rudiment
from station.music.score import Note
from tests.shipped_lesson import shipped_lesson
from tools.rudiment_table import PAGE, first_round, page

PAS = {
    1: ("RLRLRLRL", "11111111"),
    2: ("RLRL", "1113"),
    3: ("RLRLRLR", "1111116"),
    4: ("RLRL", "1111"),
    5: ("RRRLLL", "111111"),
    6: ("RRLL", "1111"),
    7: ("RRLLR>", "11114"),
    8: ("R>LLRRL>", "211112"),
    9: ("RRLLRRL>", "1111112"),
    10: ("RRLLRRLLR>", "111111114"),
    11: ("RRLLRRLLR>L>", "1111111126"),
    12: ("RRLLRRLLRRL>", "11111111112"),
    13: ("RRLLRRLLRRLLR>", "1111111111114"),
    14: ("RRLLRRLLRRLLRRL>", "111111111111112"),
    15: ("RRLLRRLLRRLLRRLLR>", "11111111111111114"),
    16: ("R>LRR", "1111"),
    17: ("R>LRLRR", "111111"),
    18: ("R>LRLRLRR", "11111111"),
    19: ("R>LRRLL", "111111"),
    20: ("lRrL", "11"),
    21: ("lR>LR", "111"),
    22: ("lR>R", "11"),
    23: ("lRL>RLlR", "11114"),
    24: ("lR>LRR", "1111"),
    25: ("lR>RLR", "1111"),
    26: ("lR>LRRLL", "111111"),
    27: ("lR>LRrL>", "1111"),
    28: ("lR>RL", "111"),
    29: ("lR>L", "11"),
    30: ("lR>LLR", "2112"),
    31: ("llRrrL", "11"),
    32: ("llRL>", "11"),
    33: ("llRllRL>", "111"),
    34: ("llRLR>", "112"),
    35: ("R>RLRR", "11222"),
    36: ("R>llRLRR", "21111"),
    37: ("R>llRllRLRR", "221111"),
    38: ("llRLRL>", "1113"),
    39: ("llRllRLRL>", "31113"),
    40: ("llRllRllRLRL>", "331113"),
}

TITLES = """Single Stroke Roll, Single Stroke Four, Single Stroke Seven, Multiple Bounce Roll, Triple Stroke Roll,
Double Stroke Open Roll, Five Stroke Roll, Six Stroke Roll, Seven Stroke Roll, Nine Stroke Roll, Ten Stroke Roll,
Eleven Stroke Roll, Thirteen Stroke Roll, Fifteen Stroke Roll, Seventeen Stroke Roll, Single Paradiddle,
Double Paradiddle, Triple Paradiddle, Paradiddle-diddle, Flam, Flam Accent, Flam Tap, Flamacue, Flam Paradiddle,
Single Flammed Mill, Flam Paradiddle-diddle, Pataflafla, Swiss Army Triplet, Inverted Flam Tap, Flam Drag, Drag,
Single Drag Tap, Double Drag Tap, Lesson 25, Single Dragadiddle, Drag Paradiddle #1, Drag Paradiddle #2,
Single Ratamacue, Double Ratamacue, Triple Ratamacue"""

MIRROR = str.maketrans("RLrl", "LRlr")
SAME_LEAD = {2, 8, 9, 11, 12, 14, 19, 28, 34}
"""Rudiments whose next round is led by the same hand; of 16 and the like the second half is the mirrored round."""
WHOLE = {1, 4, 5, 6, 20, 27, 31}
"""Rudiments whose round as typed in simply goes round: it holds both hands' parts, or as 27 keeps its lead."""
OPEN_ROLLS = range(6, 16)
LEVELS = [(r.number, level, name) for r in RUDIMENTS for level, name in enumerate(r.lessons)]
each_lesson = pytest.mark.parametrize(("number", "level", "name"), LEVELS, ids=[name for *_, name in LEVELS])


def by_hand(lesson: Lesson) -> list[Note]:
    """Strokes of the hands in the order in which they sound."""
    score = lesson.score
    rows = [score[i] for i in np.argsort(score.onset_ns, kind="stable").tolist()]
    return [n for n in rows if n.limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND)]


def main(lesson: Lesson) -> list[Note]:
    """Strokes of the hands without grace strokes."""
    return [n for n in by_hand(lesson) if n.lead_ms <= 0]


def spelt(lesson: Lesson) -> str:
    """The strokes in the order in which they sound, as the chart spells them."""
    out = ""
    for note in by_hand(lesson):
        letter = "RL"[note.limb]
        out += letter.lower() if note.lead_ms > 0 else letter
        out += ">" if note.dynamic is Dynamic.ACCENT else ""
    return out


def leads(lesson: Lesson, one: str) -> str:
    """Which hand leads each round, R or L; fails where the lesson is anything but whole rounds."""
    rest, hands = spelt(lesson), ""
    while rest:
        lead = next(hand for hand, said in (("R", one), ("L", one.translate(MIRROR))) if rest.startswith(said))
        hands, rest = hands + lead, rest[len(one) :]
    return hands


@each_lesson
def test_hands_graces_and_accents_are_those_of_the_chart(number: int, level: int, name: str) -> None:
    hands = leads(shipped_lesson(name), PAS[number][0])
    first = "L" if level == 1 and number not in SAME_LEAD else "R"
    if number in WHOLE:
        assert set(hands) == {first}
    elif number in SAME_LEAD:
        half = len(hands) // 2
        assert hands == "R" * half + "L" * half
    else:
        assert hands == (first + first.translate(MIRROR)) * (len(hands) // 2)


@each_lesson
def test_the_rhythm_is_the_charts(number: int, level: int, name: str) -> None:
    strokes, times = PAS[number][0], [int(t) for t in PAS[number][1]]
    ticks = [n.tick for n in main(shipped_lesson(name))]
    ends = [*ticks[1:], shipped_lesson(name).score.end_tick]
    lasts = [b - a for a, b in zip(ticks, ends, strict=True)]
    assert len(times) == sum(c.isupper() for c in strokes)
    shortest = lasts[times.index(1)]
    for start in range(0, len(lasts), len(times)):
        found = [Fraction(t, shortest) for t in lasts[start : start + len(times)]]
        assert found[:-1] == times[:-1]
        assert found[-1] >= times[-1] if name.endswith(("roll", "roll-medium", "roll-fast")) else found[-1] == times[-1]


@pytest.mark.parametrize("number", list(PAS))
def test_the_table_is_the_chart(number: int) -> None:
    """The table that code and page use, against the transcription."""
    row = RUDIMENTS[number - 1]
    times = [s.quarters for s in row.chart]
    assert row.strokes.replace(" ", "") == PAS[number][0]
    assert [t / min(times) for t in times] == [int(t) for t in PAS[number][1]]


def test_a_chart_stroke_by_hand() -> None:
    first, *_, last = find_rudiment("lesson-25").chart
    assert first == ChartStroke("R", 2, False, Fraction(1, 4))
    assert last == ChartStroke("R", 0, True, Fraction(1, 2))
    assert [s.quarters for s in find_rudiment("2").chart] == [Fraction(1, 6)] * 3 + [Fraction(1, 2)]


def test_names_and_order_are_those_of_the_chart() -> None:
    assert [r.title for r in RUDIMENTS] == [t.strip() for t in TITLES.replace("\n", " ").split(",")]
    assert [r.number for r in RUDIMENTS] == list(PAS)


@pytest.mark.parametrize("number", OPEN_ROLLS)
@pytest.mark.parametrize(("level", "rate_hz"), [(0, 7), (1, 10), (2, 13)])
def test_open_rolls_go_at_seven_ten_and_thirteen(number: int, level: int, rate_hz: float) -> None:
    """Measured from the moments of the strokes: within the roll the shortest and the median gap."""
    lesson = shipped_lesson(RUDIMENTS[number - 1].lessons[level])
    gaps_s = np.diff(np.unique([lesson.score.tempo_map.ns_at(n.tick) for n in main(lesson)])) / 1e9
    assert 1 / gaps_s.min() == pytest.approx(rate_hz, rel=0.03)
    assert 1 / np.median(gaps_s) == pytest.approx(rate_hz, rel=0.03)
    assert {n.ornament for n in main(lesson) if n.dynamic is Dynamic.NORMAL} == {Ornament.ROLL}


@pytest.mark.parametrize("name", find_rudiment("4").lessons)
def test_the_multiple_bounce_roll_buzzes_at_six_to_nine(name: str) -> None:
    lesson = shipped_lesson(name)
    notes = main(lesson)
    assert {n.articulation for n in notes} == {Articulation.BUZZ}
    a_second = lesson.tempo_bpm / 60 * PPQ / (notes[1].tick - notes[0].tick)
    assert 6 <= a_second <= 9
    assert a_second * lesson.target_tempo_bpm / lesson.tempo_bpm <= 9
    assert {n.duration_ticks for n in notes} == {notes[1].tick - notes[0].tick}  # one runs into the next


@pytest.mark.parametrize(
    ("number", "beats"),
    [(2, {2, 4}), (3, {2, 4}), (7, {2, 4}), (10, {3}), (11, {3, 3.5}), (12, {3.5}), (13, {4}), (38, {2, 4}), (40, {4})],
)
def test_where_the_release_falls(number: int, beats: set[float]) -> None:
    """Beats of the bar, counted from 1; of 2 and 3, which have no accents, the strokes before a rest."""
    for name in RUDIMENTS[number - 1].lessons:
        lesson = shipped_lesson(name)
        loud = [n.tick for n in main(lesson) if n.dynamic is Dynamic.ACCENT]
        ticks = [n.tick for n in main(lesson)]
        longest = [a for a, b in pairwise([*ticks, lesson.score.end_tick]) if b - a == PPQ]
        assert {1 + (t % (4 * PPQ)) / PPQ for t in loud or longest} == beats


@each_lesson
def test_a_level_adds_tempo_and_feet(number: int, level: int, name: str) -> None:
    lesson, row = shipped_lesson(name), RUDIMENTS[number - 1]
    assert lesson.title == f"Rudiment {number}: {row.title}" + ("", ", medium", ", fast")[level]
    assert {n.piece for n in by_hand(lesson)} == {Piece.SNARE}
    feet = {n.piece for n in lesson.score} - {Piece.SNARE}
    assert feet == (set(), {Piece.HIHAT_PEDAL}, {Piece.HIHAT_PEDAL, Piece.KICK})[level]
    assert lesson.target_tempo_bpm > lesson.tempo_bpm
    if level:
        slower = shipped_lesson(row.lessons[level - 1])
        assert slower.level <= lesson.level
        assert slower.about != lesson.about
        pace = [x.tempo_bpm / min(np.diff([n.tick for n in main(x)])) for x in (slower, lesson)]
        assert pace[0] * slower.target_tempo_bpm / slower.tempo_bpm < pace[1]


@pytest.mark.parametrize("number", list(PAS))
def test_grace_strokes_are_the_hands_own(number: int) -> None:
    """Flams 15–40 ms before, a drag's strokes 40–70 ms apart (players' practice), at every level."""
    for name in RUDIMENTS[number - 1].lessons:
        leads_ms = {n.lead_ms for n in by_hand(shipped_lesson(name)) if n.lead_ms > 0}
        said = PAS[number][0]
        if "ll" in said:
            (near, far) = sorted(leads_ms)
            assert 40 <= near <= 70
            assert 40 <= far - near <= 70
        elif "l" in said:
            assert all(15 <= ms <= 40 for ms in leads_ms)
            assert leads_ms
        else:
            assert not leads_ms


def test_the_page_is_up_to_date() -> None:
    assert PAGE.read_text(encoding="utf-8") == page()


def test_the_page_says_what_a_lesson_plays() -> None:
    """Drag paradiddle #1 by hand: an accented eighth, then four sixteenths in 6/8, the first with a drag."""
    ours = first_round(shipped_lesson("drag-paradiddle-1"), 5)
    assert [(s.hand, s.graces, s.accented) for s in ours] == [
        ("R", 0, True),
        ("R", 2, False),
        ("L", 0, False),
        ("R", 0, False),
        ("R", 0, False),
    ]
    assert [s.quarters for s in ours] == [Fraction(1, 2)] + [Fraction(1, 4)] * 4


def test_finding() -> None:
    assert find_rudiment("16").title == "Single Paradiddle"
    assert find_rudiment("Flam Tap").number == 22
    assert find_rudiment("drag-paradiddle-2").number == 37
    assert find_rudiment("Drag Paradiddle #2").number == 37
    with pytest.raises(BadInput, match="did you mean flam-tap"):
        find_rudiment("flamtap")
    with pytest.raises(BadInput, match="no such rudiment"):
        find_rudiment("41")


@pytest.mark.parametrize(("word", "title"), [("16", "Single Paradiddle"), ("Flam Tap", "Flam Tap")])
def test_a_rudiment_is_practised_by_its_number_or_title(word: str, title: str) -> None:
    assert shipped_lesson(word).title.endswith(f": {title}")
    with pytest.raises(BadInput, match="no such lesson"):
        shipped_lesson("41")
