"""Bars that anybody can read, and turns made of them: strokes in beats of a 4/4 bar at 100 beats a minute."""

from collections.abc import Iterable, Sequence

import numpy as np

from station.core.pieces import Piece
from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Turn
from tests.unit.practice.battle.improvising.played_by_hand import Stroke, turn_of

K, S, H = Piece.KICK, Piece.SNARE, Piece.HIHAT
GROUND = Ground(100.0)
ALL_PADS = (K, S, H, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1, Piece.CRASH_1, Piece.RIDE)

_HATS: list[Stroke] = [(i / 2, H, 80 if i % 2 == 0 else 50) for i in range(8)]
GROOVE: list[Stroke] = [*_HATS, (0, K, 100), (1, S, 105), (1.75, S, 30), (2.25, S, 30), (2.5, K, 95), (3, S, 108)]
VARIED: list[Stroke] = [*_HATS, (0, K, 100), (1, S, 105), (1.75, S, 30), (2.25, K, 90), (3, S, 108), (3.25, K, 80)]
FILL: list[Stroke] = [
    *(stroke for stroke in GROOVE if stroke[0] < 2),
    *((2 + i / 4, drum, (95, 60)[i % 2]) for i, drum in enumerate((S, S, Piece.TOM_1, Piece.TOM_1, Piece.TOM_2))),
    (3.25, Piece.TOM_2, 60),
    (3.5, Piece.FLOOR_TOM_1, 110),
    (3.75, K, 100),
]
LANDING: list[Stroke] = [(0, K, 110), (0, Piece.CRASH_1, 110)]


def bars_of(*bars: Sequence[Stroke], noise_ms: float = 0.0, lean_ms: float = 0.0, landing: bool = True) -> Turn:
    """The bars one after the other, and the landing on the downbeat behind them."""
    played = [*bars, LANDING] if landing else [*bars]
    strokes = [(4 * bar + beat, piece, velocity) for bar, has in enumerate(played) for beat, piece, velocity in has]
    return turn_of(strokes, GROUND, len(bars), noise_ms, lean_ms)


def phrase(noise_ms: float = 0.0, lean_ms: float = 0.0) -> Turn:
    """A groove, varied, again, and a fill that comes home: what a teacher would call four bars."""
    return bars_of(GROOVE, VARIED, GROOVE, FILL, noise_ms=noise_ms, lean_ms=lean_ms)


def struck(beats: Iterable[float], pieces: Sequence[Piece] = (S,), velocity: int = 110) -> Turn:
    """Four bars of the same pieces at once, all as loud."""
    return turn_of([(beat, piece, velocity) for beat in beats for piece in pieces], GROUND, 4)


def noise(seed: int) -> Turn:
    """Sixty strokes anywhere in four bars, on any pad, at any velocity."""
    rng = np.random.default_rng(seed)
    drawn = zip(rng.uniform(0, 16, 60), rng.integers(0, len(ALL_PADS), 60), rng.integers(1, 128, 60), strict=True)
    return turn_of([(float(beat), ALL_PADS[pad], int(velocity)) for beat, pad, velocity in drawn], GROUND, 4)


def with_velocities(turn: Turn, factor: float) -> Turn:
    """The turn on a kit that sends other velocities."""
    hits = turn.played.hits.copy()
    hits["velocity"] = np.clip(np.rint(hits["velocity"] * factor), 1, 127)
    return Turn(turn.ground, turn.bars, Performance.from_array(hits))
