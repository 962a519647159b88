"""Findings of shares: notes that are left out, strokes that nobody wrote, and pieces struck for others.

A share is beyond what goes wrong with anyone if all of its interval is (Wilson 1927).
"""

from collections.abc import Sequence

import numpy as np

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.music.judgement import Label
from station.scoring.analysis.finding import MIN_SLOTS, Z_95, Finding, worst_bars
from station.scoring.analysis.habits import CHANCE
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.technique.observability import Swallowed

FREE_LOSS, _CLEAR_LOSS = 0.05, 0.2
"""One stroke in twenty goes wrong with anyone; one in five is what to work at (our choice; TEACHING's pass is 90 %)."""


def misses_and_extras(summary: Summary) -> list[Finding]:
    """A piece whose notes are left out, and strokes that nobody wrote."""
    found = []
    observable = summary.swallowed == Swallowed.NO
    missed = (summary.alignment.note_label == Label.MISS) & observable
    for piece, group in summary.by_piece.items():
        here = (summary.score.notes["piece"] == piece) & observable
        bars = worst_bars(summary, missed[here].astype(np.float64), here)
        found += _of_share("missed", _name(piece), (int(missed[here].sum()), int(here.sum())), bars)
        extras = group.extras or 0
        found += _of_share("extra", _name(piece), (extras, group.matched + extras), ())
    return found


def wrong_pieces(summary: Summary) -> list[Finding]:
    """Pieces that are struck where others are written."""
    found = []
    for wrong in summary.wrong_pieces:
        here = summary.score.notes["piece"] == wrong.written
        missed = (summary.alignment.note_label == Label.WRONG_PIECE).astype(np.float64)
        bars = worst_bars(summary, missed[here], here)
        subject = f"{_name(wrong.played)} for {_name(wrong.written)}"
        found += _of_share("wrong_piece", subject, (wrong.count, int(here.sum())), bars)
    return found


def _of_share(fault: str, subject: str, share: tuple[int, int], bars: Sequence[int]) -> list[Finding]:
    """A finding in percent if the interval of `share` (so many of so many) lies beyond `FREE_LOSS`, else nothing."""
    bad, of = share
    if bad < 2 or of < MIN_SLOTS:
        return []
    if wilson(bad, of, CHANCE)[0] <= FREE_LOSS:
        return []
    low, high = wilson(bad, of)
    percent = 100 * bad / of
    return [Finding(fault, subject, percent, (100 * low, 100 * high), "%", bad / of / _CLEAR_LOSS, tuple(bars))]


def wilson(hit: int, of: int, z: float = Z_95) -> tuple[float, float]:
    """Interval of a share, `z` standard errors to both sides (Wilson 1927)."""
    z2, share = z * z, hit / of
    centre = (share + z2 / (2 * of)) / (1 + z2 / of)
    half = z / (1 + z2 / of) * (share * (1 - share) / of + z2 / (4 * of * of)) ** 0.5
    return max(centre - half, 0.0), min(centre + half, 1.0)


def _name(piece: int) -> str:
    return piece_name(Piece(piece))
