"""Examines what the station makes of sensors on sticks: strokes, false strokes, which hand struck, hits in the air.

    PYTHONPATH=. .venv/bin/python benchmarks/stick_check.py --quick
    ... --part strokes motions hands air cost    only these
    ... --sensors "400 Hz" "100 Hz"              only these sensors, as `stick_cases.sensors` names them
    ... --seeds 5 --first 20                     seeds 20 … 24

The sticks are simulated (`station.simulation.sticks`), by physics that shares nothing with what is examined. A stroke
counts as found when one is told for the same hand within 40 ms of it, after the median lag of the recording is taken
away (a filter in the sensor delays: the lag is told beside). Tables have the worst cases first.
"""

import argparse
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks import stick_cases
from benchmarks.stick_air import examine_air
from benchmarks.stick_cases import Case
from station.core.events import SensorMounted, SensorSamples, StickStroke
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.simulation.sticks.stick_swing import SimulatedSticks
from station.simulation.sticks.swing_spec import StrokeKind
from station.sync.sticks import Sticks
from station.sync.strokes.hand_naming import name_hands

REACH_S = 0.040
CLOSE_S = 0.040
"""Strokes of two hands closer than this are a flam or a unison."""
PARTS = ("strokes", "motions", "hands", "air", "cost")

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Heard:
    """What was told of one recording: strokes in order, how long it took in s and how many samples there were."""

    strokes: tuple[StickStroke, ...]
    took_s: float
    samples: int


def hear(played: SimulatedSticks) -> Heard:
    """Both sticks' samples in the order in which they arrive."""
    sticks = Sticks()
    events: list[SensorMounted | SensorSamples] = []
    for stick in played.sticks.values():
        start_ns = int(stick.arrival_ns[0]) - 1
        events.append(SensorMounted(start_ns, stick.device, stick.mounting))
        events += stick.events()
    events.sort(key=lambda event: event.at_ns)
    told = []
    start = time.perf_counter()
    for event in events:
        told += sticks.handle(event)
    took = time.perf_counter() - start
    strokes = tuple(sorted((e for e in told if isinstance(e, StickStroke)), key=lambda s: s.at_ns))
    return Heard(strokes, took, sum(len(stick.time_s) for stick in played.sticks.values()))


@dataclass
class Score:
    """How one recording went; times in ms, speeds and heights as shares of the truth."""

    name: str
    strokes: int
    missed: int
    false: int
    lag_ms: float
    sd_ms: float
    worst_ms: float
    speed_off: float
    speed_sd: float
    height_off_cm: float
    clipped: int
    clipped_said: int
    clipped_wrong: int

    @property
    def badness(self) -> float:
        """For the order of the table."""
        return (self.missed + self.false) / max(self.strokes, 1) + self.sd_ms / 100

    def line(self) -> str:
        """One row of the table."""
        return (
            f"{self.name:58.58s} {self.strokes:4d} {self.missed:4d} {self.false:4d} {self.lag_ms:6.1f} "
            f"{self.sd_ms:5.1f} {self.worst_ms:6.1f} {100 * self.speed_off:6.1f} {100 * self.speed_sd:5.1f} "
            f"{self.height_off_cm:6.1f} {self.clipped_said:3d}/{self.clipped:<3d} {self.clipped_wrong:3d}"
        )


HEADER = (
    f"{'case':58s} {'n':>4s} {'miss':>4s} {'fals':>4s} {'lag':>6s} {'sd':>5s} {'worst':>6s} {'v %':>6s} {'sd %':>5s} "
    f"{'h cm':>6s} {'clip said':>7s} not"
)


