"""The tables of docs/phase.md: the paper's tracker and the one that goes beyond it, on the CMU motions.

    python benchmarks/phase_tables.py ../shared/data/mocap

Model: the first cycle of walk 07_01. The truth is not the tracker's: the right femur's rising zero crossings, and of
standing and walking backwards the pelvis's own way over the floor.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from station.sync.phase.exemplars import cycles, rising_crossings_s
from station.sync.phase.periodic_model import TURN, PeriodicModel, fitted, wrapped
from station.sync.phase.phase_tracker import ADAPTIVE, PAPER, PhaseTrack, tracked
from station.sync.signals.signal import CHANNEL_SETS, FloatArray, Signal
from station.sync.signals.signal_files import read_signal

WALKS = ("07_01", "07_06", "08_01", "08_04", "02_01", "16_15", "16_22", "35_01", "35_05", "35_28", "49_01")
UNEVEN, LONG, RUNS = "03_04", "09_12", ("02_03", "09_01", "09_05", "09_11")
TEMPI = (0.5, 0.7, 1.0, 1.4, 2.0)
SETTLED_S = 0.5
ONE_STRIDE_S = 1.1
"""Of trial 35_01, which holds one crossing alone: the period of its neighbours."""
UNIT_M = 0.0254 / 0.45
"""The unit of length of the CMU skeletons: inches by their `length 0.45`."""
TRACKERS = {"paper": PAPER, "adaptive": ADAPTIVE}


@dataclass(frozen=True)
class Motions:
    """Where the files are, and the model of the walk."""

    folder: Path
    model: PeriodicModel

    def path(self, trial: str) -> Path:
        """The file of a trial, AMC where there is one."""
        kinds = [self.folder / kind / trial[:2] / f"{trial}.{kind}" for kind in ("amc", "bvh")]
        return next(path for path in kinds if path.is_file())

    def walk(self, trial: str, tempo: float = 1.0) -> Signal:
        """The four channels about the model's mean, played so many times as fast."""
        signal = read_signal(self.path(trial)).only(CHANNEL_SETS["walk"])
        count = int(len(signal) / tempo)
        at = np.arange(count) * tempo
        values = [np.interp(at, np.arange(len(signal)), column) for column in signal.values.T]
        about = np.stack(values, axis=1)
        about += self.model.mean - about.mean(axis=0)
        return Signal(np.arange(count) / 120.0, signal.names, about, trial)


def crossing_errors(signal: Signal, track: PhaseTrack, tempo: float) -> list[float]:
    """The phases, in turns, at the right femur's rising crossings, 0 by the model; the first moments left out."""
    at_s = rising_crossings_s(signal.time_s, signal.values[:, 0])
    phases = wrapped(np.interp(at_s, signal.time_s, np.unwrap(track.phase_rad))) / TURN
    return [phase for phase, second in zip(phases.tolist(), at_s, strict=True) if second > SETTLED_S / tempo]


def print_tempi(motions: Motions) -> None:
    """Phase at the crossings and the part of them within 0.1 turns, by tempo."""
    print("\n| trials | tempo | paper: RMS, within .1 | adaptive: RMS, within .1 |\n|---|---|---|---|")
    groups = {f"{len(WALKS)} walks": WALKS, f"{UNEVEN}, uneven ground": (UNEVEN,)}
    for name, trials in groups.items():
        for tempo in TEMPI:
            cells = []
            for settings in TRACKERS.values():
                errors: list[float] = []
                for trial in trials:
                    signal = motions.walk(trial, tempo)
                    errors += crossing_errors(signal, tracked(motions.model, signal.values, settings), tempo)
                found = np.array(errors)
                cells.append(f"{np.sqrt((found**2).mean()):.3f}, {100 * (np.abs(found) < 0.1).mean():.0f} %")
            print(f"| {name} | {tempo:g} | {' | '.join(cells)} |")


