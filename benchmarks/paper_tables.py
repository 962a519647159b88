"""The paper's phase tracker on the paper's data: what Boyd and Godbout (ICAD 2012) say in words, as tables.

    .venv/bin/python benchmarks/paper_tables.py [--data ../shared/data/mocap]

Walk model from 07_01, run model from 09_01, Δφ 0.05, λ 100, n_m 16, right and left femur and tibia about x, zero-mean.

* convergence: from every one of `STARTS` phases, how much of a gait cycle passes until the phase stays within `NEAR` of
  that of the tracker that fits best in the first `SETTLED` of a cycle: it began where the motion did;
* scatter: SD of the phase at the right femur's zero crossings, of a cycle, once converged;
* footfalls: how far from its trigger's threshold the phase is where the heel is lowest, and where it first touches;
* backward: how the phase runs while the body walks backwards, with λ = 100 and with λ = 0.
"""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.sync.phase.exemplars import rising_crossings_s
from station.sync.phase.periodic_model import TURN, PeriodicModel, wrapped
from station.sync.phase.phase_tracker import PAPER, TrackerSettings, tracked
from station.sync.phase.whole_recording import track_recording, zero_mean
from station.sync.sonification.trigger_table import PRESETS
from station.sync.sonification.triggers import share_of
from station.sync.walking.trial import GAIT_CHANNELS, Trial, gait_model

STARTS = 16
"""Phases to start from, all round the cycle."""
NEAR = 0.05
"""Of a cycle: a phase so near has converged (our choice: half of what the paper's triggers are judged by)."""
SETTLED = 0.75
"""Of a cycle: what comes later is converged (the paper's longest)."""


LEAP = 0.05
"""Of a cycle from one sample to the next: six times what the motion does (our choice)."""


@dataclass(frozen=True, slots=True)
class Row:
    """A trial: where it lies, which seconds of it, and what it holds, looked at by where its pelvis goes and faces."""

    name: str
    holds: str
    span_s: tuple[float, float] = (0.0, np.inf)

    @property
    def title(self) -> str:
        """The name, with the seconds where it is not the whole."""
        first, last = self.span_s
        return self.name if not np.isfinite(last) else f"{self.name} {first:g}-{last:g} s"


WALK_MODEL, RUN_MODEL = "07_01", "09_01"
WALKS = (
    Row("07_01", "the exemplar"),
    Row("07_06", "the same person, slower"),
    Row("08_01", "another, brisk"),
    Row("08_04", "slow, 1.3 s a cycle"),
    Row("02_01", "another"),
    Row("16_15", "another"),
    Row("16_22", "another, quick"),
    Row("35_01", "another, 1.9 s in all"),
    Row("35_05", "the same, slower"),
    Row("35_28", "the same"),
    Row("49_01", "slowest, 1.4 s a cycle"),
    Row("09_12", "walks ahead before its turn", (0.0, 3.2)),
)
OTHER_WALKS = (
    Row("09_12", "ahead, a U-turn, back", (0.0, 7.4)),
    Row("09_12", "backwards, a turn, backwards", (7.8, 15.9)),
    Row("03_04", "over steps, with turns"),
)
RUNS = (
    Row("09_01", "the exemplar"),
    Row("09_05", "the same person"),
    Row("09_11", "the same person"),
    Row("02_03", "another"),
)
BACKWARD = Row("09_12", "straight backwards", (12.4, 15.9))
MISSING = "a run that stops with a hop and turns (6 c) and a run around a square (6 d): no such trial is in the data"


