"""What devices report: immutable events, each with the session time (monotonic ns) at which it happened."""

from dataclasses import dataclass

from station.core.imu import ImuSample, Mounting, Quaternion
from station.core.pieces import Articulation, Limb, Piece, Zone


@dataclass(frozen=True, slots=True)
class Hit:
    """A stroke that was played.

    `velocity` 1–127, to which `velocity_fraction` adds 0 ≤ f < 1 where the kit tells it finer: sound and judgement go
    by `fine_velocity`, their sum. `openness` of the hi-hat 0 closed … 1 open, None where the kit cannot tell;
    `midi_note` the number as sent (0 where there was none); `position` 0 head's centre … 1 edge; `device` names the
    port.
    """

    at_ns: int
    piece: Piece
    zone: Zone
    velocity: int
    articulation: Articulation = Articulation.NORMAL
    openness: float | None = None
    midi_note: int = 0
    position: float | None = None
    limb: Limb = Limb.UNKNOWN
    device: str = ""
    velocity_fraction: float = 0.0

    @property
    def fine_velocity(self) -> float:
        """The velocity as finely as the kit tells it, 1 ≤ v < 128."""
        return self.velocity + self.velocity_fraction


@dataclass(frozen=True, slots=True)
class Choke:
    """A ringing cymbal was grabbed."""

    at_ns: int
    piece: Piece
    device: str = ""


@dataclass(frozen=True, slots=True)
class PedalMoved:
    """The hi-hat pedal is now at `openness` 0 closed … 1 open."""

    at_ns: int
    openness: float
    device: str = ""


@dataclass(frozen=True, slots=True)
class Switched:
    """A switch that plays nothing is pressed, and reported again while it moves.

    `switch` is `cc=64` for a controller, `program=5` for a program, `key=5` for a key of a keyboard and `button=10` for
    a button of a game kit, both by their numbers in the HID usage tables.
    """

    at_ns: int
    switch: str
    device: str = ""


@dataclass(frozen=True, slots=True)
class DeviceLost:
    """A device vanished; what it played until `at_ns` is safe."""

    at_ns: int
    device: str


@dataclass(frozen=True, slots=True)
class DeviceFound:
    """A device appeared, or came back."""

    at_ns: int
    device: str


DeviceEvent = Hit | Choke | PedalMoved | Switched | DeviceLost | DeviceFound


# --- motion sensors ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class SensorMounted:
    """The sensor `device` is here, and mounted so from now on; its sample clock and its orientation start afresh."""

    at_ns: int
    device: str
    mounting: Mounting


@dataclass(frozen=True, slots=True)
class SensorLost:
    """The sensor `device` vanished; no kit is lost with it."""

    at_ns: int
    device: str


@dataclass(frozen=True, slots=True)
class SensorSamples:
    """What a sensor measured, in order; they came at session time `at_ns`."""

    at_ns: int
    device: str
    samples: tuple[ImuSample, ...]


@dataclass(frozen=True, slots=True)
class SensorStatus:
    """How a sensor does, about once a second: what it sends and what was lost since it was found.

    `battery` 0 … 1 and `temperature_c` are None where it tells none; `note` is what it said last of itself, such as an
    error. An empty `protocol` means that nothing readable comes. `air` is what its player should know who plays an air
    kit.
    """

    at_ns: int
    device: str
    protocol: str
    rate_hz: float | None = None
    samples: int = 0
    lost: int = 0
    bad_bytes: int = 0
    battery: float | None = None
    temperature_c: float | None = None
    note: str = ""
    air: tuple[str, ...] = ()


SensorEvent = SensorMounted | SensorLost | SensorSamples | SensorStatus
"""What decoders make of a sensor and its bytes; samples stay in the engine unless somebody watches them."""


@dataclass(frozen=True, slots=True)
class StickStroke:
    """A stroke that a stick's sensor felt; `at_ns` the onset of the contact, or, in the air, the intended beat.

    `speed_m_s` of the tip just before; `height_m` how far above the point of impact the tip had been raised; `rebound`
    its speed just after over that before, 0 … 1; `angle_rad` of the stick above (+) or below (−) the horizontal at
    impact; `roll_rad` how far the stick is turned about its own axis from how it was mounted. None where the sensor
    could not tell. `clipped` says that the sensor was at its limit: the speed is a lower bound.
    """

    at_ns: int
    device: str
    limb: Limb
    speed_m_s: float | None
    height_m: float | None = None
    rebound: float | None = None
    angle_rad: float | None = None
    clipped: bool = False
    in_air: bool = False
    roll_rad: float | None = None


@dataclass(frozen=True, slots=True)
class StickPose:
    """How a stick is held, a few dozen times a second, for a picture; `turn` earth from stick.

    `resting` whether it lies still.
    """

    at_ns: int
    device: str
    limb: Limb
    turn: Quaternion
    resting: bool = False


@dataclass(frozen=True, slots=True)
class PhaseEstimate:
    """Where in its cycle a periodic motion is; see `sync.phase`.

    `phase_rad` in (−π, π]; `quality` E_max of the paper; `confidence` 0 … 1 that it is this motion, going forward;
    `cadence_rad_s` how fast the phase runs, `locked` whether it follows.
    """

    at_ns: int
    phase_rad: float
    quality: float
    confidence: float
    cadence_rad_s: float
    locked: bool


StickEvent = SensorMounted | SensorLost | SensorStatus | StickStroke | StickPose | PhaseEstimate
"""What is told of sensors beyond the engine."""
