"""A motion sensor on a stick: what it makes of the true motion, and how its samples arrive.

The order is a real chip's: the sensing element is limited, then noisy and biased, then band-limited (second order
Butterworth, causal: it delays), sampled by the chip's own clock, limited again and rounded to 16 bits.
"""

import math
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.events import SensorSamples
from station.core.imu import STANDARD_GRAVITY_M_S2, ImuSample, Mounting, Quaternion
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.simulation.sticks.swing_body import LENGTH_M
from station.simulation.sticks.swing_motion import FINE_HZ, StickPath

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

BITS = 16
ROOM_C, WARMER_BY_C, WARMS_IN_S = 24.0, 9.0, 240.0
"""A small board in a hand that plays warms by some degrees within minutes (our choice)."""
HEADROOM = 1.05
"""How far beyond its range a sensing element still follows (our choice: data sheets promise none)."""


@dataclass(frozen=True, slots=True)
class Chip:
    """Noise densities per √Hz, the spread of what is wrong at rest (±), of its scale, and how the rate wanders."""

    acceleration_noise_g: float
    rate_noise_dps: float
    acceleration_bias_g: float
    rate_bias_dps: float
    scale_error: float = 0.005
    rate_wander_dps: float = 0.02  # in a √minute; our choice, of the order of the bias instabilities that are sold
    rate_dps_a_kelvin: float = 0.005  # ICM-42688-P: "gyro zero-rate output variation over temperature"


CHIPS = MappingProxyType(
    {
        "icm42688": Chip(70e-6, 2.8e-3, 0.020, 0.5),
        "bmi270": Chip(160e-6, 7e-3, 0.020, 0.5),
        "mpu9250": Chip(300e-6, 10e-3, 0.060, 5.0, 0.03, 0.02, 0.24),
        "perfect": Chip(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
    }
)
"""TDK DS-000347 (ICM-42688-P), Bosch BST-BMI270-DS000, InvenSense PS-MPU-9250A-01: tables of sensor specifications."""


@dataclass(frozen=True, slots=True)
class Link:
    """How samples travel.

    `jitter_s` is the longest wait of a serial line; `interval_s` > 0 is Bluetooth's connection
    interval: what was measured since the last one arrives in a clump. `loss` is the share of packets that never come,
    `away_s` spans (from, to) without a connection.
    """

    jitter_s: float = 0.005
    interval_s: float = 0.0
    samples_a_packet: int = 1
    loss: float = 0.0
    away_s: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True)
class SensorSpec:
    """One sensor: where it sits (`butt_m` from the butt's end), how it is turned and how good it is.

    `turn` (stick from sensor) None is drawn at random; `stamp_wander_s` how wrong the recovered sample clock is
    (standard deviation; it wanders over seconds); `clock_ppm` how fast the chip's clock runs.
    """

    rate_hz: float = 400.0
    chip: str = "icm42688"
    butt_m: float = 0.076
    turn: Quaternion | None = None
    acceleration_range_g: float = 16.0
    rate_range_dps: float = 2000.0
    band: float = 0.4
    clock_ppm: float = 40.0
    stamp_wander_s: float = 0.0002
    tells_orientation: bool = False
    has_gyro: bool = True
    link: Link = field(default_factory=Link)


@dataclass(frozen=True, slots=True)
class SimulatedStick:
    """What came from one stick, and the truth about it.

    Rows are samples that arrived, in order: `time_s` (n,) when they were measured, `stamp_ns` (n,) the same by the
    recovered clock, `arrival_ns` (n,), `acceleration` (n, 3) in m/s² and `rate` (n, 3) in rad/s in the sensor's axes,
    `orientation` (n, 4) or None, `temperature_c` (n,) of the chip. `measured` counts all samples, also those that were
    lost; `number` (n,) numbers them.
    """

    limb: Limb
    device: str
    mounting: Mounting
    time_s: Floats
    stamp_ns: Ints
    arrival_ns: Ints
    number: Ints
    acceleration: Floats
    rate: Floats | None
    orientation: Floats | None
    temperature_c: Floats
    measured: int
    sensor: SensorSpec
    motion: StickPath

    @property
    def samples(self) -> tuple[ImuSample, ...]:
        """All samples that arrived."""
        rate = [None] * len(self.time_s) if self.rate is None else [tuple(r) for r in self.rate.tolist()]
        turns = [None] * len(self.time_s) if self.orientation is None else [tuple(q) for q in self.orientation.tolist()]
        rows = zip(self.stamp_ns.tolist(), self.acceleration.tolist(), rate, turns, strict=True)
        return tuple(ImuSample(at, (a[0], a[1], a[2]), r, q) for at, a, r, q in rows)

    def events(self) -> list[SensorSamples]:
        """The samples as they arrived: one event for all that came at one time."""
        samples = self.samples
        starts = np.flatnonzero(np.diff(self.arrival_ns, prepend=-1)).tolist()
        return [
            SensorSamples(int(self.arrival_ns[a]), self.device, samples[a:b])
            for a, b in zip(starts, [*starts[1:], len(samples)], strict=True)
        ]


