"""Hits that nobody counts, however much they are unwritten: what good drummers' feet and left hands do on their own.

The list is the teacher's: the hi-hat foot keeping time, the chick that closes an open hat, a feathered kick, and notes
at ghost level beside a backbeat. Such a hit still answers a written note of its piece; only if none claims it, it is
not an extra. `Unwritten` answers for whole arrays (the report) and for one hit at a time (live) by the same rules.
"""

from bisect import bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Dynamic, Piece
from station.core.units import NS_PER_MS
from station.music.performance import Performance
from station.music.score import Score

GHOST_VELOCITY = 45
"""Upper end of ghost strokes (HUMANS, Velocity)."""

FEATHER_VELOCITY = 40
"""A feathered kick is felt, not heard (our choice, below the ghost strokes' upper end)."""

OPEN_FROM = 0.3
"""Openness from which a hi-hat rings on until somebody closes it (our choice)."""

_BEAT_REACH_NS = 60 * NS_PER_MS
"""How far from a beat a feathered kick may lie (our choice: half a 16th at 125 bpm)."""


@dataclass(frozen=True, eq=False)
class Masks:
    """Over the hits (m,): `feet` never answer another piece's note, `quiet` (feet among them) are never extras."""

    feet: NDArray[np.bool_]
    quiet: NDArray[np.bool_]


class Unwritten:
    """The rules over one score."""

    def __init__(self, score: Score) -> None:
        notes = score.notes
        bars = range(score.bar_count)
        self._bar_ns = score.tempo_map.ns_at([score.tempo_map.bar_start(bar) for bar in bars])
        self._foot_bar = _bars_with(score, notes["piece"] == Piece.HIHAT_PEDAL)
        self._backbeat_bar = _bars_with(score, (notes["piece"] == Piece.SNARE) & (notes["dynamic"] != Dynamic.GHOST))
        hats = np.flatnonzero(notes["piece"] == Piece.HIHAT)
        hats = hats[np.argsort(score.onset_ns[hats], kind="stable")]
        self._hat_ns = score.onset_ns[hats]
        self._hat_open = np.asarray(notes["openness"][hats] >= OPEN_FROM)  # NaN, not said, is never open
        beats = [tick for tick, _ in score.tempo_map.beats_between(0, score.end_tick + 1)]
        self._beat_ns = score.tempo_map.ns_at(beats)
        self._lists = [
            a.tolist() for a in (self._bar_ns, self._foot_bar, self._backbeat_bar, self._hat_ns, self._hat_open)
        ]
        self._beat_list: list[int] = self._beat_ns.tolist()

    def masks(self, performance: Performance, hit_ns: NDArray[np.int64]) -> Masks:
        """The rules for every hit, `hit_ns` (m,) being its score time."""
        piece, velocity = performance.hits["piece"], performance.hits["velocity"]
        bar = np.maximum(np.searchsorted(self._bar_ns, hit_ns, side="right") - 1, 0)
        feet = (piece == Piece.HIHAT_PEDAL) & (~self._foot_bar[bar] | self._after_open_hat(hit_ns))
        ghosts = (piece == Piece.SNARE) & (velocity <= GHOST_VELOCITY) & self._backbeat_bar[bar]
        feathers = (piece == Piece.KICK) & (velocity <= FEATHER_VELOCITY) & self._on_beat(hit_ns)
        return Masks(feet, feet | ghosts | feathers)

    def is_foot(self, piece: Piece, hit_ns: int) -> bool:
        """One hit of `Masks.feet`."""
        if piece is not Piece.HIHAT_PEDAL:
            return False
        bar_ns, foot_bar, _, hat_ns, hat_open = self._lists
        hat = bisect_right(hat_ns, hit_ns) - 1
        return not foot_bar[max(bisect_right(bar_ns, hit_ns) - 1, 0)] or (hat >= 0 and hat_open[hat])

    def is_quiet(self, piece: Piece, velocity: int, hit_ns: int) -> bool:
        """One hit of `Masks.quiet`."""
        if piece is Piece.SNARE and velocity <= GHOST_VELOCITY:
            bar_ns, _, backbeat_bar, _, _ = self._lists
            return bool(backbeat_bar[max(bisect_right(bar_ns, hit_ns) - 1, 0)])
        if piece is Piece.KICK and velocity <= FEATHER_VELOCITY:
            beats = self._beat_list
            i = bisect_right(beats, hit_ns)
            return any(abs(beat - hit_ns) <= _BEAT_REACH_NS for beat in beats[max(i - 1, 0) : i + 1])
        return self.is_foot(piece, hit_ns)

    def _after_open_hat(self, hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        """Which hits come after a written open stroke of the hi-hat and before its next stroke."""
        if not len(self._hat_ns):
            return np.zeros(len(hit_ns), np.bool_)
        before = np.searchsorted(self._hat_ns, hit_ns, side="right") - 1
        return (before >= 0) & self._hat_open[np.maximum(before, 0)]

    def _on_beat(self, hit_ns: NDArray[np.int64]) -> NDArray[np.bool_]:
        right = np.minimum(np.searchsorted(self._beat_ns, hit_ns, side="right"), len(self._beat_ns) - 1)
        left = np.maximum(right - 1, 0)
        distance = np.minimum(np.abs(self._beat_ns[right] - hit_ns), np.abs(hit_ns - self._beat_ns[left]))
        return np.asarray(distance <= _BEAT_REACH_NS)


def _bars_with(score: Score, which: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which bars hold one of the notes marked in `which` (n,); shape (bars,)."""
    return np.asarray(np.bincount(score.bar[which], minlength=score.bar_count)[: score.bar_count] > 0)