def scored(name: str, played: SimulatedSticks, heard: Heard) -> Score:
    """Compares what was told with the truth."""
    truth = played.truth
    needed = on_pads(truth) & (truth["bounce"] == 0) & was_measured(played)
    pairs, lag_s, told_rows = pair_up(played, heard.strokes, needed)
    extra = ~on_pads(truth) | (truth["bounce"] > 0) | ~was_measured(played)
    false = false_strokes(played, heard.strokes, told_rows, extra, lag_s)
    off_ms = np.array([1e3 * (heard.strokes[t].at_ns / NS_PER_S - truth["at_s"][row] - lag_s) for row, t in pairs])
    speeds = [(heard.strokes[t].speed_m_s, truth["speed_m_s"][row]) for row, t in pairs]
    speed = np.array([told / real - 1 for told, real in speeds if told is not None])
    heights = [(heard.strokes[t].height_m, truth["height_m"][row]) for row, t in pairs]
    height = np.array([abs(told - real) for told, real in heights if told is not None])
    clipped = was_clipped(played)
    return Score(
        name,
        int(needed.sum()),
        int(needed.sum()) - len(pairs),
        len(false),
        1e3 * lag_s,
        float(off_ms.std()) if len(off_ms) else 0.0,
        float(np.abs(off_ms).max()) if len(off_ms) else 0.0,
        float(np.median(speed)) if len(speed) else float("nan"),
        float(speed.std()) if len(speed) else float("nan"),
        float(100 * np.median(height)) if len(height) else float("nan"),
        sum(bool(clipped[row]) for row, _ in pairs),
        sum(bool(clipped[row]) and heard.strokes[t].clipped for row, t in pairs),
        sum(not clipped[row] and heard.strokes[t].clipped for row, t in pairs),
    )


def on_pads(truth: NDArray[np.void]) -> NDArray[np.bool_]:
    """Which touches are strokes on a pad (n,)."""
    return ~np.isin(truth["kind"], [StrokeKind.AIR.value, StrokeKind.CLICK.value])


def was_measured(played: SimulatedSticks) -> NDArray[np.bool_]:
    """Which touches (n,) a sensor could tell of: samples arrived within 100 ms before and 20 ms after."""
    measured = np.zeros(len(played.truth), bool)
    for hand, stick in played.sticks.items():
        for row in np.flatnonzero(played.truth["limb"] == hand):
            at_s = played.truth["at_s"][row]
            near = stick.time_s[(stick.time_s > at_s - 0.10) & (stick.time_s < at_s + 0.03)]
            measured[row] = len(near) > 1 and np.diff(near).max() < 0.03
    return measured


def was_clipped(played: SimulatedSticks) -> NDArray[np.bool_]:
    """Before which touches (n,) the gyro was at its limit within 20 ms: then the speed is a lower bound."""
    clipped = np.zeros(len(played.truth), bool)
    for hand, stick in played.sticks.items():
        if stick.rate is None:
            continue
        at_limit = np.degrees(np.abs(stick.rate)).max(axis=1) >= stick.sensor.rate_range_dps * (1 - 1e-4)
        for row in np.flatnonzero(played.truth["limb"] == hand):
            since = stick.time_s - played.truth["at_s"][row]
            clipped[row] = bool((at_limit & (since > -0.02) & (since < 0.004)).any())
    return clipped


def pair_up(
    played: SimulatedSticks, strokes: Sequence[StickStroke], rows: NDArray[np.bool_]
) -> tuple[list[tuple[int, int]], float, set[int]]:
    """Pairs (row of the truth, index of a told stroke), the median lag in s, the told ones that are paired."""
    told_s = np.array([s.at_ns / NS_PER_S for s in strokes])
    told_limb = np.array([int(s.limb) for s in strokes])
    first = _closest(played.truth, rows, told_s, told_limb, 0.060, 0.0)
    lag = float(np.median([told_s[t] - played.truth["at_s"][r] for r, t in first])) if first else 0.0
    pairs = _closest(played.truth, rows, told_s, told_limb, REACH_S, lag)
    return pairs, lag, {t for _, t in pairs}


def _closest(
    truth: NDArray[np.void],
    rows: NDArray[np.bool_],
    told_s: Floats,
    told_limb: NDArray[np.int64],
    reach_s: float,
    lag: float,
) -> list[tuple[int, int]]:
    """One to one, the closest first."""
    candidates = []
    for row in np.flatnonzero(rows).tolist():
        for told in np.flatnonzero(told_limb == truth["limb"][row]).tolist():
            apart = abs(told_s[told] - truth["at_s"][row] - lag)
            if apart <= reach_s:
                candidates.append((apart, row, told))
    taken_rows: set[int] = set()
    taken: set[int] = set()
    pairs = []
    for _, row, told in sorted(candidates):
        if row not in taken_rows and told not in taken:
            taken_rows.add(row)
            taken.add(told)
            pairs.append((row, told))
    return sorted(pairs)


def false_strokes(
    played: SimulatedSticks, strokes: Sequence[StickStroke], paired: set[int], forgiven: NDArray[np.bool_], lag: float
) -> list[StickStroke]:
    """Strokes told that were none; a buzz's bounces, clicks and what fell into a gap of the samples are forgiven."""
    forgiven_pairs = pair_up_with(played, strokes, forgiven, paired, lag)
    return [s for i, s in enumerate(strokes) if i not in paired and i not in forgiven_pairs]


