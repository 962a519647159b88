"""What came out of a session, as the results page and its picture show it.

Asynchrony is played − written in ms, negative is early. Numbers without data are None and are not drawn.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from math import ceil

import numpy as np
from numpy.typing import NDArray

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.music.judgement import Label
from station.music.score import Score
from station.render.snapshot import ON_TIME_MS

ON_THE_BEAT_MS = 10.0
"""Full marks within 10 ms (HUMANS, Velocity and ears)."""
STEADY_MS, FAIRLY_STEADY_MS = 20.0, 35.0
"""Spread that is called steady, and fairly steady: the bounds of a good pass (TEACHING, Defaults)."""

NEARLY_ALL = 0.9
"""Share of the notes from which only their timing is spoken of (TEACHING, Defaults: a pass is at least 90 % right)."""
MOST_TICKS = 16
"""Numbers that have room on the time axis; our choice."""


Interval = tuple[float, float]


@dataclass(frozen=True, eq=False)
class ResultFacts:
    """A session's result.

    Rows of the arrays are the notes that were judged: `time_s`, `piece`, `label` of `Label`, `asynchrony_ms` NaN where
    nothing was played, `right` whether it was. `extra_s` when unwritten hits fell, `bar_s` where bars begin and the
    last ends; so far from its note a stroke is on time as `on_time_ms` says. `mean_ci` is the 95 % interval of the mean
    of all, None where it is not known; `passages` are there where the fills lie elsewhere than the groove.
    """

    words: "ResultWords"
    time_s: NDArray[np.float64]
    piece: NDArray[np.uint8]
    label: NDArray[np.uint8]
    asynchrony_ms: NDArray[np.float64]
    right: NDArray[np.bool_]
    extra_s: NDArray[np.float64]
    bar_s: NDArray[np.float64]
    on_time_ms: float = ON_TIME_MS
    mean_ci: Interval | None = None
    passages: "Passages | None" = None

    @property
    def known(self) -> NDArray[np.bool_]:
        """Which notes (n,) could be judged: not those of moments in which nothing could be heard."""
        return np.asarray(self.label != Label.UNKNOWN)

    def count(self, label: Label) -> int:
        """How many notes bear `label`; extras are counted apart."""
        return len(self.extra_s) if label is Label.EXTRA else int(np.count_nonzero(self.label == label))


@dataclass(frozen=True, slots=True)
class ResultWords:
    """What is written on a result beside its numbers.

    `points` 0–100, `advice` sentences on what to do next, `technique` lines on what hands and feet did; passes begin
    in the bars `starts` of the score, the first of which is the lesson's `first_bar`, from 0.
    """

    title: str
    subtitle: str
    points: float | None
    advice: tuple[str, ...] = ()
    technique: tuple[str, ...] = ()
    first_bar: int = 0
    starts: tuple[int, ...] = ()


def result_facts(
    score: Score,
    label: NDArray[np.uint8],
    asynchrony_ns: NDArray[np.int64],
    right: NDArray[np.bool_],
    extra_s: NDArray[np.float64],
    words: ResultWords,
) -> ResultFacts:
    """The facts of one alignment: `label`, `asynchrony_ns` and `right` (n,) belong to the rows of `score`."""
    paired = (label == Label.MATCH) | (label == Label.WRONG_PIECE)
    bars = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]
    return ResultFacts(
        words,
        score.onset_s,
        score.notes["piece"],
        label,
        np.where(paired, asynchrony_ns / 1e6, np.nan),
        right,
        extra_s,
        score.tempo_map.seconds_at(bars),
    )


@dataclass(frozen=True, slots=True)
class PieceLean:
    """How one piece lies: its name, notes and hits, and of these the mean and spread in ms.

    `mean_ci` is the 95 % interval of the mean, None where it is not known.
    """

    name: str
    notes: int
    hits: int
    mean_ms: float | None
    sd_ms: float | None
    mean_ci: Interval | None = None


@dataclass(frozen=True, slots=True)
class Passages:
    """The groove, and the mean of the fills in ms, which lies surely elsewhere."""

    groove: PieceLean
    fills_ms: float


def leans(facts: ResultFacts) -> Iterator[PieceLean]:
    """One lean a piece, in the order of `Piece`."""
    for piece in np.unique(facts.piece):
        mine = facts.piece == piece
        yield _lean(piece_name(Piece(int(piece))), facts, mine)


def whole_lean(facts: ResultFacts) -> PieceLean:
    """The lean of all notes together."""
    return replace(_lean("all", facts, np.ones(len(facts.piece), np.bool_)), mean_ci=facts.mean_ci)


def headline(facts: ResultFacts) -> str:
    """The whole in a few words: how much was right where that is less than nearly all, then bias and spread."""
    if not facts.count(Label.MATCH):
        return "nothing to judge"
    share = float(facts.right[facts.known].mean())
    right = "" if share >= NEARLY_ALL else f"{min(round(100 * share), ceil(100 * NEARLY_ALL) - 1)} % right; "
    return f"{right}{_time_in_words(facts)}"


def _time_in_words(facts: ResultFacts) -> str:
    """Bias and spread; of the groove where the fills lie elsewhere, so that nobody moves all for their sake."""
    if facts.passages is None:
        return in_words(whole_lean(facts))
    return f"{in_words(facts.passages.groove)} in the groove, {_side(facts.passages.fills_ms)} in the fills"


def ticks(facts: ResultFacts) -> tuple[str, list[tuple[int, str]]]:
    """What the time axis counts, and its marks: row of `bar_s` and number. Passes if several, else bars."""
    if len(facts.words.starts) > 1:
        every = max(1, round(len(facts.words.starts) / MOST_TICKS))
        return "pass", [(bar, str(number)) for number, bar in enumerate(facts.words.starts, 1)][::every]
    bars = len(facts.bar_s) - 1
    every = max(1, round(bars / MOST_TICKS))
    return "bar", [(bar, str(facts.words.first_bar + bar + 1)) for bar in range(0, bars, every)]


def _lean(name: str, facts: ResultFacts, rows: NDArray[np.bool_]) -> PieceLean:
    played = facts.asynchrony_ms[rows & (facts.label == Label.MATCH)]
    mean = float(played.mean()) if len(played) else None
    spread = float(played.std(ddof=1)) if len(played) > 1 else None
    return PieceLean(name, int((rows & facts.known).sum()), len(played), mean, spread)


def in_words(lean: PieceLean) -> str:
    """Bias and spread apart, as a teacher would say it: "steady but 14 ms late"."""
    if lean.mean_ms is None:
        return "nothing to judge"
    where = _where(lean.mean_ms, lean.mean_ci)
    on = where == _ON
    if lean.sd_ms is None:
        return where
    if lean.sd_ms <= STEADY_MS:
        return f"steady, {where}" if where == _UNSURE else f"steady {'and' if on else 'but'} {where}"
    if lean.sd_ms <= FAIRLY_STEADY_MS:
        return f"fairly steady, {where}"
    return f"uneven, {where}"


_ON, _UNSURE = "on the beat", "neither early nor late for sure"


def _where(mean_ms: float, ci: Interval | None) -> str:
    """The bias as far as its interval bears it: on the beat is what lies there as a whole."""
    if ci is None:
        return _ON if abs(mean_ms) <= ON_THE_BEAT_MS else _side(mean_ms)
    if max(-ci[0], ci[1]) <= ON_THE_BEAT_MS:
        return _ON
    return _side(mean_ms) if ci[0] * ci[1] > 0 else _UNSURE


def _side(ms: float) -> str:
    return f"{abs(ms):.0f} ms {'late' if ms > 0 else 'early'}"
