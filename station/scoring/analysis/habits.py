"""Habits: what a player does in one kind of place and not in others, explained by as few causes as the data bear.

Two models, one for time and one for loudness (`sparse_model`), have a suspect for every piece, each hand, the places in
the beat, swung offbeats, fills and where they land, long waits, second strokes of doubles, ghosts, accents, and a fade
over the take. Effects are absolute where the time that was asked for is known (a click, or the file's own time): each
is measured from there, and a piece that is early makes no other one late. Where only the player's own tempo is known,
most strokes stand at 0 by the way it is found, and effects are measured from these. `music.passages` says which strokes
a habit concerns. Timing effects are in ms, negative is early; loudness in dB, negative is softer.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Ornament, Piece, word
from station.core.units import NS_PER_S
from station.music import passages
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.sparse_model import CONSTANT, Column, Effect, Explained, explain
from station.scoring.analysis.timing_spread import asynchrony_ms, standard_error, timed_notes
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.matching.played_graces import main_of_grace

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]

STAND_MS = 15.0
"""How far from the click players usually stand: professionals 10–16 ms ahead (HUMANS)."""

LEAN_SHARE = 0.16
"""By how much pieces usually lean apart, of the smallest lean that matters: 4 of 25 ms. The 5–11 ms of HUMANS would
hide a lean of 25 ms in a short take; what is too small to matter is left to `findings`."""

DRIFT_MS = 10.0
"""How far a player usually moves against the click from one end of a take to the other (our choice: within it)."""

PAD_DB = 1.5
"""By how much a player's pads usually differ from what is written (our choice: pads answer differently, and less than
2 dB is hardly heard, HUMANS): what one pad alone shows may be the pad."""

FULL_SCALE = 127
"""The largest velocity: what was struck harder is not known, so that such strokes tell no level."""

_SECOND, _THIRD = 1.0, 2.0
"""What causes cost that are thought of second and third, where pieces, fills, swing and doubles come first: a hand and
a wait, the offbeats; a unit less than what tells two explanations apart is enough to break ties."""

HANDS = {"left_hand": Limb.LEFT_HAND, "right_hand": Limb.RIGHT_HAND}
FILL_EFFECTS = ("fills", "fill_shift", "landings", "landing_fade")
OFFBEATS = ("offbeats", "ands", "quarters")


@dataclass(frozen=True, eq=False)
class Habits:
    """All effects by name, and the strokes (n,) that each concerns; empty where too little was played.

    In ms: `all` the common lean, each piece by its word, `left_hand`, `right_hand`, `offbeats` (all beside the beat),
    `ands` and `quarters` (in the middle of the beat, and at its quarters), `fills` (more and more), `fill_shift` (all
    of a fill alike), `landings` (for a beat) and `landing_fade` (put right within it), `long_waits` (and `rests`),
    `doubles`; `swing` in fractions of the unit that swings; `flams` how far grace strokes lead. In dB: `left_level`,
    `ghost_level`, `accent_level`, `doubles_level`, `graces_level` (grace less main stroke) and `fade` from one end of
    the take to the other.

    `timing` and `level` are the two models, None where too little was played. `rest_ms` (n,) is what the first leaves
    over. `off_db` (n,) played less written loudness, NaN where nothing was matched or heard.
    """

    effects: dict[str, Effect]
    strokes: dict[str, Flags]
    timing: Explained | None
    level: Explained | None
    rest_ms: Floats
    off_db: Floats


def habits(
    score: Score, performance: Performance, alignment: Alignment, hears_velocity: bool, least_lean_ms: float = 25.0
) -> Habits:
    """What `performance` shows of each habit that `score` has places for; `least_lean_ms` is the least that matters."""
    strokes = _places(score)
    timing, rest_ms = _timing(score, alignment, strokes, LEAN_SHARE * least_lean_ms)
    off_db = _off_db(score, performance, alignment) if hears_velocity else np.full(len(score), np.nan)
    level = _levels(score, performance, alignment, strokes, off_db)
    effects = {
        **({} if timing is None else timing.effects),
        **_flams(score, performance, alignment),
        **({} if level is None else level.effects),
        **(_graces(score, performance, alignment) if hears_velocity else {}),
    }
    return Habits(effects, {name: strokes[name] for name in effects}, timing, level, rest_ms, off_db)


def _places(score: Score) -> dict[str, Flags]:
    """Which strokes (n,) each effect concerns."""
    notes, main = score.notes, ~score.is_grace
    fills, beside = passages.fills(score), passages.offbeats(score)
    places = {word(Piece(p)): main & (notes["piece"] == p) for p in np.unique(notes["piece"]).tolist()}
    return places | {
        **{name: main & (notes["limb"] == limb) for name, limb in HANDS.items()},
        CONSTANT: main,
        "offbeats": beside.all,
        "ands": beside.ands,
        "quarters": beside.quarters,
        "fills": fills,
        "fill_shift": fills,
        "landings": passages.landings(score),
        "landing_fade": passages.landings(score),
        "long_waits": passages.long_waits(score),
        "rests": passages.long_waits(score, passages.REST),
        "doubles": passages.second_of_doubles(score),
        "swing": passages.swung(score).flags,
        "flams": score.is_grace,
        "left_level": main & (notes["limb"] == Limb.LEFT_HAND),
        "ghost_level": main & (notes["dynamic"] == Dynamic.GHOST),
        "accent_level": main & (notes["dynamic"] == Dynamic.ACCENT),
        "doubles_level": passages.second_of_doubles(score),
        "graces_level": score.is_grace,
        "fade": main,
    }


# --- time -------------------------------------------------------------------------------------------------------------


def _timing(
    score: Score, alignment: Alignment, places: dict[str, Flags], lean_ms: float
) -> tuple[Explained | None, Floats]:
    """The causes of the asynchronies, and what they leave over (n,), NaN where nothing was played."""
    rows, rest = np.flatnonzero(timed_notes(score, alignment)), np.full(len(score), np.nan)
    if not len(rows):
        return None, rest
    pieces = [word(Piece(p)) for p in np.unique(score.notes["piece"][rows]).tolist()]
    shapes = {
        **places,
        "fills": passages.fill_ramp(score),
        "landing_fade": passages.landing_fade(score),
        "swing": passages.swung(score).span_ms,
    }
    absolute = alignment.reference is not Reference.PLAYER

    def column(name: str, cost: float = 0.0, tau: float | None = None) -> Column:
        return Column(name, shapes[name][rows].astype(np.float64), tau, cost)

    base = [column(CONSTANT, tau=STAND_MS), *(column(piece, tau=lean_ms) for piece in pieces)]
    base.append(Column("drift", _through(score.notes["tick"][rows]), DRIFT_MS))
    suspects = [column(name) for name in (*pieces, "swing", "fills", "landings", "landing_fade", "doubles")]
    suspects += [column(name, _SECOND) for name in (*HANDS, "fill_shift", "long_waits", "rests")]
    suspects += [column(name, _THIRD) for name in OFFBEATS]
    suspects += [column(CONSTANT)] if absolute else []
    found = explain(asynchrony_ms(alignment)[rows], base, suspects, score.notes["tick"][rows])
    if found is not None:
        rest[rows] = found.rest
    return found, rest


def _through(times: NDArray[np.generic]) -> Floats:
    """How far through the take each time is, −½ … ½."""
    since = (times - times.min()).astype(np.float64)
    return np.asarray(since / max(float(since.max()), 1.0) - 0.5)


def flam_leads_ms(score: Score, performance: Performance, alignment: Alignment) -> tuple[Indices, Floats]:
    """The grace strokes of flams that were heard with their main stroke, and how far each led, in ms."""
    graces, mains = _heard_graces(score, alignment)
    flam = score.notes["ornament"][graces] == Ornament.FLAM
    graces, mains = graces[flam], mains[flam]
    at_s = performance.hits["at_ns"] / NS_PER_S
    return graces, 1e3 * (at_s[alignment.hit_of_note[mains]] - at_s[alignment.hit_of_note[graces]])


def _flams(score: Score, performance: Performance, alignment: Alignment) -> dict[str, Effect]:
    graces, lead_ms = flam_leads_ms(score, performance, alignment)
    return _mean("flams", lead_ms, score.notes["tick"][graces])


def _graces(score: Score, performance: Performance, alignment: Alignment) -> dict[str, Effect]:
    graces, mains = _heard_graces(score, alignment)
    level, hit = level_db(performance.fine_velocity), alignment.hit_of_note
    return _mean("graces_level", level[hit[graces]] - level[hit[mains]], score.notes["tick"][graces])


def _heard_graces(score: Score, alignment: Alignment) -> tuple[Indices, Indices]:
    """Grace strokes that were heard with their main strokes, and these."""
    main = main_of_grace(score)
    graces = np.flatnonzero(main >= 0)
    matched = alignment.note_label == Label.MATCH
    graces = graces[matched[graces] & matched[main[graces]]]
    return graces, main[graces]


def _mean(name: str, values: Floats, slots: Indices) -> dict[str, Effect]:
    """The mean of values (n,) as an effect; nothing of fewer than four slots."""
    error = standard_error(values, slots)
    if error is None:
        return {}
    return {name: Effect(float(values.mean()), error.value, len(np.unique(slots)))}


# --- loudness ---------------------------------------------------------------------------------------------------------


def _off_db(score: Score, performance: Performance, alignment: Alignment) -> Floats:
    """How much louder than written each note (n,) was struck, NaN where it was not."""
    off = np.full(len(score), np.nan)
    rows = np.flatnonzero(alignment.note_label == Label.MATCH)
    played = performance.fine_velocity[alignment.hit_of_note[rows]]
    off[rows] = level_db(played) - level_db(score.notes["velocity"][rows])
    return off


def _levels(
    score: Score, performance: Performance, alignment: Alignment, places: dict[str, Flags], off_db: Floats
) -> Explained | None:
    hit = np.maximum(alignment.hit_of_note, 0)
    rows = np.flatnonzero(~np.isnan(off_db) & ~score.is_grace)
    rows = rows[performance.hits["velocity"][hit[rows]] < FULL_SCALE]
    if not len(rows):
        return None
    at_ns = performance.hits["at_ns"][hit[rows]]

    def column(name: str, cost: float = 0.0, tau: float | None = None) -> Column:
        return Column(name, places[name][rows].astype(np.float64), tau, cost)

    pieces = [word(Piece(p)) for p in np.unique(score.notes["piece"][rows]).tolist()]
    base = [Column(CONSTANT, np.ones(len(rows))), *(column(piece, tau=PAD_DB) for piece in pieces)]
    suspects = [column(name) for name in ("accent_level", "ghost_level", "doubles_level")]
    suspects += [column("left_level", _SECOND), Column("fade", _through(at_ns))]
    return explain(off_db[rows], base, suspects, score.notes["tick"][rows])
