"""Rolls and orchestrated rudiments: their speeds measured from the scores, their hands against stickings typed in here.

Speeds are those that part of the lessons' promise: open rolls at 7, 10 and 13 strokes a second, press rolls at six to
nine strokes of the hands.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import NS_PER_MS
from station.drills.lesson import Lesson
from station.drills.library import find_lesson
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note
from station.scoring.align import align
from tests.fakes.played import played

HANDS = {Limb.RIGHT_HAND: "R", Limb.LEFT_HAND: "L"}


def strokes(lesson: Lesson) -> list[Note]:
    """Main strokes of the hands by time."""
    return sorted((n for n in lesson.score if n.limb in HANDS and n.lead_ms <= 0), key=lambda n: n.tick)


def hands(lesson: Lesson) -> str:
    """Which hand plays each main stroke."""
    return "".join(HANDS[n.limb] for n in strokes(lesson))


def gaps_s(lesson: Lesson) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
    """Seconds from each main stroke to the next."""
    return np.diff([lesson.score.tempo_map.ns_at(n.tick) for n in strokes(lesson)]) / 1e9


@pytest.mark.parametrize(
    ("name", "rate_hz"),
    [
        ("check-and-roll", 7),
        ("roll-accents", 7),
        ("seven-stroke-pickup", 7),
        ("fifteen-stroke-pickup", 10),
        ("seven-stroke-pickup-fast", 13),
        *(
            (f"{name}{end}", hz)
            for name in ("long-roll", "roll-ladder")
            for end, hz in (("", 7), ("-medium", 10), ("-fast", 13))
        ),
    ],
)
def test_open_rolls_go_at_seven_ten_and_thirteen(name: str, rate_hz: float) -> None:
    lesson = find_lesson(name)
    assert 1 / gaps_s(lesson).min() == pytest.approx(rate_hz, rel=0.03)
    assert Ornament.ROLL in {n.ornament for n in strokes(lesson)}


@pytest.mark.parametrize("end", ["", "-medium", "-fast"])
def test_the_ladder_has_the_odd_rolls_in_order(end: str) -> None:
    """Strokes up to each accent; the last roll's release is accented, too."""
    lengths, run = [], 0
    for note in strokes(find_lesson(f"roll-ladder{end}")):
        run += 1
        if note.dynamic is Dynamic.ACCENT:
            lengths.append(run)
            run = 0
    assert lengths == [5, 5, 7, 9, 11, 13, 15, 17]
    assert run == 0


@pytest.mark.parametrize("name", ["press-roll-triplets", "press-roll-released", "open-to-closed"])
def test_press_rolls_go_at_six_to_nine_hand_strokes(name: str) -> None:
    """One written stroke for each motion of a hand, which lasts until the next: how often it bounces is not written."""
    lesson = find_lesson(name)
    presses = [n for n in strokes(lesson) if n.articulation is Articulation.BUZZ]
    times = [lesson.score.tempo_map.ns_at(n.tick) / 1e9 for n in presses]
    assert 6 <= 1 / min(np.diff(times)) <= 9
    assert min(np.diff(times)) * lesson.tempo_bpm / lesson.target_tempo_bpm >= 1 / 9
    assert {n.duration_ticks for n in presses} == {min(np.diff([n.tick for n in presses]))}


@pytest.mark.parametrize("name", ["singles-to-doubles", "singles-to-doubles-fast", "slow-doubles"])
def test_singles_and_doubles_are_one_even_row(name: str) -> None:
    gaps = gaps_s(find_lesson(name))
    assert gaps == pytest.approx(gaps[0])


