"""Both hands as they are looked at for tangles: what is kept from one look to the next, and how little it takes."""

import tracemalloc
from collections.abc import Callable
from functools import lru_cache

import numpy as np
import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.avoidance.both_hands import SLOPES, BothHands, HandsGrid
from station.motion.avoidance.detours import looks
from station.motion.drummer import Drummer
from station.motion.kinematics.collisions import depth_in_kit
from station.motion.kit.kit import load_kit
from station.motion.strokes.hand import HandPart
from station.music.score import Note, Score
from station.music.tempo import TempoMap

CROSSING = {Limb.RIGHT_HAND: (Piece.HIHAT, Piece.SNARE), Limb.LEFT_HAND: (Piece.SNARE, Piece.FLOOR_TOM_1)}


@lru_cache(maxsize=1)
def crossing() -> Drummer:
    """Hands that cross at 120 bpm, two bars long."""
    notes = [
        Note(
            (2 * i + k) * PPQ // 2,
            pieces[i % 2],
            Zone.BOW if pieces[i % 2] == Piece.HIHAT else Zone.HEAD,
            100,
            limb=limb,
        )
        for i in range(8)
        for k, (limb, pieces) in enumerate(CROSSING.items())
    ]
    return Drummer(Score.from_notes(notes, TempoMap.constant(120)))


def a_stage(grid_hz: float | None = None) -> tuple[tuple[HandPart, HandPart], HandsGrid]:
    """Their straight ways, on which they come too near, at shoulders that stay."""
    drummer = crossing()
    hands = drummer.parts
    assert hands is not None
    right, left = (part.led(0 * part.bump, part.strokes.most, part.contacts, part.gives) for part in hands)
    times = [hand.events.time_s for hand in hands]
    grid = looks(*times) if grid_hz is None else np.arange(0.0, 60.0, 1 / grid_hz)
    roots = [np.tile(np.array(hand.lies[0].root)[:, None], len(grid)) for hand in hands]
    return (right, left), HandsGrid(drummer.figure, drummer.kit, grid, (roots[0], roots[1]), (right.bump, left.bump))


def lifted(hand: HandPart, k: int) -> HandPart:
    bump = hand.bump.copy()
    bump[k, 2] += 0.2
    return hand.led(bump, hand.strokes.most, hand.contacts, hand.gives)


def lowered(hand: HandPart, k: int) -> HandPart:
    most = np.full(len(hand.strokes.most), np.inf)
    most[k] = 0.1
    return hand.led(hand.bump, most, hand.contacts, hand.gives)


def steeper(hand: HandPart, k: int) -> HandPart:
    contacts = hand.contacts.copy()
    contacts[k, SLOPES] += 0.3
    return hand.led(hand.bump, hand.strokes.most, contacts, hand.gives)


def giving(hand: HandPart, k: int) -> HandPart:
    gives, at = hand.gives.copy(), float(hand.events.time_s[k])
    gives[k] = at + 0.1, at + 0.4, 10.0, -0.2, 0.0, 0.2
    return hand.led(hand.bump, hand.strokes.most, hand.contacts, gives)


@pytest.mark.parametrize("change", [lifted, lowered, steeper, giving])
@pytest.mark.parametrize("k", [0, 3])
def test_a_second_look_sees_what_a_fresh_one_does(change: Callable[[HandPart, int], HandPart], k: int) -> None:
    (right, left), stage = a_stage()
    before = BothHands.of((right, left), stage)
    changed = change(right, k), change(left, k)
    again, fresh = BothHands.of(changed, stage, before), BothHands.of(changed, stage)
    assert before.near.any()
    assert np.array_equal(again.near, fresh.near)


def test_looking_at_a_minute_takes_little_memory() -> None:
    """60,000 moments: an arm at each would be 28 numbers, twice for two hands, 54 MB; their sticks' points 48 MB."""
    hands, stage = a_stage(1000.0)
    BothHands.of(hands, stage)
    stick = np.tile(np.array([0.0, 0.6, 0.8]), (len(stage.grid), 1))
    tracemalloc.start()
    BothHands.of(hands, stage)
    depth_in_kit(load_kit(), stick, stick - (0.0, 0.0, 0.2))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert peak < 25e6
