"""What the app says to the engine and hears from it: plain immutable values that cross a process boundary.

The transport has a zero, the session time at which cue time 0 is *heard*. Cues are placed on it in nanoseconds; the
engine knows no bars and no lessons.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.events import DeviceEvent, SensorSamples, StickEvent
from station.core.pieces import Articulation, Piece, Zone
from station.sound.buses import Bus, ClickVoice
from station.sound.track import PreparedTrack, Track
from station.sync.air.air_zones import AirKit
from station.sync.drill.drill_model import DrillModel
from station.sync.sonification.triggers import Trigger

__all__ = [
    "CUE_DTYPE",
    "AddCues",
    "Annotate",
    "Bus",
    "CaptureSaved",
    "ClickVoice",
    "Command",
    "EngineEvent",
    "KeyHit",
    "Notice",
    "Play",
    "Quit",
    "RawBytes",
    "Ready",
    "RecordCapture",
    "ReloadDevice",
    "Resume",
    "SetAirDrums",
    "SetBacking",
    "SetLevel",
    "SetMaster",
    "SetMidiOut",
    "SetPiece",
    "SetSounds",
    "Sounding",
    "SoundsSet",
    "Started",
    "Status",
    "Stop",
    "TrackPhase",
    "Unheard",
    "Watch",
    "WatchRawBytes",
    "WatchSensors",
]

CUE_DTYPE = np.dtype(
    [
        ("at_ns", np.int64),  # from the transport's zero
        ("bus", np.uint8),
        ("piece", np.uint8),  # Piece, or ClickVoice on the click bus
        ("zone", np.uint8),
        ("articulation", np.uint8),
        ("velocity", np.uint8),  # 1–127; 0 grabs the ringing cymbal (a choke)
        ("openness", np.float32),  # hi-hat 0 closed … 1 open; NaN where it does not matter
    ]
)


# --- to the engine ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Play:
    """Start the transport: cue time 0 is heard `start_in_ns` from now, or as soon after as the sound card can."""

    cues: NDArray[np.void]
    start_in_ns: int


@dataclass(frozen=True, eq=False)
class Resume:
    """Go on with a transport whose zero was heard at session time `zero_ns`: what lies behind is over.

    It is for an engine that takes another's place; that one has said `Started` and recorded its zero.
    """

    cues: NDArray[np.void]
    zero_ns: int


@dataclass(frozen=True, eq=False)
class AddCues:
    """Let `cues` sound too, at their times from the zero of the transport that runs or was asked to start.

    Those whose time has passed are late, as others are; where the transport stands nothing is added.
    """

    cues: NDArray[np.void]


@dataclass(frozen=True, slots=True)
class Stop:
    """Stop the transport and drop its cues; what rings, rings out."""


@dataclass(frozen=True, slots=True)
class SetLevel:
    """Set a bus's level (0 silent, 1 full) and pan (−1 left … 1 right)."""

    bus: Bus
    level: float
    pan: float = 0.0


@dataclass(frozen=True, slots=True)
class SetPiece:
    """Set the level (0 silent, 1 as the kit has it) and pan (−1 left … 1 right) of a piece, whoever plays it."""

    piece: Piece
    level: float
    pan: float = 0.0


@dataclass(frozen=True, slots=True)
class SetMaster:
    """Set the level of all that sounds (0 silent, 1 full)."""

    level: float


@dataclass(frozen=True, slots=True)
class SetSounds:
    """Let the drum kit and the click of these names sound, as soon as they are read; `SoundsSet` says when.

    What rings, rings out. Sounds that cannot be had leave those before in place.
    """

    drums: str
    click: str


@dataclass(frozen=True, slots=True)
class SetBacking:
    """Play along to `track` whenever the transport runs, from `at_ns` after its zero on; None for no track.

    `loaded` is filled in on the way, by whoever has time to read the file.
    """

    track: PreparedTrack | None
    at_ns: int = 0
    loaded: Track | None = None


@dataclass(frozen=True, slots=True)
class SetMidiOut:
    """Send the demonstration to the MIDI output whose name contains `port`, from the next start on; None to none."""

    port: str | None


@dataclass(frozen=True, slots=True)
class SetAirDrums:
    """Make hits of what the sticks play in the air, by `kit`; None for no air drums.

    `ahead_ns` is how long before its beat a stroke may sound, where it is foretold; None for none that is.
    """

    kit: AirKit | None
    ahead_ns: int | None = None