def print_convergence(motions: Motions) -> None:
    """Cycles until the phase stays within 0.05 turns of the settled one, from 24 phases at 12 samples of each walk."""
    print("\n| tracker | median | 95 % | longest, cycles |\n|---|---|---|---|")
    for name, settings in TRACKERS.items():
        taken: list[float] = []
        for trial in WALKS:
            signal = motions.walk(trial)
            settled = tracked(motions.model, signal.values, settings).phase_rad
            crossings_s = rising_crossings_s(signal.time_s, signal.values[:, 0])
            period = float(np.median(np.diff(crossings_s))) if len(crossings_s) > 1 else ONE_STRIDE_S
            for first in np.linspace(60, len(signal) - 150, 12).astype(int):
                for start_rad in np.linspace(-np.pi, np.pi, 24, endpoint=False):
                    started = replace(settings, start_rad=float(start_rad))
                    track = tracked(motions.model, signal.values[first : first + 200], started)
                    off = np.abs(wrapped(track.phase_rad - settled[first : first + 200])) > 0.05 * TURN
                    taken.append((np.flatnonzero(off).max(initial=-1) + 1) / (120 * period))
        print(f"| {name} | {np.median(taken):.2f} | {np.quantile(taken, 0.95):.2f} | {max(taken):.2f} |")


def floor_speeds(path: Path) -> tuple[FloatArray, FloatArray]:
    """Speeds of the pelvis over the floor, forwards and sideways as it faces, in m/s over a quarter of a second."""
    signal = read_signal(path)
    root = "Hips" if path.suffix == ".bvh" else "root"
    x, z, *angles = signal.only([f"{root}_{each}" for each in ("tx", "tz", "rx", "ry", "rz")]).values.T
    rx, ry, rz = np.radians(angles)
    ahead = np.stack([np.cos(rz) * np.sin(ry) * np.cos(rx) + np.sin(rz) * np.sin(rx), np.cos(ry) * np.cos(rx)], axis=1)
    ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)  # the third column of Rz Ry Rx, on the floor
    at = np.arange(len(signal))
    late, early = np.minimum(at + 15, len(signal) - 1), np.maximum(at - 15, 0)
    place = np.stack([x, z], axis=1) * UNIT_M
    speed = (place[late] - place[early]) / ((late - early) / 120.0)[:, None]
    return (speed * ahead).sum(axis=1), speed[:, 0] * ahead[:, 1] - speed[:, 1] * ahead[:, 0]


def print_confidence(motions: Motions) -> None:
    """What is taken for the model's motion, by what it was: locked, beside E_max above 0.8."""
    rows: dict[str, list[tuple[PhaseTrack, PhaseTrack, FloatArray]]] = {}

    def add(kind: str, values: FloatArray, mask: FloatArray) -> None:
        paper, adaptive = (tracked(motions.model, values, settings) for settings in (PAPER, ADAPTIVE))
        rows.setdefault(kind, []).append((paper, adaptive, mask))

    for trial in (*WALKS, UNEVEN, LONG):
        signal = motions.walk(trial)
        ahead, aside = floor_speeds(motions.path(trial))
        later = signal.time_s > SETTLED_S
        kind = "uneven ground" if trial == UNEVEN else "walking forwards"
        add(kind, signal.values, later & (ahead > 0.5) & (np.abs(aside) < 0.35))
        add("walking backwards", signal.values, later & (ahead < -0.3) & (np.abs(aside) < 0.5))
    for trial in WALKS:
        signal = motions.walk(trial)
        count = len(signal)
        add("played backwards", signal.values[::-1], signal.time_s > SETTLED_S)
        held = np.concatenate([signal.values[: count // 2], np.repeat(signal.values[count // 2][None], 240, axis=0)])
        held += np.random.default_rng(count).normal(0, 0.3, held.shape)
        add("standing still (a frame held)", held, np.arange(len(held)) > count // 2 + 60)
        arms = read_signal(motions.path(trial)).only(["rhumerus_rx", "lhumerus_rx", "rradius_rx", "lradius_rx"]).values
        add("arms in place of legs", arms - arms.mean(axis=0) + motions.model.mean, signal.time_s > SETTLED_S)
    print("\n| motion | samples | paper: E_max > 0.8 | adaptive: locked |\n|---|---|---|---|")
    for kind, found in rows.items():
        quality = np.concatenate([paper.quality[mask > 0] for paper, _, mask in found])
        locked = np.concatenate([adaptive.locked[mask > 0] for _, adaptive, mask in found])
        print(f"| {kind} | {len(locked)} | {100 * (quality > 0.8).mean():.0f} % | {100 * locked.mean():.0f} % |")


def main() -> None:
    """Print all tables."""
    folder = Path(sys.argv[1])
    exemplar = read_signal(folder / "amc/07/07_01.amc").only(CHANNEL_SETS["walk"])
    motions = Motions(folder, fitted(exemplar.names, cycles(exemplar, "rfemur_rx")))
    tables: tuple[Callable[[Motions], None], ...] = (print_tempi, print_convergence, print_confidence)
    for table in tables:
        table(motions)


if __name__ == "__main__":
    main()