@pytest.mark.parametrize("name", ["check-and-roll", "open-to-closed", "one-two-three-bounces"])
def test_the_hands_keep_their_motion(name: str) -> None:
    """Each motion takes an eighth, whatever it makes of it: where the other hand takes over, half a beat has passed."""
    lesson = find_lesson(name)
    notes = strokes(lesson)
    starts = [b.tick for a, b in pairwise(notes) if a.limb is not b.limb]
    assert set(np.diff(starts)) == {lesson.beat_ticks // 2}


ORCHESTRATED = {
    "paradiddle-toms": "RLRRLRLL",
    "inverted-paradiddle-groove": "RLLRLRRL",
    "paradiddle-ride-kick": "RLRRLRLL",
    "paradiddle-samba": "RLRRLRLL",
    "six-stroke-toms": "RLLRRL",
    "five-stroke-crash": "RRLLRLLRRL",
    "nine-stroke-toms": "RRLLRRLLRLLRRLLRRL",
    "single-stroke-four-kit": "RLRLRLRLLRLRLRLR",
    "flam-accents-over-toms": "RLRLRL",
    "flam-taps-wide": "RRLL",
    "ratamacue-kit": "RLRLLRLR",
    "paradiddle-diddle-ride": "RLRRLL",
    "double-paradiddle-six-eight": "RLRLRRLRLRLL",
    "lesson-25-street": "RLRRLRRLRRLRLRLLRLLRLLRL",
    "drag-paradiddle-groove": "RRRLRRLLLRLL",
    "dragadiddle-toms": "RRLRRLLRLL",
}


@pytest.mark.parametrize(("name", "sticking"), ORCHESTRATED.items())
def test_an_orchestrated_rudiment_is_still_the_rudiment(name: str, sticking: str) -> None:
    """Hands in the order of the strokes, whole rounds; grace strokes left out."""
    lesson = find_lesson(name)
    found = hands(lesson)
    assert found == sticking * (len(found) // len(sticking))
    assert len({n.piece for n in strokes(lesson)}) > (name != "lesson-25-street")


def test_the_swiss_fill_is_swiss_triplets() -> None:
    lesson = find_lesson("swiss-triplet-fill")
    fill = lesson.score.bars(3, 3)
    notes = sorted((n for n in fill if n.limb in HANDS and n.lead_ms <= 0), key=lambda n: n.tick)
    assert "".join(HANDS[n.limb] for n in notes) == "RRL" * 4
    assert [n.piece for n in notes[:3]] == [Piece.SNARE, Piece.FLOOR_TOM_1, Piece.TOM_1]
    assert [n.ornament is Ornament.FLAM for n in notes] == [True, False, False] * 4


@pytest.mark.parametrize("name", ["multiple-bounce-roll", "multiple-bounce-roll-fast", "press-roll-triplets"])
@pytest.mark.parametrize("every_ms", [25, 33])
@pytest.mark.parametrize("clocked", [True, False])
def test_bounces_of_a_press_roll_are_not_judged(name: str, every_ms: int, clocked: bool) -> None:
    """Two bounces after each press, on a kit that sends them all: every press is right and nothing is an extra."""
    score = find_lesson(name).score.repeated(8)
    hits = list(played(score, score.onset_s, np.arange(len(score))))
    presses = [h for h in hits if h.piece is Piece.SNARE]
    bounces = [
        replace(h, at_ns=h.at_ns + k * every_ms * NS_PER_MS, velocity=h.velocity // 2) for h in presses for k in (1, 2)
    ]
    alignment = align(score, Performance.from_hits([*hits, *bounces]), clocked)
    counted = {label: alignment.count(label) for label in Label if alignment.count(label)}
    assert counted == {Label.MATCH: len(score), Label.IGNORED: len(bounces)}


@pytest.mark.parametrize(
    ("name", "slow_hz", "fast_hz"),
    [
        ("open-close-open-singles", 4.0, 140 * 4 / 60),
        ("open-close-open-doubles", 4.0, 150 * 4 / 60),
        ("open-close-open-paradiddles", 4.0, 130 * 4 / 60),
    ],
)
def test_open_close_open_goes_there_and_back(name: str, slow_hz: float, fast_hz: float) -> None:
    """Strokes a second at both ends and at the top, half-way, and only rising before it and falling after it.

    A ramp goes by beats, each at the tempo of its middle: within 5 % at the slow end, whose sixteen beats are few.
    """
    gaps = gaps_s(find_lesson(name))
    top = len(gaps) // 2
    assert 1 / gaps[0] == pytest.approx(slow_hz, rel=0.05)
    assert 1 / gaps[-1] == pytest.approx(slow_hz, rel=0.05)
    assert 1 / gaps[top] == pytest.approx(fast_hz, rel=0.03)
    assert (np.diff(gaps[:top]) <= 2e-9).all()
    assert (np.diff(gaps[top + 1 :]) >= -2e-9).all()


@pytest.mark.parametrize("name", ["long-roll-swell", "long-roll-swell-fast", "press-roll-swell"])
def test_a_swell_grows_to_the_middle_and_fades(name: str) -> None:
    velocity = [n.velocity for n in strokes(find_lesson(name))]
    top = len(velocity) // 2
    assert all(a <= b for a, b in pairwise(velocity[: top + 1]))
    assert all(a >= b for a, b in pairwise(velocity[top:]))
    assert velocity[top] > 1.4 * velocity[0]  # p to f by the sticks' heights: the root of 9 inches over 3
    assert velocity[-1] == pytest.approx(velocity[0], abs=2)


@pytest.mark.parametrize(
    "name", ["thirteen-stroke-roll-fast", "fifteen-stroke-roll-fast", "seventeen-stroke-roll-fast"]
)
def test_a_fast_roll_grows_into_its_accent(name: str) -> None:
    notes = strokes(find_lesson(name))
    roll = [n.velocity for n in notes[: next(i for i, n in enumerate(notes) if n.dynamic is Dynamic.ACCENT)]]
    assert all(a <= b for a, b in pairwise(roll))
    assert roll[-1] > 1.4 * roll[0]


def test_a_soft_roll_is_as_soft_as_ghosts() -> None:
    notes = strokes(find_lesson("soft-roll"))
    assert {n.velocity for n in notes[:16]} == {80}
    assert {n.velocity for n in notes[16:]} == {32}


@pytest.mark.parametrize("name", ["swiss-triplet-fill", "paradiddle-toms", "six-stroke-toms", "single-stroke-four-kit"])
def test_what_ends_on_the_crash_says_so(name: str) -> None:
    landing = find_lesson(name).landing
    assert set(landing["piece"].tolist()) == {Piece.CRASH_1, Piece.KICK}
