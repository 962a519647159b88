"""Which strokes of the written music a planted fault concerns: this benchmark's own reading, by drummers' words.

All masks have shape (n,), a row a stroke of the score, and leave grace strokes out (they follow their main stroke).
The detector has definitions of its own; nothing is shared with it.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.planted.planted_music import Music
from station.core.pieces import CYMBALS, HALF_OPEN, TOMS, Dynamic, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Score

Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]

_EIGHTHS = 8
_WAIT_S, _WAIT_BEATS, _MOST_WAITS = 1.0, 1.5, 0.4
"""A long wait is a second and one and a half beats without a stroke; where most strokes follow one, none is long."""
_NO_WAIT_S = 0.7
"""A shorter silence nobody calls a wait: a beat at 86 bpm; our choice."""
_DOUBLE_S = 0.26
"""Two strokes of one hand that are farther apart are no double but two strokes; our choice."""
_FILL_STROKES, _FILL_BARS, _MOST_FILLS = 3, 2, 1 / 3
"""Fewer strokes are a pickup, more bars a solo; fills in a third of the beats are the groove; our choice."""
_SAME_DB = 2.0
"""Written levels that far apart are meant to differ (HUMANS: just noticeable 2–3 dB)."""


def level_db(velocity: NDArray[np.generic] | float) -> Floats:
    """Level of a velocity in dB below the loudest (HUMANS: 40·log10(v/127))."""
    return 40 * np.log10(np.maximum(np.asarray(velocity, np.float64), 1) / 127)


@dataclass(frozen=True, eq=False)
class Written:
    """A piece of music with what its strokes are."""

    music: Music

    @property
    def score(self) -> Score:
        """The score itself."""
        return self.music.score

    @cached_property
    def main(self) -> Mask:
        """Strokes that stand on their tick, graces left out."""
        return ~self.score.is_grace

    def piece(self, piece: Piece) -> Mask:
        """Strokes on a piece."""
        return np.asarray(self.main & (self.score.notes["piece"] == piece), np.bool_)

    def limb(self, limb: Limb) -> Mask:
        """Strokes of a limb."""
        return np.asarray(self.main & (self.score.notes["limb"] == limb), np.bool_)

    @cached_property
    def pieces(self) -> list[Piece]:
        """The pieces that are written."""
        return [Piece(p) for p in np.unique(self.score.notes["piece"])]

    @cached_property
    def time_s(self) -> Floats:
        """When each stroke's tick is, graces at their main stroke's."""
        return np.asarray(self.score.tempo_map.seconds_at(self.score.notes["tick"]), np.float64)

    @cached_property
    def beat_ticks(self) -> int:
        """The beat that a drummer taps: a dotted quarter in six and twelve eight."""
        meter = self.score.tempo_map.meter_at(0)
        compound = meter.unit == _EIGHTHS and meter.beats % 3 == 0
        return 3 * meter.beat_ticks if compound else PPQ

    @cached_property
    def is_quarters(self) -> bool:
        """Whether bars are whole quarters, so that an eighth can be off the beat."""
        meter = self.score.tempo_map.meter_at(0)
        return meter.unit != _EIGHTHS

    @cached_property
    def in_bar(self) -> NDArray[np.int64]:
        """Ticks from the bar's start."""
        starts = np.array([self.score.tempo_map.bar_start(b) for b in range(self.score.bar_count)], np.int64)
        return np.asarray(self.score.notes["tick"] - starts[self.score.bar], np.int64)

    @cached_property
    def place(self) -> Floats:
        """Where in its beat a stroke stands, 0 ≤ p < 1."""
        return np.asarray(self.in_bar % self.beat_ticks / self.beat_ticks, np.float64)

    def _at(self, low: float, high: float) -> Mask:
        return self.main & (self.place >= low - 1e-3) & (self.place <= high + 1e-3)

    @cached_property
    def offbeats(self) -> Mask:
        """The straight eighths between the beats; none where the music swings or counts in eighths."""
        swings = self._at(0.55, 0.72).any() or not self.is_quarters
        return self._at(0.5, 0.5) & (not swings)

    @cached_property
    def swung(self) -> Mask:
        """The short notes of swung eighths; none where triplets' middles or straight eighths stand beside them."""
        short = self._at(0.55, 0.72)
        others = self.main & ~short & (self.place > 0)
        return np.asarray(short & self.is_quarters & (others.sum() <= 0.1 * short.sum()), np.bool_)

    @cached_property
    def only_eighths(self) -> bool:
        """Whether nothing is shorter than an eighth, so that the music could be swung."""
        return not (self.main & ~np.isin(self.in_bar % PPQ, (0, PPQ // 2))).any()

    @cached_property
    def moment(self) -> NDArray[np.int64]:
        """The number of each stroke's moment: strokes on one tick share it; shape (n,), in order."""
        return np.unique(self.score.notes["tick"], return_inverse=True)[1].astype(np.int64)

    @cached_property
    def after_wait(self) -> Mask:
        """Strokes that come in after a long wait."""
        ticks = np.unique(self.score.notes["tick"])
        gap_s = np.diff(self.score.tempo_map.seconds_at(ticks), prepend=np.inf)
        long = (gap_s >= _WAIT_S) & (np.diff(ticks, prepend=0) >= _WAIT_BEATS * self.beat_ticks)
        long[0] = False
        mask: Mask = long[self.moment] & self.main
        return mask & bool(mask.sum() <= _MOST_WAITS * self.main.sum())

    @cached_property
    def fills(self) -> list[tuple[Mask, Mask]]:
        """Each fill and its landing: beats of drums alone up to a bar's end, and the strokes of the beat after it."""
        beat, toms = self.score.notes["tick"] // self.beat_ticks, np.isin(self.score.notes["piece"], TOMS)
        found = []
        for start, stop in self._beats_of_drums():
            inside = self.main & (beat >= start) & (beat < stop)
            first, last = (int(self.score.bar[inside][k]) for k in (0, -1))
            ends_a_bar = self.score.tempo_map.bar_start(last + 1) == stop * self.beat_ticks
            is_more = (inside & toms).any() or stop - start > 1
            if ends_a_bar and is_more and last - first < _FILL_BARS and inside.sum() >= _FILL_STROKES:
                found.append((inside, self._landing(inside, beat == stop)))
        return found

    def _landing(self, fill: Mask, beat: Mask) -> Mask:
        """The strokes of the beat after a fill; none where the fill ends in a wait, after which they would be, too."""
        after = self.main & beat
        waits = not after.any() or self.time_s[after][0] - self.time_s[fill][-1] > _NO_WAIT_S
        return after & (not waits)

    def _beats_of_drums(self) -> list[tuple[int, int]]:
        """From and until which beat no timekeeper plays, begun by a beat with more than a backbeat on the drums."""
        notes, beats = self.score.notes, int(self.score.end_tick // self.beat_ticks)
        is_drum = self.main & np.isin(notes["piece"], [Piece.SNARE, *TOMS])
        is_time = self.main & np.isin(notes["piece"], [Piece.HIHAT, *CYMBALS])
        drums, time = (
            np.bincount(notes["tick"][m] // self.beat_ticks, minlength=beats)[:beats] for m in (is_drum, is_time)
        )
        edges = np.flatnonzero(np.diff(time == 0, prepend=False, append=False))
        runs = zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True)
        filled = [
            (start + int(np.argmax(drums[start:stop] > 1)), stop) for start, stop in runs if drums[start:stop].max() > 1
        ]
        return filled if sum(stop - start for start, stop in filled) <= _MOST_FILLS * beats else []

    @cached_property
    def second_of_double(self) -> Mask:
        """Second strokes of doubles: two of one hand between strokes of the other, on a piece that both play."""
        return self._doubles[0]

    @cached_property
    def first_of_double(self) -> Mask:
        """First strokes of those."""
        return self._doubles[1]

    @cached_property
    def double_ms(self) -> float:
        """The median interval between the two strokes of a double."""
        first, second = (self.time_s[mask] for mask in (self.first_of_double, self.second_of_double))
        return float(np.median(second - first)) * 1000 if len(first) else 0.0

    @cached_property
    def _doubles(self) -> tuple[Mask, Mask]:
        notes, found = self.score.notes, np.zeros((2, len(self.score)), np.bool_)
        right, left = (self.limb(hand) for hand in (Limb.RIGHT_HAND, Limb.LEFT_HAND))
        ornamented = self.main_of[~self.main]
        shared = np.intersect1d(notes["piece"][right], notes["piece"][left])
        rows = np.flatnonzero(right | left)
        if not self.music.has_sticking:
            rows = rows[:0]
        runs = np.split(rows, np.flatnonzero(np.diff(notes["limb"][rows]) != 0) + 1)
        at_s, level = self.time_s, level_db(notes["velocity"])
        for before, run, behind in zip([rows[:0], *runs], runs, [*runs[1:], rows[:0]], strict=False):
            if len(run) != 2:
                continue
            first, second = run
            alone = all(at_s[k] < at_s[first] for k in before) and all(at_s[k] > at_s[second] for k in behind)
            plain = first not in ornamented and second not in ornamented
            same = (
                plain
                and notes["piece"][first] == notes["piece"][second]
                and abs(level[second] - level[first]) <= _SAME_DB
            )
            if alone and same and notes["piece"][first] in shared and at_s[second] - at_s[first] <= _DOUBLE_S:
                found[:, second], found[:, first] = (True, False), (False, True)
        return found[0], found[1]

    def _graces(self, ornament: Ornament) -> Mask:
        return np.asarray(self.score.is_grace & (self.score.notes["ornament"] == ornament), np.bool_)

    @cached_property
    def flam_graces(self) -> Mask:
        """Grace strokes of flams."""
        return self._graces(Ornament.FLAM)

    @cached_property
    def main_of(self) -> NDArray[np.int64]:
        """Row of the main stroke of each row: itself, or for a grace the one on its tick and piece."""
        own = np.arange(len(self.score))
        key = {(int(self.score.notes["tick"][i]), int(self.score.notes["piece"][i])): i for i in own[self.main]}
        tick, piece = self.score.notes["tick"], self.score.notes["piece"]
        return np.array([key.get((int(tick[i]), int(piece[i])), i) for i in own], np.int64)

    @cached_property
    def ghosts_and_others(self) -> tuple[Mask, Mask]:
        """Ghosts, and the louder strokes of the pieces on which ghosts are played: taps, else accents."""
        return self._against(Dynamic.GHOST, (Dynamic.NORMAL, Dynamic.ACCENT))

    @cached_property
    def accents_and_taps(self) -> tuple[Mask, Mask]:
        """Accents, and the taps of the pieces on which accents are played."""
        return self._against(Dynamic.ACCENT, (Dynamic.NORMAL,))

    def _against(self, dynamic: Dynamic, others: tuple[Dynamic, ...]) -> tuple[Mask, Mask]:
        written, piece = self.score.notes["dynamic"], self.score.notes["piece"]
        these = self.main & (written == dynamic)
        for other in others:
            those = self.main & (written == other) & np.isin(piece, np.unique(piece[these]))
            if those.sum() >= these.sum() / 8:
                return these & np.isin(piece, np.unique(piece[those])), those
        return these & False, these & False

    @cached_property
    def compared_hands(self) -> bool:
        """Whether both hands play the same thing often enough to be compared: one piece, one dynamic."""
        notes = self.score.notes
        if not self.music.has_sticking:
            return False
        for piece in self.pieces:
            for dynamic in Dynamic:
                here = self.piece(piece) & (notes["dynamic"] == dynamic)
                both = [int((here & self.limb(hand)).sum()) for hand in (Limb.RIGHT_HAND, Limb.LEFT_HAND)]
                if min(both) >= 0.25 * self.main.sum():
                    return True
        return False

    @cached_property
    def closed_hats(self) -> Mask:
        """Hi-hat strokes that are written closed."""
        return self.piece(Piece.HIHAT) & ~self.open_hats

    @cached_property
    def open_hats(self) -> Mask:
        """Hi-hat strokes that are written open or half open."""
        openness = np.nan_to_num(self.score.notes["openness"], nan=0.0)
        return np.asarray(self.piece(Piece.HIHAT) & (openness >= HALF_OPEN), np.bool_)

    @cached_property
    def is_buzzed(self) -> bool:
        """Whether buzz rolls are written, which this player cannot play."""
        return bool((self.score.notes["duration_ticks"] > 0).any())

    @cached_property
    def short_gap_ms(self) -> float:
        """The interval between moments than which a tenth are shorter."""
        gaps = np.diff(np.unique(self.time_s))
        return float(np.quantile(gaps, 0.1)) * 1000 if len(gaps) else np.inf
