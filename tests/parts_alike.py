"""Whether a part that was written and read again is still the same, feature by feature.

A format's table says what it keeps; this says of each of those features what became of it.
"""

from collections.abc import Callable, Collection, Mapping

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import HAND_PIECES, Articulation, Limb, Ornament, Piece, word
from station.core.units import NS_PER_MS, PPQ
from station.music.drum_part import DrumPart
from station.music.formats.music_format import Feature, MusicFormat

_TICKS = PPQ // 26_880
"""Times so close are the same: what a MIDI file of the greatest division can tell apart."""
_MS = 0.02
_USUAL_FEET = {int(Piece.KICK): int(Limb.RIGHT_FOOT), int(Piece.HIHAT_PEDAL): int(Limb.LEFT_FOOT)}
_Rows = NDArray[np.void]


def differences(before: DrumPart, after: DrumPart, features: Collection[Feature]) -> list[str]:
    """What of `features` came back otherwise, a line each; empty if all came back.

    Strokes are told apart as main strokes and grace strokes. Where neither flams nor drags are asked for, strokes of
    `after` that sound where grace strokes of `before` do are those, and not looked at; a format without tempo has none.
    Where times are not asked for, strokes are paired piece by piece in their order.
    """
    found = [f"{feature.value}: {fault}" for feature in Feature if feature in features and feature in _OF_PART
             if (fault := _OF_PART[feature](before, after))]  # fmt: skip
    by_time = Feature.TIMES in features
    ours, theirs = _main(before.score.notes, by_time), _main(after.score.notes, by_time)
    if Feature.TEMPO in features and not {Feature.FLAMS, Feature.DRAGS} & set(features):
        theirs = _without_graces_of(before, after, theirs)
    if len(ours) != len(theirs):  # strokes that the writer left out are told as lost times
        return [*found, f"{Feature.TIMES.value}: {len(ours)} strokes became {len(theirs)}"] * (
            Feature.TIMES in features
        )
    for feature, same in _OF_STROKES.items():
        if feature in features and not (equal := same(ours, theirs)).all():
            found.append(f"{feature.value}: {_first(before, ours, theirs, ~equal)}")
    return found + _grace_differences(before, after, features)


def kept_differences(form: MusicFormat, part: DrumPart) -> list[str]:
    """What comes back otherwise of what `form` says it keeps, but for what its writer says is lost of this part."""
    assert form.write is not None, "a format that is written"
    assert form.keeps is not None, "and says what it keeps"
    written = form.write(part)
    after = form.read(written.data, "written" + form.endings[0])
    return differences(part, after, set(form.keeps) - {loss.feature for loss in written.lost})


# --- what the part has ------------------------------------------------------------------------------------------------


def _unlike(before: object, after: object) -> str:
    return "" if before == after else f"{before} became {after}"


def _words(text: str) -> str:
    return " ".join(text.split())


_OF_PART: Mapping[Feature, Callable[[DrumPart, DrumPart], str]] = {
    Feature.TIMES: lambda a, b: (
        "" if abs(a.score.end_tick - b.score.end_tick) <= _TICKS else _unlike(a.score.end_tick, b.score.end_tick)
    ),
    Feature.TEMPO: lambda a, b: _unlike(a.score.tempo_map.tempos, b.score.tempo_map.tempos),
    Feature.METERS: lambda a, b: _unlike(
        *([(m.tick, m.beats, m.unit) for m in p.score.tempo_map.meters] for p in (a, b))
    ),
    Feature.METER_GROUPS: lambda a, b: _unlike(*([m.felt_groups for m in p.score.tempo_map.meters] for p in (a, b))),
    Feature.BEAT: lambda a, b: _unlike(a.beat_ticks, b.beat_ticks),
    Feature.SWING: lambda a, b: _unlike(a.swing, b.swing),
    Feature.LOUDNESS: lambda a, b: _unlike(a.score.loudness, b.score.loudness),
    Feature.TITLE: lambda a, b: _unlike(_words(a.score.title), _words(b.score.title)),
    Feature.AUTHOR: lambda a, b: _unlike(_words(a.author), _words(b.author)),
    Feature.ABOUT: lambda a, b: _unlike(_words(a.about), _words(b.about)),
    Feature.SECTIONS: lambda a, b: _unlike(a.sections, b.sections),
}


