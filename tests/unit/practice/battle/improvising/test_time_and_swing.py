"""Swing by the tempo, and the time that is kept under the student."""

import numpy as np

from station.core.pieces import Piece
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.improvising.played_touch import swing_ms, swing_ratio
from station.practice.battle.improvising.time_keeping import ar1, time_keeping
from station.practice.battle.opponents.opponent import OPPONENTS


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