def pair_up_with(
    played: SimulatedSticks, strokes: Sequence[StickStroke], rows: NDArray[np.bool_], paired: set[int], lag: float
) -> set[int]:
    """Indices of told strokes, not `paired`, that belong to `rows` of the truth."""
    told_s = np.array([s.at_ns / NS_PER_S for s in strokes])
    told_limb = np.array([-9 if i in paired else int(s.limb) for i, s in enumerate(strokes)])
    return {t for _, t in _closest(played.truth, rows, told_s, told_limb, REACH_S, lag)}


# --- the parts ------------------------------------------------------------------------------------------------------


def examine_strokes(seeds: range, names: Sequence[str]) -> None:
    """Every kind of music with every sensor."""
    scores, costs = [], []
    for sensor_name in names:
        sensor = stick_cases.sensors()[sensor_name]
        for seed in seeds:
            for name, strokes in stick_cases.music(seed).items():
                played = Case(name, strokes, sensor=sensor, seed=seed).played()
                heard = hear(played)
                costs.append((heard.took_s, heard.samples))
                scores.append(scored(f"{name} · {sensor_name} · seed {seed}", played, heard))
        _table_total(sensor_name, [s for s in scores if f"· {sensor_name} ·" in s.name])
    _table("strokes, worst cases first", sorted(scores, key=lambda s: -s.badness)[:40])
    took, samples = (sum(column) for column in zip(*costs, strict=True))
    print(f"\ncost: {1e6 * took / samples:.1f} µs a sample ({samples} samples, {took:.1f} s)")


def examine_motions(seeds: range, names: Sequence[str]) -> None:
    """What is no stroke must not be told as one."""
    print(f"\n{'motion that is no stroke':60s} {'told':>5s} {'of':>4s}  first at (s after the motion began), speed")
    rows = []
    for sensor_name in names:
        for seed in seeds:
            for name, (strokes, gestures) in stick_cases.motions(seed).items():
                played = Case(name, strokes, gestures, stick_cases.sensors()[sensor_name], seed=seed).played()
                heard = hear(played)
                needed = on_pads(played.truth)
                paired = pair_up(played, heard.strokes, needed)[2]
                others = [s for i, s in enumerate(heard.strokes) if i not in paired and not s.in_air]
                count = len(gestures) or int((~needed).sum())
                rows.append((len(others), f"{name} · {sensor_name} · seed {seed}", count, _first(others, gestures)))
    for told, name, count, first in sorted(rows, reverse=True)[:30]:
        print(f"{name:60s} {told:5d} {count:4d}  {first}")
    total: dict[str, list[int]] = {}
    for told, name, count, _ in rows:
        both = total.setdefault(name.split(" · ")[0], [0, 0])
        both[0] += told
        both[1] += count
    print("in all: " + ", ".join(f"{name} {told}/{count}" for name, (told, count) in total.items()))


def _first(others: Sequence[StickStroke], gestures: Sequence) -> str:  # type: ignore[type-arg]
    if not others:
        return ""
    at_s = others[0].at_ns / NS_PER_S
    begun = [g.at_s for g in gestures if g.at_s <= at_s] or [at_s]
    speed = others[0].speed_m_s
    return f"{at_s:.3f} ({at_s - begun[-1]:+.2f}), {'?' if speed is None else f'{speed:.2f}'} m/s"


def examine_hands(seeds: range, names: Sequence[str]) -> None:
    """Which hand played each of the kit's hits."""
    rows = []
    for sensor_name in names:
        sensor = stick_cases.sensors()[sensor_name]
        for seed in seeds:
            for name, strokes in stick_cases.music(seed).items():
                module = stick_cases.modules(seed)
                played = Case(name, strokes, sensor=sensor, module=module, seed=seed).played()
                limbs = name_hands(played.pad_hits, hear(played).strokes)
                rows.append(_hands_row(f"{name} · {sensor_name} · seed {seed}", played, limbs))
    print(f"\n{'hands, worst first':60s} {'apart':>6s} named right | {'close':>5s} named right | false hits named")
    for row in sorted(rows, key=lambda r: _shortfall(r[1]))[:40]:
        print(f"{row[0]:60s} " + _hands_line(row[1]))
    for sensor_name in names:
        sums = np.sum([r[1] for r in rows if f"· {sensor_name} ·" in r[0]], axis=0)
        print(f"{'all with ' + sensor_name:60s} " + _hands_line(sums))