# --- what each main stroke has ----------------------------------------------------------------------------------------


def _main(notes: _Rows, by_time: bool) -> _Rows:
    rows = notes[notes["lead_ms"] == 0]
    return _paired(rows, rows["limb"], by_time)


def _paired(rows: _Rows, last_key: NDArray[np.void], by_time: bool) -> _Rows:
    """In the order in which they are compared: by time, or piece by piece."""
    return _in_order(rows, last_key, *((rows["piece"], rows["tick"]) if by_time else (rows["tick"], rows["piece"])))


def _without_graces_of(before: DrumPart, after: DrumPart, rows: _Rows) -> _Rows:
    graces = before.score.is_grace
    sounding = set(zip(before.score.notes["piece"][graces].tolist(), before.score.onset_ns[graces].tolist(),
                       strict=True))  # fmt: skip
    onsets = after.score.tempo_map.ns_at(rows["tick"]).tolist()
    is_grace = [
        any(piece == p and abs(onset - at) < NS_PER_MS for p, at in sounding)
        for piece, onset in zip(rows["piece"].tolist(), onsets, strict=True)
    ]
    kept: _Rows = rows[~np.array(is_grace, bool)]
    return kept


def _in_order(rows: _Rows, *keys: NDArray[np.void]) -> _Rows:
    """By the last of `keys` first."""
    ordered: _Rows = rows[np.lexsort(keys)]
    return ordered


def _equal(column: str) -> Callable[[_Rows, _Rows], NDArray[np.bool_]]:
    return lambda a, b: np.asarray(a[column] == b[column])


def _close(column: str) -> Callable[[_Rows, _Rows], NDArray[np.bool_]]:
    return lambda a, b: np.asarray(np.abs(a[column] - b[column]) <= _TICKS)


def _struck(articulation: Articulation) -> Callable[[_Rows, _Rows], NDArray[np.bool_]]:
    return lambda a, b: np.asarray((a["articulation"] == articulation) == (b["articulation"] == articulation))


def _same_zone(a: _Rows, b: _Rows) -> NDArray[np.bool_]:
    """Cross-sticks and rim shots have features of their own."""
    has_its_own = np.isin(a["articulation"], (Articulation.CROSS_STICK, Articulation.RIM_SHOT))
    return np.asarray((a["zone"] == b["zone"]) | has_its_own)


def _same_openness(a: _Rows, b: _Rows) -> NDArray[np.bool_]:
    left, right = a["openness"], b["openness"]
    return np.asarray((left == right) | (np.isnan(left) & np.isnan(right)) | (a["piece"] != Piece.HIHAT))


def _ornamented(*ornaments: Ornament) -> Callable[[_Rows, _Rows], NDArray[np.bool_]]:
    def same(a: _Rows, b: _Rows) -> NDArray[np.bool_]:
        left, right = (
            np.where(np.isin(rows["ornament"], ornaments) & (rows["articulation"] != Articulation.BUZZ),
                     rows["ornament"], 0)
            for rows in (a, b)
        )  # fmt: skip
        return np.asarray(left == right)

    return same


def _same_hand(a: _Rows, b: _Rows) -> NDArray[np.bool_]:
    return np.asarray((a["limb"] == b["limb"]) | ~np.isin(a["piece"], sorted(HAND_PIECES)))


def _foot(rows: _Rows) -> NDArray[np.int64]:
    pairs = zip(rows["piece"].tolist(), rows["limb"].tolist(), strict=True)
    return np.array([_USUAL_FEET[piece] if limb == Limb.UNKNOWN else limb for piece, limb in pairs], np.int64)


