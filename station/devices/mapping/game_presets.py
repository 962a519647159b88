"""What the lanes of game drums mean, which speak HID: presets like those of MIDI modules.

Rock Band: the pro kits' usual reading (yellow cymbal hi-hat, blue ride, green crash; three toms). First-generation kits
have four pads and no cymbal; yellow is the hi-hat and green the crash there, as the songs of that game have them (our
choice of the several readings; a kit's own file says otherwise). Behind a MIDI Pro adapter the second pedal is the
hi-hat's (RPCS3 RB3MidiDrums.cpp). Guitar Hero: the notes that the kit itself speaks (PlasticBand, "5-Lane Drums").
Neither tells how open a hi-hat is.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.note_map import KitMap, NoteMeaning
from station.core.pieces import CLOSED, Articulation, Piece, Zone
from station.devices.mapping.device_map import DeviceMap

_STOMP = NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, CLOSED)
_HIHAT = NoteMeaning(Piece.HIHAT, Zone.BOW)

_ROCK_BAND: KitMap = MappingProxyType(
    {
        36: NoteMeaning(Piece.KICK),
        35: NoteMeaning(Piece.KICK),
        38: NoteMeaning(Piece.SNARE),
        48: NoteMeaning(Piece.TOM_1),
        45: NoteMeaning(Piece.TOM_2),
        43: NoteMeaning(Piece.FLOOR_TOM_1),
        46: _HIHAT,
        51: NoteMeaning(Piece.RIDE, Zone.BOW),
        49: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        2: _HIHAT,
        3: NoteMeaning(Piece.TOM_1),
        4: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
    }
)

_GUITAR_HERO: KitMap = MappingProxyType(
    {
        36: NoteMeaning(Piece.KICK),
        38: NoteMeaning(Piece.SNARE),
        46: _HIHAT,
        48: NoteMeaning(Piece.TOM_1),
        49: NoteMeaning(Piece.CRASH_1, Zone.EDGE),
        45: NoteMeaning(Piece.FLOOR_TOM_1),
        100: _STOMP,
    }
)

_NO_NOTES: KitMap = MappingProxyType({})

_TABLE = (
    DeviceMap("rock-band", "Rock Band drums", _ROCK_BAND, ("rock band drums",), None, reports="rock-band"),
    DeviceMap(
        "rock-band-midi-pro",
        "Rock Band MIDI Pro adapter",
        MappingProxyType({**_ROCK_BAND, 35: _STOMP}),
        ("rock band midi pro",),
        None,
        reports="rock-band",
    ),
    DeviceMap("guitar-hero", "Guitar Hero drums", _GUITAR_HERO, ("guitar hero drums",), None, reports="guitar-hero"),
    DeviceMap("foot-switch", "Foot switch", _NO_NOTES, ("foot switch (pcsensor)",), None, reports="keys"),
)

GAME_PRESETS: Mapping[str, DeviceMap] = MappingProxyType({preset.name: preset for preset in _TABLE})