@dataclass(frozen=True, slots=True)
class TrackPhase:
    """Tell where in the drill of `model` the sticks are, as `PhaseEstimate`s from now on; None for no longer.

    The phase lets `triggers` sound; what they sound is heard, and is no hit of the student's. A `note` is kept in the
    capture at that very place, as the text of `Annotate` is.
    """

    model: DrillModel | None
    triggers: tuple[Trigger, ...] = ()
    note: str = ""


@dataclass(frozen=True, slots=True)
class KeyHit:
    """A stroke played on the computer's keyboard, stamped `at_ns` when it was polled."""

    at_ns: int
    piece: Piece
    zone: Zone
    velocity: int
    articulation: Articulation = Articulation.NORMAL
    openness: float | None = None


@dataclass(frozen=True, slots=True)
class RecordCapture:
    """Write every byte of every device to a capture at `path` from now on; None ends the capture."""

    path: Path | None


@dataclass(frozen=True, slots=True)
class Annotate:
    """Keep `text` in the capture, where one is open: what its bytes do not say of what went on."""

    text: str


@dataclass(frozen=True, slots=True)
class WatchRawBytes:
    """Tell every byte that comes from a kit as `RawBytes` from now on, for a page that shows them; or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class WatchSensors:
    """Tell every sample of the sticks as `SensorSamples` from now on, for who learns from them; or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class ReloadDevice:
    """Read what the user taught of `device` anew, a kit's pads or a sensor's mounting: it was changed."""

    device: str


@dataclass(frozen=True, slots=True)
class Quit:
    """End the engine process."""


Setting = SetLevel | SetPiece | SetMaster | SetSounds | SetBacking | SetMidiOut | SetAirDrums | TrackPhase
Watch = WatchRawBytes | WatchSensors
Transport = Play | Resume | AddCues | Stop
Command = Transport | Setting | KeyHit | RecordCapture | Annotate | Watch | ReloadDevice | Quit


# --- from the engine -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Ready:
    """The engine process is up: hits are heard and sounded by the card named `output`, None when it runs silent.

    `rate_hz` is the card's, for which a track to play along to is prepared; None when silent.
    """

    output: str | None
    rate_hz: int | None = None


@dataclass(frozen=True, slots=True)
class Sounding:
    """The sound goes to the card named `output` from now on, at `rate_hz`; None where there is none any more."""

    output: str | None
    rate_hz: int | None = None


@dataclass(frozen=True, slots=True)
class SoundsSet:
    """A `SetSounds` was obeyed: these sound from now on; `fault` says why they do not."""

    drums: str
    click: str
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class CaptureSaved:
    """A `RecordCapture` was obeyed: what was played before it has been reported, and is on the disk where one was open.

    `path` is that of the command; `fault` says why nothing is recorded, or what the capture that ended lacks.
    """

    path: Path | None
    fault: str | None = None


@dataclass(frozen=True, slots=True)
class Started:
    """The transport runs; its zero is heard at session time `zero_ns` by the report of `output`, None when silent."""

    zero_ns: int
    output: str | None = None


@dataclass(frozen=True, slots=True)
class Notice:
    """Something a user should read once, such as "no sound card: running silent"."""

    text: str


@dataclass(frozen=True, slots=True)
class Unheard:
    """No stroke could be heard between these session times: the engine had ended, and another took its place."""

    from_ns: int
    until_ns: int


@dataclass(frozen=True, slots=True)
class Status:
    """How the engine is doing; sent once a second while it runs.

    `underflows` audio blocks that came too late, `late_cues` cues whose time had passed, both since the start;
    `output_latency_ms` as the stream reports it, None when silent; `load` share of the block time used for mixing.
    """

    at_ns: int
    underflows: int
    late_cues: int
    output_latency_ms: float | None
    load: float


@dataclass(frozen=True, slots=True)
class RawBytes:
    """Bytes of `device` that came at `at_ns`, as they are; the events that they bring are reported besides."""

    at_ns: int
    device: str
    data: bytes


Heard = DeviceEvent | StickEvent | SensorSamples | RawBytes
EngineEvent = Heard | Ready | Sounding | SoundsSet | CaptureSaved | Started | Notice | Status | Unheard
