"""Air drumming measured: writes the tables of docs/air-drumming.md.

    python benchmarks/air_drums.py [--data ../shared/data] [--seeds N] [--docs docs/air-drumming.md]

Strokes, gestures and kits are played by the simulated sticks (`station.simulation.sticks`), which know the beat: the
peak of the tip's acceleration. Zones of real strokes are those of imu/airdrums (40 Hz, orientation only), which can
prove no times. Everything has a seed. About a minute.
"""

import argparse
import sys
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import pi, radians
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.events import PhaseEstimate
from station.core.pieces import Limb, Piece, Zone, word
from station.core.units import NS_PER_MS, NS_PER_S
from station.simulation.sticks.stick_swing import HANDS, SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_sensor import Link, SensorSpec, SimulatedStick
from station.simulation.sticks.swing_spec import GestureKind, StickGesture, StickStrokeSpec, StrokeKind
from station.sync.air.air_drums import AirDrums
from station.sync.air.air_strokes import AirBeat, AirStrokes
from station.sync.air.air_swing import SwingReader, wrapped
from station.sync.air.air_zones import AirKit, AirZone
from station.sync.air.heading_tracker import HeadingTracker
from station.sync.air.zone_learning import STROKES, AirAim, AskedZone, LearntAir, ZoneLearning, zone_of
from station.sync.strokes.stick_orientation import StickMotion, StickOrientation

BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"
NEAR_S = 0.06
"""A hit that is further from every beat belongs to none: strokes of a hand come 120 ms apart at the least here."""
Pieces = Mapping[Limb, tuple[Piece, ...]]
APART: Pieces = {
    Limb.RIGHT_HAND: (Piece.SNARE, Piece.TOM_2, Piece.FLOOR_TOM_1),
    Limb.LEFT_HAND: (Piece.SNARE, Piece.HIHAT),
}
CLOSE: Pieces = {
    Limb.RIGHT_HAND: (*APART[Limb.RIGHT_HAND], Piece.RIDE),
    Limb.LEFT_HAND: (*APART[Limb.LEFT_HAND], Piece.TOM_1),
}
"""The second as kits stand: the ride 11° beside the floor tom for the right hand, the tom 16° beside the snare for the
left."""
Row = Sequence[object]


def main() -> int:
    """Prints the tables, and writes them into a page where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", type=Path, default=Path("../shared/data"))
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--docs", type=Path)
    options = parser.parse_args()
    tables = [
        stroke_table(options.seeds),
        gesture_table(options.seeds),
        kit_table(options.seeds),
        forecast_table(options.seeds),
        zone_table(options.data / "imu" / "airdrums"),
        drift_table(),
    ]
    text = "\n".join(tables)
    print(text)
    if options.docs is not None:
        page = options.docs.read_text(encoding="utf-8")
        before, after = page.split(BEGIN)[0], page.split(END)[1]
        write_whole(options.docs, f"{before}{BEGIN}\n\n{text}\n{END}{after}".encode())
    return 0


def table(title: str, head: Row, rows: Iterable[Row]) -> str:
    """A titled table in Markdown."""
    lines = [f"**{title}**", "", "| " + " | ".join(map(str, head)) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(map(str, row)) + " |" for row in rows]) + "\n"


# --- strokes ----------------------------------------------------------------------------------------------------------


def air_strokes(
    count: int,
    seed: int,
    gap_s: tuple[float, float],
    speed_m_s: tuple[float, float] = (0.8, 6.0),
    pieces: Pieces = CLOSE,
) -> list[StickStrokeSpec]:
    """Strokes of both hands at pieces by chance, the first four at the snare."""
    rng, strokes = np.random.default_rng(seed), []
    for hand in HANDS:
        at_s = 3.0 + (0.1 if hand is Limb.LEFT_HAND else 0.0)
        for number in range(count):
            piece = Piece.SNARE if number < 4 else pieces[hand][int(rng.integers(len(pieces[hand])))]
            speed = float(np.exp(rng.uniform(*np.log(speed_m_s))))
            strokes.append(StickStrokeSpec(at_s, hand, piece, speed_m_s=speed, kind=StrokeKind.AIR))
            at_s += float(rng.uniform(*gap_s))
    return strokes


def pair_of(spec: SensorSpec) -> StickPair:
    """Two sticks with the same kind of sensor."""
    return StickPair(sensors=dict.fromkeys(HANDS, spec))


def motions_of(stick: SimulatedStick) -> list[StickMotion]:
    """What the orientation filter tells of a stick's samples."""
    orientation = StickOrientation(stick.mounting)
    return [motion for sample in stick.samples for motion in orientation.feed(sample)]


