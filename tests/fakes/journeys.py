"""Students who skip, go back, stop, begin anywhere and change their tempo, with the truth about every stroke.

A journey is a row of legs: segments of bars, each at its own tempo and after its own pause. Seeded normal noise, notes
left out, strokes added and strokes on another piece are drawn here, so that no word of the code under test is in it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S, PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap


def through_composed(bars: int, tempo_bpm: float, seed: int = 0) -> Score:
    """Grooves of eighths on the hat with kicks and snares that are drawn anew for each bar: no two bars are alike."""
    rng = np.random.default_rng(seed)
    notes = []
    for bar in range(bars):
        start = bar * 4 * PPQ
        kicks = {0, *rng.choice(np.arange(1, 16), 3, replace=False).tolist()}
        snares = {4, 12, int(rng.integers(16))}
        for piece, steps in ((Piece.KICK, kicks), (Piece.SNARE, snares), (Piece.HIHAT, range(0, 16, 2))):
            notes += [Note(start + step * PPQ // 4, piece) for step in steps]
        if rng.random() < 0.5:
            other = (Piece.CRASH_1, Piece.TOM_1, Piece.FLOOR_TOM_1)[int(rng.integers(3))]
            notes.append(Note(start + int(rng.integers(16)) * PPQ // 4, other))
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm))


@dataclass(frozen=True)
class Leg:
    """Bars [`first`, `end`) from 0, fractions allowed, `rate` times as fast as written, after `pause_s` of silence."""

    first: float
    end: float
    rate: float = 1.0
    pause_s: float = 0.0


@dataclass(frozen=True)
class Slips:
    """How the strokes differ from the notes."""

    sd_s: float = 0.015
    missing: float = 0.03
    extra: float = 0.03
    wrong_piece: float = 0.02


@dataclass(frozen=True)
class Stroke:
    """A `hit`, the note that it was meant for (None for one too many), where in the score it was, and in which leg."""

    hit: Hit
    note: int | None
    score_s: float
    leg: int


@dataclass(frozen=True)
class Journey:
    """Strokes in order of time."""

    score: Score
    strokes: tuple[Stroke, ...]
    bar_s: float

    def after(self, leg: int, bars: float) -> list[int]:
        """Numbers of the strokes of a leg that come more than so many bars after its beginning."""
        mine = [i for i, stroke in enumerate(self.strokes) if stroke.leg == leg]
        start_s = self.strokes[mine[0]].score_s
        return [i for i in mine if self.strokes[i].score_s > start_s + bars * self.bar_s]

    def not_played_again(self) -> list[int]:
        """Numbers of the strokes whose notes no later one answers."""
        last = {stroke.note: i for i, stroke in enumerate(self.strokes)}
        return [i for i, stroke in enumerate(self.strokes) if last[stroke.note] == i]


def travel(score: Score, legs: Sequence[Leg], seed: int, slips: Slips | None = None) -> Journey:
    """Play `legs` of `score`, whose bars are all as long as the first."""
    rng, slips = np.random.default_rng(seed), slips or Slips()
    bar_s = float(score.tempo_map.seconds_at(score.tempo_map.bar_start(1)))
    pieces = sorted({Piece(p) for p in score.notes["piece"]})
    strokes: list[Stroke] = []
    now_s = 0.0
    for number, leg in enumerate(legs):
        now_s += leg.pause_s
        first_s, end_s = leg.first * bar_s, leg.end * bar_s
        inside = np.flatnonzero((score.onset_s >= first_s - 1e-6) & (score.onset_s < end_s - 1e-6))
        for note in inside[rng.random(len(inside)) >= slips.missing].tolist():
            own, at_s = Piece(score.notes["piece"][note]), float(score.onset_s[note])
            is_wrong = rng.random() < slips.wrong_piece
            piece = pieces[int(rng.integers(len(pieces)))] if is_wrong else own
            played_s = now_s + (at_s - first_s) / leg.rate + rng.normal(0, slips.sd_s)
            strokes.append(Stroke(_hit(played_s, piece), note if piece is own else None, at_s, number))
        for at_s in rng.uniform(first_s, end_s, rng.poisson(slips.extra * len(inside))).tolist():
            piece = pieces[int(rng.integers(len(pieces)))]
            strokes.append(Stroke(_hit(now_s + (at_s - first_s) / leg.rate, piece), None, at_s, number))
        now_s += (end_s - first_s) / leg.rate
    return Journey(score, tuple(sorted(strokes, key=lambda stroke: stroke.hit.at_ns)), bar_s)


def _hit(at_s: float, piece: Piece) -> Hit:
    return Hit(round(at_s * NS_PER_S), piece, Zone.HEAD, 80)
