"""How well the phase of a drill is found: the tables of docs/drill-phase.md.

    python benchmarks/drill_phase.py [LESSON …]

Two students play each lesson: the animated drummer in another style and with other chances, whose motion the model is
made of, and the simulated sticks of `station.simulation.sticks`, which know nothing of that drummer: another body,
another stroke, sensors with faults, mounted at random. Their phase is known. Phases are told apart within the loop's
shortest repeat. A student of another lesson must not lock.
"""

import sys
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from station.core.events import PhaseEstimate, SensorEvent, SensorMounted, SensorSamples
from station.core.imu import ImuSample, Mounting
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.motion.style.style_file import load_style
from station.music.score import Score
from station.simulation.sticks.stick_swing import StickPair, play
from station.simulation.sticks.swing_score import EXACT, NOVICE, PROFESSIONAL, PlayerSpec, spec_from_score
from station.simulation.sticks.swing_sensor import SensorSpec
from station.sync.drill.drill_model import HANDS, DrillModel
from station.sync.drill.drill_tracker import DrillTracker
from station.sync.drill.drummed_model import Demonstrated, drill_model
from station.sync.drill.stick_signals import stick_signals
from station.sync.phase.periodic_model import TURN
from station.sync.phase.phase_tracker import PhaseTracker, TrackerSettings

LESSONS = ("single-paradiddle", "rock-1", "flam-tap", "five-stroke-roll")
LOOPS = 4
RATE_HZ = 200.0
START_S = 3.0
WRONG_MS = 80.0


@dataclass(frozen=True, eq=False)
class Played:
    """Events of both sensors; at `known_s` (n,) the student was at `place_s` (n,) of their score at its own tempo."""

    told: list[SensorEvent]
    known_s: np.ndarray
    place_s: np.ndarray
    loop_s: float


def by_drummer(score: Score, style: Style) -> Played:
    """The animated drummer, their sensors as noisy as the data sheets of cheap ones say, and somewhat more."""
    drummer, loop_s = Drummer(score.repeated(LOOPS + 1), style=style), score.length_ns / NS_PER_S
    signals = stick_signals(drummer, 0.0, LOOPS * loop_s, rate_hz=RATE_HZ)
    chance = np.random.default_rng(7)
    told: list[SensorEvent] = []
    for side, hand in enumerate(HANDS):
        force = signals.force_m_s2[:, side] + chance.normal(0, 0.3, (len(signals.time_s), 3))
        rate = signals.rate_rad_s[:, side] + chance.normal(0, 0.02, force.shape)
        told += [SensorMounted(0, hand.name, Mounting(hand)), *_packets(hand.name, signals.time_s, force, rate)]
    return Played(_in_order(told), signals.time_s, signals.time_s, loop_s)


def by_simulation(score: Score, player: PlayerSpec, seed: int = 0) -> Played:
    """The simulated sticks; between strokes the place is straight between those of the strokes."""
    whole, loop_s = score.repeated(LOOPS), score.length_ns / NS_PER_S
    strokes = spec_from_score(whole, start_s=START_S, player=player, seed=seed)
    written = spec_from_score(whole, start_s=START_S, player=EXACT)
    pair = StickPair(sensors={hand: SensorSpec(rate_hz=RATE_HZ) for hand in HANDS})
    sticks = play(strokes, pair=pair, seed=seed).sticks
    told: list[SensorEvent] = []
    for hand in HANDS:
        told += [SensorMounted(0, sticks[hand].device, sticks[hand].mounting), *sticks[hand].events()]
    at_s, place_s = (np.array(sorted(stroke.at_s for stroke in each)) for each in (strokes, written))
    return Played(_in_order(told), at_s, place_s - START_S, loop_s)


def _packets(device: str, time_s: np.ndarray, force: np.ndarray, rate: np.ndarray) -> Iterable[SensorSamples]:
    rows = zip(np.round(time_s * NS_PER_S).astype(int).tolist(), force.tolist(), rate.tolist(), strict=True)
    samples = [ImuSample(at, tuple(pull), tuple(turn)) for at, pull, turn in rows]
    for begin in range(0, len(samples), 4):
        packet = tuple(samples[begin : begin + 4])
        yield SensorSamples(packet[-1].at_ns, device, packet)


def _in_order(told: list[SensorEvent]) -> list[SensorEvent]:
    return sorted(told, key=lambda event: event.at_ns)


@dataclass(frozen=True, slots=True)
class Row:
    """From the second loop on: median and SD of the phase's error and what 95 % are within, ms; shares of the time."""

    median_ms: float
    sd_ms: float
    p95_ms: float
    right: float
    locked: float
    locked_wrong: float
    lock_s: float

    def __str__(self) -> str:
        times = f"{self.median_ms:6.1f} | {self.sd_ms:6.1f} | {self.p95_ms:6.1f}"
        return f"{times} | {self.right:.2f} | {self.locked:.2f} | {self.locked_wrong:.3f} | {self.lock_s:4.1f}"


