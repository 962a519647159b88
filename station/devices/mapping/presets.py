"""Which note number and controller of a drum module means what: one table a module, and General MIDI for the rest.

Only modules with a map that its maker or several independent users published are here; another kit starts from General
MIDI, and its owner teaches the station the rest. Each table lists what differs from its base. Of two Roland modules
only the pedal's way is known; their notes are General MIDI's until their owner says otherwise.

Sources: Roland TD-17 default factory MIDI note map (TD-11 and TD-27 send the same numbers), Roland VQD106 and TD-07
(the pedal), Alesis Nitro and Nitro Max user guides, Alesis Crimson II user guide, Yamaha DTX502 and DTXplorer
owner's manuals (MIDI data format), Alesis DM10 MkII user guide, edrumulus.ino of corrados/edrumulus; the Groove MIDI
Dataset (a TD-11) for the pieces of the position controllers, which its implementation leaves to the owner.
"""

import re
from collections.abc import Mapping
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.note_map import GENERAL_MIDI, V_DRUMS, KitMap, NoteMeaning
from station.core.pieces import CLOSED, HALF_OPEN, OPEN, TOMS, Articulation, Piece, Zone
from station.devices.mapping.device_map import DeviceMap, PedalRange
from station.devices.mapping.game_presets import GAME_PRESETS

_ROLAND: KitMap = MappingProxyType(
    {**V_DRUMS, 27: NoteMeaning(Piece.PERCUSSION, Zone.HEAD), 28: NoteMeaning(Piece.PERCUSSION, Zone.RIM)}
)

_ALESIS_NITRO: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        **{number: V_DRUMS[number] for number in (48, 50, 45, 47, 43, 58)},  # three toms and their rims
        41: NoteMeaning(Piece.FLOOR_TOM_2),
        39: NoteMeaning(Piece.FLOOR_TOM_2, Zone.RIM),
        21: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, OPEN),
        23: NoteMeaning(Piece.HIHAT, Zone.BOW, openness=HALF_OPEN),
    }
)

_ALESIS_CRIMSON: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        8: NoteMeaning(Piece.HIHAT, Zone.BOW),
        22: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, CLOSED),
        23: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, OPEN),
        50: NoteMeaning(Piece.TOM_1),
        82: NoteMeaning(Piece.TOM_1, Zone.RIM),
        47: NoteMeaning(Piece.TOM_2),
        80: NoteMeaning(Piece.TOM_2, Zone.RIM),
        43: NoteMeaning(Piece.FLOOR_TOM_1),
        75: NoteMeaning(Piece.FLOOR_TOM_1, Zone.RIM),
        41: NoteMeaning(Piece.FLOOR_TOM_2),
        73: NoteMeaning(Piece.FLOOR_TOM_2, Zone.RIM),
    }
)

_YAMAHA_TOMS = {
    48: NoteMeaning(Piece.TOM_1),
    47: NoteMeaning(Piece.TOM_2),
    43: NoteMeaning(Piece.FLOOR_TOM_1),
}

_YAMAHA_DTX502: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        **_YAMAHA_TOMS,
        31: NoteMeaning(Piece.SNARE),  # 31, 34 and 27: the snare with its wires off
        34: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        27: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        51: NoteMeaning(Piece.RIDE, Zone.BOW),
        52: NoteMeaning(Piece.RIDE, Zone.EDGE),
        53: NoteMeaning(Piece.RIDE, Zone.BELL),
        59: NoteMeaning(Piece.CRASH_1, Zone.BOW),
        49: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        55: NoteMeaning(Piece.CRASH_1, Zone.BELL),
        78: NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=OPEN),
        85: NoteMeaning(Piece.HIHAT, Zone.BELL, openness=OPEN),
        79: NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=CLOSED),
        86: NoteMeaning(Piece.HIHAT, Zone.BELL, openness=CLOSED),
        83: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, OPEN),
        15: NoteMeaning(Piece.PERCUSSION),  # 15 and 16, beside 56 and 57: pads that their owner adds
        16: NoteMeaning(Piece.PERCUSSION),
    }
)

_YAMAHA_DTXPLORER: KitMap = MappingProxyType(
    {
        **GENERAL_MIDI,
        **_YAMAHA_TOMS,
        33: NoteMeaning(Piece.KICK),
        31: NoteMeaning(Piece.SNARE),
        34: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
        37: NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        85: NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, OPEN),
        51: NoteMeaning(Piece.RIDE, Zone.BOW),
        52: NoteMeaning(Piece.RIDE, Zone.EDGE),
    }
)