def beats_of(motions: Sequence[StickMotion], tip_m: float) -> list[AirBeat]:
    """The strokes found."""
    reader, strokes = SwingReader(tip_m), AirStrokes()
    found = (strokes.feed(swing) for motion in motions if (swing := reader.feed(motion)) is not None)
    return [beat for beat in found if beat is not None]


class Found(NamedTuple):
    """Errors of the beats and how long after the true beat each was told, ms (n,); strokes missed and false ones."""

    errors_ms: list[float]
    told_ms: list[float]
    missed: int
    false: int


def compared(true_s: NDArray[np.float64], beats: Sequence[AirBeat]) -> Found:
    """Beats against the truth, each at most once."""
    errors, told, used, false = [], [], set(), 0
    for beat in beats:
        nearest = int(np.argmin(np.abs(true_s - beat.at_ns / NS_PER_S)))
        error_s = beat.at_ns / NS_PER_S - true_s[nearest]
        if abs(error_s) > NEAR_S or nearest in used:
            false += 1
            continue
        used.add(nearest)
        errors.append(float(error_s) * 1e3)
        told.append((beat.told_ns / NS_PER_S - float(true_s[nearest])) * 1e3)
    return Found(errors, told, len(true_s) - len(used), false)


LINKS = {"serial": Link(), "2 % lost": Link(loss=0.02), "Bluetooth, 2 % lost": Link(interval_s=0.015, loss=0.02)}


def stroke_table(seeds: int) -> str:
    """Found, false, timing and cost, by the sensor's rate, the link and how dense the strokes come."""
    rows = []
    for rate_hz in (100.0, 200.0, 400.0, 1000.0):
        for name, link in LINKS.items():
            if name != "serial" and rate_hz not in (200.0, 400.0):
                continue
            spec = SensorSpec(rate_hz=rate_hz, link=link)
            rows.append((f"{rate_hz:.0f}", name, *_stroke_row(spec, seeds)))
    head = ("Hz", "link", "strokes", "found", "false", "bias ms", "SD ms", "worst ms", "told after ms", "µs a sample")
    return table("Strokes in the air: 120–500 ms apart, tips 0.8–6 m/s", head, rows)


def _stroke_row(spec: SensorSpec, seeds: int) -> Row:
    parts, strokes, cost_s, samples = [], 0, 0.0, 0
    for seed in range(seeds):
        for gap_s in ((0.3, 0.5), (0.12, 0.2)):
            sim = play(air_strokes(40, seed, gap_s), pair=pair_of(spec), seed=seed)
            for hand, stick in sim.sticks.items():
                motions = motions_of(stick)
                begin_s = time.perf_counter()
                beats = beats_of(motions, stick.mounting.tip_m)
                cost_s += time.perf_counter() - begin_s
                true_s = sim.truth["at_s"][sim.truth["limb"] == hand]
                parts.append(compared(true_s, beats))
                strokes, samples = strokes + len(true_s), samples + len(motions)
    errors = np.array([error for part in parts for error in part.errors_ms])
    told = [after for part in parts for after in part.told_ms]
    return (
        strokes,
        len(errors),
        sum(part.false for part in parts),
        f"{errors.mean():+.1f}",
        f"{errors.std():.2f}",
        f"{np.abs(errors).max():.1f}",
        f"{np.median(told):.1f}",
        f"{cost_s / samples * 1e6:.0f}",
    )


def gesture_table(seeds: int) -> str:
    """False hits of motions that are no strokes."""
    rows = []
    for kind in GestureKind:
        counts = []
        for size in (1.0, 2.0):
            gestures = [StickGesture(3.0 + 3.0 * n, 2.0, hand, kind, size) for n in range(4) for hand in HANDS]
            sims = [play([], gestures, pair=pair_of(SensorSpec()), seed=seed) for seed in range(seeds)]
            sticks = [stick for sim in sims for stick in sim.sticks.values()]
            false = sum(len(beats_of(motions_of(stick), stick.mounting.tip_m)) for stick in sticks)
            counts.append(f"{false} in {8 * seeds}")
        rows.append((kind.value, *counts))
    return table("Motions that are no strokes: false hits, 400 Hz", ("motion", "usual size", "twice as large"), rows)


