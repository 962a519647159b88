"""The forty rudiments against the hand sequences of the PAS chart, typed in from it and not from the table.

Small letters are grace strokes, `>` follows an accent. Of rudiments that go on by themselves one round is given; of
those that a second bar leads from the left, the right-hand bar's first round.
"""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Piece
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.drills.rudiments import RUDIMENTS, Rudiment, find_rudiment, rudiment_lesson

PAS = {
    1: "RL",
    2: "RLRL",
    3: "RLRLRLR",
    4: "RL",
    5: "RRRLLL",
    6: "RRLL",
    7: "RRLLR>",
    8: "R>LLRRL>",
    9: "RRLLRRL>",
    10: "RRLLRRLLR>",
    11: "RRLLRRLLR>L>",
    12: "RRLLRRLLRRL>",
    13: "RRLLRRLLRRLLR>",
    14: "RRLLRRLLRRLLRRL>",
    15: "RRLLRRLLRRLLRRLLR>",
    16: "R>LRRL>RLL",
    17: "R>LRLRRL>RLRLL",
    18: "R>LRLRLRRL>RLRLRLL",
    19: "R>LRRLL",
    20: "lRrL",
    21: "lR>LRrL>RL",
    22: "lRRrLL",
    23: "lRL>RLlR",
    24: "lRLRRrLRLL",
    25: "lR>RLRrL>LRL",
    26: "lRLRRLLrLRLLRR",
    27: "lR>LRrL>",
    28: "lRRL",
    29: "lRLrLR",
    30: "lRLLRrLRRL",
    31: "llRrrL",
    32: "llRL>rrLR>",
    33: "llRllRL>rrLrrLR>",
    34: "llRLR>",
    35: "R>RLRRL>LRLL",
    36: "R>llRLRRL>rrLRLL",
    37: "R>llRllRLRRL>rrLrrLRLL",
    38: "llRLRL>rrLRLR>",
    39: "llRllRLRL>",
    40: "llRllRllRLRL>",
}

TITLES = """Single Stroke Roll, Single Stroke Four, Single Stroke Seven, Multiple Bounce Roll, Triple Stroke Roll,
Double Stroke Open Roll, Five Stroke Roll, Six Stroke Roll, Seven Stroke Roll, Nine Stroke Roll, Ten Stroke Roll,
Eleven Stroke Roll, Thirteen Stroke Roll, Fifteen Stroke Roll, Seventeen Stroke Roll, Single Paradiddle,
Double Paradiddle, Triple Paradiddle, Paradiddle-diddle, Flam, Flam Accent, Flam Tap, Flamacue, Flam Paradiddle,
Single Flammed Mill, Flam Paradiddle-diddle, Pataflafla, Swiss Army Triplet, Inverted Flam Tap, Flam Drag, Drag,
Single Drag Tap, Double Drag Tap, Lesson 25, Single Dragadiddle, Drag Paradiddle #1, Drag Paradiddle #2,
Single Ratamacue, Double Ratamacue, Triple Ratamacue"""


def spelt(lesson: Lesson) -> str:
    """The strokes in the order in which they sound, as the chart spells them."""
    score = lesson.score
    out = ""
    for i in np.argsort(score.onset_ns, kind="stable").tolist():
        note = score[i]
        letter = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}[note.limb]
        out += letter.lower() if note.lead_ms > 0 else letter
        out += ">" if note.dynamic is Dynamic.ACCENT else ""
    return out


@pytest.mark.parametrize("rudiment", RUDIMENTS, ids=lambda r: r.name)
def test_hands_and_accents_are_those_of_the_chart(rudiment: Rudiment) -> None:
    found = spelt(rudiment_lesson(rudiment))
    expected = PAS[rudiment.number]
    assert found.startswith(expected)
    assert rudiment.number == RUDIMENTS.index(rudiment) + 1


