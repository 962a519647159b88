"""Doubles, drags and buzz rolls: the hand strikes once, the stick's rebounds do the rest.

What is expected is how rolls are taught: one motion of the wrist for both strokes of a double, the second from the
fingers, lower; a press roll's stick is pressed once and bounces ever lower.
"""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Ornament, Piece
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
HEAD_M = 0.66


def drummer_of(notes: list[Note], tempo_bpm: float = 120) -> Drummer:
    return Drummer(Score.from_notes(notes, TempoMap.constant(tempo_bpm)), style=Style(variation=0.0))


def seen(drummer: Drummer, at: Array, limb: Limb = R) -> tuple[Array, Array, Array]:
    """The wrist's and the stick's angle in degrees, and the tip's height over the snare."""
    rows, side = drummer.rows(at), "right" if limb == R else "left"
    wrist, stick = (np.degrees(rows[:, frame.ANGLES][:, ANGLE_NAMES.index(f"{side}_{n}")]) for n in ("wrist", "stick"))
    return wrist, stick, rows[:, frame.TIP].reshape(-1, 2, 3)[:, int(limb), 2] - HEAD_M


def valleys(curve: Array, least: float) -> list[int]:
    """Where `curve` has been lowest before it rises by `least`, having fallen by as much before."""
    found, low, high, falling = [], 0, float(curve[0]), False
    for i, value in enumerate(curve.tolist()):
        if falling:
            low = i if value < curve[low] else low
            if value > curve[low] + least:
                found.append(low)
                falling, high = False, value
        else:
            high = max(high, value)
            if value < high - least:
                falling, low = True, i
    return found


@pytest.mark.parametrize("tempo_bpm", [85, 100, 120])
def test_an_open_roll_is_one_motion_of_the_wrist_for_two_strokes(tempo_bpm: float) -> None:
    sticking = [R, R, L, L] * 10
    notes = [Note(i * PPQ // 8, Piece.SNARE, velocity=90, limb=x) for i, x in enumerate(sticking)]
    drummer = drummer_of(notes, tempo_bpm)
    gap = 60 / tempo_bpm / 8
    at = np.arange(16 * gap - 1.5 * gap, 16 * gap + 2.5 * gap, 0.0005)
    wrist, stick, height = seen(drummer, at)
    assert len(valleys(wrist, 1.0)) == 1
    assert len(valleys(stick[at < 17.2 * gap], 0.5)) == 2  # the upstroke after them is no third
    first, second = height[at < 16 * gap].max(), height[(at > 16 * gap) & (at < 17 * gap)].max()
    assert 0.02 < second < 0.6 * first
    assert height.min() > -0.001


def test_single_strokes_are_no_doubles() -> None:
    drummer = drummer_of([Note(i * PPQ // 4, Piece.SNARE, velocity=90, limb=R) for i in range(16)], 140)
    assert not any(hand.events.rebounds.any() for hand in drummer._hands)
    wrist, _, _ = seen(drummer, np.arange(0.5, 1.5, 0.001))
    assert len(valleys(wrist, 1.0)) == pytest.approx(1.0 / (60 / 140 / 4), abs=1)


def test_a_drags_graces_are_low_and_one_motion_of_the_other_hand() -> None:
    graces = [Note(4 * PPQ, Piece.SNARE, velocity=45, limb=L, ornament=Ornament.DRAG, lead_ms=ms) for ms in (100, 50)]
    drummer = drummer_of([*graces, Note(4 * PPQ, Piece.SNARE, velocity=112, limb=R)])
    at = np.arange(1.85, 2.1, 0.0005)
    wrist, stick, height = seen(drummer, at, L)
    assert height[at < 1.95].max() < 0.06
    assert height[at < 1.95].max() > 1.4 * height[(at > 1.9) & (at < 1.95)].max() > 0.005
    assert np.interp([1.9, 1.95], at, height) == pytest.approx(np.zeros(2), abs=1e-3)
    both = (at > 1.85) & (at < 1.99)
    assert len(valleys(wrist[both], 0.5)) == 1
    assert len(valleys(stick[both], 0.5)) == 2
    assert seen(drummer, at[at < 2.0])[2].max() > 0.25  # the main hand waits high


def test_a_buzz_is_one_press_and_bounces_ever_lower() -> None:
    press = Note(2 * PPQ, Piece.SNARE, velocity=90, limb=R, articulation=Articulation.BUZZ)
    drummer = drummer_of([Note(0, Piece.SNARE, limb=R), press])
    at = np.arange(0.99, 1.13, 0.0002)
    wrist, _, height = seen(drummer, at)
    touches = valleys(height, 0.0005)
    assert len(touches) >= 4
    assert height[touches] == pytest.approx(np.zeros(len(touches)), abs=1e-4)
    tops = [height[a:b].max() for a, b in pairwise(touches)]
    assert tops == sorted(tops, reverse=True)
    assert 0.001 < tops[-1] < tops[0] < 0.012
    assert (np.diff(at[touches]) < 0.05).all()
    pressed = wrist[touches[0] : touches[-1]]
    assert np.ptp(pressed) < 1.5  # the body moves on


def test_a_buzz_roll_is_carried_on_by_both_hands_without_a_gap() -> None:
    roll = Note(2 * PPQ, Piece.SNARE, velocity=90, limb=R, articulation=Articulation.BUZZ, duration_ticks=2 * PPQ)
    drummer = drummer_of([roll])
    sounds = np.sort(np.concatenate([hand.events.time_s for hand in drummer._hands]))
    sounds = sounds[(sounds >= 1.0) & (sounds < 2.0)]
    assert np.diff(sounds).max() < 0.08


def test_a_stick_bounces_on_ever_lower_while_the_wrist_rests() -> None:
    """A blow, its rebound and two more bounces 60 ms apart: the wrist moves for the first two, the stick for all."""
    notes = [Note(4 * PPQ + i * PPQ // 10, Piece.SNARE, velocity=v, limb=R) for i, v in enumerate((110, 60, 33, 15))]
    drummer = drummer_of(notes, 100)
    right = drummer._hands[0].events
    assert right.rebounds.tolist()[1:5] == [False, True, False, False]
    assert right.bounces.tolist()[1:5] == [False, False, True, True]
    at = np.arange(2.4, 2.58, 0.0005)
    wrist, _, height = seen(drummer, at)
    tops = [height[(at > 2.4 + 0.06 * i) & (at < 2.46 + 0.06 * i)].max() for i in range(3)]
    assert all(later < 0.8 * earlier for earlier, later in pairwise(tops))
    assert np.ptp(wrist[at > 2.47]) < 3.0
    assert height.min() > -0.001
