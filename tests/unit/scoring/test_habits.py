"""Habits told apart: shifts and levels of known size put into a noisy performance, found again with their intervals.

The noise is made here, independent of the regression: normal, with a part that all strokes of a slot share and that
fades from slot to slot. What goes in is what must come out.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music import passages
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.error_rates import wilson
from station.scoring.analysis.habits import habits
from station.scoring.analysis.points import Feel
from station.scoring.analysis.summary import Summary, SummaryView, summarise
from station.scoring.report.advice import Advice, advise
from tests.fakes.answers import Played, take
from tests.fakes.scores import beat_and_fill, double_strokes, flams, rock_beat, swing_ride

Floats = NDArray[np.float64]


def noise_ms(score: Score, seed: int, sd_ms: float = 10.0) -> Floats:
    """Noise of every stroke: two thirds of its variance shared within a slot, fading by a half from slot to slot."""
    rng = np.random.default_rng(seed)
    ticks, slot = np.unique(score.notes["tick"], return_inverse=True)
    shared = np.zeros(len(ticks))
    for k in range(len(ticks)):
        shared[k] = 0.5 * shared[k - 1] + 0.75**0.5 * rng.normal() if k else rng.normal()
    mixed: Floats = sd_ms * ((2 / 3) ** 0.5 * shared[slot] + (1 / 3) ** 0.5 * rng.normal(size=len(score)))
    return mixed


def performed(
    score: Score,
    seed: int = 1,
    shift_ms: Floats | float = 0.0,
    level_db: Floats | float = 0.0,
    view: SummaryView | None = None,
) -> Summary:
    rng = np.random.default_rng(1000 + seed)
    hits = np.zeros(len(score), HIT_DTYPE)
    hits["limb"] = Limb.UNKNOWN
    hits["at_ns"] = score.onset_ns + np.rint((noise_ms(score, seed) + shift_ms) * NS_PER_MS).astype(np.int64)
    hits["piece"] = score.notes["piece"]
    loud = score.notes["velocity"] * 10 ** (np.asarray(level_db) / 40) * (1 + 0.06 * rng.normal(size=len(score)))
    hits["velocity"] = np.clip(np.rint(loud), 1, 127)
    performance = Performance.from_array(hits)
    return summarise(score, performance, align(score, performance, clocked=True), view)


def test_levels_are_heard_as_finely_as_they_were_sent() -> None:
    """The left hand at 79.5, the right at 80: 40·log10(79.5/80) = −0.109 dB; half a step too soft in half the notes."""
    left = HANDS.notes["limb"] == Limb.LEFT_HAND
    played = take(HANDS, Played(velocity=np.where(left, 79.5, 80)))
    found = summarise(played.score, played.performance, played.alignment)
    assert found.habits.effects["left_level"].value == pytest.approx(-0.109, abs=1e-3)
    assert found.by_piece[Piece.SNARE].velocity_error == pytest.approx(-0.25)


def first(advice: tuple[Advice, ...]) -> str | None:
    return advice[0].fault if advice else None


ROCK, FILL, DOUBLES, FLAMS = rock_beat(16), beat_and_fill(8), double_strokes(16), flams(16)
SWING, HANDS = swing_ride(16), double_strokes(16)
PLANTED = [
    ("late_kick", ROCK, "kick", 40.0 * (ROCK.notes["piece"] == Piece.KICK), 40.0),
    ("slow_hihat_foot", SWING, "hihat_pedal", 45.0 * (SWING.notes["piece"] == Piece.HIHAT_PEDAL), 45.0),
    ("rush_fills", FILL, "fills", -20.0 * passages.fill_ramp(FILL), -20.0),
    ("uneven_doubles", DOUBLES, "doubles", -50.0 * passages.second_of_doubles(DOUBLES), -50.0),
    ("wide_flams", FLAMS, "flams", -22.0 * FLAMS.is_grace, 52.0),
    ("straight_swing", SWING, "swing", -0.13 * 500 * passages.swung(SWING).flags, -0.13),
]
LEVELS = [
    ("flat_accents", ROCK, "accent_level", -4.0 * (ROCK.notes["dynamic"] == Dynamic.ACCENT), -4.0),
    ("loud_ghosts", ROCK, "ghost_level", 9.0 * (ROCK.notes["dynamic"] == Dynamic.GHOST), 9.0),
    ("weak_left", HANDS, "left_level", -4.0 * (HANDS.notes["limb"] == Limb.LEFT_HAND), -4.0),
]


@pytest.mark.parametrize(("fault", "score", "effect", "shift_ms", "size"), PLANTED, ids=[row[0] for row in PLANTED])
def test_a_planted_shift_is_named_first_and_measured(
    fault: str, score: Score, effect: str, shift_ms: Floats, size: float
) -> None:
    found = []
    for seed in range(8):
        summary = performed(score, seed, shift_ms=shift_ms)
        found.append(summary.habits.effects[effect])
        assert first(advise(summary)) == fault
    mean, error = (float(np.mean(values)) for values in ([e.value for e in found], [e.error for e in found]))
    assert mean == pytest.approx(size, abs=4 * error / 8**0.5)


@pytest.mark.parametrize(("fault", "score", "effect", "level_db", "size"), LEVELS, ids=[row[0] for row in LEVELS])
def test_a_planted_level_is_named_first_and_measured(
    fault: str, score: Score, effect: str, level_db: Floats, size: float
) -> None:
    found = []
    for seed in range(8):
        summary = performed(score, seed, level_db=level_db)
        found.append(summary.habits.effects[effect].value)
        assert first(advise(summary)) == fault
    assert np.mean(found) == pytest.approx(size, abs=0.6)


@pytest.mark.parametrize("score", [ROCK, FILL, DOUBLES, FLAMS, SWING])
def test_without_a_fault_nothing_is_said(score: Score) -> None:
    said = [first(advise(performed(score, seed))) for seed in range(20)]
    assert said.count(None) >= 19


def test_two_faults_are_both_named() -> None:
    kick = 45.0 * (FILL.notes["piece"] == Piece.KICK)
    for seed in range(8):
        faults = {a.fault for a in advise(performed(FILL, seed, shift_ms=kick - 25.0 * passages.fill_ramp(FILL)))}
        assert {"late_kick", "rush_fills"} <= faults


def test_a_lean_within_feel_is_not_scolded() -> None:
    laid_back = 15.0 * (ROCK.notes["piece"] == Piece.SNARE)
    assert first(advise(performed(ROCK, 3, shift_ms=laid_back))) is None


def test_a_swing_within_feel_is_not_scolded_and_costs_nothing() -> None:
    """Written 2:1, held 1.75:1: offbeats 0.030 of a beat of 500 ms early, 15 ms where a teacher minds 30."""
    softer: Floats = (1.75 / 2.75 - 2 / 3) * 500.0 * passages.swung(SWING).flags.astype(np.float64)
    assert first(advise(performed(SWING, 3, shift_ms=softer))) is None
    exact = performed(SWING, 3)
    held = performed(SWING, 3, shift_ms=softer)
    assert exact.points is not None
    assert held.points == pytest.approx(exact.points, abs=1.0)


def test_a_goal_makes_feel_a_fault() -> None:
    """The same lean and the same swing, where a lesson allows 10 ms and a ratio 0.2 off."""
    strict = SummaryView(feel=Feel(lean_ms=10.0, swing_error=0.2))
    laid_back = 18.0 * (ROCK.notes["piece"] == Piece.SNARE)
    assert first(advise(performed(ROCK, 3, shift_ms=laid_back, view=strict))) == "late_snare"
    softer: Floats = (1.6 / 2.6 - 2 / 3) * 500.0 * passages.swung(SWING).flags.astype(np.float64)
    assert first(advise(performed(SWING, 3, shift_ms=softer, view=strict))) == "straight_swing"


def test_the_spread_is_the_same_number_in_sentence_and_table() -> None:
    rng = np.random.default_rng(5)
    summary = performed(ROCK, 5, shift_ms=rng.normal(0.0, 40.0, len(ROCK)))
    (said,) = (advice for advice in advise(summary) if advice.fault == "unsteady")
    assert said.effect == summary.timing.sd_ms
    assert f"spread by {said.effect:.0f} ms" in said.text


def test_tempi_are_told_in_the_beat_of_the_lesson() -> None:
    """100 quarters a minute are 66.7 dotted quarters; 85 % of them 56.7."""
    view = SummaryView(beat_ticks=PPQ * 3 // 2)
    said = advise(performed(FILL, 1, shift_ms=-25.0 * passages.fill_ramp(FILL), view=view))[0]
    assert "57 bpm" in said.text


def test_early_in_places_is_not_early_throughout() -> None:
    """The groove 24 ms early and the fills 20 ms late: by the mean of all 17 ms early."""
    fills = passages.fills(FILL)
    said = advise(performed(FILL, shift_ms=np.where(fills, 20.0, -24.0)))
    assert np.mean(np.where(fills, 20.0, -24.0)) > -18.0
    assert {one.fault for one in said} == {"drag_fills"}
    assert first(advise(performed(FILL, shift_ms=-26.0))) == "early"


def test_pieces_are_called_as_drummers_call_them() -> None:
    late: Floats = 60.0 * (ROCK.notes["piece"] == Piece.HIHAT)
    said = advise(performed(ROCK, 3, shift_ms=late))
    assert not any("hihat" in one.text for one in said)
    assert any("hi-hat" in one.text for one in said)


def test_few_strokes_bear_no_sentence() -> None:
    """One bar of rock with its kicks 60 ms late: two strokes prove nothing."""
    score = rock_beat(1)
    assert advise(performed(score, 2, shift_ms=60.0 * (score.notes["piece"] == Piece.KICK))) == ()


def test_advice_carries_bars_numbers_and_what_to_do() -> None:
    """Fills stand in every fourth bar."""
    said = advise(performed(FILL, 1, shift_ms=-25.0 * passages.fill_ramp(FILL)))[0]
    assert set(said.bars) <= set(range(4, 33, 4))
    assert said.ci[0] <= said.effect <= said.ci[1] < 0
    assert f"rush by {-said.effect:.0f} ms in the fills" in said.text
    assert "85 bpm" in said.text  # 85 % of 100


def test_missing_strokes_are_told_when_they_are_many() -> None:
    score = rock_beat(8)
    rng = np.random.default_rng(1)
    kept = (score.notes["piece"] != Piece.SNARE) | (rng.random(len(score)) < 0.5)
    hits = np.zeros(int(kept.sum()), HIT_DTYPE)
    hits["limb"] = Limb.UNKNOWN
    hits["at_ns"], hits["piece"], hits["velocity"] = score.onset_ns[kept], score.notes["piece"][kept], 80
    performance = Performance.from_array(hits)
    said = advise(summarise(score, performance, align(score, performance, clocked=True)))
    assert any(a.fault == "missed" and "snare" in a.text for a in said)


def test_wilson_by_hand() -> None:
    """10 of 100: (0.1 + 1.92/100 ± 1.96·√(0.0009 + 0.0000960))/(1.0384) = 5.52 % … 17.44 % (Wilson 1927)."""
    low, high = wilson(10, 100)
    assert low == pytest.approx(0.0552, abs=1e-4)
    assert high == pytest.approx(0.1744, abs=1e-4)


def test_too_little_is_nothing() -> None:
    empty = Score.from_notes([], ROCK.tempo_map)
    silence = Performance.from_hits([])
    found = habits(empty, silence, align(empty, silence, clocked=True), hears_velocity=True)
    assert (found.effects, found.timing) == ({}, None)


def test_a_fault_of_loudness_names_the_bars_where_it_is_heard() -> None:
    """Accents soft in the last eight bars of sixteen only: no bar before is named."""
    score = rock_beat(16)
    accents = (score.notes["dynamic"] == Dynamic.ACCENT) & (score.bar >= 8)
    said = advise(performed(score, level_db=np.where(accents, -9.0, 0.0)))
    assert said
    assert all(bar > 8 for bar in said[0].bars)


def test_wide_flams_name_the_bars_where_they_are_wide() -> None:
    """All of them 50 ms wide, the last four bars 80."""
    wide = FLAMS.is_grace & (FLAMS.bar >= 12)
    said = advise(performed(FLAMS, shift_ms=np.where(wide, -50.0, -20.0 * FLAMS.is_grace)))
    assert first(said) == "wide_flams"
    assert all(bar > 12 for bar in said[0].bars)
