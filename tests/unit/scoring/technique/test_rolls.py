"""Open rolls by evenness and buzz rolls by start, end, continuity and shape; every expected value by hand."""

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.technique.rolls import buzz_rolls, open_roll_runs, open_rolls
from tests.fakes.answers import Played, take
from tests.fakes.scores import double_strokes, even_snare, flams

SNARE = Piece.SNARE


def thirty_seconds(strokes: int) -> Score:
    """An open roll of diddles at 60 bpm, 125 ms apart, right right left left."""
    limbs = (Limb.RIGHT_HAND, Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.LEFT_HAND)
    notes = [Note(i * PPQ // 8, SNARE, ornament=Ornament.ROLL, limb=limbs[i % 4]) for i in range(strokes)]
    return Score.from_notes(notes, TempoMap.constant(60))


def test_what_rolls() -> None:
    """Sixteenths at 60 bpm are 250 ms apart and roll; quarters at 500 ms, flams and four strokes do not."""
    assert [len(run) for run in open_roll_runs(double_strokes(2))] == [32]
    assert open_roll_runs(even_snare(32, 500)) == []
    assert open_roll_runs(flams(4)) == []
    assert open_roll_runs(thirty_seconds(4)) == []


def test_a_roll_that_stops_and_goes_on_is_two() -> None:
    notes = [Note(start + i * PPQ // 8, SNARE) for start in (0, 4 * PPQ) for i in range(8)]
    assert [len(run) for run in open_roll_runs(Score.from_notes(notes, TempoMap.constant(60)))] == [8, 8]


def test_an_even_roll_has_no_spread_however_late() -> None:
    played = take(thirty_seconds(32), Played(off_ms=20.0))
    rolls = open_rolls(played.score, played.performance, played.alignment)
    assert rolls is not None
    assert rolls.intervals_pct.sd == pytest.approx(0.0, abs=1e-6)
    assert rolls.second_ms.mean == pytest.approx(0.0, abs=1e-6)


def test_second_strokes_early_by_hand() -> None:
    """Every second stroke 10 ms early: intervals 115 and 135 ms of 125, in turn 92 and 108 %.

    31 intervals, 16 short and 15 long: mean 99.742, sum of squares 16·7.742² + 15·8.258² = 1981.9, SD √(1981.9/30).
    Seconds lie 10 ms before the middle of their neighbours, the last has none after it.
    """
    score = thirty_seconds(32)
    played = take(score, Played(off_ms=np.tile([0.0, -10.0], 16)))
    rolls = open_rolls(score, played.performance, played.alignment)
    assert rolls is not None
    assert rolls.intervals_pct.sd == pytest.approx((1981.9 / 30) ** 0.5, abs=1e-3)
    assert rolls.intervals_pct.ci is not None
    assert rolls.second_ms.count == 15
    assert rolls.second_ms.mean == pytest.approx(-10.0)


def test_second_strokes_softer_by_hand() -> None:
    """64.5 after 80: 40·log10(64.5/80) = −3.74 dB."""
    score = thirty_seconds(32)
    played = take(score, Played(velocity=np.tile([80, 64.5], 16)))
    rolls = open_rolls(score, played.performance, played.alignment)
    assert rolls is not None
    assert rolls.second_db.mean == pytest.approx(40 * np.log10(64.5 / 80))


# --- buzz rolls -------------------------------------------------------------------------------------------------------


def buzzes(count: int) -> Score:
    """A buzz of two beats (1000 ms at 120 bpm) in every bar."""
    notes = [
        Note(4 * PPQ * k, SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=2 * PPQ)
        for k in range(count)
    ]
    return Score.from_notes(notes, TempoMap.constant(120))


def bounces(bar: int, times_ms: list[float], velocities: list[int] | int = 50) -> tuple[tuple[float, Piece, int], ...]:
    levels = [velocities] * len(times_ms) if isinstance(velocities, int) else velocities
    return tuple((2000.0 * bar + at, SNARE, velocity) for at, velocity in zip(times_ms, levels, strict=True))


EVERY_40 = [float(at) for at in range(40, 1000, 40)]


def test_whole_buzzes_by_hand() -> None:
    """Bounces from 40 to 960 ms: the next would come at 1000, the written end; no hole; equally loud."""
    score = buzzes(6)
    played = take(score, Played(more=tuple(b for bar in range(6) for b in bounces(bar, EVERY_40))))
    buzz = buzz_rolls(score, played.performance, played.alignment)
    assert buzz is not None
    assert (buzz.written, buzz.heard, buzz.judged, buzz.continuous, buzz.tells_bounces) == (6, 6, 6, 6, True)
    assert buzz.start_ms.mean == pytest.approx(0.0)
    assert buzz.end_ms.mean == pytest.approx(0.0, abs=1e-6)
    assert buzz.shape_db.mean == pytest.approx(0.0)
    assert buzz.longest_gap_ms == pytest.approx(40.0)


def test_the_count_of_bounces_says_nothing() -> None:
    """Every 20 or every 50 ms: as whole as every 40."""
    for every in (20, 50):
        more = tuple(b for bar in range(4) for b in bounces(bar, [float(t) for t in range(every, 1000, every)]))
        played = take(buzzes(4), Played(more=more))
        buzz = buzz_rolls(played.score, played.performance, played.alignment)
        assert buzz is not None
        assert buzz.continuous == 4
        assert buzz.end_ms.mean == pytest.approx(0.0, abs=1e-6)


def test_a_hole_an_early_end_and_a_fading_shape_by_hand() -> None:
    """Bar 1 lacks 400 to 520, a gap of 200 ms; all stop at 760, 200 ms early; 80 falls to 40, 12 dB."""
    short = [at for at in EVERY_40 if at <= 760]
    half = len(short) // 2
    levels = [80] * (len(short) - half) + [40] * half
    more = [bounces(bar, short, levels) for bar in range(5)]
    more[1] = tuple(b for b in more[1] if not 2400 <= b[0] <= 2520)
    played = take(buzzes(5), Played(more=tuple(b for bar in more for b in bar)))
    buzz = buzz_rolls(played.score, played.performance, played.alignment)
    assert buzz is not None
    assert (buzz.judged, buzz.continuous) == (5, 4)
    assert buzz.longest_gap_ms == pytest.approx(200.0)
    assert buzz.end_ms.mean == pytest.approx(-200.0, abs=1e-6)
    level = level_db(np.array([40, 80]))
    assert buzz.shape_db.mean == pytest.approx(level[0] - level[1], abs=1.0)


def test_a_press_that_never_bounced_is_broken_where_others_bounced() -> None:
    played = take(buzzes(3), Played(more=bounces(0, EVERY_40) + bounces(2, EVERY_40)))
    buzz = buzz_rolls(played.score, played.performance, played.alignment)
    assert buzz is not None
    assert (buzz.judged, buzz.continuous) == (3, 2)


def test_a_kit_that_sends_one_hit_a_buzz_cannot_tell() -> None:
    played = take(buzzes(5))
    buzz = buzz_rolls(played.score, played.performance, played.alignment)
    assert buzz is not None
    assert (buzz.heard, buzz.tells_bounces, buzz.judged, buzz.continuous) == (5, False, 0, None)
    assert (buzz.end_ms.mean, buzz.shape_db.mean, buzz.longest_gap_ms) == (None, None, None)


def test_scores_without_rolls_ask_for_nothing() -> None:
    played = take(even_snare(16, 500))
    assert open_rolls(played.score, played.performance, played.alignment) is None
    assert buzz_rolls(played.score, played.performance, played.alignment) is None