def _same_foot(a: _Rows, b: _Rows) -> NDArray[np.bool_]:
    """A foot that nobody wrote is the usual one."""
    same = np.ones(len(a), bool)
    feet = np.isin(a["piece"], list(_USUAL_FEET)) & np.isin(b["piece"], list(_USUAL_FEET))
    same[feet] = _foot(a[feet]) == _foot(b[feet])
    return same


_OF_STROKES: Mapping[Feature, Callable[[_Rows, _Rows], NDArray[np.bool_]]] = {
    Feature.TIMES: _close("tick"),
    Feature.PIECES: _equal("piece"),
    Feature.SWING: _close("swing_ticks"),
    Feature.VELOCITIES: _equal("velocity"),
    Feature.DYNAMICS: _equal("dynamic"),
    Feature.ZONES: _same_zone,
    Feature.CROSS_STICKS: _struck(Articulation.CROSS_STICK),
    Feature.RIM_SHOTS: _struck(Articulation.RIM_SHOT),
    Feature.OPENNESS: _same_openness,
    Feature.FOOT_SPLASHES: _struck(Articulation.SPLASH),
    Feature.FLAMS: _ornamented(Ornament.FLAM),
    Feature.DRAGS: _ornamented(Ornament.DRAG),
    Feature.DIDDLES: _ornamented(Ornament.DIDDLE, Ornament.ROLL),
    Feature.BUZZES: lambda a, b: _struck(Articulation.BUZZ)(a, b) & _close("duration_ticks")(a, b),
    Feature.CHOKES: _close("choke_ticks"),
    Feature.STICKING: _same_hand,
    Feature.FEET: _same_foot,
    Feature.TIMING: _equal("late_ms"),
}


def _first(part: DrumPart, ours: _Rows, theirs: _Rows, where: NDArray[np.bool_]) -> str:
    i = int(np.flatnonzero(where)[0])
    place = part.score.tempo_map.position_at(int(ours["tick"][i]))
    changed = [
        f"{name} {ours[name][i]} became {theirs[name][i]}"
        for name in ours.dtype.names or ()
        if ours[name][i] != theirs[name][i]
        and not (ours[name][i] != ours[name][i] and theirs[name][i] != theirs[name][i])
    ]
    count = int(np.count_nonzero(where))
    piece = word(Piece(int(ours["piece"][i])))
    return f"{count} strokes, first bar {place.bar + 1}, beat {place.beat + 1}, {piece}: {', '.join(changed)}"


# --- grace strokes ----------------------------------------------------------------------------------------------------


def _grace_differences(before: DrumPart, after: DrumPart, features: Collection[Feature]) -> list[str]:
    found = []
    for feature, ornament in ((Feature.FLAMS, Ornament.FLAM), (Feature.DRAGS, Ornament.DRAG)):
        if feature not in features:
            continue
        by_time = Feature.TIMES in features
        ours, theirs = (_graces(part.score.notes, ornament, by_time) for part in (before, after))
        if len(ours) != len(theirs) or not _same_graces(ours, theirs, by_time):
            found.append(f"{feature.value}: {len(ours)} grace strokes became {len(theirs)} others")
            continue
        if Feature.GRACE_SPACING in features:
            same = (np.abs(ours["lead_ms"] - theirs["lead_ms"]) < _MS) & (ours["velocity"] == theirs["velocity"])
            if not same.all():
                found.append(f"{Feature.GRACE_SPACING.value}: {_first(before, ours, theirs, ~same)}")
        if Feature.STICKING in features and not _same_hand(ours, theirs).all():
            found.append(f"{Feature.STICKING.value}: {_first(before, ours, theirs, ~_same_hand(ours, theirs))}")
    return found


def _same_graces(ours: _Rows, theirs: _Rows, by_time: bool) -> bool:
    same = _equal("piece")(ours, theirs) & (_close("tick")(ours, theirs) | (not by_time))
    return bool(same.all())


def _graces(notes: _Rows, ornament: Ornament, by_time: bool) -> _Rows:
    rows = notes[(notes["lead_ms"] > 0) & (notes["ornament"] == ornament)]
    return _paired(rows, -rows["lead_ms"], by_time)
