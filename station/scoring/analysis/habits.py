"""Habits: what a player does in one kind of place and not in others, each told apart from all the rest.

Two models, one for time and one for loudness (`regression`), have a column for every kind of place that the score
holds: fills, long waits, swung offbeats, second strokes of doubles, the feet, the left hand, ghosts, accents. What is
left are differences that every player has: pieces and hands that lean apart by some ms or dB. `music.passages` says
which strokes a habit concerns. Timing effects are in ms, negative is early; loudness in dB, negative is softer.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Limb, Piece, word
from station.music import passages
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import level_db
from station.scoring.analysis.regression import CONSTANT, Column, Effect, fit
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes
from station.scoring.matching.alignment import Alignment
from station.scoring.matching.grace_strokes import main_of_grace
from station.scoring.matching.slow_drift import robust_sd

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

LEAN_SHARE = 0.4
"""Pieces lean apart by this share of the player's SD in any take (HUMANS: 11 of 27 ms)."""

LEAST_LEAN_MS = 3.0

FILL_SHAPE_MS = 10.0
"""A fill may be off from its first stroke on instead of more and more: by so much, as believed before it is known (our
choice: without it a fill that is late at once makes the pieces of its beginning and end lean apart)."""

CHANCE = 2.8
"""Standard errors: one fault-free effect in two hundred goes beyond, and of a score's five to ten most are free to some
size besides. Over the shipped lessons one fault-free session in four hundred gets a sentence."""

PIECE_LEVEL_DB = 0.4
"""The levels of different pads are comparable to so much: what the module sends is also what is heard (our choice)."""

FEET = {Piece.KICK: "kick", Piece.HIHAT_PEDAL: "hihat_pedal"}


@dataclass(frozen=True, eq=False)
class Habits:
    """All effects by name, and the strokes (n,) that each concerns; empty where too little was played.

    Names: `all` the common lean with habits apart, `kick`, `hihat_pedal`, `fills`, `long_waits`, `doubles` in ms,
    `swing` in fractions of the unit that swings, `lean_PIECE` of a hand's piece against the other hand pieces in ms,
    `flams` in ms (positive: wider than written), `left_level`, `ghost_level`, `accent_level` in dB. `timing_sd_ms` is
    the spread of the main strokes with all that taken out; None where too little was played. `off_db` (n,) played less
    written loudness, NaN where nothing was matched or heard.
    """

    effects: dict[str, Effect]
    strokes: dict[str, Flags]
    timing_sd_ms: float | None
    off_db: Floats


def habits(score: Score, performance: Performance, alignment: Alignment, hears_velocity: bool) -> Habits:
    """What `performance` shows of each habit that `score` has places for."""
    strokes = _places(score)
    timing, sd_ms = _timing(score, alignment, strokes)
    off_db = _off_db(score, performance, alignment) if hears_velocity else np.full(len(score), np.nan)
    effects = {
        **timing,
        **_flams(score, alignment),
        **_levels(score, off_db, strokes),
    }
    return Habits(effects, {name: strokes[name] for name in effects}, sd_ms, off_db)


def _places(score: Score) -> dict[str, Flags]:
    """Which strokes (n,) each effect concerns."""
    notes, main = score.notes, ~score.is_grace
    places = {CONSTANT: main} | {name: main & (notes["piece"] == piece) for piece, name in FEET.items()}
    places |= {
        "fills": passages.fills(score),
        "long_waits": passages.long_waits(score),
        "doubles": passages.second_of_doubles(score),
        "swing": passages.swung(score).flags,
        "flams": score.is_grace,
        "left_level": main & (notes["limb"] == Limb.LEFT_HAND),
        "ghost_level": main & (notes["dynamic"] == Dynamic.GHOST),
        "accent_level": main & (notes["dynamic"] == Dynamic.ACCENT),
    }
    for piece in np.unique(notes["piece"]).tolist():
        if Piece(piece) not in FEET:
            places[f"lean_{word(Piece(piece))}"] = main & (notes["piece"] == piece)
    return places


# --- time -------------------------------------------------------------------------------------------------------------


def _timing(score: Score, alignment: Alignment, places: dict[str, Flags]) -> tuple[dict[str, Effect], float | None]:
    """Effects in time, and the spread that they leave, in ms."""
    timed = np.flatnonzero(timed_notes(score, alignment))
    off = asynchrony_ms(alignment)[timed]
    sd = robust_sd(off)
    if sd is None:
        return {}, None
    tau = max(LEAN_SHARE * sd, LEAST_LEAN_MS)
    columns = [Column(name, places[name][timed].astype(np.float64)) for name in (*FEET.values(), *_IN_TIME)]
    ramp = passages.fill_ramp(score)[timed]
    columns.append(Column("fills", ramp))
    columns.append(Column("swing", passages.swung(score).span_ms[timed]))  # the effect is a fraction of it
    common = _hands_and_pieces(score, timed, tau)
    common.append(Column("fill_shape", places["fills"][timed] - ramp, FILL_SHAPE_MS))
    whole = fit(off, columns + common, score.notes["tick"][timed])
    if whole is None:
        return {}, sd
    found = {name: whole.effects[name] for name in (CONSTANT, *(c.name for c in columns)) if name in whole.effects}
    return found | _leans(score, timed, off, columns, common), whole.sd


