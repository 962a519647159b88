"""Examines air drumming: zones are taught as a player would, then played; what is told is held against the truth.

The truth of a beat is the peak of the tip's |acceleration|; a hit belongs to the beat of the same hand that is nearest,
within 60 ms after the median lag.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from benchmarks.stick_cases import GRIPS, HANDS, L, R
from station.core.events import Hit, SensorSamples
from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.simulation.sticks.stick_swing import SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_score import PROFESSIONAL, as_played_by
from station.simulation.sticks.swing_sensor import SensorSpec
from station.simulation.sticks.swing_spec import GestureKind, StickGesture, StickStrokeSpec, StrokeKind
from station.sync.air.air_drums import AirDrums
from station.sync.air.air_zones import AirKit
from station.sync.air.zone_learning import AskedZone, ZoneLearning
from station.sync.strokes.stick_orientation import StickOrientation

ZONES = {R: (Piece.SNARE, Piece.TOM_2, Piece.FLOOR_TOM_1), L: (Piece.SNARE, Piece.HIHAT)}
"""Pieces that lie 40° or more apart as each hand sees them."""
TOO_CLOSE = {R: (Piece.HIHAT, Piece.SNARE), L: (Piece.SNARE,)}
"""Hi-hat and snare: 10° apart for the right hand."""
KINDS = (("slow", 0), ("slow", 20), ("eighths", 0), ("eighths", 20), ("fast", 0), ("restless", 0), ("long", 0))
MUSIC = {
    "slow": (0.6, 30, True),
    "eighths": (0.25, 80, False),
    "fast": (0.09, 120, False),
    "restless": (0.6, 24, True),
    "long": (0.4, 300, False),
}
"""Seconds from beat to beat, how many, both hands at once or in turn. `restless` hands lift, twitch, wave after it."""
TAUGHT = 8
SPARE = 2
REACH_S = 0.060
Asked = tuple[float, AskedZone]
"""A zone that is asked for, and from when on."""
HEADER = (
    f"{'in the air':46s} {'n':>4s} {'miss':>4s} {'fals':>4s} {'zone':>5s} {'lag':>6s} {'sd':>5s} {'worst':>6s} "
    f"{'told after beat: median':>10s} {'p95':>6s} {'r(v)':>5s}"
)


@dataclass(frozen=True)
class AirScore:
    """How one air session went; `told_ms` (n,) how long after its beat each hit was told."""

    name: str
    beats: int
    missed: int
    false: int
    wrong_zone: int
    off_ms: NDArray[np.float64]
    told_ms: NDArray[np.float64]
    velocity_correlation: float

    def line(self) -> str:
        """One row of the table."""
        found = max(len(self.off_ms), 1)
        lag = float(np.median(self.off_ms)) if len(self.off_ms) else float("nan")
        return (
            f"{self.name:46.46s} {self.beats:4d} {self.missed:4d} {self.false:4d} "
            f"{100 * (1 - self.wrong_zone / found):5.1f} {lag:6.1f} {self.off_ms.std():5.1f} "
            f"{np.abs(self.off_ms - lag).max(initial=0):6.1f} {np.median(self.told_ms):10.1f} "
            f"{np.percentile(self.told_ms, 95):18.1f} {self.velocity_correlation:5.2f}"
        )


def examine_air(seeds: range, sensors: dict[str, SensorSpec]) -> None:
    """Every kind of playing with every sensor."""
    print(f"\n{HEADER}")
    for name, sensor in sensors.items():
        for seed in seeds:
            for kind, ahead_ms in KINDS:
                label = f"{kind}, {ahead_ms} ms ahead · {name} · seed {seed}"
                print(air_score(label, kind, sensor, seed, ahead_ms).line(), flush=True)
    strokes, asked, _ = taught(TOO_CLOSE, 0)
    played = _played(strokes, [], next(iter(sensors.values())), 0)
    learning, _ = _heard(played, AirDrums(AirKit(())), asked, np.inf)
    told = [f"{c.one.piece.name} and {c.other.piece.name}" for c in learning.learnt().close]
    print(f"zones 10° apart, told to be too close: {', '.join(told) or 'nothing said'}")


def air_score(name: str, kind: str, sensor: SensorSpec, seed: int, ahead_ms: int) -> AirScore:
    """Teaches, plays and compares."""
    lesson, asked, until_s = taught(ZONES, seed)
    strokes = music(kind, until_s + 1.0, seed)
    gestures = restless(strokes, seed) if kind == "restless" else []
    played = _played([*lesson, *strokes], gestures, sensor, seed)
    drums = AirDrums(AirKit(()), ahead_ms * NS_PER_MS if ahead_ms else None)
    _, told = _heard(played, drums, asked, until_s)
    return _compared(name, played, told, until_s)


def taught(zones: dict[Limb, tuple[Piece, ...]], seed: int) -> tuple[list[StickStrokeSpec], list[Asked], float]:
    """Two strokes a second at each zone, when each was asked for, and when the last is over.

    A player who watches strikes until enough have counted, so there are `SPARE` more than needed.
    """
    strokes, asked, at_s = [], [], 3.0
    for limb, pieces in zones.items():
        for piece in pieces:
            strokes += [_air(at_s + 0.5 * i, limb, piece, 3.5) for i in range(TAUGHT + SPARE)]
            asked.append((at_s - 0.3, AskedZone(limb, piece)))
            at_s += 0.5 * (TAUGHT + SPARE) + 0.7
    return as_played_by(PROFESSIONAL, strokes, seed), asked, at_s


def music(kind: str, from_s: float, seed: int) -> list[StickStrokeSpec]:
    """Strokes in the air; each hand begins at its first zone."""
    rng = np.random.default_rng(seed)
    every_s, count, both = MUSIC[kind]
    strokes = [_air(from_s, R, Piece.SNARE, 3.5), _air(from_s + every_s, L, Piece.SNARE, 3.5)]
    now = dict.fromkeys(HANDS, Piece.SNARE)
    for i in range(count):
        at_s = from_s + (i + 3) * every_s
        for hand in HANDS if both else (HANDS[i % 2],):
            if rng.uniform() < (0.15 if kind == "fast" else 0.5):
                now[hand] = ZONES[hand][int(rng.integers(len(ZONES[hand])))]
            strokes.append(_air(at_s, hand, now[hand], float(rng.uniform(2.5, 6.0))))
    return as_played_by(PROFESSIONAL, strokes, seed)


def restless(strokes: Sequence[StickStrokeSpec], seed: int) -> list[StickGesture]:
    """What hands do in a pause after the music: they lift, twitch, wave, scratch and rest, but strike nothing."""
    rng = np.random.default_rng(seed + 4000)
    at_s, gestures = strokes[-1].at_s + 1.0, []
    for i in range(12):
        kind = (GestureKind.LIFT, GestureKind.TWITCH, GestureKind.WAVE, GestureKind.SCRATCH, GestureKind.TWIRL)[i % 5]
        lasts_s = rng.uniform(0.15, 0.3) if kind is GestureKind.TWITCH else rng.uniform(0.6, 2.0)
        gestures.append(StickGesture(at_s, lasts_s, HANDS[i % 2], kind))
        at_s += lasts_s + 0.6
    return gestures


def _air(at_s: float, limb: Limb, piece: Piece, speed_m_s: float) -> StickStrokeSpec:
    return StickStrokeSpec(at_s, limb, piece, speed_m_s=speed_m_s, kind=StrokeKind.AIR)


def _played(
    strokes: Sequence[StickStrokeSpec], gestures: Sequence[StickGesture], sensor: SensorSpec, seed: int
) -> SimulatedSticks:
    rng = np.random.default_rng(seed + 3000)
    sensors = {hand: replace(sensor, clock_ppm=float(rng.uniform(-100, 100))) for hand in HANDS}
    return play(
        strokes, gestures, pair=StickPair(sensors, {hand: str(rng.choice(GRIPS[:3])) for hand in HANDS}), seed=seed
    )


def _heard(
    played: SimulatedSticks, drums: AirDrums, asked: Sequence[Asked], until_s: float
) -> tuple[ZoneLearning, list[tuple[int, Hit]]]:
    """The lesson, and the hits after `until_s`, each with the time of the sample that told it."""
    events: list[SensorSamples] = sorted((e for s in played.sticks.values() for e in s.events()), key=lambda e: e.at_ns)
    turned = {stick.device: StickOrientation(stick.mounting) for stick in played.sticks.values()}
    for stick in played.sticks.values():
        drums.mount(stick.device, stick.mounting)
    learning, idle = ZoneLearning([zone for _, zone in asked]), ZoneLearning(())
    told = []
    for event in events:
        at_s = event.at_ns / NS_PER_S
        if at_s > until_s and drums.learning is not None:
            drums.use(learning.learnt().kit)
        elif at_s <= until_s:
            shown = [zone for from_s, zone in asked if from_s <= at_s]
            drums.learning = learning if shown and shown[-1] == learning.now else idle
        for sample in event.samples:
            for motion in turned[event.device].feed(sample):
                told += [(motion.at_ns, hit) for hit in drums.moved(event.device, motion)]
    return learning, told


def _compared(name: str, played: SimulatedSticks, told: list[tuple[int, Hit]], until_s: float) -> AirScore:
    truth = played.truth[played.truth["at_s"] > until_s]
    first, lag = _pairs(truth, told, 0.0), 0.0
    if first:
        lag = float(np.median([told[t][1].at_ns / NS_PER_S - truth["at_s"][row] for row, t in first]))
    pairs = _pairs(truth, told, lag)
    off = np.array([1e3 * (told[t][1].at_ns / NS_PER_S - truth["at_s"][row]) for row, t in pairs])
    late = np.array([1e3 * (told[t][0] / NS_PER_S - truth["at_s"][row]) for row, t in pairs])
    wrong = sum(int(told[t][1].piece) != int(truth["piece"][row]) for row, t in pairs)
    speeds = np.array([[truth["speed_m_s"][row], told[t][1].fine_velocity] for row, t in pairs]).reshape(-1, 2)
    alike = float(np.corrcoef(speeds.T)[0, 1]) if len(speeds) > 2 else float("nan")
    if not len(late):
        off, late = np.zeros(0), np.array([np.nan])
    return AirScore(name, len(truth), len(truth) - len(pairs), len(told) - len(pairs), wrong, off, late, alike)


def _pairs(truth: NDArray[np.void], told: list[tuple[int, Hit]], lag: float) -> list[tuple[int, int]]:
    """One to one, the closest first."""
    candidates = [
        (abs(hit.at_ns / NS_PER_S - row["at_s"] - lag), i, t)
        for t, (_, hit) in enumerate(told)
        for i, row in enumerate(truth)
        if int(hit.limb) == int(row["limb"]) and abs(hit.at_ns / NS_PER_S - row["at_s"] - lag) < REACH_S
    ]
    rows: set[int] = set()
    taken: set[int] = set()
    pairs = []
    for _, i, t in sorted(candidates):
        if i not in rows and t not in taken:
            rows.add(i)
            taken.add(t)
            pairs.append((i, t))
    return pairs
