"""Benchmarks of a drill's phase: processor time to follow two sticks, for each sample, and to make a model."""

from time import process_time

from station.bench.harness.benchmark import Benchmark, Measurement
from station.core.events import SensorMounted, SensorSamples
from station.core.imu import ImuSample, Mounting
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.motion.style.style import Style
from station.sync.drill.drill_model import HANDS
from station.sync.drill.drill_tracker import DrillTracker
from station.sync.drill.drummed_model import Demonstrated, drill_model
from station.sync.drill.stick_signals import stick_signals

_LESSON = "single-paradiddle"
_PACKET_S = 0.02
"""Samples come in packets of so long, as over Bluetooth and USB (our choice)."""
_SECONDS = 5.0
_LIMIT_S = 60.0


def _packets(rate_hz: float) -> list[SensorSamples]:
    """Five seconds of both sticks as the drummer moves them."""
    drummer = Drummer(find_lesson(_LESSON).score.repeated(3))
    signals = stick_signals(drummer, 0.0, _SECONDS, rate_hz=rate_hz)
    size = round(_PACKET_S * rate_hz)
    at_ns = [round(at * NS_PER_S) for at in signals.time_s.tolist()]
    force, rate = signals.force_m_s2.tolist(), signals.rate_rad_s.tolist()
    packets = []
    for begin in range(0, len(at_ns), size):
        for side, hand in enumerate(HANDS):
            rows = range(begin, min(begin + size, len(at_ns)))
            samples = tuple(ImuSample(at_ns[k], tuple(force[k][side]), tuple(rate[k][side])) for k in rows)
            packets.append(SensorSamples(samples[-1].at_ns, hand.name, samples))
    return packets


def _tracking(rate_hz: float) -> Measurement:
    """Microseconds a sample of one sensor."""
    model = drill_model(find_lesson(_LESSON).score, Demonstrated(load_kit(), figure_of(), Style()))
    packets = _packets(rate_hz)
    tracker = DrillTracker(model)
    for hand in HANDS:
        tracker.handle(SensorMounted(0, hand.name, Mounting(hand)))
    begin_s = process_time()
    for packet in packets:
        tracker.handle(packet)
    spent_s = process_time() - begin_s
    samples = sum(len(packet.samples) for packet in packets)
    share = 100 * spent_s / _SECONDS
    return Measurement(spent_s / samples * 1e6, None, f"{share:.1f} % of one core, n_m {model.centre_count}")


def _making() -> Measurement:
    section, played = find_lesson(_LESSON).score, Demonstrated(load_kit(), figure_of(), Style())
    begin_s = process_time()
    drill_model(section, played)
    return Measurement(process_time() - begin_s, None, f"{_LESSON}, a drummer for each of five tempi")


BENCHMARKS = (
    Benchmark("drill_phase_200_hz", "µs/sample", 100.0, "lower", None, lambda: _tracking(200.0), limit_s=_LIMIT_S),
    Benchmark("drill_phase_1000_hz", "µs/sample", 20.0, "lower", None, lambda: _tracking(1000.0), limit_s=_LIMIT_S),
    Benchmark("drill_model", "s", 5.0, "lower", None, _making, limit_s=_LIMIT_S),
)
