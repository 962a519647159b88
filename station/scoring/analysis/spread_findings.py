"""Unsteadiness: of one limb against the others, and of the whole.

A limb is unsteady where its own spread, habits taken out, is large in itself and large beside that of the other limbs;
if all spread alike, the whole is. Two spreads are told apart on the scale of their logarithms, whose error is
1/√(2n) for n strokes of normal errors.
"""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece, word
from station.core.student_t import t_quantile_95
from station.music import passages
from station.scoring.analysis.fault_table import kind_of
from station.scoring.analysis.finding import CHANCE, MIN_SLOTS, Z_95, Finding, worst_bars
from station.scoring.analysis.summary import Summary
from station.scoring.analysis.technique.estimates import scatter
from station.scoring.analysis.timing_spread import asynchrony_ms, timed_notes

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

BESIDE_OTHERS = 1.5
"""One limb is unsteady from so many times the spread of the others on (the fault table)."""

_LIMB_SHARE, _RATIO_SHARE, _WHOLE_SHARE, _SURE_SHARE = 0.75, 0.85, 0.8, 0.7
"""Named from these shares of the smallest sizes on: spreads of 30 strokes are known to an eighth, of 100 to a 14th, and
the farthest strokes of an unsteady limb answer no note any more. The last is for the lower end of the interval: an SD
of 20 ms is no fault."""

_MOST_SD_MS, _SD_SHARE = 35.0, 0.15
"""TEACHING: a pass's SD is at most 35 ms, at slow tempi 15 % of the interval."""

_SLIP_SDS = 4.0
"""Strokes farther off than so many robust SDs are slips or wrong pairs and no unsteadiness (our choice)."""


def limbs_of(summary: Summary) -> NDArray[np.int64]:
    """Who plays each note (n,): the written limb, else the foot that plays kick and pedal; `UNKNOWN` of other hands."""
    notes = summary.score.notes
    limb = notes["limb"].astype(np.int64)
    unsaid = limb == Limb.UNKNOWN
    limb[unsaid & (notes["piece"] == Piece.KICK)] = Limb.RIGHT_FOOT
    limb[unsaid & (notes["piece"] == Piece.HIHAT_PEDAL)] = Limb.LEFT_FOOT
    return limb


def spread_findings(summary: Summary) -> Iterator[Finding]:
    """Unsteady limbs, or else an unsteady whole."""
    rest = summary.habits.rest_ms
    played = ~np.isnan(rest)
    if played.sum() < 2 * MIN_SLOTS:
        return
    limb = limbs_of(summary)
    unsteady = [
        (one, there) for one in Limb if one != Limb.UNKNOWN and _stands_out(summary, one, there := limb == one, played)
    ]
    for one, there in unsteady:
        yield _finding(summary, f"unsteady_{word(one)}", _sd(rest[there & played]), there & played)
    others = played & ~np.any([there for _, there in unsteady], axis=0) if unsteady else played
    yield from _of_whole(summary, others)


def _stands_out(summary: Summary, limb: Limb, there: Flags, played: Flags) -> bool:
    rest = summary.habits.rest_ms
    own, others = rest[there & played], rest[~there & played]
    if len(own) < 2 * MIN_SLOTS or len(others) < 2 * MIN_SLOTS:
        return False
    sd, beside = _sd(own), _sd(others)
    surely = np.log(sd / beside) > CHANCE * (0.5 / len(own) + 0.5 / len(others)) ** 0.5
    least = summary.view.faults.least(f"unsteady_{word(limb)}")
    return bool(surely and sd >= _LIMB_SHARE * least and sd >= _RATIO_SHARE * BESIDE_OTHERS * beside)


def _of_whole(summary: Summary, strokes: Flags) -> Iterator[Finding]:
    """The spread of the report's tables, so that a student reads one number everywhere, if habits do not explain it."""
    sd, count = summary.timing.sd_ms, int(strokes.sum())
    if sd is None or count < 4 * MIN_SLOTS:
        return
    least = max(summary.view.faults.least("unsteady"), min(_MOST_SD_MS, _SD_SHARE * _usual_interval_ms(summary)))
    left = min(sd, _sd(summary.habits.rest_ms[strokes]))
    if left < _WHOLE_SHARE * least or left * (1 - Z_95 / (2 * count) ** 0.5) < _SURE_SHARE * least:
        return
    timed = timed_notes(summary.score, summary.alignment)
    yield _finding(summary, "unsteady", sd, timed, f"{least:.0f}")


def _finding(summary: Summary, fault: str, sd: float, strokes: Flags, subject: str = "") -> Finding:
    off = asynchrony_ms(summary.alignment)[strokes]
    bars = tuple(worst_bars(summary, np.abs(off - np.median(off)), strokes))
    severity = sd / summary.view.faults.least(fault)
    return Finding(fault, subject, sd, _interval(summary, sd, off, strokes), kind_of(fault).unit, severity, bars)


def _interval(summary: Summary, sd: float, off: Floats, strokes: Flags) -> tuple[float, float]:
    """That of the tables' spread about `sd`, by its ratios; of few moments, what independent strokes would have."""
    count = int(strokes.sum())
    found = scatter(off, np.zeros(count, np.int64), summary.score.notes["tick"][strokes].astype(np.int64))
    if found.ci is not None and found.sd:
        return sd * found.ci[0] / found.sd, sd * found.ci[1] / found.sd
    half = (Z_95 if count > 60 else t_quantile_95(count - 1.0)) * sd / (2 * count) ** 0.5
    return sd - half, sd + half


def _sd(rest: Floats) -> float:
    """Spread about 0 of residuals, slips left out."""
    limit = _SLIP_SDS * max(1.4826 * float(np.median(np.abs(rest))), 1e-6)
    kept = rest[np.abs(rest) <= limit]
    return max(float(np.mean(kept**2) ** 0.5), 1e-6)


def _usual_interval_ms(summary: Summary) -> float:
    ticks, _ = passages.slots(summary.score)
    waits = np.diff(summary.score.tempo_map.seconds_at(ticks))
    return float(np.median(waits)) * 1e3 if len(waits) else 0.0
