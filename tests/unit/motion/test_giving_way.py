"""A hand that rests where the other must pass gives way, and is back on its drum in time."""

from math import radians

import numpy as np
import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics.arm import Contact
from station.motion.kit.kit import load_kit
from station.motion.strokes.travel import HandPath
from station.music.score import Note, Score
from station.music.tempo import TempoMap

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
HAT, RIDE, SNARE = Piece.HIHAT, Piece.RIDE, Piece.SNARE
TOM_1, TOM_2, FLOOR = Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1


@pytest.mark.parametrize(
    ("kit", "right", "left"),
    [
        ("four_piece", {0: SNARE, 8: SNARE}, {2: FLOOR, 4: TOM_1, 6: RIDE}),
        ("four_piece", {0: SNARE}, {2: FLOOR, 4: TOM_2, 6: SNARE}),
        ("four_piece", {0: RIDE, 8: TOM_1}, {2: FLOOR, 4: TOM_1, 6: SNARE}),
        ("seven_piece", {0: RIDE}, {2: TOM_2, 4: FLOOR, 6: RIDE}),
        ("seven_piece", {0: RIDE}, {2: HAT, 4: HAT, 6: FLOOR}),
    ],
    ids=["between strokes", "after the last", "beside the ride", "over the ride", "at the floor tom"],
)
def test_sticks_pass_a_hand_at_rest(kit: str, right: dict[int, Piece], left: dict[int, Piece]) -> None:
    """Times in eighths at 90 bpm: a human has the time to make room (3 mm, as everywhere)."""
    notes = [
        Note(at * PPQ // 2, piece, Zone.BOW if piece in (HAT, RIDE) else Zone.HEAD, 110, limb=limb)
        for limb, part in ((R, right), (L, left))
        for at, piece in part.items()
    ]
    found = audit(Drummer(Score.from_notes(notes, TempoMap.constant(90)), load_kit(kit)))
    assert found.hands_m.value <= 0.003, found.hands_m
    assert found.kit_m.value <= 0.003, found.kit_m
    assert found.limit_rad.value <= radians(1), found.limit_rad
    assert found.speed.value <= 1.0, found.speed
    assert found.strike_m.value <= 1e-6, found.strike_m


@pytest.mark.parametrize(("off", "back"), [(1.2, 1.8), (-np.inf, 0.9), (2.1, np.inf)])
def test_a_hand_moves_off_and_comes_back(off: float, back: float) -> None:
    """By hand: 25 cm up in the middle, nothing outside, and no jump (a minimum jerk of 25 cm in 0.1 s: 4.7 m/s)."""
    contacts = np.zeros((2, len(Contact._fields)))
    contacts[:, :3] = 0.1, 0.5, 0.7
    gives = np.zeros((2, 6))
    gives[0 if off < 1.9 else 1] = off, back, 10.0, 0.0, 0.0, 0.25
    way = HandPath.of(np.array([1.0, 2.0]), contacts, np.zeros((1, 4)), np.zeros(1, bool), np.zeros(1, bool), gives)
    time_s = np.arange(0.5, 3.0, 0.005)
    height = np.asarray(way.many(time_s).z)
    assert height == pytest.approx([way.at(t)[2] for t in time_s.tolist()])
    inside = (time_s > off + 0.1) & (time_s < back - 0.1)
    assert height[inside] == pytest.approx(0.95)
    assert height[(time_s < off) | (time_s > back)] == pytest.approx(0.7)
    assert np.abs(np.diff(height)).max() / 0.005 < 4.8