def _hands_row(name: str, played: SimulatedSticks, limbs: Sequence[Limb]) -> tuple[str, NDArray[np.int64]]:
    """Counts: strokes apart (all, named, right), close to the other hand's (all, named, right), false (all, named)."""
    counts = np.zeros(8, np.int64)
    truth = played.truth
    for row, limb in zip(played.pad_truth.tolist(), limbs, strict=True):
        if row < 0:
            counts[6] += 1
            counts[7] += limb is not Limb.UNKNOWN
            continue
        if truth["bounce"][row] > 0:
            continue
        others = np.abs(truth["at_s"] - truth["at_s"][row])[truth["limb"] != truth["limb"][row]]
        at = 3 if len(others) and others.min() < CLOSE_S else 0
        counts[at] += 1
        counts[at + 1] += limb is not Limb.UNKNOWN
        counts[at + 2] += int(limb) == int(truth["limb"][row])
    return name, counts


def _shortfall(c: NDArray[np.int64]) -> float:
    wrong = c[1] - c[2] + c[4] - c[5]
    return float(-wrong * 5 - (c[0] - c[1]) - (c[3] - c[4]) * 0.5) / max(float(c[0] + c[3]), 1.0)


def _hands_line(c: NDArray[np.int64]) -> str:
    def share(a: int, b: int) -> str:
        return f"{100 * a / b:5.1f}" if b else "    —"

    return (
        f"{c[0]:6d} {share(c[1], c[0])} {share(c[2], c[1])} | {c[3]:5d} {share(c[4], c[3])} {share(c[5], c[4])} | "
        f"{c[7]}/{c[6]}"
    )


def examine_cost(rate_hz: float = 1000.0) -> None:
    """Two sensors at 1 kHz: how much of a core."""
    strokes = stick_cases.music(0)["rock groove"]
    played = Case("cost", strokes, sensor=stick_cases.sensors()["1000 Hz"]).played()
    best = min((hear(played) for _ in range(3)), key=lambda heard: heard.took_s)
    each = best.took_s / best.samples
    print(f"\ntwo sensors at 1 kHz: {1e6 * each:.1f} µs a sample, {100 * 2 * rate_hz * each:.1f} % of a core")


def _table(title: str, scores: Sequence[Score]) -> None:
    print(f"\n{title}\n{HEADER}")
    for score in scores:
        print(score.line())


def _table_total(name: str, scores: Sequence[Score]) -> None:
    strokes = sum(s.strokes for s in scores)
    missed, false = sum(s.missed for s in scores), sum(s.false for s in scores)
    sd = np.sqrt(np.average([s.sd_ms**2 for s in scores], weights=[max(s.strokes, 1) for s in scores]))
    lag = [s.lag_ms for s in scores]
    print(
        f"{name:32s} {strokes} strokes, missed {100 * missed / strokes:.2f} %, false {100 * false / strokes:.2f} %, "
        f"lag {np.median(lag):.1f} ({min(lag):.1f} … {max(lag):.1f}) ms, SD {sd:.2f} ms, "
        f"speed {100 * np.nanmedian([s.speed_off for s in scores]):+.1f} ± "
        f"{100 * np.nanmedian([s.speed_sd for s in scores]):.1f} %, "
        f"height {np.nanmedian([s.height_off_cm for s in scores]):.1f} cm",
        flush=True,
    )


def main() -> None:
    """Examine what is asked for and print."""
    options = _options()
    seeds = range(options.first, options.first + (1 if options.quick else options.seeds))
    names = options.sensors or (["400 Hz", "200 Hz"] if options.quick else list(stick_cases.sensors()))
    for part in options.part:
        if part == "cost":
            examine_cost()
        elif part == "air":
            examine_air(seeds, {name: stick_cases.sensors()[name] for name in names})
        else:
            _EXAMINERS[part](seeds, names)


_EXAMINERS = {"strokes": examine_strokes, "motions": examine_motions, "hands": examine_hands}


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="two sensors and one seed")
    parser.add_argument("--part", nargs="*", choices=PARTS, default=PARTS)
    parser.add_argument("--sensors", nargs="*")
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--first", type=int, default=0)
    return parser.parse_args()


if __name__ == "__main__":
    main()
