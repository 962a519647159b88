"""What the sticks' examiner plays: kinds of music, motions that are no strokes, sensors of many kinds.

Every case is drawn from a seed. Nothing here knows how strokes are found.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from station.core.pieces import Limb, Piece, Zone
from station.simulation.sticks.stick_swing import HANDS, SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_pads import ModuleSpec
from station.simulation.sticks.swing_places import place
from station.simulation.sticks.swing_score import PROFESSIONAL, PlayerSpec, as_played_by, spec_from_sticking
from station.simulation.sticks.swing_sensor import Link, SensorSpec
from station.simulation.sticks.swing_spec import (
    GestureKind,
    StickGesture,
    StickStrokeSpec,
    StrokeKind,
    speed_for_velocity,
)

R, L = HANDS
GRIPS = ("german", "american", "french", "traditional")
TRAVEL_M_S = 1.6
"""40 cm in 0.25 s (`shared/HUMANS.md`): hands go no faster from drum to drum."""
QUICK_HANDS = PlayerSpec(clock_share=0.01, motor_s=0.003, force_share=0.08)
"""Rolls at 10–20 strokes a second are played by fast, even hands only."""


@dataclass(frozen=True)
class Case:
    """One recording: its name, what is played and with what."""

    name: str
    strokes: Sequence[StickStrokeSpec]
    gestures: Sequence[StickGesture] = ()
    sensor: SensorSpec = field(default_factory=SensorSpec)
    module: ModuleSpec = field(default_factory=ModuleSpec)
    seed: int = 0

    def played(self) -> SimulatedSticks:
        """The recording; grips and clocks differ from seed to seed."""
        rng = np.random.default_rng(self.seed + 1000)
        sensors = {hand: replace(self.sensor, clock_ppm=float(rng.uniform(-100, 100))) for hand in HANDS}
        grips = {R: str(rng.choice(GRIPS[:3])), L: str(rng.choice(GRIPS))}
        return play(self.strokes, self.gestures, pair=StickPair(sensors, grips), module=self.module, seed=self.seed)


def music(seed: int) -> dict[str, list[StickStrokeSpec]]:
    """Kinds of music by name, each some ten seconds."""
    rng = np.random.default_rng(seed)

    def written(sticking: str, every_s: float, times: int, velocity: float = 80.0) -> list[StickStrokeSpec]:
        player = QUICK_HANDS if every_s < 0.11 else PROFESSIONAL
        return as_played_by(player, spec_from_sticking(sticking, every_s=every_s, times=times, velocity=velocity), seed)

    singles = {f"single roll {hz} a second": written("RL", 1 / hz, 4 * hz) for hz in (4, 8, 12, 16, 20)}
    return singles | {
        "one hand 5 a second": written("R", 0.2, 40),
        "one hand 8 a second": written("R", 0.125, 50),
        "doubles 70 ms": written("RRLL", 0.07, 25),
        "doubles 55 ms": written("RRLL", 0.055, 30),
        "paradiddles": written("RLRR LRLL", 0.125, 8),
        "accents and taps": written("R>LRL R>LLR", 0.15, 8, 50),
        "ghosts": written("RLRL", 0.15, 12, 22),
        "flams": written("lR rL", 0.4, 12),
        "flam taps": written("lRR rLL", 0.2, 8),
        "drags": written("llR rrL", 0.4, 12),
        "ratamacues": written("llRLRL>rrLRLR>", 0.17, 5),
        "unisons": _unisons(rng, 24),
        "rock groove": _groove(rng, 12, PROFESSIONAL),
        "wrong stickings": _groove(rng, 12, replace(PROFESSIONAL, wrong_sticking=0.25)),
        "crossing fills": _fills(rng, 10),
        "loud": written("RLRL", 0.25, 10, 127),
        "loudest": [replace(s, speed_m_s=s.speed_m_s * 1.5, height_m=None) for s in written("RLRL", 0.3, 8, 127)],
        "buzzes": _buzzes(8),
        "rims": [replace(s, zone=Zone.RIM) for s in written("RLRR LRLL", 0.2, 5)],
    }


def motions(seed: int) -> dict[str, tuple[list[StickStrokeSpec], list[StickGesture]]]:
    """Motions that are no strokes, of each kind and both hands, with a stroke before and after."""
    rng = np.random.default_rng(seed)
    found = {}
    for kind, lasts, sizes in (
        (GestureKind.LIFT, (0.3, 1.5), (0.5, 1.5)),
        (GestureKind.TWITCH, (0.1, 0.3), (0.5, 2.0)),
        (GestureKind.WAVE, (1.5, 3.0), (0.5, 1.2)),
        (GestureKind.SCRATCH, (1.5, 3.0), (0.5, 1.5)),
        (GestureKind.TWIRL, (0.8, 2.0), (1.0, 2.0)),
        (GestureKind.REST, (2.0, 4.0), (1.0, 1.0)),
        (GestureKind.REGRIP, (0.3, 0.8), (-1.0, 1.0)),
    ):
        gestures, at_s = [], 4.0
        for i in range(8):
            gesture = StickGesture(at_s, rng.uniform(*lasts), HANDS[i % 2], kind, rng.uniform(*sizes))
            gestures.append(gesture)
            at_s += gesture.lasts_s + 0.8
        around = [StickStrokeSpec(at, hand) for at in (3.0, at_s + 0.5) for hand in HANDS]
        found[kind.value] = (around, gestures)
    clicks = [
        StickStrokeSpec(4 + 0.5 * i, hand, kind=StrokeKind.CLICK, speed_m_s=2.0) for i in range(8) for hand in HANDS
    ]
    found["clicks"] = ([StickStrokeSpec(3.0, hand) for hand in HANDS] + clicks, [])
    beside = [StickStrokeSpec(4 + 0.7 * i, HANDS[i % 2], kind=StrokeKind.AIR, speed_m_s=3.0) for i in range(12)]
    found["strokes beside the pad"] = ([StickStrokeSpec(3.0, hand) for hand in HANDS] + beside, [])
    return found


def sensors() -> dict[str, SensorSpec]:
    """Sensors by name, the usual one first."""
    usual = SensorSpec(rate_hz=400)
    return {
        "400 Hz": usual,
        "100 Hz": replace(usual, rate_hz=100),
        "200 Hz": replace(usual, rate_hz=200),
        "1000 Hz": replace(usual, rate_hz=1000),
        "200 Hz, MPU-9250": replace(usual, rate_hz=200, chip="mpu9250"),
        "400 Hz, stamps off by 2 ms": replace(usual, stamp_wander_s=0.002),
        "400 Hz, 2 % lost": replace(usual, link=Link(loss=0.02)),
        "400 Hz, 2 % of packets of 5 lost": replace(usual, link=Link(loss=0.02, samples_a_packet=5)),
        "200 Hz, Bluetooth 30 ms": replace(
            usual, rate_hz=200, link=Link(interval_s=0.03, samples_a_packet=6, loss=0.01)
        ),
        "200 Hz, gyro ±1000 °/s": replace(usual, rate_hz=200, rate_range_dps=1000.0),
        "100 Hz, no gyro but attitude": replace(usual, rate_hz=100, has_gyro=False, tells_orientation=True),
        "400 Hz, away for a second": replace(usual, link=Link(away_s=((6.0, 7.0),))),
    }


def _unisons(rng: np.random.Generator, count: int) -> list[StickStrokeSpec]:
    strokes = []
    for i in range(count):
        at_s = 3 + 0.4 * i
        hands = dict(zip((R, L), (Piece.HIHAT, Piece.SNARE), strict=True))
        for hand in (R, L) if i % 2 == 0 else (R,):
            zone = Zone.BOW if hands[hand] is Piece.HIHAT else Zone.HEAD
            velocity = float(rng.uniform(50, 110))
            strokes.append(
                StickStrokeSpec(
                    at_s + rng.normal(0, 0.008), hand, hands[hand], zone, speed_m_s=speed_for_velocity(velocity)
                )
            )
    return strokes


def _groove(rng: np.random.Generator, bars: int, player: PlayerSpec) -> list[StickStrokeSpec]:
    """Eighths on the hi-hat, backbeats and a few ghosts on the snare, a crash now and then; 110 bpm."""
    eighth = 60 / 110 / 2
    strokes = []
    for bar in range(bars):
        for i in range(8):
            at_s = 3 + (8 * bar + i) * eighth
            crash = i == 0 and bar % 4 == 0
            piece = Piece.CRASH_1 if crash else Piece.HIHAT
            zone = Zone.EDGE if crash else Zone.BOW
            velocity = 110 if crash else 85 if i % 2 == 0 else 65
            strokes.append(StickStrokeSpec(at_s, R, piece, zone, speed_for_velocity(velocity), shoulder=crash))
            if i in (2, 6):
                strokes.append(StickStrokeSpec(at_s, L, speed_m_s=speed_for_velocity(112)))
            elif rng.uniform() < 0.25:
                strokes.append(StickStrokeSpec(at_s + eighth / 2, L, speed_m_s=speed_for_velocity(35)))
    return as_played_by(player, strokes, int(rng.integers(1 << 30)))


def _fills(rng: np.random.Generator, bars: int) -> list[StickStrokeSpec]:
    """Sixteenths around the drums with either hand, hands crossing; 100 bpm."""
    pieces = (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1, Piece.HIHAT)
    strokes: list[StickStrokeSpec] = []
    hand = R
    for i in range(bars * 8):
        hand = (L if hand is R else R) if rng.uniform() < 0.8 else hand
        piece = pieces[int(rng.integers(len(pieces)))] if i % 2 == 0 else strokes[-1].piece
        before = next((s for s in reversed(strokes) if s.limb is hand), None)
        if before is not None and math.dist(place(piece), place(before.piece)) > TRAVEL_M_S * (
            0.15 * i - before.at_s + 3
        ):
            piece = before.piece
        zone = Zone.BOW if piece is Piece.HIHAT else Zone.HEAD
        strokes.append(StickStrokeSpec(3 + 0.15 * i, hand, piece, zone, speed_for_velocity(rng.uniform(60, 115))))
    return as_played_by(PROFESSIONAL, strokes, int(rng.integers(1 << 30)))


def _buzzes(count: int) -> list[StickStrokeSpec]:
    return [
        StickStrokeSpec(3 + 0.5 * i, HANDS[i % 2], speed_m_s=2.5, kind=StrokeKind.BUZZ, lasts_s=0.25)
        for i in range(count)
    ]


def air_zones() -> dict[Limb, tuple[Piece, ...]]:
    """What each hand plays in the air."""
    return {
        R: (Piece.HIHAT, Piece.SNARE, Piece.TOM_2, Piece.FLOOR_TOM_1, Piece.RIDE),
        L: (Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.CRASH_1),
    }


def modules(seed: int) -> ModuleSpec:
    """A drum module: latencies of 3–5 ms, jitter of 0.5–1 ms, a miss and a false hit now and then."""
    rng = np.random.default_rng(seed + 2000)
    return ModuleSpec(
        latency_s=float(rng.uniform(0.003, 0.005)), jitter_s=float(rng.uniform(0.0005, 0.001)), missed=0.01, false=0.01
    )
