"""The faults that are planted, word by word.

A fault is planted in a teacher's smallest size, or as large as an oracle needs (`planted_oracle`) where that is more.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from station.bench.rigs.planted import planted_levels as levels
from station.bench.rigs.planted import planted_timing as timing
from station.bench.rigs.planted.planted_oracle import smallest_share
from station.bench.rigs.planted.planted_player import ADDED, LEFT_OUT, OPENNESS_SLIP, Sheet, astray, wrong_openness
from station.bench.rigs.planted.planted_routes import left_out_bars, repeated_bars, stopped
from station.bench.rigs.planted.planted_shapes import HANDS
from station.bench.rigs.planted.planted_stage import FEWEST, MOST, Maker, Planted, Stage
from station.bench.rigs.planted.planted_strokes import Mask, Written
from station.core.pieces import Piece, word

OPENNESS_SHARE = 0.25
"""Part 7's table: openness wrong in a quarter."""
ERROR_SHARE = 0.1
"""Of all strokes left out or added (TEACHING: a pass is 90 % right)."""
ASTRAY_SHARE = 0.25
"""Of one piece's strokes on another, as of openness."""


def hats(name: str, of: Callable[[Written], Mask]) -> Maker:
    """Hi-hats on the wrong openness."""

    def make(stage: Stage) -> Planted | None:
        strokes = of(stage.written)
        share = max(OPENNESS_SHARE, smallest_share(int(strokes.sum()), OPENNESS_SLIP))
        if strokes.sum() < FEWEST or share > MOST * OPENNESS_SHARE:
            return None
        wrong = min(1.0, stage.times * share)
        return Planted(name, 100 * wrong, strokes, name, lambda s, rng: wrong_openness(s, strokes, wrong, rng))

    return make


def errors(name: str, usual: float, planted: Callable[[Sheet, float], Sheet]) -> Maker:
    """Strokes that are left out or added."""

    def make(stage: Stage) -> Planted | None:
        strokes = stage.written.main
        share = max(ERROR_SHARE, smallest_share(int(strokes.sum()), usual))
        if share > MOST * ERROR_SHARE:
            return None
        wrong = min(1.0, stage.times * share)
        return Planted(name, 100 * wrong, strokes, "errors", lambda sheet, _: planted(sheet, wrong))

    return make


def _wrong_piece(stage: Stage) -> Planted | None:
    """The second most played hand piece, or the only one, is taken for a neighbour."""
    written = stage.written
    counts = sorted(((int(written.piece(p).sum()), p) for p in written.pieces if p not in _FEET), reverse=True)
    if not counts:
        return None
    count, piece = counts[min(1, len(counts) - 1)]
    share = max(ASTRAY_SHARE, smallest_share(count, 0.0))
    if count < FEWEST or share > MOST * ASTRAY_SHARE:
        return None
    strokes, wrong = written.piece(piece), min(1.0, stage.times * share)
    return Planted("wrong_piece", 100 * wrong, strokes, "errors", lambda s, rng: astray(s, written, piece, wrong, rng))


_FEET = (Piece.KICK, Piece.HIHAT_PEDAL)


def routed(name: str, route: Callable[[Written, bool, Sheet, np.random.Generator], Sheet | None]) -> Maker:
    """Not played once through."""

    def make(stage: Stage) -> Planted | None:
        written, clocked = stage.written, stage.conditions.clocked
        if route(written, clocked, Sheet.as_written(written), np.random.default_rng(0)) is None:
            return None
        return Planted(name, 1, written.main, "route", lambda s, rng: route(written, clocked, s, rng) or s)

    return make


_PIECES = [word(p) for p in Piece if p is not Piece.HIHAT_PEDAL]
_SHIFTED = [
    *(f"{side}_{name}" for name in (*_PIECES, *HANDS, "offbeats") for side in ("late", "early")),
    *("slow_hihat_foot", "early_hihat_foot", "straight_swing", "hard_swing", "swung_straight"),
    *("rush_fills", "drag_fills", "fill_lands_late", "fill_lands_early", "drag_slow", "rush_slow"),
    *("uneven_doubles", "lazy_doubles"),
]

FAULTS: Mapping[str, Maker] = MappingProxyType(
    {name: timing.shifted(name) for name in _SHIFTED}
    | {"early": timing.whole("early", -1), "late": timing.whole("late", 1)}
    | {"rushing": timing.tempo("rushing", 1), "dragging": timing.tempo("dragging", -1)}
    | {"unsteady": timing.unsteady("unsteady", None)}
    | {f"unsteady_{name}": timing.unsteady(f"unsteady_{name}", limb) for name, limb in timing.LIMBS.items()}
    | {"wide_flams": timing.flams("wide_flams", timing.WIDE_MS)}
    | {"tight_flams": timing.flams("tight_flams", timing.TIGHT_MS)}
    | {name: levels.level(name, levels.against_other_hand) for name in ("weak_left", "weak_right")}
    | {"loud_ghosts": levels.level("loud_ghosts", levels.ghosts)}
    | {"flat_accents": levels.level("flat_accents", levels.accents)}
    | {"loud_graces": levels.level("loud_graces", levels.graces)}
    | {"weak_doubles": levels.level("weak_doubles", levels.doubles)}
    | {"fades": levels.fade("fades", -1), "grows": levels.fade("grows", 1)}
    | {
        "open_hats": hats("open_hats", lambda w: w.closed_hats),
        "closed_hats": hats("closed_hats", lambda w: w.open_hats),
    }
    | {"stopped": routed("stopped", stopped), "left_out_bars": routed("left_out_bars", left_out_bars)}
    | {"repeated_bars": routed("repeated_bars", repeated_bars)}
    | {"missed": errors("missed", LEFT_OUT, lambda s, share: replace(s, left_out=np.full_like(s.left_out, share)))}
    | {"extra": errors("extra", ADDED, lambda s, share: replace(s, added=share))}
    | {"wrong_piece": _wrong_piece}
)
"""Each word of a fault, and what makes it in a piece of music; None where the music does not exercise it."""