_ALESIS_DM10: KitMap = MappingProxyType(
    {**GENERAL_MIDI, 42: NoteMeaning(Piece.HIHAT, Zone.BOW), 46: NoteMeaning(Piece.HIHAT, Zone.BOW)}
)
"""One hi-hat note, whichever its owner has set: the pedal alone tells how open it is."""

_EDRUMULUS: KitMap = MappingProxyType({**V_DRUMS, 66: NoteMeaning(Piece.RIDE, Zone.EDGE)})

_UP_TO_90 = PedalRange(wide_open=0, shut=90)
"""The TD-11 too: whoever plays its closed notes in the Groove MIDI Dataset has the pedal at 90."""
_UP_TO_100 = PedalRange(wide_open=0, shut=100)
"""From 100 on edrumulus sends the notes of the closed hi-hat."""
_THREE_PLACES = PedalRange(steps=(0, 56, 127))
"""A DTXplorer's pedal may be an on-off one, or one with a middle."""

_SNARE_POSITION: Mapping[int, frozenset[Piece]] = MappingProxyType({16: frozenset({Piece.SNARE})})
_TD11_POSITIONS: Mapping[int, frozenset[Piece]] = MappingProxyType(
    {**_SNARE_POSITION, 17: frozenset({Piece.RIDE}), 18: frozenset(TOMS)}
)

GENERAL_MIDI_PRESET = DeviceMap("general-midi", "General MIDI", GENERAL_MIDI)

_TABLE = (
    GENERAL_MIDI_PRESET,
    DeviceMap("roland-td-11", "Roland TD-11", V_DRUMS, ("td-11",), _UP_TO_90, position_controllers=_TD11_POSITIONS),
    DeviceMap("roland-td-17", "Roland TD-17", _ROLAND, ("td-17",)),
    DeviceMap("roland-td-27", "Roland TD-27", _ROLAND, ("td-27",), position_controllers=_SNARE_POSITION),
    DeviceMap("roland-td-07", "Roland TD-07 (pedal only)", GENERAL_MIDI, ("td-07",), _UP_TO_90),
    DeviceMap("roland-vqd106", "Roland VQD106 (pedal only)", GENERAL_MIDI, ("vqd106",), _UP_TO_90),
    DeviceMap("alesis-nitro", "Alesis Nitro, Nitro Mesh, Nitro Max", _ALESIS_NITRO, ("nitro",), None),
    DeviceMap("alesis-crimson-2", "Alesis Crimson II", _ALESIS_CRIMSON, ("crimson",)),
    DeviceMap("alesis-dm10", "Alesis DM10 MkII", _ALESIS_DM10, ("dm10",)),
    DeviceMap("yamaha-dtx502", "Yamaha DTX502", _YAMAHA_DTX502, ("dtx502",)),
    DeviceMap("yamaha-dtxplorer", "Yamaha DTXplorer", _YAMAHA_DTXPLORER, ("dtxplorer",), _THREE_PLACES),
    DeviceMap("edrumulus", "edrumulus", _EDRUMULUS, ("edrumulus",), _UP_TO_100, position_controllers=_SNARE_POSITION),
)

PRESETS: Mapping[str, DeviceMap] = MappingProxyType({preset.name: preset for preset in _TABLE})
"""The modules that speak MIDI."""
KNOWN_KITS: Mapping[str, DeviceMap] = MappingProxyType({**PRESETS, **GAME_PRESETS})
"""All presets by name: those a kit's own file may build on, and a capture may name."""

_WINDOWS_COUNT = re.compile(r"^\d+- ")
_ALSA_ADDRESS = re.compile(r" \d+:\d+$")


def stable_name(port: str) -> str:
    """A port's name without what changes when it is plugged in again: the numbers of `2- TD-17` and `Nitro 28:0`."""
    return _ALSA_ADDRESS.sub("", _WINDOWS_COUNT.sub("", port))


def preset_for(port: str) -> DeviceMap:
    """The preset of the kit whose port this is, in any case of letters; General MIDI where none is known."""
    name = port.lower()
    for preset in KNOWN_KITS.values():
        if any(word in name for word in preset.port_words):
            return preset
    return GENERAL_MIDI_PRESET


def preset_named(name: str) -> DeviceMap:
    """The preset called `name`; raises `BadInput` that lists those there are."""
    try:
        return KNOWN_KITS[name]
    except KeyError:
        raise BadInput(name, "", f"no such kit preset{did_you_mean(name, KNOWN_KITS)}") from None