class Data:
    """The folder with `amc/SUBJECT/TRIAL.amc` and `bvh/SUBJECT/TRIAL.bvh`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def trial(self, row: Row) -> Trial:
        """The trial of a row; of two editions the AMC one. Raises `BadInput` where neither is there."""
        subject = row.name.split("_", maxsplit=1)[0]
        paths = [self._folder / kind / subject / f"{row.name}.{kind}" for kind in ("amc", "bvh")]
        path = next((path for path in paths if path.is_file()), None)
        if path is None:
            raise BadInput(paths[0], "", "no such trial (mocap.cs.cmu.edu has it); --data says where the trials are")
        return Trial.read(path).between(*row.span_s)

    def model(self, name: str) -> PeriodicModel:
        """The model of a gait, from the first cycle of a trial."""
        return gait_model(self.trial(Row(name, "")).signal)


def cycle_s(trial: Trial) -> float:
    """The trial's gait cycle in seconds: between right steps, else twice that from a right to a left one."""
    right, left = (foot.low_s for foot in trial.steps)
    if len(right) > 1 or len(left) > 1:
        return float(np.median(np.concatenate([np.diff(right), np.diff(left)])))
    return 2 * float(abs(right[0] - left[0]))


def convergence(model: PeriodicModel, trial: Trial) -> NDArray[np.float64]:
    """Of every start the share of a cycle until the phase stays where it belongs, (STARTS,)."""
    values = zero_mean(model, trial.signal).values
    rate_hz, cycle = trial.signal.rate_hz, cycle_s(trial)
    tracks = [tracked(model, values, TrackerSettings(start_rad=TURN * start / STARTS)) for start in range(STARTS)]
    first = round(SETTLED * cycle * rate_hz)
    belongs = max(tracks, key=lambda track: float(track.quality[:first].mean())).phase_rad
    found = []
    for track in tracks:
        far = np.flatnonzero(abs(wrapped(track.phase_rad - belongs)) > NEAR * TURN)
        found.append((far[-1] + 1 if len(far) else 0) / rate_hz / cycle)
    return np.array(found)


def crossing_phases(model: PeriodicModel, trial: Trial) -> NDArray[np.float64]:
    """The phase at the right femur's zero crossings after convergence, in cycles about 0."""
    signal = trial.signal
    phase = np.unwrap(track_recording(model, signal, PAPER).phase_rad)
    crossings_s = rising_crossings_s(signal.time_s, signal.only(GAIT_CHANNELS[:1]).values[:, 0])
    late_s = crossings_s[crossings_s > signal.time_s[0] + SETTLED * cycle_s(trial)]
    return wrapped(np.interp(late_s, signal.time_s, phase)) / TURN


def trigger_errors(model: PeriodicModel, trial: Trial, preset: str) -> tuple[NDArray[np.float64], ...]:
    """Share of the cycle at heel lows and at first contacts, less the threshold, once converged: two arrays."""
    signal = trial.signal
    phase = np.unwrap(track_recording(model, signal, PAPER).phase_rad)
    converged_s = signal.time_s[0] + SETTLED * cycle_s(trial)
    errors: tuple[list[float], list[float]] = ([], [])
    for foot, trigger in zip(trial.steps, PRESETS[preset], strict=True):
        for found, times_s in zip(errors, (foot.low_s, foot.contact_s), strict=True):
            for at_rad in np.interp(times_s[foot.contact_s > converged_s], signal.time_s, phase):
                found.append((share_of(float(at_rad)) - trigger.threshold + 0.5) % 1.0 - 0.5)
    return tuple(np.array(found) for found in errors)


def sd(values: NDArray[np.float64]) -> str:
    """The SD in words; of fewer than two nothing is known."""
    return f"{values.std(ddof=1):.3f}" if len(values) > 1 else "    -"


