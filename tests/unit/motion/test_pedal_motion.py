"""The footboards: the beater's 60° in 45 ms, rebound and burying; the hi-hat's opening, openness, chick and splash."""

import math

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.kinematics.pedal_motion import BEATER_SWING_RAD, beater_m, hat_board, kick_board
from station.motion.kit.kit import load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap

FOOT = Limb.LEFT_FOOT


def hat(notes: list[Note]) -> tuple[np.ndarray, np.ndarray]:
    """Times and openness of the hi-hat's foot, beats of half a second."""
    score = Score.from_notes(notes, TempoMap.constant(120))
    at = np.arange(0.0, 3.0, 0.001)
    return at, hat_board(score, score.onset_s).many(at)[0]


def test_a_kick_swings_its_beater_60_degrees_down_in_45_ms() -> None:
    board = kick_board(np.array([1.0]), np.array([127.0]), buried=False)
    at = np.arange(0.8, 1.0005, 0.0005)
    angle = np.degrees(board.many(at)[0] * BEATER_SWING_RAD)
    assert angle.max() == pytest.approx(60.0, abs=1.0)  # HUMANS
    assert 1.0 - at[np.flatnonzero(angle > 0.97 * angle.max())[-1]] == pytest.approx(0.045, abs=0.01)
    assert angle[-1] == pytest.approx(0.0, abs=1e-6)
    assert -np.diff(angle)[-1] / 0.0005 == pytest.approx(2267, rel=0.05)  # HUMANS


def test_it_rebounds_or_is_buried() -> None:
    rebound, buried = (kick_board(np.array([1.0]), np.array([100.0]), b) for b in (False, True))
    assert rebound.at(1.05)[0] > 0.2
    assert abs(buried.at(1.05)[0]) < 0.02
    assert buried.at(1.3)[0] == pytest.approx(rebound.at(1.3)[0])


def test_softer_kicks_swing_less() -> None:
    soft, loud = (
        kick_board(np.array([1.0]), np.array([v]), False).many(np.arange(0.9, 1, 0.001))[0].max() for v in (20.0, 127.0)
    )
    assert soft < 0.9 * loud


def test_the_beater_touches_the_head_at_angle_nought_and_goes_back_from_it() -> None:
    kit = load_kit()
    assert beater_m(kit, 0.0) == pytest.approx(kit.pieces[Piece.KICK].centre)
    assert beater_m(kit, math.radians(60.0))[1] < kit.pieces[Piece.KICK].centre[1] - 0.1


def test_the_hat_opens_60_to_100_ms_before_its_open_note() -> None:
    notes = [Note(i * PPQ, Piece.HIHAT, Zone.BOW, openness=o) for i, o in enumerate((0.0, 0.0, 1.0, 0.0))]
    at, gap = hat(notes)
    opens = at[np.flatnonzero(gap > 0.02)[0]]
    assert 0.055 <= 1.0 - opens <= 0.1
    assert gap[1000] == pytest.approx(1.0, abs=1e-6)
    assert gap[1500] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("openness", [0.15, 0.5, 0.8])
def test_it_follows_the_written_openness(openness: float) -> None:
    _, gap = hat(
        [Note(0, Piece.HIHAT, Zone.BOW, openness=0.0), Note(2 * PPQ, Piece.HIHAT, Zone.BOW, openness=openness)]
    )
    assert gap[1000] == pytest.approx(openness, abs=1e-6)
    assert gap[2500] == pytest.approx(openness, abs=1e-6)


def test_it_closes_exactly_on_the_chick() -> None:
    _, gap = hat([Note(2 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, limb=FOOT, articulation=Articulation.CHICK)])
    assert gap[1000] == pytest.approx(0.0, abs=1e-9)
    assert gap[950:999].min() > 0.0
    assert gap[900:999].max() > 0.2
    assert gap[1050] == pytest.approx(0.0, abs=1e-6)


def test_a_splash_lets_it_ring() -> None:
    _, gap = hat([Note(2 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, limb=FOOT, articulation=Articulation.SPLASH)])
    assert gap[1000] == pytest.approx(0.0, abs=1e-9)
    assert gap[1100] > 0.3


def test_boards_stay_between_down_and_raised() -> None:
    """A spline that passed its keys would put the beater into the head or a cymbal through the other."""
    times = np.cumsum([0.0, 0.5, 0.25, 0.125, 0.1, 0.08, 0.2, 0.6])
    for buried in (False, True):
        share = kick_board(times, np.full(8, 100.0), buried).many(np.arange(-0.5, 3.0, 0.001))[0]
        assert share.min() >= -1e-9
        assert share.max() <= 1.0 + 1e-9
    chick = {"piece": Piece.HIHAT_PEDAL, "zone": Zone.PEDAL, "limb": FOOT}
    opened = [Note(i * PPQ // 4, Piece.HIHAT, Zone.BOW, openness=o) for i, o in enumerate((0.0, 1.0, 0.3, 0.0, 1.0))]
    _, gap = hat([*opened, *(Note(i * PPQ // 2, **chick) for i in range(3, 8))])  # type: ignore[arg-type] # a table
    assert gap.min() >= -1e-9
    assert gap.max() <= 1.0 + 1e-9


@pytest.mark.parametrize("gap_s", [0.3, 0.15, 0.1, 0.06, 0.02, 0.003])
def test_no_board_moves_faster_than_the_measured_foot(gap_s: float) -> None:
    """Its beater comes down with 2267°/s of 60° (HUMANS); what comes too soon after swings less, and still hits."""
    strikes = np.array([1.0, 1.0 + gap_s, 1.0 + 2 * gap_s])
    board = kick_board(strikes, np.full(3, 127.0), buried=False)
    at = np.arange(0.5, 2.0, 0.0005)
    assert np.abs(np.diff(board.many(at)[0])).max() / 0.0005 < 1.05 * 2267 / 60
    assert board.many(strikes)[0] == pytest.approx(np.zeros(3), abs=1e-9)


@pytest.mark.parametrize("gap_ticks", [PPQ, PPQ // 8, PPQ // 24, PPQ // 60])
def test_a_hat_that_is_shut_at_once_hardly_opens(gap_ticks: int) -> None:
    at, gap = hat(
        [
            Note(2 * PPQ, Piece.HIHAT, Zone.BOW, openness=1.0),
            Note(2 * PPQ + gap_ticks, Piece.HIHAT_PEDAL, Zone.PEDAL, limb=FOOT),
            Note(2 * PPQ + 2 * gap_ticks, Piece.HIHAT_PEDAL, Zone.PEDAL, limb=FOOT),
        ]
    )
    assert np.abs(np.diff(gap)).max() / 0.001 < 1.05 * 2267 / 60
    struck = 1.0 + np.array([1, 2]) * gap_ticks / (2 * PPQ)
    assert np.interp(struck, at, gap) == pytest.approx(np.zeros(2), abs=0.02)
