"""Who strikes is laid out by each test; latencies, jitter and lost strokes are its own, not those of the code."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from random import Random

import numpy as np
import pytest

from station.core.events import Hit, StickStroke
from station.core.pieces import Limb, Piece, Zone
from station.sync.strokes.hand_naming import name_hands
from station.sync.strokes.stick_offsets import offset_candidates

R, L, FOOT = Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_FOOT


@dataclass(frozen=True)
class Played:
    at_ms: float
    limb: Limb
    piece: Piece = Piece.SNARE
    speed: float = 2.5


@dataclass(frozen=True)
class Room:
    """How late each sensor is against the pads, in ms, and what else goes wrong."""

    right_ms: float = 25.0
    left_ms: float = -12.0
    jitter_ms: float = 1.2
    lost: float = 0.01
    seed: int = 1


def heard(played: list[Played], room: Room) -> tuple[list[Hit], list[StickStroke], list[Limb]]:
    random = Random(room.seed)
    hits, strokes, truth = [], [], []
    for one in sorted(played, key=lambda one: one.at_ms):
        velocity = 127 * (one.speed / 6) ** 0.6 * math.exp(random.gauss(0, 0.08))
        if random.random() >= room.lost:
            at_ms = one.at_ms + random.gauss(0, 0.8)
            hits.append(Hit(round(at_ms * 1e6), one.piece, Zone.HEAD, min(max(round(velocity), 1), 127)))
            truth.append(one.limb)
        if one.limb.is_hand and random.random() >= room.lost:
            late_ms = room.right_ms if one.limb is R else room.left_ms
            at_ms = one.at_ms + late_ms + random.gauss(0, room.jitter_ms)
            strokes.append(StickStroke(round(at_ms * 1e6), one.limb.name, one.limb, one.speed, angle_rad=0.05))
    return hits, strokes, truth


def told(played: list[Played], room: Room) -> tuple[float, float]:
    """The share of hits by hands that is named, and of these the share that is right."""
    hits, strokes, truth = heard(played, room)
    named = name_hands(hits, strokes)
    hands = [(said, true) for said, true in zip(named, truth, strict=True) if true.is_hand]
    said = [(a, b) for a, b in hands if a is not Limb.UNKNOWN]
    return len(said) / len(hands), sum(a is b for a, b in said) / max(len(said), 1)


def roll(gap_ms: float, sticking: str, sd_ms: float = 5.0) -> Callable[[Random], list[Played]]:
    def make(random: Random) -> list[Played]:
        return [
            Played(500 + k * gap_ms + random.gauss(0, sd_ms), R if sticking[k % len(sticking)] == "R" else L)
            for k in range(240)
        ]

    return make


def any_sticking(random: Random) -> list[Played]:
    pieces = [Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.RIDE]
    return [
        Played(500 + k * 80, random.choice([R, L]), random.choice(pieces), random.uniform(0.5, 5)) for k in range(240)
    ]


def flams(random: Random) -> list[Played]:
    played = []
    for k in range(120):
        grace, main = random.choice([(R, L), (L, R)])
        played += [Played(500 + 400 * k - random.uniform(15, 40), grace, speed=0.9), Played(500 + 400 * k, main)]
    return played


def unisons(random: Random) -> list[Played]:
    played = []
    for k in range(160):
        played.append(Played(500 + 150 * k + random.gauss(0, 5), R, Piece.HIHAT, 1.5))
        if k % 2:
            played.append(Played(500 + 150 * k + random.gauss(0, 5), L, Piece.SNARE, 3.0))
        else:
            played.append(Played(500 + 150 * k, FOOT, Piece.KICK))
    return played


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("latencies_ms", [(25.0, -12.0), (-55.0, 50.0), (45.0, 45.0)])
@pytest.mark.parametrize(
    ("make", "least"),
    [
        (roll(50, "RL"), 0.95),
        (roll(62.5, "RL", sd_ms=2.0), 0.95),
        (roll(60, "RRLL"), 0.95),
        (roll(90, "RLRRLRLL"), 0.95),
        (any_sticking, 0.95),
        (flams, 0.8),
        (unisons, 0.8),
    ],
    ids=["roll", "even_roll", "doubles", "paradiddle", "any_sticking", "flams", "unisons"],
)
def test_hands_are_named_and_right(
    make: Callable[[Random], list[Played]], least: float, latencies_ms: tuple[float, float], seed: int
) -> None:
    named, right = told(make(Random(seed)), Room(*latencies_ms, seed=seed))
    assert named >= least
    assert right >= 0.99


@pytest.mark.parametrize("late_ms", [-25.0, 0.0, 25.0])
def test_an_even_roll_is_named_rightly_or_left_open(late_ms: float) -> None:
    """Hands that alternate like a machine fit latencies a stroke apart just as well: nobody could tell them apart."""
    for seed in range(6):
        named, right = told(roll(50, "RL", sd_ms=0.0)(Random(seed)), Room(late_ms, late_ms + 3, seed=seed))
        assert named < 0.02 or right > 0.99


def test_more_jitter_and_loss_name_fewer_hands_but_no_more_wrong_ones() -> None:
    named, right = told(any_sticking(Random(5)), Room(jitter_ms=3.0, lost=0.04))
    assert named >= 0.85
    assert right >= 0.99


def test_where_no_stroke_was_felt_nobody_can_tell() -> None:
    hits, strokes, truth = heard(roll(120, "RL")(Random(2)), Room(lost=0.0))
    only_right = [stroke for stroke in strokes if stroke.limb is R]
    named = name_hands(hits, only_right)
    assert {said for said, true in zip(named, truth, strict=True) if true is L} == {Limb.UNKNOWN}
    assert sum(said is R for said in named) >= 110


def test_without_sensors_hands_are_unknown_and_feet_are_feet() -> None:
    hits = [
        Hit(0, Piece.SNARE, Zone.HEAD, 80),
        Hit(1, Piece.KICK, Zone.HEAD, 80),
        Hit(2, Piece.HIHAT_PEDAL, Zone.PEDAL, 9),
    ]
    assert name_hands(hits, []) == (Limb.UNKNOWN, Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
    assert name_hands([], []) == ()


def test_a_kick_beside_a_stroke_of_the_hand_stays_a_foot() -> None:
    played = [one for k in range(40) for one in (Played(300.0 * k, R), Played(300.0 * k + 1, FOOT, Piece.KICK))]
    hits, strokes, truth = heard(played, Room(lost=0.0))
    assert list(name_hands(hits, strokes)) == truth


def test_a_limb_that_a_device_tells_is_kept_and_strokes_in_the_air_count_for_nothing() -> None:
    hits, strokes, _ = heard([Played(200.0 * k, R) for k in range(30)], Room(lost=0.0))
    told_left = [replace(hit, limb=L) for hit in hits]
    assert set(name_hands(told_left, strokes)) == {L}
    assert set(name_hands(hits, [replace(stroke, in_air=True) for stroke in strokes])) == {Limb.UNKNOWN}


def test_order_and_a_shift_of_all_times_change_nothing() -> None:
    hits, strokes, _ = heard(any_sticking(Random(3)), Room())
    named = name_hands(hits, strokes)
    backwards = name_hands(hits[::-1], strokes[::-1])
    assert backwards[::-1] == named
    later = name_hands(
        [replace(hit, at_ns=hit.at_ns + 10**15) for hit in hits],
        [replace(stroke, at_ns=stroke.at_ns + 10**15) for stroke in strokes],
    )
    assert later == named


def test_a_window_of_a_few_hits_is_named_too() -> None:
    hits, strokes, truth = heard(roll(125, "RL")(Random(4))[:24], Room(lost=0.0))
    named = name_hands(hits, strokes)
    assert sum(a is b for a, b in zip(named, truth, strict=True)) >= 22


def test_the_offset_is_where_the_differences_heap_up() -> None:
    """Hits 30 ms after strokes at uneven times: every other difference occurs once."""
    strokes_ms = [0.0, 130.0, 301.0, 512.0, 777.0, 1000.0, 1313.0]
    candidates = offset_candidates(np.array([at + 30 for at in strokes_ms]), np.array(strokes_ms))
    assert candidates[0] == pytest.approx(30.0, abs=0.5)
    assert offset_candidates(np.array([5000.0]), np.array(strokes_ms)) == []