@pytest.mark.parametrize("rudiment", RUDIMENTS, ids=lambda r: r.name)
def test_the_loop_goes_on_where_it_began_or_is_led_by_the_left(rudiment: Rudiment) -> None:
    found, one = spelt(rudiment_lesson(rudiment)), PAS[rudiment.number]
    mirrored = one.translate(str.maketrans("RLrl", "LRlr"))
    rounds = len(found) // len(one)
    changes_hands = found.startswith(one + mirrored)
    by_bars = found in (one * rounds, (one * (rounds // 2)) + mirrored * (rounds // 2))
    alternating = found == ((one + mirrored) * rounds)[: len(found)]
    assert by_bars or (changes_hands and alternating), found


def test_names_and_order_are_those_of_the_chart() -> None:
    assert [r.title for r in RUDIMENTS] == [t.strip() for t in TITLES.replace("\n", " ").split(",")]


@pytest.mark.parametrize(("number", "ticks"), [(7, [0, 13440, 26880, 40320, 53760]), (21, [0, 0, 35840, 71680])])
def test_rhythm_by_hand(number: int, ticks: list[int]) -> None:
    """Five stroke: 32nds and an eighth's rest; flam accent: triplets, the grace on its main stroke's tick."""
    assert rudiment_lesson(RUDIMENTS[number - 1]).score.notes["tick"].tolist()[: len(ticks)] == ticks


def test_landing_strokes_are_on_the_beat() -> None:
    for number in (2, 3, 9, 10, 12, 13, 14, 15, 38, 39, 40):
        score = rudiment_lesson(RUDIMENTS[number - 1]).score
        accents = [n.tick for n in score if n.dynamic is Dynamic.ACCENT] or [score[len(score) - 1].tick]
        assert all(t % PPQ == 0 for t in accents), number


@pytest.mark.parametrize("tempo", [40, 55.5, 90])
def test_any_tempo(tempo: float) -> None:
    lesson = rudiment_lesson(find_rudiment("flam-tap"), tempo)
    assert lesson.beats_a_minute == tempo


def test_a_tempo_beyond_hands() -> None:
    with pytest.raises(BadInput, match="too fast"):
        rudiment_lesson(find_rudiment("single-stroke-roll"), 400)
    with pytest.raises(BadInput, match="expected a number"):
        rudiment_lesson(find_rudiment("single-stroke-roll"), 5)


def test_finding() -> None:
    assert find_rudiment("16").title == "Single Paradiddle"
    assert find_rudiment("Flam Tap").number == 22
    assert find_rudiment("drag-paradiddle-2").number == 37
    assert find_rudiment("Drag Paradiddle #2").number == 37
    with pytest.raises(BadInput, match="did you mean flam-tap"):
        find_rudiment("flamtap")
    with pytest.raises(BadInput, match="no such rudiment"):
        find_rudiment("41")


@pytest.mark.parametrize("rudiment", RUDIMENTS, ids=lambda r: r.name)
def test_each_ships_as_a_lesson_with_the_same_strokes(rudiment: Rudiment) -> None:
    shipped = find_lesson(rudiment.name)
    assert shipped.title == f"Rudiment {rudiment.number}: {rudiment.title}"
    assert spelt(shipped) == spelt(rudiment_lesson(rudiment))
    assert {n.piece for n in shipped.score} == {Piece.SNARE}


@pytest.mark.parametrize(("word", "title"), [("16", "Single Paradiddle"), ("Flam Tap", "Flam Tap")])
def test_a_rudiment_is_practised_by_its_number_or_title(word: str, title: str) -> None:
    assert find_lesson(word).title.endswith(f": {title}")
    with pytest.raises(BadInput, match="no such lesson"):
        find_lesson("41")


def test_the_multiple_bounce_roll_buzzes() -> None:
    assert {n.articulation for n in rudiment_lesson(RUDIMENTS[3]).score} == {Articulation.BUZZ}
