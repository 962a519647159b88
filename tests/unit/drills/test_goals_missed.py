"""Goals of limbs and of bars: measured on strokes that are placed by hand, asked of results that are made by hand."""

import json
from collections.abc import Callable
from dataclasses import replace
from math import sqrt

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import NS_PER_MS, PPQ
from station.drills.lesson import BarGoals, Goals, PartGoals, Section
from station.drills.library import find_lesson
from station.drills.mastery.goals_missed import PassFault, missed_goals
from station.drills.mastery.mastery_json import from_json, to_json
from station.drills.mastery.pass_measures.asked_parts import AskedPart, Part, asked_parts, bars_called
from station.drills.mastery.pass_measures.part_facts import PartResult
from station.drills.mastery.pass_measures.pass_facts import PassResult, PassView, measure_pass
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from station.drills.mastery.verdict import Grade, judge
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.matching.hit_windows import Level
from tests.unit.drills.mastering import CLEAN

RIGHT = Part("right hand", limb=Limb.RIGHT_HAND)
LEFT = Part("left hand", limb=Limb.LEFT_HAND)
FILL = Part("fill (bar 2)", bars=(1, 1))


def eighths(bars: int = 2) -> Score:
    """Eighths on the snare at 60, hand to hand: a second's beat, 8 strokes a bar; the last of a bar is accented."""
    notes = [
        Note(i * PPQ // 2, Piece.SNARE, velocity=80, limb=Limb(i % 2))
        if i % 8 < 7
        else Note(i * PPQ // 2, Piece.SNARE, velocity=113, limb=Limb.LEFT_HAND, dynamic=Dynamic.ACCENT)
        for i in range(8 * bars)
    ]
    return Score.from_notes(notes, TempoMap.constant(60.0), 4 * PPQ * bars)


def measured(
    parts: tuple[Part, ...],
    off_ms: Callable[[int], float] = lambda i: 0.0,
    louder: Callable[[int], float] = lambda i: 1.0,
    missed: frozenset[int] = frozenset(),
    times: int = 1,
    hears_velocity: bool = True,
) -> PassResult:
    """Two bars of eighths, `times`, stroke i of them `off_ms(i)` late and so many times `louder`, some `missed`."""
    score = eighths().repeated(times)
    hits = np.zeros(len(score), HIT_DTYPE)
    hits["at_ns"] = score.onset_ns + np.array([round(off_ms(i % 16) * NS_PER_MS) for i in range(len(score))])
    hits["piece"], hits["openness"], hits["position"] = score.notes["piece"], np.nan, np.nan
    hits["velocity"] = [round(v * louder(i % 16)) for i, v in enumerate(score.notes["velocity"].tolist())]
    performance = Performance.from_array(hits[[i for i in range(len(score)) if i not in missed]])
    view = PassView(parts=parts, hears_velocity=hears_velocity)
    return measure_pass(score, performance, align(score, performance, clocked=True), [0, 1] * times, view)


# --- measures ---------------------------------------------------------------------------------------------------------


def test_each_hand_has_its_own_lean_and_spread() -> None:
    """The left hand is 12 ms late and swings ±8 about it: 8 strokes, squares 512, 7 free; the right is still."""
    result = measured((RIGHT, LEFT), lambda i: 0.0 if i % 2 == 0 else 12.0 + (8.0 if i % 4 == 1 else -8.0))
    right, left = result.parts
    assert (right.notes, right.right, right.lean_ms, right.sd_ms) == (8, 8, 0.0, 0.0)
    assert (left.notes, left.right) == (8, 8)
    assert left.lean_ms == pytest.approx(12.0)
    assert left.sd_ms == pytest.approx(sqrt(512 / 7), abs=1e-6)


def test_the_bars_have_theirs() -> None:
    result = measured((FILL,), lambda i: -15.0 if i >= 8 else 3.0, missed=frozenset({9, 10}))
    (fill,) = result.parts
    assert (fill.notes, fill.right, fill.lean_ms) == (8, 6, -15.0)
    assert fill.sd_ms == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(("a_beat_ms", "expected_pct"), [(-40.0, 100 / 0.96 - 100), (25.0, 100 / 1.025 - 100)])
@pytest.mark.parametrize("times", [1, 3])
def test_the_tempo_of_bars_is_told_from_the_slope(a_beat_ms: float, expected_pct: float, times: int) -> None:
    """A beat of 1000 ms played in 960 is a tempo 1/0.96 of what is written, as often as the bars come round."""
    result = measured((FILL,), lambda i: a_beat_ms * (i - 8) / 2 if i >= 8 else 0.0, times=times)
    assert result.parts[0].tempo_error_pct == pytest.approx(expected_pct, abs=1e-3)


def test_a_limb_has_no_tempo_of_its_own() -> None:
    assert measured((LEFT,)).parts[0].tempo_error_pct is None


def test_the_distance_from_the_written_loudness() -> None:
    """Beats 3 and 4 stand beside the accent: the pad's own level is that of the taps; the accent alone is soft.

    Half the velocity of 113, 56, is 40·log10(56/113) = −12.2 dB; of a bar's five judged strokes (the accent and four
    taps within two beats) one: 2.44 on average; bar 2's taps lie beside bar 1's accent, too: four more, so that bar 2
    has eight judged strokes, bar 1 five.
    """
    off_db = 40 * np.log10(56 / 113)
    result = measured((FILL, RIGHT), louder=lambda i: 56 / 113 if i == 15 else 1.0)
    assert result.parts[0].loudness_error_db == pytest.approx(abs(off_db) / 8, abs=1e-6)
    assert result.loudness_error_db == pytest.approx(abs(off_db) / 13, abs=1e-6)
    assert result.parts[1].loudness_error_db == pytest.approx(0.0)


def test_keys_have_no_loudness() -> None:
    result = measured((FILL,), hears_velocity=False)
    assert result.loudness_error_db is result.parts[0].loudness_error_db is None


# --- goals ------------------------------------------------------------------------------------------------------------


def asking(part: Part, **goals: float) -> Rules:
    return replace(DEFAULT_RULES, parts=(AskedPart(part, PartGoals(**goals)),))


@pytest.mark.parametrize(
    ("got", "goals", "fault", "sentence"),
    [
        (
            PartResult(LEFT, 20, 20, sd_ms=33.2),
            {"max_sd_ms": 25},
            "spread",
            "Your left hand spreads 33 ms; the goal is 25.",
        ),
        (
            PartResult(LEFT, 20, 17),
            {"min_accuracy": 0.9},
            "right",
            "Your left hand has 85 % of its notes right; the goal is 90.",
        ),
        (
            PartResult(RIGHT, 20, 20, lean_ms=-18.0),
            {"max_lean_ms": 12.5},
            "lean",
            "Your right hand is 18 ms early on average; the goal is 12.5.",
        ),
        (
            PartResult(FILL, 8, 8, tempo_error_pct=6.21),
            {"max_tempo_error_pct": 4},
            "tempo",
            "In fill (bar 2) you play 6.3 % faster than the click; the goal is 4.",
        ),
        (
            PartResult(FILL, 8, 8, tempo_error_pct=-6.2),
            {"max_tempo_error_pct": 4},
            "tempo",
            "In fill (bar 2) you play 6.2 % slower than the click; the goal is 4.",
        ),
        (
            PartResult(FILL, 8, 8, loudness_error_db=5.0),
            {"max_loudness_error_db": 3},
            "loudness",
            "In fill (bar 2) you are 5.0 dB off the written loudness on average; the goal is 3.",
        ),
    ],
)
def test_what_is_missed_is_said(got: PartResult, goals: dict[str, float], fault: str, sentence: str) -> None:
    rules = asking(got.part, **goals)
    (miss,) = missed_goals(replace(CLEAN, parts=(got,)), rules)
    assert (miss.fault, miss.part) == (fault, got.part)
    assert miss.sentence.startswith(sentence)
    verdict = judge(replace(CLEAN, parts=(got,)), rules)
    assert verdict.grade is Grade.BAD
    assert verdict.words.startswith(f"{got.part.name}: ")


def test_what_is_reached_or_unknown_is_not_missed() -> None:
    every = {
        "min_accuracy": 0.9,
        "max_sd_ms": 25,
        "max_lean_ms": 10,
        "max_loudness_error_db": 3,
        "max_tempo_error_pct": 4,
    }
    reached = PartResult(FILL, 10, 9, 25.0, -10.0, 3.0, -4.0)
    assert missed_goals(replace(CLEAN, parts=(reached,)), asking(FILL, **every)) == ()
    assert missed_goals(replace(CLEAN, parts=(PartResult(FILL, 0, 0),)), asking(FILL, **every)) == ()
    assert missed_goals(CLEAN, asking(FILL, **every)) == ()  # bars that this pass has not


def test_the_whole_comes_first() -> None:
    late = PartResult(LEFT, 20, 20, sd_ms=40.0)
    missed = missed_goals(replace(CLEAN, sd_ms=50.0, parts=(late,)), asking(LEFT, max_sd_ms=20))
    assert [(miss.fault, miss.part) for miss in missed] == [(PassFault.SPREAD, None), (PassFault.SPREAD, LEFT)]


def test_a_spread_of_slow_waits_is_loose_in_a_hand_too() -> None:
    """12 % of half a second is 60 ms."""
    rules = asking(LEFT, max_sd_ms=20)
    for sd_ms, grade in ((59.0, Grade.LOOSE), (61.0, Grade.BAD)):
        wide = replace(CLEAN, interval_ms=500.0, parts=(PartResult(LEFT, 20, 20, sd_ms=sd_ms),))
        assert judge(wide, rules).grade is grade


# --- a lesson's -------------------------------------------------------------------------------------------------------


def test_only_a_lesson_asks_of_parts() -> None:
    with pytest.raises(BadInput, match="no such rule"):
        DEFAULT_RULES.changed({"parts": []})


def test_what_a_part_came_to_survives_as_json() -> None:
    result = replace(CLEAN, parts=(PartResult(LEFT, 20, 18, sd_ms=12.5), PartResult(FILL, 8, 8, tempo_error_pct=-3.0)))
    assert from_json(PassResult, json.loads(json.dumps(to_json(result))), "here") == result


def test_a_lessons_parts() -> None:
    goals = Goals(
        limbs={Limb.LEFT_HAND: PartGoals(max_sd_ms=25.0), Limb.RIGHT_HAND: PartGoals(max_sd_ms=20.0)},
        bars=(BarGoals(1, 1, PartGoals(max_tempo_error_pct=3.0)),),
    )
    lesson = replace(find_lesson("rock-1"), goals=goals, sections=(Section("groove", 0, 0), Section("fill", 1, 1)))
    assert [each.part for each in asked_parts(lesson)] == [RIGHT, LEFT, FILL]
    assert DEFAULT_RULES.for_lesson(lesson, Level.BEGINNER).asked == (RIGHT, LEFT, FILL)


@pytest.mark.parametrize(
    ("bars", "said"), [((0, 0), "A (bar 1)"), ((2, 3), "bars 3–4"), ((1, 2), "bars 2–3"), ((4, 5), "A (bars 5–6)")]
)
def test_how_bars_are_called(bars: tuple[int, int], said: str) -> None:
    sections = (Section("A", 0, 1), Section("", 2, 3), Section("A", 4, 5))
    assert bars_called(*bars, sections) == said
