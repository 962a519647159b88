"""What a performance shows, each finding an effect with the interval that the data can bear.

A detector looks at a `Summary` for one kind of fault and returns findings whose interval excludes "nothing": a mean
with Student's interval over slots (`timing`), a share with Wilson's. `free` is what feel allows; a finding's strength
is how far, in standard errors, its effect lies beyond that. Sentences are written by `advice`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece, word
from station.music.judgement import Label
from station.scoring.alignment import Reference
from station.scoring.points import FREE_LEAN_MS
from station.scoring.summary import Summary
from station.scoring.timing import StandardError, asynchrony_ms, standard_error, t_quantile_95, timed_notes

FREE_BIAS_MS = 10.0
"""Full marks within 10 ms (HUMANS); less than that of a common lean is nobody's fault."""

MIN_NOTES = 8
"""Fewer notes bear no sentence (our choice: a bar of eighths)."""

FREE_LOSS = 0.02
"""Two strokes in a hundred go wrong with anyone (our choice; TEACHING's pass allows one wrong pad in 50)."""

_Z_95 = 1.959964


@dataclass(frozen=True, slots=True)
class Finding:
    """One fault: its size with sign and 95 % interval in `unit`, the lesson's bars (from 0) where it is worst.

    `subject` names the piece, limb … that it is about, in words; `strength` in standard errors beyond what is free.
    """

    fault: str
    subject: str
    effect: float
    ci: tuple[float, float]
    unit: str
    strength: float
    bars: tuple[int, ...]


def find_all(summary: Summary) -> list[Finding]:
    """Every finding, the strongest first."""
    found = [*_common_lean(summary), *_leans(summary), *_losses(summary), *_wrong_pieces(summary)]
    return sorted(found, key=lambda finding: -finding.strength)


def _of_mean(
    fault: str, subject: str, effect: float, error: StandardError, free: float, bars: Sequence[int]
) -> list[Finding]:
    """A finding in ms if the interval of `effect` lies beyond ±`free`, else nothing."""
    half = t_quantile_95(error.freedom) * error.value
    if abs(effect) - half <= free:
        return []
    strength = (abs(effect) - free) / max(error.value, 1e-6)
    return [Finding(fault, subject, effect, (effect - half, effect + half), "ms", strength, tuple(bars))]


def _common_lean(summary: Summary) -> list[Finding]:
    """Everything early or late against the click."""
    if summary.alignment.reference is Reference.PLAYER:
        return []
    timed = timed_notes(summary.score, summary.alignment)
    off = asynchrony_ms(summary.alignment)[timed]
    error = standard_error(off, summary.score.notes["tick"][timed])
    if error is None or len(off) < MIN_NOTES:
        return []
    effect = float(off.mean())
    fault = "late" if effect > 0 else "early"
    return _of_mean(fault, "everything", effect, error, FREE_BIAS_MS, worst_bars(summary, off * np.sign(effect), timed))


def _leans(summary: Summary) -> list[Finding]:
    """A piece that stands apart from the rest by more than feel."""
    score, timed = summary.score, timed_notes(summary.score, summary.alignment)
    off = asynchrony_ms(summary.alignment)
    found = []
    for piece in np.unique(score.notes["piece"][timed]).tolist():
        own, rest = timed & (score.notes["piece"] == piece), timed & (score.notes["piece"] != piece)
        errors = [standard_error(off[here], score.notes["tick"][here]) for here in (own, rest)]
        if min(own.sum(), rest.sum()) < MIN_NOTES or errors[0] is None or errors[1] is None:
            continue
        effect = float(off[own].mean() - off[rest].mean())
        error = StandardError(
            (errors[0].value ** 2 + errors[1].value ** 2) ** 0.5, min(errors[0].freedom, errors[1].freedom)
        )
        side = "late" if effect > 0 else "early"
        bars = worst_bars(summary, off[own] * np.sign(effect), own)
        found += _of_mean(f"{side}_{word(Piece(piece))}", _name(piece), effect, error, FREE_LEAN_MS, bars)
    return found


def _losses(summary: Summary) -> list[Finding]:
    """A piece whose notes are left out, and strokes that nobody wrote."""
    found = []
    label = summary.alignment.note_label
    for piece, group in summary.by_piece.items():
        here = summary.score.notes["piece"] == piece
        missed = (label == Label.MISS).astype(np.float64)
        bars = worst_bars(summary, missed[here], here)
        found += _of_share("missed", _name(piece), group.misses, group.notes, bars)
        extras, struck = group.extras or 0, group.matched + (group.extras or 0)
        found += _of_share("extra", _name(piece), extras, struck, ())
    return found


def _wrong_pieces(summary: Summary) -> list[Finding]:
    found = []
    for wrong in summary.wrong_pieces:
        here = summary.score.notes["piece"] == wrong.written
        missed = (summary.alignment.note_label == Label.WRONG_PIECE).astype(np.float64)
        bars = worst_bars(summary, missed[here], here)
        subject = f"{_name(wrong.played)} for {_name(wrong.written)}"
        found += _of_share("wrong_piece", subject, wrong.count, int(here.sum()), bars)
    return found


def _of_share(fault: str, subject: str, hit: int, of: int, bars: Sequence[int]) -> list[Finding]:
    """A finding in percent if the interval of the share lies beyond `FREE_LOSS`, else nothing."""
    if of < MIN_NOTES or hit < 2:
        return []
    low, high = wilson(hit, of)
    if low <= FREE_LOSS:
        return []
    share = hit / of
    strength = (share - FREE_LOSS) / max((share - low) / _Z_95, 1e-6)
    return [Finding(fault, subject, 100 * share, (100 * low, 100 * high), "%", strength, tuple(bars))]


def wilson(hit: int, of: int) -> tuple[float, float]:
    """95 % interval of a share (Wilson 1927)."""
    z2, share = _Z_95**2, hit / of
    centre = (share + z2 / (2 * of)) / (1 + z2 / of)
    half = _Z_95 / (1 + z2 / of) * (share * (1 - share) / of + z2 / (4 * of * of)) ** 0.5
    return max(centre - half, 0.0), min(centre + half, 1.0)


def worst_bars(summary: Summary, badness: NDArray[np.float64], notes: NDArray[np.bool_], most: int = 3) -> list[int]:
    """Up to `most` bars, in order, whose notes (mask (n,), `badness` one value each) are worse than the mean."""
    bars = summary.view.bars(summary.score)[notes]
    if not len(bars):
        return []
    total, number = np.bincount(bars, weights=badness), np.maximum(np.bincount(bars), 1)
    mean = total / number
    worse = [
        int(b) for b in np.argsort(-mean, kind="stable") if b in bars and mean[b] >= badness.mean() and mean[b] > 0
    ]
    return sorted(worse[:most])


def _name(piece: int) -> str:
    return word(Piece(piece)).replace("_", " ")
