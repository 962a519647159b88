"""What a virtual student gets wrong at random: strokes left out, strokes on another piece, strokes that nobody wrote.

A slip must be beyond dispute, or its truth would not be known: a stroke that nobody wrote keeps `CLEAR_MS` away from
every written stroke and roll of its piece and from every note that was not rightly played, as far as there is room,
and none comes after the last written stroke; a wrong piece is one on which nothing is written near by, and never one
that stands in for the right one on a smaller kit. Unwritten chicks, feathered kicks and ghosts are nobody's slip, so
extras are of plain loudness and never of the hi-hat foot.

An ornament is left out, or lands on another piece, together with its main stroke.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.passages import slots
from station.music.score import Score
from station.simulation.student_form import Form
from station.simulation.student_reading import StudentReading

CLEAR_MS = 100.0
"""Beyond the widest window that judges a beginner's stroke (YARG's ±70 ms, PEERS) by two of a student's SDs."""
PLAIN_VELOCITY = 70
"""The least mean velocity of an extra: HUMANS has ghosts end at 45 and normal strokes begin at 60."""
FINEST_GRID = PPQ // 8
"""Extras fall on the score's own grid, halved where it is full, down to 32nd notes; our choice."""
BRUSHED_SHARE = 0.02
"""How likely an extra is on a piece that the score does not use, while its own pieces have room; our choice."""

_NEIGHBOURS: dict[Piece, tuple[Piece, ...]] = {
    Piece.SNARE: (Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.HIHAT),
    Piece.HIHAT: (Piece.SNARE, Piece.CRASH_1, Piece.TOM_1),
    Piece.RIDE: (Piece.FLOOR_TOM_1, Piece.TOM_2, Piece.CRASH_1),
    Piece.RIDE_2: (Piece.FLOOR_TOM_1, Piece.TOM_2, Piece.CRASH_1),
    Piece.CRASH_1: (Piece.HIHAT, Piece.TOM_1),
    Piece.CRASH_2: (Piece.TOM_2, Piece.FLOOR_TOM_1),
    Piece.SPLASH: (Piece.HIHAT, Piece.TOM_1),
    Piece.CHINA: (Piece.FLOOR_TOM_1, Piece.TOM_2),
    Piece.TOM_1: (Piece.TOM_2, Piece.SNARE),
    Piece.TOM_2: (Piece.TOM_1, Piece.FLOOR_TOM_1),
    Piece.TOM_3: (Piece.TOM_1, Piece.SNARE),
    Piece.TOM_4: (Piece.TOM_1, Piece.SNARE),
    Piece.FLOOR_TOM_1: (Piece.TOM_2, Piece.SNARE),
    Piece.FLOOR_TOM_2: (Piece.TOM_2, Piece.SNARE),
    Piece.COWBELL: (Piece.TOM_1, Piece.HIHAT),
    Piece.TAMBOURINE: (Piece.TOM_1, Piece.HIHAT),
    Piece.CLAP: (Piece.TOM_1, Piece.SNARE),
    Piece.PERCUSSION: (Piece.SNARE, Piece.TOM_1),
}
"""Where a stroke lands that misses its piece, by the layout of the kit in HUMANS; the feet have one pedal each."""


@dataclass(frozen=True, eq=False)
class Slips:
    """Of each row its `label` and the `piece` struck, (n,) each; of each extra its tick and piece, (e,) each."""

    label: NDArray[np.uint8]
    piece: NDArray[np.uint8]
    extra_tick: NDArray[np.int64]
    extra_piece: NDArray[np.uint8]


class Slipper:
    """Draws the slips of a student, score after score, each kind from a stream of its own."""

    def __init__(self, of_notes: np.random.Generator, of_extras: np.random.Generator) -> None:
        self._of_notes = of_notes
        self._of_extras = of_extras

    def slip(self, reading: StudentReading, form: Form) -> Slips:
        """The slips in one playing of `reading` by a student in this `form`."""
        score = reading.score
        where = _SlipPlace(score)
        label = np.full(len(score), Label.MATCH, np.uint8)
        piece = score.notes["piece"].copy()
        chance, which = self._of_notes.random((len(score), 2)).T
        hand = np.isin(reading.limbs, (Limb.RIGHT_HAND, Limb.LEFT_HAND))
        missed = chance < form.miss
        astray = hand & ~missed & (chance < form.miss + form.wrong_piece)
        label[missed] = Label.MISS
        for row in np.intersect1d(np.flatnonzero(astray), reading.main).tolist():
            if (other := where.free_neighbour(row, float(which[row]))) is not None:
                label[row], piece[row] = Label.WRONG_PIECE, other
        label = label[reading.main]
        piece = np.where(label == Label.WRONG_PIECE, piece[reading.main], score.notes["piece"])
        ticks, pieces = self._extras(score, where, label, form.extra)
        return _wired(Slips(label, piece, ticks, pieces), score, form)

    def _extras(
        self, score: Score, where: "_SlipPlace", label: NDArray[np.uint8], extra: float
    ) -> tuple[NDArray[np.int64], NDArray[np.uint8]]:
        """Ticks and pieces of the strokes that nobody wrote: the clearest places first, commoner pieces more often."""
        count = int(self._of_extras.binomial(len(score), extra)) if len(score) else 0
        if count == 0:
            return np.empty(0, np.int64), np.empty(0, np.uint8)
        step = _grid(score)
        # music is over with its last stroke: who lands on a one does not play on in the rests of its bar
        ticks = np.arange(0, max(int(score.notes["tick"].max()), step), step)
        wrongly_played = np.flatnonzero(label != Label.MATCH)
        # a stroke at the very end would be the landing that nobody counts
        disputed_ns = np.sort(np.append(where.onset_ns[wrongly_played], score.length_ns))
        from_wrong = _distance_ms(disputed_ns, score.tempo_map.ns_at(ticks))
        places: list[NDArray[np.float64]] = []
        for struck, share in where.shares.items():
            clear = np.minimum(np.minimum(from_wrong, where.distance_ms(struck, ticks)), CLEAR_MS)
            room = np.count_nonzero(clear == CLEAR_MS) or len(ticks)
            chance = self._of_extras.standard_exponential(len(ticks)) * room / share
            places.append(np.column_stack([clear, chance, ticks, np.full(len(ticks), struck)]))
        table = np.concatenate(places)
        chosen = table[np.lexsort((table[:, 1], -table[:, 0]))][:count]
        return chosen[:, 2].astype(np.int64), chosen[:, 3].astype(np.uint8)


