"""The GrooveScribe letter nearest to a stroke, and what of the stroke it does not say."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

from station.core.pieces import CLOSED, HALF_OPEN, OPEN, Articulation, Dynamic, Ornament, Piece, Zone
from station.music.formats.groovescribe.groove_letters import LETTER_OF, GrooveStroke
from station.music.formats.lost_bars import LostBars
from station.music.formats.music_format import Feature
from station.music.score import Note

_NEAREST: Mapping[Piece, Piece] = MappingProxyType(
    {
        Piece.RIDE_2: Piece.RIDE,
        Piece.CRASH_2: Piece.CRASH_1,
        Piece.SPLASH: Piece.CRASH_1,
        Piece.TOM_2: Piece.TOM_1,
        Piece.TOM_3: Piece.FLOOR_TOM_1,
        Piece.TOM_4: Piece.FLOOR_TOM_1,
        Piece.FLOOR_TOM_2: Piece.FLOOR_TOM_1,
        Piece.TAMBOURINE: Piece.PERCUSSION,
        Piece.CLAP: Piece.PERCUSSION,
    }
)
_ZONES = {
    Piece.RIDE: Zone.BOW,
    Piece.HIHAT: Zone.BOW,
    Piece.CRASH_1: Zone.EDGE,
    Piece.CHINA: Zone.EDGE,
    Piece.HIHAT_PEDAL: Zone.PEDAL,
}


def nearest_letter(note: Note, bar: int, losses: LostBars) -> tuple[str, str]:
    """The line and letter nearest to a stroke; what of it they do not say is added to `losses`, with its bar."""
    meant = GrooveStroke(note.piece, note.zone, note.articulation, note.dynamic, note.openness, note.ornament)
    said = meant
    for feature, nearer in _STEPS:
        if said in LETTER_OF:
            break
        changed = nearer(said)
        if changed != said:
            losses.add(feature, SENTENCES[feature], bar)
        said = changed
    if note.choke_ticks:
        losses.add(Feature.CHOKES, SENTENCES[Feature.CHOKES], bar)
    return LETTER_OF[said]


def _known_piece(stroke: GrooveStroke) -> GrooveStroke:
    return replace(stroke, piece=_NEAREST.get(stroke.piece, stroke.piece))


def _plain_articulation(stroke: GrooveStroke) -> GrooveStroke:
    if stroke.piece is Piece.HIHAT_PEDAL:
        return replace(stroke, zone=Zone.PEDAL, articulation=Articulation.CHICK, openness=CLOSED)
    if stroke.articulation is Articulation.RIM_SHOT:
        return replace(stroke, zone=Zone.HEAD, articulation=Articulation.NORMAL)
    return stroke


def _no_buzz(stroke: GrooveStroke) -> GrooveStroke:
    if stroke.articulation is not Articulation.BUZZ or stroke.piece is Piece.SNARE:
        return stroke
    return replace(stroke, articulation=Articulation.NORMAL, ornament=Ornament.NONE)


def _usual_zone(stroke: GrooveStroke) -> GrooveStroke:
    if stroke.articulation is Articulation.CROSS_STICK:
        return replace(stroke, zone=Zone.RIM)
    return replace(stroke, zone=_ZONES.get(stroke.piece, Zone.HEAD))


def _open_or_closed(stroke: GrooveStroke) -> GrooveStroke:
    if stroke.piece is Piece.HIHAT:
        return replace(stroke, openness=OPEN if (stroke.openness or CLOSED) >= HALF_OPEN else CLOSED)
    return stroke if stroke.piece is Piece.HIHAT_PEDAL else replace(stroke, openness=None)


def _no_diddle(stroke: GrooveStroke) -> GrooveStroke:
    is_diddle = stroke.ornament in (Ornament.DIDDLE, Ornament.ROLL) and stroke.articulation is not Articulation.BUZZ
    return replace(stroke, ornament=Ornament.NONE) if is_diddle else stroke


def _no_grace(ornament: Ornament) -> Callable[[GrooveStroke], GrooveStroke]:
    def nearer(stroke: GrooveStroke) -> GrooveStroke:
        is_plain_snare = stroke.piece is Piece.SNARE and stroke.articulation is Articulation.NORMAL
        return stroke if stroke.ornament is not ornament or is_plain_snare else replace(stroke, ornament=Ornament.NONE)

    return nearer


_STEPS: tuple[tuple[Feature, Callable[[GrooveStroke], GrooveStroke]], ...] = (
    (Feature.PIECES, _known_piece),
    (Feature.FOOT_SPLASHES, lambda s: _plain_articulation(s) if s.piece is Piece.HIHAT_PEDAL else s),
    (Feature.RIM_SHOTS, _plain_articulation),
    (Feature.BUZZES, _no_buzz),
    (Feature.ZONES, _usual_zone),
    (Feature.OPENNESS, _open_or_closed),
    (Feature.DIDDLES, _no_diddle),
    (Feature.FLAMS, _no_grace(Ornament.FLAM)),
    (Feature.DRAGS, _no_grace(Ornament.DRAG)),
    (Feature.DYNAMICS, lambda s: replace(s, dynamic=Dynamic.NORMAL)),
)
"""In this order, until there is a letter: so an accented flam stays a flam, an accented diddle an accent."""

SENTENCES: Mapping[Feature, str] = MappingProxyType(
    {
        Feature.PIECES: "pieces that GrooveScribe has no line for are written as the nearest",
        Feature.FOOT_SPLASHES: "splashes of the hi-hat foot become chicks",
        Feature.RIM_SHOTS: "rim shots become plain strokes",
        Feature.BUZZES: "buzz rolls of another length, or of another drum than the snare",
        Feature.ZONES: "rims, edges and bells but the ride's",
        Feature.OPENNESS: "a half-open hi-hat becomes open or closed",
        Feature.DIDDLES: "diddles become single strokes",
        Feature.FLAMS: "flams of other pieces than the snare",
        Feature.DRAGS: "drags of other pieces than the snare",
        Feature.DYNAMICS: "accents and ghosts that have no letter become plain strokes",
        Feature.CHOKES: "chokes are left out",
        Feature.TIMES: "strokes that come back at another time",
    }
)
