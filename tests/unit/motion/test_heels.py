"""The heels that keep time: up between the beats, down on them; the ball and the closed hi-hat stay."""

import numpy as np
import pytest

from station.core.pieces import Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

BEAT_S = 0.5


def groove(bpm: float = 120.0, chicks: tuple[int, ...] = ()) -> Score:
    notes = [Note(k * PPQ // 2, Piece.HIHAT, Zone.BOW, openness=0.0) for k in range(32)]
    notes += [Note(k * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL) for k in chicks]
    return Score.from_notes(notes, TempoMap.constant(bpm))


def ankles(drummer: Drummer, at_s: np.ndarray, joint: Joint = Joint.LEFT_ANKLE) -> np.ndarray:
    return np.asarray(drummer.rows(at_s)[:, frame.JOINTS].reshape(-1, 21, 3)[:, joint, 2])


def test_the_heel_falls_on_the_beat_and_rises_between() -> None:
    beats = BEAT_S * np.arange(2, 10)
    drummer = Drummer(groove())
    on, off = ankles(drummer, beats), ankles(drummer, beats + BEAT_S / 2)
    assert on == pytest.approx(np.full(8, on[0]), abs=1e-9)
    assert (off - on).min() > 0.01, "a centimetre and more: it can be seen"
    assert (off - on).max() < 0.04, "no stamping"


def test_the_ball_stays_and_the_hat_stays_closed() -> None:
    rows = Drummer(groove()).rows(np.arange(1.0, 4.0, 0.001))
    toe = rows[:, frame.JOINTS].reshape(-1, 21, 3)[:, Joint.LEFT_TOE]
    assert np.ptp(toe, axis=0).max() < 1e-6
    assert rows[:, frame.GAP].max() < 0.001


def test_it_rests_where_the_foot_plays_and_goes_by_tempo_and_style() -> None:
    playing = Drummer(groove(chicks=(4, 5, 6, 7)))
    at = np.arange(2.05, 3.4, 0.01)
    tipped = playing.keys.heels.many(at)[1]  # type: ignore[union-attr] # a drummer has keys
    assert np.abs(tipped).max() == 0.0

    def rise(bpm: float, amount: float) -> float:
        drummer = Drummer(groove(bpm), style=Style(amplitude_heel=amount))
        return float(np.ptp(ankles(drummer, np.arange(1.0, 3.0, 0.005))))

    assert rise(120, 0) == pytest.approx(0.0, abs=1e-9)
    assert rise(120, 80) > 1.2 * rise(120, 50)
    assert rise(200, 50) < 0.7 * rise(120, 50)


def test_the_kicks_heel_moves_less_and_only_where_it_rests() -> None:
    at = np.arange(1.0, 4.0, 0.005)
    right, left = (np.ptp(ankles(Drummer(groove()), at, j)) for j in (Joint.RIGHT_ANKLE, Joint.LEFT_ANKLE))
    assert 0.2 * left < right < 0.8 * left