def measure(motion: StickPath, sensor: SensorSpec, device: str, rng: np.random.Generator) -> SimulatedStick:
    """What `sensor` reports of `motion`."""
    turn = random_turn(rng) if sensor.turn is None else sensor.turn
    chip = CHIPS[sensor.chip]
    to_sensor = matrix_of(turn).T
    felt = motion.force_free_of_gravity(sensor.butt_m) @ to_sensor.T
    turned = motion.rate_rad_s() @ to_sensor.T
    time_s = _sample_times(motion.time_s, sensor, rng)
    degrees = math.radians(1.0)
    acceleration = _through_chip(
        felt,
        motion.time_s,
        time_s,
        _Element(
            sensor.acceleration_range_g * STANDARD_GRAVITY_M_S2,
            chip.acceleration_noise_g * STANDARD_GRAVITY_M_S2,
            chip.acceleration_bias_g * STANDARD_GRAVITY_M_S2,
            chip.scale_error,
            0.0,
        ),
        sensor,
        rng,
    )
    rate = _through_chip(
        turned,
        motion.time_s,
        time_s,
        _Element(
            sensor.rate_range_dps * degrees,
            chip.rate_noise_dps * degrees,
            chip.rate_bias_dps * degrees,
            chip.scale_error,
            chip.rate_wander_dps * degrees,
            chip.rate_dps_a_kelvin * degrees,
        ),
        sensor,
        rng,
    )
    kept, arrival_s = _arrivals(time_s, sensor.link, rng)
    stamps = np.rint((time_s + _wander(time_s, sensor.stamp_wander_s, rng))[kept] * NS_PER_S).astype(np.int64)
    orientation = _orientations(motion, time_s[kept], turn, rng) if sensor.tells_orientation else None
    return SimulatedStick(
        limb=motion.limb,
        device=device,
        mounting=Mounting(motion.limb, turn, LENGTH_M - sensor.butt_m, sensor.butt_m, learnt=True),
        time_s=time_s[kept],
        stamp_ns=np.maximum.accumulate(stamps),
        arrival_ns=np.rint(arrival_s[kept] * NS_PER_S).astype(np.int64),
        number=np.flatnonzero(kept),
        acceleration=acceleration[kept],
        rate=rate[kept] if sensor.has_gyro else None,
        orientation=orientation,
        temperature_c=temperature_c(time_s[kept] - motion.time_s[0]),
        measured=len(time_s),
        sensor=sensor,
        motion=motion,
    )


@dataclass(frozen=True, slots=True)
class _Element:
    """One kind of sensing element: all in the unit it measures; noise per √Hz, wander per √minute."""

    range: float
    noise: float
    bias: float
    scale_error: float
    wander: float
    warming: float = 0.0  # per kelvin


def _through_chip(
    true: Floats, fine_s: Floats, time_s: Floats, element: _Element, sensor: SensorSpec, rng: np.random.Generator
) -> Floats:
    """What the chip gives out at `time_s` for the true values (n, 3) at `fine_s`."""
    limit = element.range * HEADROOM
    scaled = true * (1 + rng.uniform(-1, 1, 3) * element.scale_error) + rng.uniform(-1, 1, 3) * element.bias
    noisy = np.clip(scaled, -limit, limit) + rng.normal(0, 1, true.shape) * element.noise * math.sqrt(FINE_HZ / 2)
    smooth = _band_limited(noisy, sensor.band * sensor.rate_hz)
    sampled = np.stack([np.interp(time_s, fine_s, smooth[:, axis]) for axis in range(3)], axis=1)
    if element.wander and len(time_s) > 1:
        steps = rng.normal(0, 1, sampled.shape) * element.wander * math.sqrt(1 / (60 * sensor.rate_hz))
        sampled += np.cumsum(steps, axis=0)
    warmer = temperature_c(time_s - fine_s[0]) - ROOM_C
    sampled += warmer[:, None] * rng.uniform(-1, 1, 3) * element.warming
    step = element.range / 2 ** (BITS - 1)
    rounded: Floats = np.clip(np.rint(sampled / step), -(2 ** (BITS - 1)), 2 ** (BITS - 1) - 1) * step
    return rounded


def _band_limited(values: Floats, corner_hz: float) -> Floats:
    """`values` (n, 3) after a second-order Butterworth low pass, as its frequency response has it."""
    n = len(values)
    pad = int(FINE_HZ * 4 / corner_hz)
    padded = np.concatenate([np.repeat(values[:1], pad, axis=0), values])
    size = 1 << (len(padded) + pad - 1).bit_length()
    s = 1j * np.fft.rfftfreq(size, 1 / FINE_HZ) / corner_hz
    response = 1 / (1 + math.sqrt(2) * s + s**2)
    offset = padded[0]
    smooth = np.fft.irfft(np.fft.rfft(padded - offset, size, axis=0) * response[:, None], size, axis=0)
    result: Floats = smooth[pad : pad + n] + offset
    return result


