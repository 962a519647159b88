"""Draws from the table of human playing have the figures of the table, and these are near to published ones."""

import numpy as np

from station.core.pieces import Piece
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.expression import swing_ms, swing_ratio
from station.practice.battle.improvising.human_playing import ar1, human_late_ms, human_playing, human_velocity
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.time_keeping import time_keeping
from station.practice.battle.opponents.opponent import OPPONENTS


def _groove(beats: int) -> Beats:
    """Sixteenths on the hi-hat, a kick or snare on each beat."""
    found = Beats.silent(beats, 4)
    found.struck[:, :4, Instrument.CLOSED_HIHAT] = True
    found.struck[::2, 0, Instrument.KICK] = True
    found.struck[1::2, 0, Instrument.SNARE] = True
    return found


def test_lateness_has_a_humans_spread_and_goes_together() -> None:
    """HUMANS, Timing: 26–28 ms in whole takes; within four bars less, and correlated from stroke to stroke."""
    beats = _groove(400)
    late = human_late_ms(beats, 1.0, np.random.default_rng(1))
    assert 12 < late.std() < 28
    hat = np.zeros(beats.struck.shape)
    hat[beats.struck] = late
    steps = hat[:, :4, Instrument.CLOSED_HIHAT].ravel()
    assert 0.1 < np.corrcoef(steps[:-1], steps[1:])[0, 1] < 0.5


def test_a_steadier_clock_is_steadier() -> None:
    beats = _groove(100)
    wide, narrow = (human_late_ms(beats, spread, np.random.default_rng(2)).std() for spread in (1.0, 0.5))
    assert np.isclose(narrow, wide / 2, rtol=0.1)


def test_backbeats_are_louder_than_what_lies_between() -> None:
    table = human_playing().deciles
    backbeat, early, middle = 1, 3, 5
    assert table[Instrument.SNARE, backbeat, middle] > table[Instrument.SNARE, early, middle] + 30


def test_velocities_are_midi_and_as_wide_as_a_humans() -> None:
    """HUMANS, Velocity: 15–21 within a take and place, so more over places."""
    rng = np.random.default_rng(3)
    spreads = [human_velocity(_groove(16), 0.0, rng).std() for _ in range(40)]
    assert 10 < np.mean(spreads) < 40
    values = human_velocity(_groove(64), 0.0, rng)
    assert values.min() >= 1
    assert values.max() <= 127


def test_ar1_has_its_correlation() -> None:
    course = ar1(20_000, 0.6, np.random.default_rng(4))
    assert np.isclose(np.corrcoef(course[:-1], course[1:])[0, 1], 0.6, atol=0.03)
    assert np.isclose(course.std(), 1.0, atol=0.05)


def test_swing_follows_the_tempo() -> None:
    """Friberg & Sundström 2002, in HUMANS: about 3.5 to 1 at 120 and slower, even eighths at 300."""
    assert swing_ratio(60 / 120) == 3.5
    assert swing_ratio(60 / 300) == 1.0
    beats = Beats.silent(4, 4, 3)
    late = swing_ms(beats, Ground(200, feel=Feel.TRIPLET))
    assert np.allclose(late[:, 2], 0.0)  # 300 ms a beat: two to one, a triplet
    assert swing_ms(beats, Ground(150, feel=Feel.TRIPLET))[0, 2] > 20


def test_time_is_kept_softly_by_the_feet() -> None:
    for name, opponent in OPPONENTS.items():
        score = time_keeping(opponent, Ground(100), 2, np.random.default_rng(1)).score
        assert set(score.notes["piece"].tolist()) <= {Piece.KICK, Piece.HIHAT_PEDAL}, name
        assert score.notes["velocity"].max() < 60
        groove = time_keeping(opponent, Ground(100), 2, np.random.default_rng(1), with_hands=True).score
        assert len(groove) > len(score)
