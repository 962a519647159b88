"""What the page for sticks shows: each sensor and its stick, what is learnt of them, what they are used for."""

from collections import deque
from dataclasses import dataclass, field
from math import atan2, cos, remainder, sin, tau

from station.core.events import PhaseEstimate, SensorStatus, StickPose, StickStroke
from station.core.imu import Mounting, Quaternion
from station.core.pieces import Limb
from station.core.units import NS_PER_S
from station.devices.imu.imu_protocols import PROTOCOLS
from station.sync.air.air_zones import AirZone

HEADING_S = 4.0
"""How long the picture takes to bring a stick that points aside back to its middle (our choice: a swing does not move
it, and a heading that drifts by degrees a minute is never seen)."""
SILENT_NS = 2 * NS_PER_S
"""A sensor of which so long nothing was heard says nothing: it tells its status every second (our choice: one lost)."""
_SHOWN_LOST = 0.01
"""From a lost sample in a hundred on it is said (our choice)."""
_STROKES_KEPT = 16


@dataclass(slots=True)
class SeenStick:
    """One sensor as it was heard of, and where its stick points ahead in the picture."""

    mounting: Mounting = field(default_factory=Mounting)
    heard_ns: int | None = None
    status: SensorStatus | None = None
    pose: StickPose | None = None
    ahead_rad: float = 0.0
    strokes: deque[StickStroke] = field(default_factory=lambda: deque(maxlen=_STROKES_KEPT))

    def hold(self, pose: StickPose) -> None:
        """The stick is held so; what is ahead in the picture follows it slowly."""
        heading = _heading(pose.turn)
        if self.pose is None:
            self.ahead_rad = heading
        else:
            share = min(1.0, max(0, pose.at_ns - self.pose.at_ns) / NS_PER_S / HEADING_S)
            self.ahead_rad += share * remainder(heading - self.ahead_rad, tau)
        self.pose = pose


@dataclass(frozen=True, slots=True)
class StickView:
    """One stick: its sensor `device`, the hand that holds it, and what there is to say of both.

    `turn` is earth from stick, with the heading such that 0 is ahead; None before its pose is known. Whether it
    `moves` is None then, and while its sensor is silent. `facts` are in
    order of use, `troubles` what the player should mend.
    """

    device: str
    limb: Limb
    is_learnt: bool
    turn: Quaternion | None
    moves: bool | None
    facts: tuple[str, ...]
    troubles: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Lesson:
    """What is learnt at present: what to do now, and how much of it is done, 0 … 1."""

    asks: str
    done: float


@dataclass(frozen=True, slots=True)
class SticksView:
    """What the page shows; `lesson` is None while nothing is learnt, `learnt` what came of it last."""

    sticks: tuple[StickView, ...] = ()
    lesson: Lesson | None = None
    learnt: tuple[str, ...] = ()
    plays_air: bool = False
    zones: tuple[AirZone, ...] = ()
    follows_phase: bool = False
    sounds_phase: bool = False
    phase: PhaseEstimate | None = None


def view_of(device: str, seen: SeenStick, now_ns: int) -> StickView:
    """One stick at `now_ns`."""
    return StickView(
        device,
        seen.mounting.limb,
        seen.mounting.learnt,
        None if seen.pose is None else _ahead(seen.pose.turn, seen.ahead_rad),
        None if seen.pose is None or _is_silent(seen, now_ns) else not seen.pose.resting,
        tuple(_facts(seen)),
        tuple(_troubles(seen, now_ns)),
    )


def _facts(seen: SeenStick) -> list[str]:
    facts, status = [], seen.status
    if status is not None and status.protocol:
        rate = "" if status.rate_hz is None else f", {status.rate_hz:.0f} Hz"
        facts.append(f"{PROTOCOLS[status.protocol].title}{rate}")
        if status.battery is not None:
            facts.append(f"battery {status.battery:.0%}")
        facts.append(f"{_lost(status):.1%} lost" if status.lost else "none lost")
    if seen.strokes:
        facts.append(_stroke_in_words(seen.strokes[-1]))
    return facts


def _stroke_in_words(stroke: StickStroke) -> str:
    """The last stroke: how fast, and from how high."""
    speed = "a stroke" if stroke.speed_m_s is None else f"last stroke {stroke.speed_m_s:.1f} m/s"
    return speed if stroke.height_m is None else f"{speed} from {100 * stroke.height_m:.0f} cm"


def _troubles(seen: SeenStick, now_ns: int) -> list[str]:
    said, status = list[str](), seen.status
    if status is None or seen.heard_ns is None:
        return ["nothing has come from it yet"]
    if _is_silent(seen, now_ns):
        return ["it has fallen silent"]
    if not status.protocol:
        return [status.note or "nothing readable comes: does it speak at another rate (PORT@BAUD)?"]
    if status.note:
        said.append(f"it says: {status.note}")
    if _lost(status) > _SHOWN_LOST:
        said.append("samples are lost: bring it nearer, or lower its rate")
    clipped = sum(stroke.clipped for stroke in seen.strokes)
    if clipped:
        said.append(
            f"{clipped} of the last {len(seen.strokes)} strokes were beyond its gyro, so faster than shown: "
            "set it to a wider range, if it has one"
        )
    return [*said, *status.air]


def _is_silent(seen: SeenStick, now_ns: int) -> bool:
    return seen.heard_ns is None or now_ns - seen.heard_ns > SILENT_NS


def _lost(status: SensorStatus) -> float:
    """The share of samples that never came."""
    return status.lost / max(1, status.lost + status.samples)


def _heading(turn: Quaternion) -> float:
    """Where the stick points, counter-clockwise from above, radians."""
    w, x, y, z = turn
    return atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z))


def _ahead(turn: Quaternion, ahead_rad: float) -> Quaternion:
    """`turn`, turned back about the vertical by `ahead_rad`."""
    w, x, y, z = turn
    c, s = cos(ahead_rad / 2.0), -sin(ahead_rad / 2.0)
    return (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)