# --- whole kits -------------------------------------------------------------------------------------------------------


def taught(rate_hz: float, seed: int, pieces: Pieces) -> LearntAir:
    """A kit learnt from eight strokes at each piece of each hand, usual speed."""
    strokes, asked = [], []
    for hand in HANDS:
        for number, piece in enumerate(pieces[hand]):
            asked.append(AskedZone(hand, piece))
            begin_s = 3.0 + 5.0 * number
            strokes += [
                StickStrokeSpec(begin_s + 0.5 * n, hand, piece, speed_m_s=3.3, kind=StrokeKind.AIR)
                for n in range(STROKES)
            ]
    sim = play(strokes, pair=pair_of(SensorSpec(rate_hz=rate_hz)), seed=seed)
    learning = ZoneLearning(asked)
    for hand in HANDS:
        stick = sim.sticks[hand]
        for beat in beats_of(motions_of(stick), stick.mounting.tip_m):
            learning.strike(hand, AirAim(beat.heading_rad, beat.elevation_rad, beat.speed_m_s))
    return learning.learnt()


class Played(NamedTuple):
    """Of a kit's strokes: pieces right, wrong, unclear; the hits' errors and when they were told, ms after the beat."""

    right: int
    wrong: int
    unclear: int
    errors_ms: list[float]
    told_ms: list[float]
    failed: int


def performed(kit: AirKit, sim: SimulatedSticks, ahead_ns: int | None, loop_s: float | None = None) -> Played:
    """A performance, heard by an air kit; a loop's phase is told where it has one."""
    drums, right, wrong, errors, told, failed = AirDrums(kit, ahead_ns), 0, 0, [], [], 0
    for hand, stick in sim.sticks.items():
        truth = sim.truth[sim.truth["limb"] == hand]
        drums.mount(stick.device, stick.mounting)
        for motion in motions_of(stick):
            if loop_s is not None:
                phase = wrapped(2.0 * pi * motion.at_ns / NS_PER_S / loop_s)
                drums.phase(PhaseEstimate(motion.at_ns, phase, 1.0, 1.0, 2.0 * pi / loop_s, True))
            for hit in drums.moved(stick.device, motion):
                nearest = int(np.argmin(np.abs(truth["at_s"] - hit.at_ns / NS_PER_S)))
                right += int(truth["piece"][nearest]) == int(hit.piece)
                wrong += int(truth["piece"][nearest]) != int(hit.piece)
                errors.append((hit.at_ns / NS_PER_S - float(truth["at_s"][nearest])) * 1e3)
                told.append((motion.at_ns / NS_PER_S - float(truth["at_s"][nearest])) * 1e3)
        status = drums.status(stick.device)
        failed += 0 if status is None else status.failed
    return Played(right, wrong, len(sim.truth) - right - wrong, errors, told, failed)


def kit_table(seeds: int) -> str:
    """Pieces right through the whole path: learnt, then played in another session with another heading."""
    rows = []
    for name, pieces in (("three and two, apart", APART), ("four and three, as kits stand", CLOSE)):
        for rate_hz in (100.0, 200.0, 400.0):
            learnt = [taught(rate_hz, seed, pieces) for seed in range(seeds)]
            sims = [_groove(rate_hz, 50 + seed, (1.2, 6.0), pieces) for seed in range(seeds)]
            heard = [performed(each.kit, sim, None) for each, sim in zip(learnt, sims, strict=True)]
            counts = [sum(column) for column in zip(*(part[:3] for part in heard), strict=True)]
            pairs = sorted(
                {f"{word(pair.one.piece)}–{word(pair.other.piece)}" for each in learnt for pair in each.close}
            )
            shares = (f"{count / sum(counts):.1%}" for count in counts)
            rows.append((name, f"{rate_hz:.0f}", sum(counts), *shares, ", ".join(pairs) or "none"))
    head = ("pieces of both hands", "Hz", "strokes", "right", "wrong", "unclear", "said to be too close")
    return table("A kit taught by eight strokes a piece, then played: 300–500 ms apart, 1.2–6 m/s", head, rows)


