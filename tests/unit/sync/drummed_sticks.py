"""A student who plays as the drummer does: samples of the sensors on their sticks, and where in the loop they were."""

import pickle
from dataclasses import dataclass
from functools import cache

import numpy as np

from station.core.events import PhaseEstimate, SensorMounted, SensorSamples
from station.core.imu import ImuSample, Mounting
from station.core.pieces import Limb
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.sync.drill.drill_model import HANDS, DrillModel
from station.sync.drill.drill_tracker import DrillTracker
from station.sync.drill.drummed_model import Demonstrated, drill_model
from station.sync.drill.stick_signals import stick_signals

RATE_HZ = 200.0
NATURAL = Style()


@cache
def model_of(lesson: str) -> DrillModel:
    made = drill_model(find_lesson(lesson).score, Demonstrated(load_kit(), figure_of(), Style()))
    sent: DrillModel = pickle.loads(pickle.dumps(made))  # as it comes to the engine
    return sent


@dataclass(frozen=True, eq=False)
class Take:
    """`force` and `rate` (n, 2, 3) at `time_s` (n,); the loop lasts `loop_s` at the student's tempo."""

    time_s: np.ndarray
    force: np.ndarray
    rate: np.ndarray
    loop_s: float


def take(lesson: str, tempo: float = 1.0, style: Style = NATURAL, loops: float = 3.0, noise: float = 1.0) -> Take:
    """What sensors measure from a third of a loop on, noisier than they are (0.3 m/s² and 1.1°/s)."""
    score = find_lesson(lesson).score.at_speed(tempo)
    loop_s = score.length_ns / 1e9
    drummer = Drummer(score.repeated(int(loops) + 2), style=style)
    signals = stick_signals(drummer, 0.35 * loop_s, (0.35 + loops) * loop_s, rate_hz=RATE_HZ)
    chance = np.random.default_rng(3)
    force = signals.force_m_s2 + chance.normal(0, 0.3 * noise, signals.force_m_s2.shape)
    rate = signals.rate_rad_s + chance.normal(0, 0.02 * noise, signals.rate_rad_s.shape)
    return Take(signals.time_s, force, rate, loop_s)


def events(played: Take, hands: tuple[Limb, ...] = HANDS, chunk: int = 5) -> list[SensorMounted | SensorSamples]:
    """The take as the decoders tell it, the sensors mounted straight."""
    told: list[SensorMounted | SensorSamples] = [SensorMounted(0, hand.name, Mounting(hand)) for hand in hands]
    at_ns = np.round(played.time_s * 1e9).astype(int).tolist()
    for begin in range(0, len(at_ns), chunk):
        for hand in hands:
            side = HANDS.index(hand)
            rows = range(begin, min(begin + chunk, len(at_ns)))
            force, rate = (each[rows.start : rows.stop, side].tolist() for each in (played.force, played.rate))
            measured = zip(at_ns[rows.start : rows.stop], force, rate, strict=True)
            samples = tuple(ImuSample(at, tuple(pull), tuple(turn)) for at, pull, turn in measured)
            told.append(SensorSamples(samples[-1].at_ns, hand.name, samples))
    return told


def estimates(model: DrillModel, told: list[SensorMounted | SensorSamples]) -> list[PhaseEstimate]:
    tracker = DrillTracker(model)
    return [estimate for event in told for estimate in tracker.handle(event)]


def errors_ms(model: DrillModel, found: list[PhaseEstimate], loop_s: float) -> np.ndarray:
    """How far each phase is from the truth, as time of the student's, within their shortest repeat."""
    cycle_s = loop_s / model.repeats
    turn = np.array([e.phase_rad for e in found]) / (2 * np.pi)
    truth = np.array([e.at_ns for e in found]) / 1e9 / cycle_s
    return ((turn - truth + 0.5) % 1 - 0.5) * cycle_s * 1e3