def judged(model: DrillModel, played: Played, found: list[PhaseEstimate]) -> Row:
    """How the estimates compare with the truth, from the second loop to half a second before the end."""
    at_s = np.array([estimate.at_ns for estimate in found]) / NS_PER_S
    locked = np.array([estimate.locked for estimate in found])
    cycle_s = played.loop_s / model.repeats
    place_s = np.interp(at_s, played.known_s, played.place_s)
    turn = np.array([estimate.phase_rad for estimate in found]) / TURN
    error_ms = ((turn - place_s / cycle_s + 0.5) % 1 - 0.5) * cycle_s * 1e3
    begin_s, end_s = played.known_s[0], played.known_s[-1]
    late = (at_s > begin_s + played.loop_s) & (at_s < end_s - 0.5)
    wrong = np.abs(error_ms) > WRONG_MS
    first = np.flatnonzero(locked & ~wrong & (at_s > begin_s))
    return Row(
        float(np.median(error_ms[late])),
        float(error_ms[late].std()),
        float(np.percentile(np.abs(error_ms[late]), 95)),
        float(1 - wrong[late].mean()),
        float(locked[late].mean()),
        float((locked & wrong)[late].mean()),
        float(at_s[first[0]] - begin_s) if len(first) else float("nan"),
    )


def tracked(model: DrillModel, played: Played) -> list[PhaseEstimate]:
    """What the tracker tells of it."""
    tracker = DrillTracker(model)
    return [estimate for event in played.told for estimate in tracker.handle(event)]


class PaperTracker(DrillTracker):
    """The paper's tracker on the same steps: one model, one way, Δφ of the lesson's tempo, λ = 100 for each stroke."""

    def __init__(self, model: DrillModel) -> None:
        super().__init__(model)
        strokes = model.centre_count / 16
        step = TURN * 0.01 / model.cycle_s
        settings = TrackerSettings(cadence_rad=step, smoothing=100.0 * strokes**2)
        self._paper = PhaseTracker(model.models[model.tempi.index(1.0)], settings)
        self._drill = model

    def handle(self, event: SensorEvent) -> list[PhaseEstimate]:
        """The paper's phases, locked always: its quality alone does not say otherwise."""
        if not isinstance(event, SensorSamples):
            super().handle(event)
            return []
        found = []
        for step in self._grid.handle(event):
            phase = self._paper.step(self._drill.scaled(step.values))
            found.append(PhaseEstimate(step.at_ns, phase.phase_rad, phase.quality, 1.0, 0.0, True))
        return found


def main(lessons: Iterable[str]) -> None:
    """Print every table."""
    head = "| median ms | SD | 95 % within | right | locked | locked wrongly | first lock s |"
    print(f"| lesson | student | tempo {head}")
    for name in lessons:
        section = find_lesson(name).score
        limbs = Drummer(section).assignment.limbs
        model = drill_model(section, Demonstrated(load_kit(), figure_of(), Style()))
        print(f"{name}: {model.repeats} repeats of {model.cycle_s:.2f} s, n_m {model.centre_count}")
        for tempo in (0.5, 0.7, 1.0, 1.4, 2.0):
            _print(name, "drummer", tempo, model, by_drummer(section.at_speed(tempo), replace(Style(), seed=5)))
        for style in ("wild", "jazz", "smooth"):
            _print(name, f"drummer, {style}", 1.1, model, by_drummer(section.at_speed(1.1), load_style(style)))
        written = section.with_limbs(limbs)
        for tempo in (0.5, 0.7, 1.0, 1.4, 2.0):
            _print(name, "sticks", tempo, model, by_simulation(written.at_speed(tempo), PROFESSIONAL))
        _print(name, "sticks, novice", 1.0, model, by_simulation(written, NOVICE))
        for student, played in (
            ("drummer, paper's tracker", by_drummer(section, replace(Style(), seed=5))),
            ("sticks, paper's tracker", by_simulation(written, PROFESSIONAL)),
        ):
            paper = PaperTracker(model)
            found = [estimate for event in played.told for estimate in paper.handle(event)]
            print(f"| {name} | {student} | 1.0 | {judged(model, played, found)} |", flush=True)
        for other in sorted({*LESSONS, "train-1"} - {name}):
            foreign = find_lesson(other).score
            foreign = foreign.with_limbs(Drummer(foreign).assignment.limbs)
            for student, played in (
                ("drummer", by_drummer(foreign, Style())),
                ("sticks", by_simulation(foreign, PROFESSIONAL)),
            ):
                found = tracked(model, played)
                share = np.mean([estimate.locked for estimate in found])
                print(f"| {name} | {student} plays {other} | locked {share:.2f} |", flush=True)


def _print(name: str, student: str, tempo: float, model: DrillModel, played: Played) -> None:
    print(f"| {name} | {student} | {tempo} | {judged(model, played, tracked(model, played))} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or LESSONS)