def _groove(rate_hz: float, seed: int, speed_m_s: tuple[float, float], pieces: Pieces) -> SimulatedSticks:
    return play(
        air_strokes(60, seed, (0.3, 0.5), speed_m_s, pieces), pair=pair_of(SensorSpec(rate_hz=rate_hz)), seed=seed
    )


def forecast_table(seeds: int) -> str:
    """When hits are told, with and without forecasts."""
    rows = []
    for rate_hz in (200.0, 400.0):
        kits = [taught(rate_hz, seed, APART).kit for seed in range(seeds)]
        sims = [_groove(rate_hz, 80 + seed, (2.5, 4.5), APART) for seed in range(seeds)]
        for ahead_ms in (None, 0, 20):
            ahead_ns = None if ahead_ms is None else ahead_ms * NS_PER_MS
            heard = [performed(kit, sim, ahead_ns) for kit, sim in zip(kits, sims, strict=True)]
            name = "no forecast" if ahead_ms is None else f"up to {ahead_ms} ms ahead"
            rows.append((f"{rate_hz:.0f}", name, *_forecast(heard)))
    rows += [("400", "a known loop, up to 30 ms ahead", *_looped(seeds))]
    head = ("Hz", "forecast", "told, median ms", "95 %", "time of the hit, ms", "wrong piece", "did not come")
    return table("How long after the true beat a hit is told; strokes of 2.5–4.5 m/s", head, rows)


def _forecast(heard: Sequence[Played]) -> Row:
    errors = np.array([error for part in heard for error in part.errors_ms])
    told = [after for part in heard for after in part.told_ms]
    return (
        f"{np.median(told):+.1f}",
        f"{np.percentile(told, 95):+.1f}",
        f"{errors.mean():+.1f} ± {errors.std():.1f}",
        sum(part.wrong for part in heard),
        sum(part.failed for part in heard),
    )


def _looped(seeds: int) -> Row:
    """A loop of four quavers of 400 ms in each hand, ± 4 ms, whose phase is known."""
    heard, loop_s = [], 1.6
    for seed in range(seeds):
        rng = np.random.default_rng(seed)
        strokes = [
            StickStrokeSpec(
                3.0 + 0.4 * n + 0.2 * hand + float(rng.normal(0.0, 0.004)),
                hand,
                APART[hand][n % 2],
                speed_m_s=float(rng.uniform(2.5, 4.5)),
                kind=StrokeKind.AIR,
            )
            for hand in HANDS
            for n in range(60)
        ]
        sim = play(strokes, pair=pair_of(SensorSpec()), seed=seed)
        heard.append(performed(taught(400.0, seed, APART).kit, sim, 30 * NS_PER_MS, loop_s))
    return _forecast(heard)


# --- real strokes -----------------------------------------------------------------------------------------------------

_RECORDED = {1: Piece.KICK, 2: Piece.SNARE, 3: Piece.HIHAT}
"""What each recording strikes, by its author's own table (mmax1406/IMU_AirDrums, KnnTrainer.py)."""


def zone_table(folder: Path) -> str:
    """The three recordings of two sticks: each piece learnt from its first eight strokes and named in all others."""
    title = "Real strokes (imu/airdrums, 40 Hz): each piece learnt from its first eight strokes, tested on all others"
    if not folder.exists():
        return table(title, ("",), [(f"{folder} is not here",)])
    rows: list[Row] = []
    for sensor in (1, 2):
        strokes = {take: recorded_strokes(folder / f"{take}_sensor{sensor}.txt") for take in _RECORDED}
        zones = [_zone(take, aims[:STROKES]) for take, aims in strokes.items()]
        hand = HeadingTracker(zones)
        hand.fix(0, 0, zones[0].heading_rad)
        for zone, (take, aims) in zip(zones, strokes.items(), strict=True):
            named = [hand.clear_zone(0, aim.heading_rad, aim.elevation_rad) for aim in aims[STROKES:]]
            right, unclear = named.count(zone), named.count(None)
            rows.append((sensor, take, len(named), right, len(named) - right - unclear, unclear))
        known = HeadingTracker(zones := [_zone(take, strokes[take]) for take in (1, 2)])
        known.fix(0, 0, zones[0].heading_rad)
        named = [known.clear_zone(0, aim.heading_rad, aim.elevation_rad) for aim in strokes[3]]
        rows.append(
            (sensor, "3, only 1 and 2 taught", len(named), "–", len(named) - named.count(None), named.count(None))
        )
    return table(title, ("stick", "recording", "strokes", "right", "wrong", "unclear"), rows)


