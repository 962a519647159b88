"""Which note number and controller of a drum module means what: one table a module, and General MIDI for the rest.

Only modules with a map that its maker or several independent users published are here; another kit starts from General
MIDI. Each table lists what differs from its base. Controller 4 is the hi-hat pedal (Roland and Yamaha MIDI
implementations); `PedalRange` says which of its values mean shut and wide open.

Sources: Roland TD-17 default factory MIDI note map (TD-11 and TD-27 send the same numbers), Roland VQD106 MIDI
implementation, Alesis Nitro and Nitro Max user guides, Alesis Crimson II user guide, Yamaha DTX502 and DTXplorer
owner's manuals (MIDI data format).
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.kitmap import GENERAL_MIDI, V_DRUMS, KitMap, Strike
from station.core.pieces import Articulation, Piece, Zone

PEDAL_CONTROLLER = 4


@dataclass(frozen=True, slots=True)
class PedalRange:
    """The values of controller 4 at which the hi-hat is wide open and shut; linear between, clipped outside."""

    wide_open: int = 0
    shut: int = 127

    def openness(self, value: int) -> float:
        """Openness 0 closed … 1 open of a controller value 0–127."""
        share = (self.shut - value) / (self.shut - self.wide_open)
        return min(1.0, max(0.0, share))


@dataclass(frozen=True, slots=True)
class KitPreset:
    """How to understand one module.

    `port_words` are parts of the names that drivers give its port; `pedal` is None where the notes alone tell the
    hi-hat's openness; `choke_from` the least polyphonic aftertouch that means a grabbed cymbal; `position_controllers`
    bear where the next hit on a piece lands, 0 centre … 127 edge.
    """

    name: str
    title: str
    notes: KitMap
    port_words: tuple[str, ...] = ()
    pedal: PedalRange | None = field(default_factory=PedalRange)
    choke_from: int = 1
    position_controllers: Mapping[int, Piece] = field(default_factory=lambda: MappingProxyType({}))


_HALF_OPEN = 0.5
_SHUT = 0.0
_OPEN = 1.0

_FOUR_TOM_RIMS = {
    39: Strike(Piece.FLOOR_TOM_2, Zone.RIM),
    41: Strike(Piece.FLOOR_TOM_2),
}

_ROLAND: KitMap = MappingProxyType(
    {**V_DRUMS, 27: Strike(Piece.PERCUSSION, Zone.HEAD), 28: Strike(Piece.PERCUSSION, Zone.RIM)}
)

_ALESIS_NITRO: KitMap = MappingProxyType(
    {
        **V_DRUMS,
        **_FOUR_TOM_RIMS,
        21: Strike(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, _OPEN),
        23: Strike(Piece.HIHAT, Zone.BOW, openness=_HALF_OPEN),
        49: Strike(Piece.CRASH_1, Zone.EDGE),
        57: Strike(Piece.CRASH_2, Zone.EDGE),
    }
)

_ALESIS_CRIMSON: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        8: Strike(Piece.HIHAT, Zone.BOW),
        22: Strike(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, _SHUT),
        23: Strike(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, _OPEN),
        50: Strike(Piece.TOM_1),
        82: Strike(Piece.TOM_1, Zone.RIM),
        47: Strike(Piece.TOM_2),
        80: Strike(Piece.TOM_2, Zone.RIM),
        43: Strike(Piece.FLOOR_TOM_1),
        75: Strike(Piece.FLOOR_TOM_1, Zone.RIM),
        41: Strike(Piece.FLOOR_TOM_2),
        73: Strike(Piece.FLOOR_TOM_2, Zone.RIM),
    }
)

_YAMAHA_TOMS = {
    48: Strike(Piece.TOM_1),
    47: Strike(Piece.TOM_2),
    43: Strike(Piece.FLOOR_TOM_1),
}

_YAMAHA_DTX502: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        **_YAMAHA_TOMS,
        31: Strike(Piece.SNARE),  # 31, 34 and 27: the snare with its wires off
        34: Strike(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        27: Strike(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        51: Strike(Piece.RIDE, Zone.BOW),
        52: Strike(Piece.RIDE, Zone.EDGE),
        53: Strike(Piece.RIDE, Zone.BELL),
        59: Strike(Piece.CRASH_1, Zone.BOW),
        49: Strike(Piece.CRASH_1, Zone.EDGE),
        55: Strike(Piece.CRASH_1, Zone.BELL),
        78: Strike(Piece.HIHAT, Zone.EDGE, openness=_OPEN),
        85: Strike(Piece.HIHAT, Zone.BELL, openness=_OPEN),
        79: Strike(Piece.HIHAT, Zone.EDGE, openness=_SHUT),
        86: Strike(Piece.HIHAT, Zone.BELL, openness=_SHUT),
        83: Strike(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, _OPEN),
    }
)

_YAMAHA_DTXPLORER: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        **_YAMAHA_TOMS,
        33: Strike(Piece.KICK),
        31: Strike(Piece.SNARE),
        34: Strike(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        37: Strike(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        85: Strike(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, _OPEN),
        51: Strike(Piece.RIDE, Zone.BOW),
        52: Strike(Piece.RIDE, Zone.EDGE),
    }
)

_SNARE_POSITION: Mapping[int, Piece] = MappingProxyType({16: Piece.SNARE})

GENERAL_MIDI_PRESET = KitPreset("general-midi", "General MIDI", GENERAL_MIDI)

_TABLE = (
    GENERAL_MIDI_PRESET,
    KitPreset("roland-td-11", "Roland TD-11", V_DRUMS, ("td-11",), position_controllers=_SNARE_POSITION),
    KitPreset("roland-td-17", "Roland TD-17", _ROLAND, ("td-17",)),
    KitPreset("roland-td-27", "Roland TD-27", _ROLAND, ("td-27",), position_controllers=_SNARE_POSITION),
    KitPreset("roland-vqd106", "Roland VQD106", V_DRUMS, ("vqd106",), PedalRange(wide_open=0, shut=90)),
    KitPreset("alesis-nitro", "Alesis Nitro, Nitro Mesh, Nitro Max", _ALESIS_NITRO, ("nitro",), None),
    KitPreset("alesis-crimson-2", "Alesis Crimson II", _ALESIS_CRIMSON, ("crimson",)),
    KitPreset("yamaha-dtx502", "Yamaha DTX502", _YAMAHA_DTX502, ("dtx502",)),
    KitPreset("yamaha-dtxplorer", "Yamaha DTXplorer", _YAMAHA_DTXPLORER, ("dtxplorer",)),
)

PRESETS: Mapping[str, KitPreset] = MappingProxyType({preset.name: preset for preset in _TABLE})

_WINDOWS_COUNT = re.compile(r"^\d+- ")
_ALSA_ADDRESS = re.compile(r" \d+:\d+$")


def stable_name(port: str) -> str:
    """A port's name without what changes when it is plugged in again: the numbers of `2- TD-17` and `Nitro 28:0`."""
    return _ALSA_ADDRESS.sub("", _WINDOWS_COUNT.sub("", port))


def preset_for(port: str) -> KitPreset:
    """The preset of the module whose port this is, in any case of letters; General MIDI where none is known."""
    name = port.lower()
    for preset in _TABLE:
        if any(word in name for word in preset.port_words):
            return preset
    return GENERAL_MIDI_PRESET


def preset_named(name: str) -> KitPreset:
    """The preset called `name`; raises `BadInput` that lists those there are."""
    try:
        return PRESETS[name]
    except KeyError:
        raise BadInput(name, "", f"no such kit preset; there are {', '.join(PRESETS)}") from None
