"""Spins and tosses: clear of the kit, in nobody's joints, by gravity, and back in the hand."""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.strokes.flourish import Flourishes
from station.motion.style.style_file import load_style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]

RESTS = Score.from_notes(
    [
        Note(int(beat * PPQ), piece, velocity=100, limb=limb)
        for beat, piece, limb in (
            (0, Piece.SNARE, Limb.LEFT_HAND),
            (0, Piece.HIHAT, Limb.RIGHT_HAND),
            (6, Piece.SNARE, Limb.LEFT_HAND),
            (7, Piece.RIDE, Limb.RIGHT_HAND),
            (12, Piece.FLOOR_TOM_1, Limb.RIGHT_HAND),
            (12, Piece.TOM_1, Limb.LEFT_HAND),
            (18, Piece.SNARE, Limb.LEFT_HAND),
            (18, Piece.SNARE, Limb.RIGHT_HAND),
        )
    ],
    TempoMap.constant(120),
)


def drummers(seed: int) -> tuple[Drummer, Drummer]:
    style = replace(load_style("dramatic"), seed=seed, flourish=100.0)
    showing = Drummer(RESTS, style=style)
    return showing, showing.with_style(replace(style, flourish=0.0))


def sticks(drummer: Drummer, at: Array) -> tuple[Array, Array, Array]:
    """Butts, tips and hands, each (n, 2, 3)."""
    rows = drummer.rows(at)
    hands = rows[:, frame.JOINTS].reshape(-1, 21, 3)[:, [Joint.RIGHT_HAND, Joint.LEFT_HAND]]
    return rows[:, frame.BUTT].reshape(-1, 2, 3), rows[:, frame.TIP].reshape(-1, 2, 3), hands


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_flourishes_stay_clear_of_the_kit_and_within_the_joints_limits(seed: int) -> None:
    found = audit(drummers(seed)[0])
    assert found.kit_m.value < 0.003, found.kit_m
    assert found.limit_rad.value < 0.02, found.limit_rad
    assert found.speed.value <= 1.0, found.speed


def test_whole_turns_are_not_in_the_joints() -> None:
    at = np.arange(-0.5, 10.0, 0.004)
    shown, plain = (d.rows(at)[:, frame.ANGLES] for d in drummers(2))
    turned = np.abs(shown - plain)[:, [ANGLE_NAMES.index(f"{side}_stick") for side in ("right", "left")]]
    assert turned.max() < 1e-9
    butt, tip, _ = sticks(drummers(2)[0], at)
    assert ((tip - butt)[..., 2].max(0) > 0.9 * 0.406).all()  # upright on its way round


def test_a_stick_is_in_the_hand_but_while_it_flies_and_then_falls_freely() -> None:
    step, flights = 0.005, 0
    at = np.arange(-0.5, 10.0, step)
    for seed in range(1, 5):
        butt, tip, hand = sticks(drummers(seed)[0], at)
        share = ((hand - butt) * (tip - butt)).sum(2) / 0.406**2
        on_it = np.linalg.norm(hand - (butt + share[..., None] * (tip - butt)), axis=2) < 1e-9
        held = on_it & (np.abs(share - 1 / 3) < 0.01)  # a third from the butt (HUMANS)
        assert np.linalg.norm(tip - butt, axis=2) == pytest.approx(np.full(held.shape, 0.406), abs=1e-9)
        for side in range(2):
            flying = ~held[:, side]
            middle = (0.5 * (butt + tip) - hand)[:, side, 2]
            inside = flying[:-2] & flying[1:-1] & flying[2:]
            flights += int(np.sum(np.diff(flying.astype(int)) == 1))
            if inside.any():
                fall = np.diff(middle, 2)[inside] / step**2
                assert np.median(fall) == pytest.approx(-9.81, rel=0.05)
    assert flights >= 2


def test_the_stick_turns_only_while_the_hand_is_up() -> None:
    events = np.array([0.0, 2.0, 5.0, 5.5])
    for seed in range(6):
        flourishes = Flourishes.of(events, np.ones(1), seed)
        assert flourishes.start_s[0] >= 0.3
        now = flourishes.many(np.arange(0.0, 5.5, 0.002))
        turned = np.abs(np.diff(now.turn_rad)) > 1e-9
        turned &= np.diff(now.turn_rad) > -1.0  # the end of a flourish, where the stick is as before
        assert now.raised[1:][turned].min() == pytest.approx(1.0)
