"""What a pad can be: a table of every piece's zones, by the words that a drummer chooses and a command line takes.

`snare/rim_shot` names one; a piece alone is its first zone. Where a hi-hat's zone has no place of its own on the
pedal's way (`bow`, `edge`), the pedal tells how open it is.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.labels import piece_name
from station.core.note_map import NoteMeaning
from station.core.pieces import TOMS, Articulation, Piece, Zone, word

_SHUT, _HALF, _OPEN = 0.0, 0.5, 1.0


def _drum(piece: Piece) -> dict[str, NoteMeaning]:
    return {"head": NoteMeaning(piece), "rim": NoteMeaning(piece, Zone.RIM)}


def _cymbal(piece: Piece) -> dict[str, NoteMeaning]:
    return {zone: NoteMeaning(piece, Zone[zone.upper()]) for zone in ("bow", "edge", "bell")}


PADS: Mapping[Piece, Mapping[str, NoteMeaning]] = MappingProxyType(
    {
        Piece.KICK: {"head": NoteMeaning(Piece.KICK)},
        Piece.SNARE: {
            "head": NoteMeaning(Piece.SNARE),
            "rim_shot": NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
            "cross_stick": NoteMeaning(Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
        },
        Piece.HIHAT: {
            "bow": NoteMeaning(Piece.HIHAT, Zone.BOW),
            "edge": NoteMeaning(Piece.HIHAT, Zone.EDGE),
            "closed": NoteMeaning(Piece.HIHAT, Zone.BOW, openness=_SHUT),
            "half_open": NoteMeaning(Piece.HIHAT, Zone.BOW, openness=_HALF),
            "open": NoteMeaning(Piece.HIHAT, Zone.BOW, openness=_OPEN),
            "closed_edge": NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=_SHUT),
            "open_edge": NoteMeaning(Piece.HIHAT, Zone.EDGE, openness=_OPEN),
        },
        Piece.HIHAT_PEDAL: {
            "chick": NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.CHICK, _SHUT),
            "splash": NoteMeaning(Piece.HIHAT_PEDAL, Zone.PEDAL, Articulation.SPLASH, _OPEN),
        },
        **{piece: _drum(piece) for piece in TOMS},
        **{piece: _cymbal(piece) for piece in (Piece.RIDE, Piece.CRASH_1, Piece.CRASH_2, Piece.RIDE_2)},
        Piece.SPLASH: {"edge": NoteMeaning(Piece.SPLASH, Zone.EDGE)},
        Piece.CHINA: {"edge": NoteMeaning(Piece.CHINA, Zone.EDGE)},
        **{piece: {"head": NoteMeaning(piece)} for piece in (Piece.COWBELL, Piece.TAMBOURINE, Piece.CLAP)},
    }
)


def pad_name(strike: NoteMeaning) -> str:
    """A pad as a drummer says it: `snare, rim shot`, `hi-hat, open`, `kick`."""
    zones = PADS.get(strike.piece, {})
    if len(zones) == 1 and strike in zones.values():
        return piece_name(strike.piece)
    zone = next((name for name, known in zones.items() if known == strike), word(strike.zone))
    return f"{piece_name(strike.piece)}, {zone.replace('_', ' ')}"


def pad_named(text: str) -> NoteMeaning:
    """The pad that `PIECE` or `PIECE/ZONE` names; raises `BadInput` that lists what there is."""
    piece_word, _, zone = text.partition("/")
    pieces = {word(piece): zones for piece, zones in PADS.items()}
    if piece_word not in pieces:
        raise BadInput(text, "", f"no such piece{did_you_mean(piece_word, pieces)}")
    zones = pieces[piece_word]
    if zone and zone not in zones:
        raise BadInput(text, "", f"no such zone of the {piece_word}{did_you_mean(zone, zones)}")
    return zones[zone] if zone else next(iter(zones.values()))
