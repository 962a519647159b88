"""Other music than the benchmark's grooves, for alignment to prove itself on: slow, quick, swung, sparse, all alike.

Each kind is a row of `KINDS`: its tempo, and what stands in a bar, drawn by a seeded generator or the same every time.
Bars that are all alike are the hardest: whoever loses the beat there finds it again in any of them. Places in a bar are
in 48ths, so that triplets and 32nds are whole numbers.
"""

from collections.abc import Callable
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap

_STEPS = 48
_BAR_TICKS = 4 * PPQ
_TOMS = (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)

Strokes = list[tuple[float, Piece]]
Bar = Callable[[int, np.random.Generator], Strokes]


def _backbeat(bar: int, rng: np.random.Generator) -> Strokes:
    return [(0, Piece.KICK), (24, Piece.KICK), (12, Piece.SNARE), (36, Piece.SNARE)]


def _ballad(bar: int, rng: np.random.Generator) -> Strokes:
    """Half notes: nearly two seconds without a stroke."""
    strokes: Strokes = [(0, Piece.KICK), (24, Piece.SNARE)]
    strokes += [(30, Piece.KICK)] if rng.random() < 0.5 else []
    return strokes + ([(0, Piece.CRASH_1)] if bar % 4 == 0 else [])


def _rock(bar: int, rng: np.random.Generator) -> Strokes:
    kicks: Strokes = [(int(k), Piece.KICK) for k in rng.choice([18, 21, 30, 42], 2, replace=False)]
    return [*_backbeat(bar, rng), *kicks, *((6 * k, Piece.HIHAT) for k in range(8))]


def _alike(bar: int, rng: np.random.Generator) -> Strokes:
    """The same bar of 16ths with the same fill every fourth time."""
    fill = bar % 4 == 3
    hats: Strokes = [(3 * k, Piece.HIHAT) for k in range(8 if fill else 16)]
    drums = (Piece.SNARE, *_TOMS)
    ends: Strokes = [(3 * k, drums[(k - 8) // 2]) for k in range(8, 16)] if fill else [(36, Piece.SNARE)]
    return [*hats, (0, Piece.KICK), (9, Piece.KICK), (12, Piece.SNARE), *ends]


def _thirty_seconds(bar: int, rng: np.random.Generator) -> Strokes:
    """Hats 62 ms apart at 120 bpm: a player's spread is half the way to the next."""
    return [*_backbeat(bar, rng), *((1.5 * k, Piece.HIHAT) for k in range(32))]


def _shuffle(bar: int, rng: np.random.Generator) -> Strokes:
    strokes: Strokes = [(12 * q + swung, Piece.RIDE) for q in range(4) for swung in (0, 8)]
    ghosts: Strokes = [(12 * q + 4, Piece.SNARE) for q in range(4) if rng.random() < 0.4]
    return [*strokes, *ghosts, (12, Piece.HIHAT_PEDAL), (36, Piece.HIHAT_PEDAL), (0, Piece.KICK), (24, Piece.KICK)]


def _funk(bar: int, rng: np.random.Generator) -> Strokes:
    ghosts: Strokes = [(3 * k, Piece.SNARE) for k in range(16) if k % 4 and rng.random() < 0.25]
    kicks: Strokes = [(3 * k, Piece.KICK) for k in range(1, 16) if k % 4 and rng.random() < 0.2]
    return [*_backbeat(bar, rng), *ghosts, *kicks, *((3 * k, Piece.HIHAT) for k in range(16))]


def _toms(bar: int, rng: np.random.Generator) -> Strokes:
    return [(3 * k, _TOMS[int(rng.integers(len(_TOMS)))]) for k in range(16)]


def _one_drum(bar: int, rng: np.random.Generator) -> Strokes:
    return [(3 * k, Piece.SNARE) for k in range(16)]


@dataclass(frozen=True, slots=True)
class MusicKind:
    """A kind of music: its tempo and what stands in a bar."""

    tempo_bpm: float
    bar: Bar


KINDS = MappingProxyType(
    {
        "ballad": MusicKind(70.0, _ballad),
        "rock": MusicKind(100.0, _rock),
        "alike": MusicKind(120.0, _alike),
        "alike_quick": MusicKind(200.0, _alike),
        "funk": MusicKind(100.0, _funk),
        "shuffle": MusicKind(160.0, _shuffle),
        "toms": MusicKind(60.0, _toms),
        "one_drum": MusicKind(100.0, _one_drum),
        "thirty_seconds": MusicKind(120.0, _thirty_seconds),
    }
)


def music(kind: str, notes: int, seed: int = 0) -> Score:
    """At least `notes` strokes of one of `KINDS`."""
    asked, rng = KINDS[kind], np.random.default_rng(seed)
    rows: set[tuple[int, int]] = set()
    bar = 0
    while len(rows) < notes:
        strokes = asked.bar(bar, rng)
        rows |= {(bar * _BAR_TICKS + round(at * _BAR_TICKS / _STEPS), int(piece)) for at, piece in strokes}
        bar += 1
    table = np.zeros(len(rows), NOTE_DTYPE)
    table["tick"], table["piece"] = np.array(sorted(rows)).T
    table["velocity"], table["dynamic"], table["limb"], table["openness"] = 80, 1, -1, np.nan
    return Score.from_array(table, TempoMap.constant(asked.tempo_bpm))
