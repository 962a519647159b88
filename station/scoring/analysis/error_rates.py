"""Findings of shares: notes that are left out, strokes that nobody wrote, and pieces struck for others.

A share is beyond what goes wrong with anyone if all of its interval is (Wilson 1927).
"""

from collections.abc import Sequence

import numpy as np

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.music.judgement import Label
from station.scoring.analysis.finding import CHANCE, MIN_SLOTS, Z_95, Finding, Flags, worst_bars
from station.scoring.analysis.journey import Journey
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.technique.observability import Swallowed

_ASTRAY = 0.15
"""Up to this share of a piece's notes a miss and an extra are one stroke that came too far from its note, and no fault
of this kind: an SD of 40 ms takes one stroke in seven beyond 60 ms."""


def misses_and_extras(summary: Summary, way: Journey) -> list[Finding]:
    """A piece whose notes are left out, and strokes that nobody wrote; or of all pieces together, if none stands out.

    What belongs to a bar that was left out or played again is said by `way` and counts as neither.
    """
    observable = (summary.swallowed == Swallowed.NO) & ~way.passed
    missed = (summary.alignment.note_label == Label.MISS) & observable
    excused = np.bincount(summary.performance.hits["piece"][way.again], minlength=len(Piece))
    left_out, unwritten, total = list[Finding](), list[Finding](), np.zeros(2, np.int64)
    for piece, group in summary.by_piece.items():
        here = (summary.score.notes["piece"] == piece) & observable
        bad, extras = int(missed[here].sum()), (group.extras or 0) - int(excused[piece])
        astray = min(bad, extras, round(_ASTRAY * int(here.sum())))
        bad, extras = bad - astray, extras - astray
        total += bad, extras
        left_out += _missed(summary, _name(piece), missed, here, bad, CHANCE)
        unwritten += _of_share(
            summary, "extra", f" on the {_name(piece)}", (extras, group.matched + extras), (), CHANCE
        )
    bad, extras = total.tolist()
    return [
        *(left_out or _missed(summary, "notes", missed, observable, bad, Z_95)),
        *(unwritten or _of_share(summary, "extra", "", (extras, summary.counts.matched + extras), (), Z_95)),
    ]


def _missed(summary: Summary, subject: str, missed: Flags, here: Flags, bad: int, z: float) -> list[Finding]:
    """What was left out `here` (n,): `bad` of the notes."""
    bars = worst_bars(summary, missed[here].astype(np.float64), here)
    return _of_share(summary, "missed", subject, (bad, int(here.sum())), bars, z)


def wrong_pieces(summary: Summary) -> list[Finding]:
    """Pieces that are struck where others are written."""
    found = []
    for wrong in summary.wrong_pieces:
        here = summary.score.notes["piece"] == wrong.written
        missed = (summary.alignment.note_label == Label.WRONG_PIECE).astype(np.float64)
        bars = worst_bars(summary, missed[here], here)
        subject = f"{_name(wrong.played)} for {_name(wrong.written)}"
        found += _of_share(summary, "wrong_piece", subject, (wrong.count, int(here.sum())), bars, CHANCE)
    return found


def wrong_hands(summary: Summary) -> list[Finding]:
    """Strokes of the other hand than is written, where sensors told the hands."""
    sticking = summary.sticking
    if sticking is None:
        return []
    told = sticking.right | sticking.wrong
    bars = worst_bars(summary, sticking.wrong[told].astype(np.float64), told)
    return _of_share(summary, "wrong_sticking", "", (int(sticking.wrong.sum()), sticking.told), bars, CHANCE)


def _of_share(
    summary: Summary, fault: str, subject: str, share: tuple[int, int], bars: Sequence[int], z: float
) -> list[Finding]:
    """A finding in percent if `share` (so many of so many) lies `z` errors beyond what is free, else nothing."""
    bad, of = share
    free = summary.view.faults.least(fault) / 100
    if bad < 2 or of < MIN_SLOTS or wilson(bad, of, z)[0] <= free:
        return []
    low, high = wilson(bad, of)
    percent = 100 * bad / of
    return [Finding(fault, subject, percent, (100 * low, 100 * high), "%", bad / of / max(free, 0.01), tuple(bars))]


def wilson(hit: int, of: int, z: float = Z_95) -> tuple[float, float]:
    """Interval of a share, `z` standard errors to both sides (Wilson 1927)."""
    z2, share = z * z, hit / of
    centre = (share + z2 / (2 * of)) / (1 + z2 / of)
    half = z / (1 + z2 / of) * (share * (1 - share) / of + z2 / (4 * of * of)) ** 0.5
    return max(centre - half, 0.0), min(centre + half, 1.0)


def _name(piece: int) -> str:
    return piece_name(Piece(piece))
