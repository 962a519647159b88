"""What devices report: immutable events, each with the session time (monotonic ns) at which it happened."""

from dataclasses import dataclass

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

    `switch` is `cc=64` for a controller, `program=5` for a program.
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