def gaits(data: Data, model: PeriodicModel, rows: Sequence[Row], preset: str) -> None:
    """Print a table of one gait."""
    head = "E_max  converged after (cycles)   at zero crossings    heel lows less threshold"
    print(f"{'':16} cycle  {head}")
    print(f"{'trial':16}   s    median  median  90 %   most    mean    SD    median most  steps  what it holds")
    lows, contacts, all_after = [], [], []
    for row in rows:
        trial = data.trial(row)
        after, at_zero = convergence(model, trial), crossing_phases(model, trial)
        low, contact = trigger_errors(model, trial, preset)
        quality = np.median(track_recording(model, trial.signal, PAPER).quality)
        print(
            f"{row.title:16} {cycle_s(trial):5.2f}  {quality:5.3f}  {np.median(after):6.2f}"
            f" {np.quantile(after, 0.9):6.2f} {after.max():6.2f}  {at_zero.mean():6.3f} {sd(at_zero)}"
            f"   {np.median(abs(low)):.3f} {abs(low).max():.3f}   {len(low):2d}   {row.holds}"
        )
        lows.append(low)
        contacts.append(contact)
        all_after.append(after)
    every = np.concatenate(all_after)
    share = 100 * float((every <= SETTLED).mean())
    print(
        f"converged: median {np.median(every):.2f} cycles, 95 % {np.quantile(every, 0.95):.2f}, most {every.max():.2f};"
        f" within {SETTLED} of a cycle {share:.0f} % of {len(every)} starts"
    )
    for name, parts in (("heel lows", lows), ("first contacts", contacts)):
        error = abs(np.concatenate(parts))
        print(f"{name}: median {np.median(error):.3f}, 95 % {np.quantile(error, 0.95):.3f}, within .1 of a cycle"
              f" {100 * float((error < 0.1).mean()):.0f} % of {len(error)} steps")  # fmt: skip


def qualities(data: Data, model: PeriodicModel) -> None:
    """Print how E_max and the phase do where the gait is not a plain walk."""
    print(f"{'trial':22} E_max median   10 %  below .5   phase runs  what it holds")
    for row in OTHER_WALKS:
        trial = data.trial(row)
        for smoothing in (100.0, 0.0):
            track = track_recording(model, trial.signal, TrackerSettings(smoothing=smoothing))
            length_s = len(track.phase_rad) / trial.signal.rate_hz
            rate = np.diff(np.unwrap(track.phase_rad)).sum() / TURN / length_s
            low = 100 * float((track.quality < 0.5).mean())
            print(
                f"{row.title:16} λ {smoothing:3.0f}   {np.median(track.quality):6.3f}     "
                f"{np.quantile(track.quality, 0.1):6.3f}  {low:5.0f} %   {rate:6.2f}/s    {row.holds}"
            )


def backward(data: Data, model: PeriodicModel) -> None:
    """Print which way the phase runs while somebody walks backwards."""
    trial = data.trial(BACKWARD)
    for smoothing in (100.0, 0.0):
        track = track_recording(model, trial.signal, TrackerSettings(smoothing=smoothing))
        steps = wrapped(np.diff(track.phase_rad))
        turns = np.diff(np.unwrap(track.phase_rad)).sum() / TURN
        down, length_s = 100 * float((steps < 0).mean()), len(steps) / trial.signal.rate_hz
        leaps = int((abs(steps) > LEAP * TURN).sum())
        print(f"λ {smoothing:3.0f}: {turns:+.2f} cycles in {length_s:.1f} s, {down:.0f} % of steps down, {leaps} leaps")


def main() -> None:
    """Reckon and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/mocap"))
    data = Data(parser.parse_args().data)
    try:
        walk, run = data.model(WALK_MODEL), data.model(RUN_MODEL)
        print(f"Walking, model from {WALK_MODEL}\n")
        gaits(data, walk, WALKS, "walk")
        print(f"\nRunning, model from {RUN_MODEL}\n")
        gaits(data, run, RUNS, "run")
        print("\nNot plain walking, walk model\n")
        qualities(data, walk)
        print(f"\nBackwards ({BACKWARD.title})\n")
        backward(data, walk)
        print(f"\nNot to be had: {MISSING}.")
    except BadInput as fault:
        parser.error(str(fault))


if __name__ == "__main__":
    main()