_IN_TIME = ("long_waits", "doubles")


def _hands_and_pieces(score: Score, rows: NDArray[np.int64], tau: float) -> list[Column]:
    """A drawn-in column for every hand piece and for the left hand."""
    notes = score.notes[rows]
    pieces = [Piece(p) for p in np.unique(notes["piece"]).tolist() if Piece(p) not in FEET]
    columns = [Column(f"lean_{word(p)}", (notes["piece"] == p).astype(np.float64), tau) for p in pieces]
    return [*columns, Column("left", (notes["limb"] == Limb.LEFT_HAND).astype(np.float64), tau)]


def _leans(
    score: Score, rows: NDArray[np.int64], off: Floats, columns: list[Column], common: list[Column]
) -> dict[str, Effect]:
    """Each hand piece against the other hand pieces: its column set free in turn."""
    pieces = [c for c in common if c.tau is not None and c.name.startswith("lean_")]
    found = {}
    for piece in pieces if len(pieces) > 1 else []:
        freed = [Column(c.name, c.values, None if c is piece else c.tau) for c in common]
        one = fit(off, columns + freed, score.notes["tick"][rows])
        if one is not None and piece.name in one.effects:
            found[piece.name] = one.effects[piece.name]
    return found


def _flams(score: Score, alignment: Alignment) -> dict[str, Effect]:
    """How much wider than written grace strokes come before their main stroke, in ms."""
    main = main_of_grace(score)
    graces = np.flatnonzero(main >= 0)
    matched = alignment.note_label == Label.MATCH
    graces = graces[matched[graces] & matched[main[graces]]]
    wider = asynchrony_ms(alignment)[main[graces]] - asynchrony_ms(alignment)[graces]
    fitted = _mean(wider, score.notes["tick"][graces])
    return {} if fitted is None else {"flams": fitted}


def _mean(values: Floats, slots: NDArray[np.int64]) -> Effect | None:
    """The mean of values that come in slots, which are independent of each other, as an effect."""
    _, slot = np.unique(slots, return_inverse=True)
    if len(slot) == 0 or slot.max() < 3:
        return None
    means = np.bincount(slot, weights=values) / np.bincount(slot)
    return Effect(float(means.mean()), float(means.std(ddof=1)) / len(means) ** 0.5, len(means))


# --- loudness ---------------------------------------------------------------------------------------------------------


def _off_db(score: Score, performance: Performance, alignment: Alignment) -> Floats:
    """How much louder than written each note (n,) was struck, NaN where it was not."""
    off = np.full(len(score), np.nan)
    rows = np.flatnonzero(alignment.note_label == Label.MATCH)
    played = performance.fine_velocity[alignment.hit_of_note[rows]]
    off[rows] = level_db(played) - level_db(score.notes["velocity"][rows])
    return off


def _levels(score: Score, off_db: Floats, places: dict[str, Flags]) -> dict[str, Effect]:
    rows = np.flatnonzero(~np.isnan(off_db) & ~score.is_grace)
    off = off_db[rows]
    pieces = score.notes["piece"][rows]
    pads = [Column(f"pad_{p}", (pieces == p).astype(np.float64), PIECE_LEVEL_DB) for p in np.unique(pieces).tolist()]
    suspects = [Column(name, places[name][rows].astype(np.float64)) for name in _IN_LEVEL]
    return _one_by_one(off, suspects, pads, score.notes["tick"][rows])


_IN_LEVEL = ("accent_level", "ghost_level", "left_level")
"""In the order in which they are suspected where they cannot be told apart: what was written is asked for first."""


def _one_by_one(y: Floats, suspects: list[Column], common: list[Column], slots: NDArray[np.int64]) -> dict[str, Effect]:
    """Effects of the suspects, taken in one after the other, the surest first, while they are beyond chance.

    A hand may play one pad alone, and that pad ghosts and accents alone: then several causes explain one thing, and one
    of them is enough. The effects of those that were not taken in are what they would be beside those that were.
    """
    found: dict[str, Effect] = {}
    taken: list[Column] = []
    left = list(suspects)
    while left:
        tried: dict[str, Effect] = {}
        for suspect in left:
            fitted = fit(y, [*taken, suspect, *common], slots)
            if fitted is not None and suspect.name in fitted.effects:
                tried[suspect.name] = fitted.effects[suspect.name]
        found |= tried
        best = max(tried, key=lambda name: abs(tried[name].value) / max(tried[name].error, 1e-9), default=None)
        if best is None or abs(tried[best].value) <= CHANCE * tried[best].error:
            break
        taken += [suspect for suspect in left if suspect.name == best]
        left = [suspect for suspect in left if suspect.name != best and not _is_explained(suspect, taken)]
    whole = fit(y, [*taken, *common], slots)
    known = {c.name: found[c.name] for c in (*taken, *left) if c.name in found}
    return known if whole is None else known | {c.name: whole.effects[c.name] for c in taken}


def _is_explained(suspect: Column, taken: list[Column]) -> bool:
    """Whether a column says nothing that those taken in do not say."""
    x = np.column_stack([np.ones(len(suspect.values)), *(column.values for column in taken)])
    rest = suspect.values - x @ np.linalg.lstsq(x, suspect.values, rcond=None)[0]
    return float(np.abs(rest).max()) < 1e-6