def _sample_times(fine_s: Floats, sensor: SensorSpec, rng: np.random.Generator) -> Floats:
    """When the chip measures, by true time: its clock is `clock_ppm` fast, its first sample anywhere in a period."""
    period = 1 / (sensor.rate_hz * (1 + sensor.clock_ppm * 1e-6))
    first = fine_s[0] + rng.uniform(0, period)
    times: Floats = first + period * np.arange(math.floor((fine_s[-1] - first) / period))
    return times


def temperature_c(since_s: Floats) -> Floats:
    """The chip's temperature (n,) in °C, `since_s` (n,) after it was switched on."""
    return np.asarray(ROOM_C + WARMER_BY_C * (1 - np.exp(-since_s / WARMS_IN_S)))


def _wander(time_s: Floats, size_s: float, rng: np.random.Generator) -> Floats:
    """A slow error with standard deviation `size_s`."""
    error = np.zeros(len(time_s))
    for _ in range(4):
        error += np.sin(2 * math.pi * (rng.uniform(0.02, 0.5) * time_s + rng.uniform()))
    return error * size_s / math.sqrt(2)


SERIAL_DELAY_S = 0.001
"""From measurement to the computer at the least, over a serial line at 921,600 baud (our choice)."""
AGAIN = 0.03
"""Share of Bluetooth's connection events that must be repeated at the next one (our choice)."""


def _arrivals(time_s: Floats, link: Link, rng: np.random.Generator) -> tuple[NDArray[np.bool_], Floats]:
    """Which samples arrive (n,), and when (n,), in order."""
    packet = np.arange(len(time_s)) // link.samples_a_packet
    last = np.minimum((packet + 1) * link.samples_a_packet, len(time_s)) - 1
    sent = time_s[last]
    count = int(packet[-1]) + 1 if len(packet) else 0
    kept = (rng.uniform(size=count) >= link.loss)[packet]
    for start, end in link.away_s:
        kept &= (sent < start) | (sent >= end)
    if link.interval_s > 0:
        event = np.ceil((sent - time_s[0]) / link.interval_s)
        late = rng.uniform(size=int(event.max()) + 2 if len(event) else 0) < AGAIN
        arrival = time_s[0] + (event + late[event.astype(int)]) * link.interval_s + 0.002
    else:
        arrival = sent + SERIAL_DELAY_S + rng.uniform(0, link.jitter_s, count)[packet]
    return kept, np.maximum.accumulate(arrival)


def _orientations(motion: StickPath, time_s: Floats, turn: Quaternion, rng: np.random.Generator) -> Floats:
    """Earth from sensor, as the chip's own fusion tells it, (n, 4): right but for a heading of its own."""
    rows = np.clip(np.searchsorted(motion.time_s, time_s), 0, len(motion.time_s) - 1)
    north = rng.uniform(-math.pi, math.pi)
    own = np.array([[math.cos(north), -math.sin(north), 0], [math.sin(north), math.cos(north), 0], [0, 0, 1]])
    return quaternions(own @ motion.axes()[rows] @ matrix_of(turn))


def random_turn(rng: np.random.Generator) -> Quaternion:
    """Any rotation, all as likely (Shoemake 1992, four normal numbers)."""
    q = rng.normal(size=4)
    w, x, y, z = (q / np.linalg.norm(q)).tolist()
    return (w, x, y, z)


def matrix_of(turn: Quaternion) -> Floats:
    """The rotation matrix (3, 3) of a unit quaternion (w, x, y, z)."""
    w, x, y, z = turn
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternions(matrices: Floats) -> Floats:
    """Unit quaternions (n, 4), w, x, y, z, of rotation matrices (n, 3, 3) (Bar-Itzhack 2000, by the largest)."""
    m = matrices
    trace = np.trace(m, axis1=1, axis2=2)
    squares = np.stack([1 + trace, *(1 - trace + 2 * m[:, i, i] for i in range(3))], axis=1)
    largest = squares.argmax(axis=1)
    a, b, c = m[:, 2, 1], m[:, 0, 2], m[:, 1, 0]
    d, e, f = m[:, 1, 2], m[:, 2, 0], m[:, 0, 1]
    products = np.stack(
        [
            np.stack([squares[:, 0], a - d, b - e, c - f], axis=1),
            np.stack([a - d, squares[:, 1], c + f, b + e], axis=1),
            np.stack([b - e, c + f, squares[:, 2], a + d], axis=1),
            np.stack([c - f, b + e, a + d, squares[:, 3]], axis=1),
        ],
        axis=1,
    )
    chosen = products[np.arange(len(m)), largest]
    result: Floats = chosen / np.linalg.norm(chosen, axis=1, keepdims=True)
    return result