def _zone(take: int, aims: Sequence[AirAim]) -> AirZone:
    return zone_of(AskedZone(Limb.RIGHT_HAND, _RECORDED[take]), aims)


def recorded_strokes(path: Path) -> list[AirAim]:
    """Where the stick pointed at its lowest after each fall of 10° or more; these recordings know no more.

    Columns: sensor, quaternion (w, x, y, z), the sensor's calibration, heading, pitch, two differences, time. The stick
    lies along the sensor's z.
    """
    table_of = np.loadtxt(path, delimiter=",")
    w, x, y, z = table_of[:, 1:5].T
    along = np.stack([2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)], 1)
    heading, elevation = np.arctan2(along[:, 1], along[:, 0]), np.arcsin(np.clip(along[:, 2], -1, 1))
    lowest: list[int] = []
    for n in range(6, len(elevation) - 1):
        is_low = elevation[n] <= elevation[n - 1] and elevation[n] < elevation[n + 1]
        if is_low and elevation[n - 6 : n].max() - elevation[n] > radians(10) and (not lowest or n - lowest[-1] > 5):
            lowest.append(n)
    return [AirAim(float(heading[n]), float(elevation[n]), 0.0) for n in lowest]


# --- drift ------------------------------------------------------------------------------------------------------------


def drift_table() -> str:
    """Ten minutes with a heading that drifts, rests in between; with and without correction."""
    rows = []
    for drift in (0.0, 2.0, 5.0, 8.0):
        with_it, without = (_mean(drift, corrects) for corrects in (True, False))
        rows.append((f"{drift:.0f}", *with_it, *without))
    head = ("° a minute", "right", "wrong", "unclear", "right, uncorrected", "wrong", "unclear")
    return table("Ten minutes with a heading that drifts: four zones 30° apart, strokes ± 5°", head, rows)


def _mean(drift: float, corrects: bool) -> list[str]:
    runs = np.array([drifted(drift, corrects, seed) for seed in range(4)], dtype=float)
    return [f"{share:.1%}" for share in runs.sum(axis=0) / runs.sum()]


def drifted(drift_deg_a_minute: float, corrects: bool, seed: int) -> tuple[int, int, int]:
    """Right, wrong and unclear strokes: runs of some seconds at two pieces, a few at others, rests of 10–60 s."""
    rng = np.random.default_rng(seed)
    centres = [(0.0, -10.0), (-30.0, -5.0), (30.0, 5.0), (-60.0, 20.0)]
    pieces = (Piece.SNARE, Piece.RIDE, Piece.HIHAT, Piece.CRASH_1)
    zones = [
        AirZone(Limb.RIGHT_HAND, piece, Zone.HEAD, radians(heading), radians(up), radians(6), radians(8))
        for piece, (heading, up) in zip(pieces, centres, strict=True)
    ]
    hand, at_s, drift, counts = HeadingTracker(zones), 0.0, 0.0, [0, 0, 0]
    rate, meant, left = drift_deg_a_minute, 0, 8
    say: Callable[[int, float, float], AirZone | None] = hand.clear_zone
    if corrects:
        say = lambda at_ns, heading, up: None if (found := hand.strike(at_ns, heading, up)) is None else found[0]  # noqa: E731
    hand.fix(0, 0, zones[0].heading_rad)
    while at_s < 600.0:
        gone_s = float(rng.uniform(10.0, 60.0)) if rng.random() < 0.004 else 0.5
        at_s += gone_s
        rate += float(rng.normal(0.0, 0.5)) * (gone_s / 60.0) ** 0.5
        drift += rate * gone_s / 60.0
        if left == 0:
            meant = int(rng.integers(4))
            left = int(rng.integers(1, 100 if meant in (1, 2) else 4))
        left -= 1
        heading = wrapped(radians(centres[meant][0] + drift + float(rng.normal(0.0, 5.0))))
        named = say(
            int(at_s * NS_PER_S) if corrects else 0, heading, radians(centres[meant][1] + float(rng.normal(0.0, 5.0)))
        )
        counts[2 if named is None else 0 if named is zones[meant] else 1] += 1
    return counts[0], counts[1], counts[2]


if __name__ == "__main__":
    sys.exit(main())