def _wired(slips: Slips, score: Score, form: Form) -> Slips:
    """The slips as a kit with such wires reports them: what counts as right or wrong is what is reported."""
    if not form.wires:
        return slips
    reported = np.arange(len(Piece), dtype=np.uint8)
    for struck, heard in form.wires.items():
        reported[struck] = heard
    piece = reported[slips.piece]
    right = np.where(piece == score.notes["piece"], Label.MATCH, Label.WRONG_PIECE)
    label = np.where(slips.label == Label.MISS, slips.label, right).astype(np.uint8)
    return Slips(label, piece, slips.extra_tick, reported[slips.extra_piece])


class _SlipPlace:
    """What is written where: distances to the strokes of a piece, and each piece's share of the extras."""

    def __init__(self, score: Score) -> None:
        self._score = score
        self.onset_ns = score.onset_ns
        self._of_piece = {
            Piece(p): np.sort(self.onset_ns[score.notes["piece"] == p]) for p in np.unique(score.notes["piece"])
        }
        buzzes = score.notes["piece"][score.notes["articulation"] == Articulation.BUZZ]
        self._buzzed_ns = {Piece(p): _buzzed_ns(score, Piece(p)) for p in np.unique(buzzes)}
        strikable = {p: len(at) for p, at in self._of_piece.items() if p is not Piece.HIHAT_PEDAL}
        total = sum(strikable.values())
        beside = {n for p in strikable for n in _NEIGHBOURS.get(p, ())} or {Piece.SNARE}
        self.shares = dict.fromkeys(sorted(beside), BRUSHED_SHARE) | {p: n / total for p, n in strikable.items()}

    def distance_ms(self, piece: Piece, ticks: NDArray[np.int64]) -> NDArray[np.float64]:
        """From each tick to the nearest written stroke of `piece`; infinite where there is none, 0 while it is buzzed.

        A stroke more in a roll is a bounce, to whoever hears it.
        """
        at_ns = self._score.tempo_map.ns_at(ticks)
        distance = _distance_ms(self._of_piece.get(piece, np.empty(0, np.int64)), at_ns)
        if piece in self._buzzed_ns:
            begins, ends = self._buzzed_ns[piece]
            buzz = np.searchsorted(begins, at_ns, side="right") - 1
            since_ms = (at_ns - np.where(buzz >= 0, ends[buzz], -_LONG_AGO_NS)) / NS_PER_MS
            distance = np.minimum(distance, np.maximum(since_ms, 0.0))
        return distance

    def free_neighbour(self, row: int, draw: float) -> Piece | None:
        """A piece beside the one of `row` with nothing written on it near by; `draw` in [0, 1) chooses."""
        at = self.onset_ns[row : row + 1]
        beside = _NEIGHBOURS.get(Piece(int(self._score.notes["piece"][row])), ())
        free = [p for p in beside if _distance_ms(self._of_piece.get(p, np.empty(0, np.int64)), at)[0] >= CLEAR_MS]
        return free[int(draw * len(free))] if free else None


_LONG_AGO_NS = 2**60


def _buzzed_ns(score: Score, piece: Piece) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """When the buzzes of `piece` begin, rising, and when the latest of them until then ends."""
    notes = score.notes
    rows = np.flatnonzero((notes["piece"] == piece) & (notes["articulation"] == Articulation.BUZZ))
    ends = score.tempo_map.ns_at(notes["tick"][rows] + notes["duration_ticks"][rows])
    order = np.argsort(score.onset_ns[rows], kind="stable")
    return score.onset_ns[rows][order], np.maximum.accumulate(ends[order])


def _distance_ms(sorted_ns: NDArray[np.int64], at_ns: NDArray[np.int64]) -> NDArray[np.float64]:
    """From each of `at_ns` to the nearest of `sorted_ns`; infinite where that is empty."""
    if len(sorted_ns) == 0:
        return np.full(len(at_ns), np.inf)
    i = np.searchsorted(sorted_ns, at_ns)
    after = np.abs(sorted_ns[np.minimum(i, len(sorted_ns) - 1)] - at_ns)
    before = np.abs(sorted_ns[np.maximum(i - 1, 0)] - at_ns)
    nearest: NDArray[np.float64] = np.minimum(before, after) / NS_PER_MS
    return nearest


def _grid(score: Score) -> int:
    """Half the grid that the score stands on, in ticks, within `FINEST_GRID` … an eighth note."""
    ticks, _ = slots(score)
    return min(max(math.gcd(PPQ, *ticks.tolist()) // 2, FINEST_GRID), PPQ // 2)
