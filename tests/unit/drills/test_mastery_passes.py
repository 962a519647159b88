"""What a pass is measured to be, on performances whose every stroke is placed by hand."""

from collections.abc import Callable, Mapping

import numpy as np
import pytest

from station.core.pieces import Ornament, Piece
from station.core.units import NS_PER_MS, PPQ
from station.drills.mastery.pass_measures.pass_facts import PassResult, StruckFor, measure_pass
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from tests.fakes import scores


def pass_over(
    score: Score,
    off_ms: Callable[[Note, int], float] = lambda note, i: 0.0,
    missed: frozenset[int] = frozenset(),
    struck: Mapping[int, Piece] | None = None,
    bars: tuple[int, ...] | None = None,
) -> PassResult:
    """Every note of `score` struck `off_ms(note, index)` late, but those `missed`; some `struck` on another piece."""
    hits = np.zeros(len(score), HIT_DTYPE)
    offsets = np.array([off_ms(note, i) for i, note in enumerate(score)])
    hits["at_ns"] = score.onset_ns + np.rint(offsets * NS_PER_MS).astype(np.int64)
    hits["piece"], hits["velocity"] = score.notes["piece"], score.notes["velocity"]
    hits["openness"] = hits["position"] = np.nan
    for i, piece in (struck or {}).items():
        hits["piece"][i] = piece
    performance = Performance.from_array(hits[[i for i in range(len(score)) if i not in missed]])
    return measure_pass(score, performance, align(score, performance, clocked=True), bars)


def alternating(size_ms: float) -> Callable[[Note, int], float]:
    return lambda note, i: size_ms if i % 2 else -size_ms


def test_a_perfect_pass() -> None:
    """Two bars of the rock beat at 120: 13 strokes each, slots 125 ms (ghost) and 250 ms apart, most of them 250."""
    result = pass_over(scores.rock_beat(2))
    assert (result.notes, result.right, result.wrong_pads, result.extras) == (26, 26, 0, 0)
    assert (result.sd_ms, result.lean_ms, result.interval_ms) == (0.0, 0.0, 250.0)
    assert result.points == pytest.approx(100.0)
    assert [(b.bar, b.notes, b.right) for b in result.bars] == [(0, 13, 13), (1, 13, 13)]


def test_the_spread_of_strokes_that_alternate() -> None:
    """16 snares ±10 ms: squares sum to 1600, one lean costs one of 16 degrees of freedom: √(1600/15) = 10.33."""
    result = pass_over(scores.even_snare(16, 500), alternating(10.0))
    assert result.sd_ms == pytest.approx((1600 / 15) ** 0.5, abs=1e-6)
    assert result.lean_ms == pytest.approx(0.0, abs=1e-6)


def test_each_pieces_lean_is_taken_out() -> None:
    """Kick 20 ms early, snare 15 ms late, hat 5 ms late, all steady: no spread at all."""
    lean = {Piece.KICK: -20.0, Piece.SNARE: 15.0, Piece.HIHAT: 5.0}
    result = pass_over(scores.rock_beat(2), lambda note, i: lean[note.piece])
    assert result.sd_ms == pytest.approx(0.0, abs=1e-6)


def test_the_swing_that_is_held_is_taken_out() -> None:
    """Written 2:1 at 120 bpm (offbeats at 333 ms of 500), played 300: 3:2 by 300/200, steadily."""
    score = scores.swing_ride(4)
    result = pass_over(score, lambda note, i: -100.0 / 3.0 if note.tick % PPQ else 0.0)
    assert result.sd_ms == pytest.approx(0.0, abs=0.1)
    assert result.swing_ratio == pytest.approx(1.5, abs=0.01)


def test_nothing_swings_in_a_straight_groove() -> None:
    assert pass_over(scores.rock_beat(1)).swing_ratio is None


def test_grace_strokes_have_no_say_in_the_spread() -> None:
    result = pass_over(scores.flams(4), lambda note, i: 12.0 * (-1) ** i if note.lead_ms else 0.0)
    assert result.right == result.notes == 32
    assert result.sd_ms == pytest.approx(0.0, abs=1e-6)


def test_rolls_have_no_say_in_the_spread() -> None:
    """Quarters on the kick in time, a roll of sixteenths on the snare that scatters."""
    quarter = PPQ // 4
    roll = [Note(i * quarter, Piece.SNARE, ornament=Ornament.ROLL) for i in range(16)]
    kicks = [Note(i * PPQ, Piece.KICK) for i in range(4)]
    score = Score.from_notes([*roll, *kicks], TempoMap.constant(60)).repeated(2)
    scatter = alternating(20.0)
    result = pass_over(score, lambda note, i: scatter(note, i) if note.ornament else 0.0)
    assert result.sd_ms == pytest.approx(0.0, abs=1e-6)


def test_only_rolls_leave_the_spread_unknown() -> None:
    notes = [Note(i * PPQ // 4, Piece.SNARE, ornament=Ornament.DIDDLE) for i in range(16)]
    assert pass_over(Score.from_notes(notes, TempoMap.constant(60))).sd_ms is None


def test_misses_and_wrong_pads() -> None:
    """Of two bars of rock, the second bar's first kick is left out and its first snare lands on the tom."""
    score = scores.rock_beat(2)
    rows = list(score)
    second = [i for i, note in enumerate(rows) if note.tick >= 4 * PPQ]
    kick = next(i for i in second if rows[i].piece is Piece.KICK)
    snare = next(i for i in second if rows[i].piece is Piece.SNARE)
    result = pass_over(score, missed=frozenset({kick}), struck={snare: Piece.TOM_1}, bars=(2, 3))
    assert (result.right, result.wrong_pads, result.extras) == (24, 1, 0)
    assert [(b.bar, b.right) for b in result.bars] == [(2, 13), (3, 11)]
    assert StruckFor(Piece.SNARE, Piece.TOM_1, 1) in result.answers


def test_a_stroke_clearly_out_of_time_counts_against_its_bar_alone() -> None:
    """One of 16 snares 80 ms late, beyond the outermost window of 70 ms: it is played, and not right."""
    result = pass_over(scores.even_snare(16, 500), lambda note, i: 80.0 if i == 9 else 0.0)
    assert result.right == 15
    assert [b.right for b in result.bars] == [4, 4, 3, 4]


def test_bars_that_are_repeated_in_a_pass_are_one() -> None:
    result = pass_over(scores.rock_beat(4), missed=frozenset({0}), bars=(1, 2, 1, 2))
    assert [(b.bar, b.notes, b.right) for b in result.bars] == [(1, 26, 25), (2, 26, 26)]


def test_who_is_late_throughout_has_played() -> None:
    """117 ms, beyond the outermost window: nothing is right, and yet the pass is not silent."""
    result = pass_over(scores.rock_beat(2), lambda note, i: 117.0)
    assert (result.right, result.played, result.is_silent) == (0, 26, False)


def test_silence() -> None:
    score = scores.rock_beat(1)
    result = pass_over(score, missed=frozenset(range(len(score))))
    assert result.is_silent
    assert (result.sd_ms, result.lean_ms, result.right) == (None, None, 0)
    assert not pass_over(score).is_silent
