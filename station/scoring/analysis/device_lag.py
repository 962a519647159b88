"""A lag that all strokes share, and whose it is: the equipment's, or a habit of the student.

Equipment is late by so many milliseconds whatever is played; people are late on a pad, or by a share of the beat. So
strokes on the quarters, where a lag of 150 ms is nobody else's note, are taken apart by tempo and by pad. Each `LagRun`
sums up one tempo: the mean of its moments (strokes that sound together are one), with the error that moments of one
clock bear,

    e² = s²/n · (1 + ρ)/(1 − ρ),    ρ = lag-1 of the moments, bias put back, at least .35 (HUMANS: .21 to .45),

and each pad in it likewise. L is the mean over runs, by 1/e². Over their beats b_i a line is fitted by least squares,
weighed by their covariance: e_i², and where there are several takes 11² between runs of one, which share the player's
stand of that day (HUMANS: static lean),

    m_i = L + g·(b_i − b̄),

whose rise between the slowest and the fastest tempo is D = g·(b_max − b_min). A lag of the equipment has D = 0, one
that is a share of the beat D = L·(b_max − b_min)/b̄; A = L − g·b̄, what is left of the line at a beat of nothing, is
what no share of the beat explains. With intervals of 95 % (of pads 99 %: there are some four), and not bare figures:

* a habit by tempo where D lies wholly beyond ±10 ms, and A may lie where people stand beside a click;
* a habit by pad where a pad less the others lies wholly beyond ±10 ms, and the least late pad stands where people do;
* equipment where neither D nor a pad lies beyond ±10 ms, L is known within ±`MOST_HALF_MS`, and D excludes the share of
  the beat;
* else the evidence is thin, and it may be either.

The equipment's and a habit that is the same at all tempi and on all pads are one number here: no stroke can tell them
apart. docs/calibration.md has the tables. Milliseconds; positive is late.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.student_t import t_quantile_95
from station.core.units import NS_PER_MS, PPQ
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.timing_spread import asynchrony_ms, slot_sums, timed_notes
from station.scoring.matching.alignment import Alignment, Reference
from station.scoring.matching.match_classes import match_classes
from station.scoring.matching.slow_drift import robust_sd

Floats = NDArray[np.float64]

LATE_MS, EARLY_MS = 30.0, -60.0
"""A lag counts from here on: `late` is a fault from 30 ms (scoring.md), and people who tap beside a click are up to 40
ms early (HUMANS; `sound.calibration.taps`), to which a clear fault of 20 is added (our choice)."""
HABIT_LOW_MS, HABIT_HIGH_MS = -40.0, 10.0
"""Where people stand beside a click; the interval of a lag that counts lies wholly beyond it."""
SAME_MS = 10.0
"""Pads and tempi are equal within it (the issue's own figure; HUMANS: full marks within 10 ms)."""
MOST_HALF_MS = 25.0
"""Half the interval of a lag that is called the equipment's (our choice: what remains of it is free as feel)."""
LEAST_MOMENTS = 8
"""Fewer moments bear no interval (as `timing_spread.MIN_SLOTS`)."""
LEAST_APART = 1.15
"""Tempi nearer to each other are one (our choice: a lag of 100 ms as a share of the beat then moves by 15)."""

_LEAST_ERROR_MS = 0.3
"""USB's polling (ANCHORS): nothing is known better."""
_LEAST_RHO, _MOST_RHO = 0.35, 0.8
_FAR_SDS = 3.0
"""A stroke farther out counts as one so far: it is a slip (Huber 1981)."""
_TAKE_SD_MS = 11.0
"""How far a player's stand moves from take to take (HUMANS, Groove MIDI: static lean)."""
_PAD_FACTOR = 1.3
"""A two-sided interval of 99 % is so many times as wide as one of 95 %."""
_REACH_MS, _STEP_MS = 200, 4
_SD_MS, _PLAYED, _STRAYS_HZ = 40.0, 0.9, 0.3
"""A beginner's spread, the notes they play, their strays a second on a class of pieces (our choice, for looking)."""
_PRIOR_MS = 100.0
"""SD of lags before anything is played (our choice): against it a lag needs but two unanswered notes."""


@dataclass(frozen=True, slots=True)
class LagMean:
    """The mean of `moments` moments and its standard error."""

    moments: int
    mean_ms: float
    error_ms: float

    @property
    def variance(self) -> float:
        """Of the mean, in ms²."""
        return max(self.error_ms, _LEAST_ERROR_MS) ** 2

    @property
    def t(self) -> float:
        """Student's point for moments of one clock: half of them are independent at a lag-1 of a third."""
        return t_quantile_95(self.moments / 2 - 1)

    @property
    def interval_ms(self) -> tuple[float, float]:
        """That of 95 %."""
        return self.mean_ms - self.t * self.error_ms, self.mean_ms + self.t * self.error_ms


@dataclass(frozen=True, slots=True)
class LagRun:
    """What one tempo of a `take`, in quarter notes a minute, says: the `whole`, and each pad with enough moments."""

    tempo_bpm: float
    whole: LagMean
    pads: Mapping[Piece, LagMean] = field(default_factory=lambda: MappingProxyType({}))
    take: str = ""

    @property
    def beat_ms(self) -> float:
        """How long a quarter lasts."""
        return 60_000.0 / self.tempo_bpm


class LagCause(Enum):
    """Whose a lag is: nobody's, for there is none; not to be told yet; the equipment's; by tempo or by pad a habit."""

    NONE = "none"
    THIN = "thin"
    EQUIPMENT = "equipment"
    TEMPO = "tempo"
    PADS = "pads"


@dataclass(frozen=True, slots=True)
class SharedLag:
    """A lag of all strokes: `lag_ms` with its 95 % interval, whose it is, and what that rests on.

    `rise_ms` is how much later the slowest of `tempi_bpm` was than the fastest, with its interval, None of one tempo;
    `apart` the pad that is farthest from the others, by how much, and the interval, None of one of `pads`.
    """

    cause: LagCause
    lag_ms: float
    low_ms: float
    high_ms: float
    tempi_bpm: tuple[float, ...] = ()
    rise_ms: tuple[float, float, float] | None = None
    apart: tuple[Piece, float, float, float] | None = None
    pads: int = 0

    @property
    def counts(self) -> bool:
        """Whether it is one that nobody has by nature."""
        late = self.lag_ms >= LATE_MS and self.low_ms > HABIT_HIGH_MS
        return late or (self.lag_ms <= EARLY_MS and self.high_ms < HABIT_LOW_MS)

    @property
    def may_be_taken_out(self) -> bool:
        """Whether judgement may leave it out until somebody has said what it is."""
        return self.counts and self.cause in (LagCause.THIN, LagCause.EQUIPMENT)


NO_LAG = SharedLag(LagCause.NONE, 0.0, 0.0, 0.0)


# --- looking ---------------------------------------------------------------------------------------------------------


def likely_lag_ms(score: Score, performance: Performance) -> float:
    """The lag within ±200 ms with which most notes are answered, at any number of tempi; hits are in score time.

    A note is answered as `docs/scoring.md` has it, ln(1 + r); a lag pays ½(lag / 100 ms)². Of even strokes all lags
    that are one note apart answer as many; other pads and other tempi tell which it is.
    """
    classes = match_classes()
    note_class, hit_class = classes[score.notes["piece"]], classes[performance.hits["piece"]]
    notes_ms, hits_ms = score.onset_ns / NS_PER_MS, performance.hits["at_ns"] / NS_PER_MS
    lags = np.arange(-_REACH_MS, _REACH_MS + 1, _STEP_MS, dtype=np.float64)
    worth = -0.5 * (lags / _PRIOR_MS) ** 2
    for each in np.intersect1d(note_class, hit_class).tolist():
        written, played = np.unique(notes_ms[note_class == each]), np.sort(hits_ms[hit_class == each])
        worth = worth + _answers(written, played, lags)
    return float(lags[worth.argmax()])


def _answers(written: Floats, played: Floats, lags: Floats) -> Floats:
    """What each of `lags` (k,) brings: notes answered by hits, and hits that have a note, each of them by half."""
    peak = _PLAYED / (_STRAYS_HZ * 1e-3 * _SD_MS * math.sqrt(2 * math.pi))
    total = np.zeros(len(lags))
    for near, of, sign in ((played, written, 1.0), (written, played, -1.0)):
        asked = of[None, :] + sign * lags[:, None]
        right = np.searchsorted(near, asked)
        after = np.abs(near[np.minimum(right, len(near) - 1)] - asked)
        before = np.abs(near[np.maximum(right - 1, 0)] - asked)
        total += 0.5 * np.log1p(peak * np.exp(-0.5 * (np.minimum(after, before) / _SD_MS) ** 2)).sum(axis=1)
    return total


# --- summing up ------------------------------------------------------------------------------------------------------


def lag_runs(score: Score, alignment: Alignment, taken_ms: float = 0.0, take: str = "") -> tuple[LagRun, ...]:
    """What the strokes of `take` on the quarters say, a run a tempo; hits were aligned `taken_ms` before they came.

    Empty where no click says what was due.
    """
    if alignment.reference is not Reference.CLICK:
        return ()
    tick = score.notes["tick"]
    rows = np.flatnonzero(timed_notes(score, alignment) & (tick % PPQ == 0))
    off, tick = asynchrony_ms(alignment)[rows] + taken_ms, tick[rows]
    beat_ns = score.tempo_map.ns_at(tick + PPQ) - score.tempo_map.ns_at(tick)
    piece = score.notes["piece"][rows]
    runs = []
    for beat in np.unique(beat_ns).tolist():
        here = beat_ns == beat
        whole = _mean(off[here], tick[here])
        if whole is None:
            continue
        pads = {Piece(k): _mean(off[here & (piece == k)], tick[here & (piece == k)]) for k in np.unique(piece[here])}
        known = {pad: mean for pad, mean in pads.items() if mean is not None}
        runs.append(LagRun(60e9 / beat, whole, MappingProxyType(known), take))
    return tuple(runs)


def _mean(off_ms: Floats, slots: NDArray[np.int64]) -> LagMean | None:
    """The mean of strokes (n,) that fall in `slots` (n,), slips drawn in; None of too few moments."""
    middle, sd = float(np.median(off_ms)) if len(off_ms) else 0.0, robust_sd(off_ms)
    if sd is None:
        return None
    drawn = np.clip(off_ms, middle - _FAR_SDS * max(sd, 1.0), middle + _FAR_SDS * max(sd, 1.0))
    mean = float(drawn.mean())
    rest = slot_sums(drawn - mean, slots)
    count = len(rest)
    if count < LEAST_MOMENTS:
        return None
    square = float(rest @ rest)
    lag_1 = float(rest[1:] @ rest[:-1]) / square if square else 0.0
    rho = min(max((count * lag_1 + 1) / (count - 3), _LEAST_RHO), _MOST_RHO)
    variance = square / (count - 1) / count * (1 + rho) / (1 - rho)
    return LagMean(count, mean, math.sqrt(variance))


# --- telling ---------------------------------------------------------------------------------------------------------


def shared_lag(runs: Iterable[LagRun]) -> SharedLag:
    """Whose the lag of all `runs` is; those of one `take` were played in one session."""
    known = [run for run in runs if run.whole.moments >= LEAST_MOMENTS]
    if not known:
        return NO_LAG
    line, pads = _line(known), _pads(known)
    apart = _apart(pads)
    found = SharedLag(
        LagCause.THIN,
        line.lag.mean_ms,
        *line.lag.interval_ms,
        tempi_bpm=tuple(sorted({round(run.tempo_bpm, 1) for run in known})),
        rise_ms=line.rise_ms,
        apart=apart,
        pads=len(pads),
    )
    return replace(found, cause=_cause(found, line, pads))


def _cause(found: SharedLag, line: "_Line", pads: Mapping[Piece, LagMean]) -> LagCause:
    if not found.counts:
        return LagCause.NONE
    rise, apart = found.rise_ms, found.apart
    unlike = rise is not None and _is_beyond(rise[1], rise[2])
    if unlike and not _is_unnatural(*line.at_no_beat_ms, found.lag_ms):
        return LagCause.TEMPO
    uneven = apart is not None and _is_beyond(apart[2], apart[3])
    if uneven and not all(_is_unnatural(*pad.interval_ms, found.lag_ms) for pad in pads.values()):
        return LagCause.PADS
    half = (found.high_ms - found.low_ms) / 2
    if rise is None or apart is None or unlike or uneven or half > MOST_HALF_MS:
        return LagCause.THIN
    return LagCause.THIN if rise[1] <= line.share_ms <= rise[2] else LagCause.EQUIPMENT


def _is_beyond(low_ms: float, high_ms: float) -> bool:
    return low_ms > SAME_MS or high_ms < -SAME_MS


def _is_unnatural(low_ms: float, high_ms: float, lag_ms: float) -> bool:
    """Whether an interval lies wholly beyond where people stand, on the side of the lag."""
    return low_ms > HABIT_HIGH_MS if lag_ms > 0 else high_ms < HABIT_LOW_MS


def _pooled(means: Sequence[LagMean]) -> LagMean:
    """Means of the same thing as one, each weighed by its own error."""
    weights = np.array([1.0 / mean.variance for mean in means])
    value = float(weights @ np.array([mean.mean_ms for mean in means]) / weights.sum())
    return LagMean(sum(mean.moments for mean in means), value, 1.0 / math.sqrt(float(weights.sum())))


@dataclass(frozen=True, slots=True)
class _Line:
    """The lag over the beat: at the mean beat, what it rises from fastest to slowest, at a beat of nothing; intervals.

    `share_ms` is the rise of a lag that is a share of the beat.
    """

    lag: LagMean
    rise_ms: tuple[float, float, float] | None
    at_no_beat_ms: tuple[float, float]
    share_ms: float


def _line(runs: Sequence[LagRun]) -> _Line:
    """Fitted to the tempi of `runs`; of tempi that are one nothing rises, and nothing is known at a beat of nothing."""
    beats, means = (
        np.array(column) for column in zip(*((run.beat_ms, run.whole.mean_ms) for run in runs), strict=True)
    )
    weights = np.linalg.inv(_covariance(runs))
    lag = _pooled([run.whole for run in runs])
    if beats.max() < LEAST_APART * beats.min():
        return _Line(lag, None, (-math.inf, math.inf), 0.0)
    middle, span = float(weights.sum(axis=0) @ beats / weights.sum()), float(beats.max() - beats.min())
    off = beats - middle
    square = float(off @ weights @ off)
    slope = float(off @ weights @ means) / square
    rise, half = slope * span, lag.t * span / math.sqrt(square)
    rest, rest_half = lag.mean_ms - slope * middle, lag.t * math.hypot(lag.error_ms, middle / math.sqrt(square))
    share = lag.mean_ms * span / middle
    return _Line(lag, (rise, rise - half, rise + half), (rest - rest_half, rest + rest_half), share)


def _covariance(runs: Sequence[LagRun]) -> Floats:
    """Of the means of `runs` (k, k) in ms²: each its own error, those of a take the stand that they share."""
    takes = np.array([run.take for run in runs])
    own = np.diag([run.whole.variance for run in runs])
    if (takes == takes[0]).all():  # what a single stand is can be told from nothing
        return own
    return np.asarray(own + _TAKE_SD_MS**2 * (takes[:, None] == takes))


def _pads(runs: Sequence[LagRun]) -> Mapping[Piece, LagMean]:
    """Each pad over all runs."""
    pads = sorted({pad for run in runs for pad in run.pads})
    return {pad: _pooled([run.pads[pad] for run in runs if pad in run.pads]) for pad in pads}


def _apart(means: Mapping[Piece, LagMean]) -> tuple[Piece, float, float, float] | None:
    """The pad that is most surely apart from the others, by how much, and the interval; None of one pad."""
    if len(means) < 2:
        return None
    rows = []
    for pad, mean in means.items():
        rest = _pooled([other for piece, other in means.items() if piece is not pad])
        by, error = mean.mean_ms - rest.mean_ms, math.hypot(mean.error_ms, rest.error_ms)
        half = _PAD_FACTOR * mean.t * error
        rows.append((abs(by) - half, (pad, by, by - half, by + half)))
    return max(rows, key=lambda row: row[0])[1]
