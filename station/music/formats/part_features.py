"""What a part has of all that a format may keep: an export names what the format has no word for at all."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import (
    CLOSED,
    CYMBALS,
    HAND_PIECES,
    OPEN,
    USUAL_FEET,
    Articulation,
    Dynamic,
    Limb,
    Ornament,
    Piece,
    Zone,
)
from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, MusicFormat, WrittenFile
from station.music.grace_strokes import Graces
from station.music.stroke_velocities import USUAL_VELOCITIES

_Rows = NDArray[np.void]


def without_a_word(form: MusicFormat, part: DrumPart, written: WrittenFile) -> tuple[Feature, ...]:
    """What `part` has, `form` has no word for, and the losses of `written` do not tell already."""
    told = {loss.feature for loss in written.lost} | set(form.keeps or {})
    return tuple(feature for feature in features_of(part) if feature not in told)


def features_of(part: DrumPart) -> tuple[Feature, ...]:
    """What `part` has beyond what every part has (times, pieces, a tempo, a meter), in the order of `Feature`."""
    of_strokes = {feature for feature, has in _OF_STROKES.items() if has(part.score.notes).any()}
    of_part = {feature for feature, has in _OF_PART.items() if has(part)}
    return tuple(feature for feature in Feature if feature in of_strokes | of_part)


def _is_unusual_beat(part: DrumPart) -> bool:
    """Whether another beat is counted than is usual in the meter."""
    return part.beat_ticks != part.score.tempo_map.meter_at(0).usual_beat_ticks


_OF_PART: Mapping[Feature, Callable[[DrumPart], bool]] = MappingProxyType(
    {
        Feature.METER_GROUPS: lambda part: any(meter.groups for meter in part.score.tempo_map.meters),
        Feature.BEAT: _is_unusual_beat,
        Feature.LOUDNESS: lambda part: bool(part.score.loudness),
        Feature.TITLE: lambda part: bool(part.score.title),
        Feature.AUTHOR: lambda part: bool(part.author),
        Feature.ABOUT: lambda part: bool(part.about),
        Feature.SECTIONS: lambda part: bool(part.sections),
    }
)


def _is_named_zone(rows: _Rows) -> NDArray[np.bool_]:
    """A place that is not where the piece is usually struck; cross-sticks and rim shots have names of their own."""
    piece, zone = rows["piece"], rows["zone"]
    is_rim = (zone == Zone.RIM) & (rows["articulation"] == Articulation.NORMAL)
    is_crash = np.isin(piece, sorted(CYMBALS - {Piece.RIDE, Piece.RIDE_2}))
    is_edge = (zone == Zone.EDGE) & ~is_crash
    return np.asarray(is_rim | is_edge | (zone == Zone.BELL) | (is_crash & (zone == Zone.BOW)))


def _is_unusual_foot(rows: _Rows) -> NDArray[np.bool_]:
    found = np.zeros(len(rows), bool)
    for piece, foot in USUAL_FEET.items():
        found |= (rows["piece"] == piece) & ~np.isin(rows["limb"], (foot, Limb.UNKNOWN))
    return found


def _struck(articulation: Articulation) -> Callable[[_Rows], NDArray[np.bool_]]:
    return lambda rows: np.asarray(rows["articulation"] == articulation)


def _ornamented(*ornaments: Ornament) -> Callable[[_Rows], NDArray[np.bool_]]:
    return lambda rows: np.isin(rows["ornament"], ornaments) & (rows["articulation"] != Articulation.BUZZ)


def _is_unusual_grace(rows: _Rows) -> NDArray[np.bool_]:
    usual = Graces()
    leads = (usual.flam_ms, usual.drag_ms, 2 * usual.drag_ms)
    return np.asarray((rows["lead_ms"] > 0) & ~np.isin(rows["lead_ms"], leads))


_OF_STROKES: Mapping[Feature, Callable[[_Rows], NDArray[np.bool_]]] = MappingProxyType(
    {
        Feature.SWING: lambda rows: np.asarray(rows["swing_ticks"] != 0),
        Feature.VELOCITIES: lambda rows: np.asarray(
            (rows["lead_ms"] == 0) & (rows["velocity"] != np.array(USUAL_VELOCITIES)[rows["dynamic"]])
        ),
        Feature.DYNAMICS: lambda rows: np.asarray((rows["lead_ms"] == 0) & (rows["dynamic"] != Dynamic.NORMAL)),
        Feature.ZONES: _is_named_zone,
        Feature.CROSS_STICKS: _struck(Articulation.CROSS_STICK),
        Feature.RIM_SHOTS: _struck(Articulation.RIM_SHOT),
        Feature.OPENNESS: lambda rows: np.asarray(
            (rows["piece"] == Piece.HIHAT) & (rows["openness"] > CLOSED) & (rows["openness"] < OPEN)
        ),
        Feature.FOOT_SPLASHES: _struck(Articulation.SPLASH),
        Feature.FLAMS: _ornamented(Ornament.FLAM),
        Feature.DRAGS: _ornamented(Ornament.DRAG),
        Feature.GRACE_SPACING: _is_unusual_grace,
        Feature.DIDDLES: _ornamented(Ornament.DIDDLE, Ornament.ROLL),
        Feature.BUZZES: _struck(Articulation.BUZZ),
        Feature.CHOKES: lambda rows: np.asarray(rows["choke_ticks"] > 0),
        Feature.STICKING: lambda rows: np.isin(rows["piece"], sorted(HAND_PIECES)) & (rows["limb"] != Limb.UNKNOWN),
        Feature.FEET: _is_unusual_foot,
        Feature.TIMING: lambda rows: np.asarray(rows["late_ms"] != 0),
    }
)
