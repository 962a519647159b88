"""How one kit is understood: what its notes and controllers mean, and what of it is no stroke.

A module's table (`presets`) says what every kit of its kind sends; a user's own (`device_file`) what this one does.
Times are nanoseconds, velocities 1–127, openness 0 closed … 1 open.

Sources of the rules: what users of drum modules and of the open trigger module edrumulus report (issues 109, 111, 112
and 145 there): crosstalk that arrives before the stroke itself, grabs that fire rim notes, stomps that fire hi-hat
notes, half-open playing that fires stomps; its defaults of 6 to 9 ms of mask and 30 ms of crosstalk cancellation.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.note_map import KitMap, NoteMeaning, strike_of
from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.velocity_curve import AS_SENT, VelocityCurve

PEDAL_CONTROLLER = 4
"""The foot controller: the hi-hat pedal of every module whose maker says so, unless its owner chose another."""

CROSSTALK_WITHIN_NS = 30 * NS_PER_MS
"""How long after a stroke its crosstalk may come where nothing else is said: edrumulus' default."""
CROSSTALK_BEFORE_NS = 5 * NS_PER_MS
"""How long before it; our choice: a pad that is struck passes its own mask time before it sends, its neighbour less."""


@dataclass(frozen=True, slots=True)
class PedalRange:
    """The values of the pedal's controller at which the hi-hat is wide open and shut; linear between, clipped outside.

    `steps` are all the values there are, from open to shut, where the controller knows but a few: what it sends counts
    as the nearest of them, and they lie evenly between open and shut. A pedal may run either way.
    """

    wide_open: int = 0
    shut: int = 127
    controller: int = PEDAL_CONTROLLER
    steps: tuple[int, ...] = ()

    def openness(self, value: int) -> float:
        """Openness 0 closed … 1 open of a controller value 0–127."""
        if self.steps:
            nearest = min(range(len(self.steps)), key=lambda step: abs(self.steps[step] - value))
            return 1.0 - nearest / (len(self.steps) - 1)
        share = (self.shut - value) / (self.shut - self.wide_open)
        return min(1.0, max(0.0, share))

    def value(self, openness: float) -> int:
        """The controller value of an `openness`, the nearest that this pedal knows."""
        if self.steps:
            return self.steps[round((1.0 - openness) * (len(self.steps) - 1))]
        return round(self.shut - openness * (self.shut - self.wide_open))


@dataclass(frozen=True, slots=True)
class Foot:
    """What the hi-hat foot does to this kit.

    `least_travel` is the openness that the pedal must have lost for a stomp to be one beside a stroke on the hi-hat
    (0: every stomp counts); within `splash_ns` of a stomp a pedal that opens again makes it a splash (0: the notes say
    which it is); `by_controller` where no note tells of a stomp, so that it is read off the pedal's way down.
    """

    least_travel: float = 0.0
    splash_ns: int = 0
    by_controller: bool = False


@dataclass(frozen=True, slots=True)
class Pad:
    """What is known of one pad: softer than `threshold` is no stroke; for `mask_ns` after a stroke there is no other.

    `least_velocity` is the softest that the pad was found to send, None where nobody has measured. All three are
    velocities as they are sent; `curve` says what a stroke counts as.
    """

    threshold: int = 1
    mask_ns: int = 0
    least_velocity: int | None = None
    curve: VelocityCurve = AS_SENT


PLAIN_PAD = Pad()


@dataclass(frozen=True, slots=True)
class Crosstalk:
    """A stroke on `source` makes `victim` send a hit, at most `share` as loud.

    It comes from `before_ns` before the stroke to `within_ns` after it.
    """

    source: Piece
    victim: Piece
    share: float
    within_ns: int = CROSSTALK_WITHIN_NS
    before_ns: int = CROSSTALK_BEFORE_NS


Sent = tuple[int, int]
"""A note as it is sent: its channel, 1–16, and its number, 0–127."""


def _nothing() -> MappingProxyType[int, frozenset[Piece]]:
    return MappingProxyType({})


@dataclass(frozen=True, slots=True)
class DeviceMap:
    """How to understand one kit.

    `port_words` are parts of the names that drivers give its port; `channel_notes` are notes that mean another thing
    on one channel; `pedal` is None where the notes alone tell the hi-hat's openness; `choke_from` the least polyphonic
    aftertouch that means a grabbed cymbal; `choke_notes` the notes that mean one; `grab_velocity` the hardest stroke
    that a grabbing hand fires on the cymbal's edge (0: none); `position_controllers` tell where the next stroke on one
    of their pieces lands, 0 centre … 127 edge; `base` names the preset that a user's own kit is built on, empty for a
    preset; `reports` the table by which its HID reports are read (`devices.hid.hid_reports`), empty for MIDI.
    """

    name: str
    title: str
    notes: KitMap
    port_words: tuple[str, ...] = ()
    pedal: PedalRange | None = field(default_factory=PedalRange)
    choke_from: int = 1
    position_controllers: Mapping[int, frozenset[Piece]] = field(default_factory=_nothing)
    choke_notes: Mapping[int, Piece] = field(default_factory=lambda: MappingProxyType({}))
    grab_velocity: int = 0
    foot: Foot = field(default_factory=Foot)
    pads: Mapping[Piece, Pad] = field(default_factory=lambda: MappingProxyType({}))
    crosstalk: tuple[Crosstalk, ...] = ()
    base: str = ""
    channel_notes: Mapping[Sent, NoteMeaning] = field(default_factory=lambda: MappingProxyType({}))
    reports: str = ""

    def strike(self, channel: int, note: int) -> NoteMeaning:
        """What `note` of `channel`, 1–16, means; `Piece.PERCUSSION` where nobody has said."""
        return self.channel_notes.get((channel, note)) or strike_of(note, self.notes)

    def knows(self, channel: int, note: int) -> bool:
        """Whether it is known what `note` of `channel` means."""
        return note in self.notes or note in self.choke_notes or (channel, note) in self.channel_notes

    @property
    def has_rules(self) -> bool:
        """Whether some of what it sends may be no stroke."""
        foot = self.foot.least_travel or self.foot.splash_ns
        return bool(self.pads or self.crosstalk or self.grab_velocity or foot)

    def pad(self, piece: Piece) -> Pad:
        """What is known of the pad of `piece`."""
        return self.pads.get(piece, PLAIN_PAD)
