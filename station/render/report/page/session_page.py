"""What a page about one practice session says: figures, words and strokes, made by `station.scenes.report`.

Asynchrony is played − written in ms, negative is early. Bars count from 1 as in the lesson. An interval is one of 95 %.
No data is None, and is not drawn.
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score

Interval = tuple[float, float]
Floats = NDArray[np.float64]


class NoteState(StrEnum):
    """What became of a written note: of all its passes together, or of one."""

    MATCH = "match"
    EARLY = "early"
    LATE = "late"
    MISS = "miss"
    WRONG_PIECE = "wrong_piece"
    UNKNOWN = "unknown"
    """Nobody could hear it."""
    UNPLAYED = "unplayed"
    """No pass came so far."""


@dataclass(frozen=True, slots=True)
class NotePasses:
    """A note of the practised section over all passes that came so far.

    `played` of `passes` times it had its match, `wrong` times another piece was struck, `unknown` times nobody could
    hear it. `mean_ms` is over those in which it was played.
    """

    piece: str
    state: NoteState
    passes: int
    played: int = 0
    wrong: int = 0
    unknown: int = 0
    mean_ms: float | None = None


@dataclass(frozen=True, eq=False)
class JudgedBars:
    """The practised bars: `section`, whose row i is note i, and `notes` (n,) of it.

    Its first bar is the lesson's `first_bar`, from 1; `sections` are names by bars of it from 0. Tempi count beats of
    `beat_ticks`; within `on_time_ms` of its time a stroke is on time.
    """

    section: Score
    notes: tuple[NotePasses, ...]
    first_bar: int
    sections: tuple[tuple[int, str], ...]
    beats_a_minute: float
    beat_ticks: int
    on_time_ms: float
    passes: int


@dataclass(frozen=True, slots=True)
class TimingFigures:
    """How `strokes` lay about their time: mean and SD, each with its interval."""

    strokes: int
    mean_ms: float | None = None
    mean_ci: Interval | None = None
    sd_ms: float | None = None
    sd_ci: Interval | None = None


@dataclass(frozen=True, slots=True)
class GroupFigures:
    """The notes of one piece, limb or bar, called `name`; `extras` None where a group has none of its own."""

    name: str
    notes: int
    matched: int
    misses: int
    wrong: int
    extras: int | None
    timing: TimingFigures


@dataclass(frozen=True, slots=True)
class BarFigures:
    """One bar of the lesson over all passes: its group, how many notes were right, and the strokes nobody wrote."""

    bar: int
    group: GroupFigures
    right: int
    extras: int


@dataclass(frozen=True, eq=False)
class StrokeTiming:
    """Every timed stroke's asynchrony (n,) and what they come to.

    `has_own_clock`: they are measured against the student's own tempo, so that the mean says nothing.
    """

    asynchrony_ms: Floats
    figures: TimingFigures
    on_time_ms: float
    has_own_clock: bool


@dataclass(frozen=True, eq=False)
class LoudnessRow:
    """Strokes of one piece that are written alike: `kind` (ghost, plain, accent), `written` and `played` (n,) 1–127."""

    piece: str
    kind: str
    written: float
    played: Floats


@dataclass(frozen=True, eq=False)
class TempoLine:
    """The tempo that was kept, bar by bar, and the one that was asked for; times in s from the first beat.

    `at_s` and `beats_a_minute` (n,) are what was played; `asked_s` and `asked` (m,) from when on which tempo was asked,
    until `end_s`. `asks`: what asked for it, such as "click".
    """

    at_s: Floats
    beats_a_minute: Floats
    asked_s: Floats
    asked: Floats
    end_s: float
    asks: str
    median: float | None
    drift: float | None
    drift_ci: Interval | None


@dataclass(frozen=True, slots=True)
class Advised:
    """A sentence of what to practise next, and what stands behind it: bars, effect and drill in words; or nothing."""

    text: str
    details: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class ExamLine:
    """A criterion: points of what it is worth, and what was measured."""

    title: str
    points: str
    measured: str


@dataclass(frozen=True, slots=True)
class ExamResult:
    """What an exam came to."""

    total: str
    band: str
    lines: tuple[ExamLine, ...]
    remark: str = ""


@dataclass(frozen=True, slots=True)
class PassRow:
    """A pass, or the bars at one tempo: in words which, how fast, how much was right, and why or how it went."""

    which: str
    tempo: str
    bars: str
    right: str
    why: str


@dataclass(frozen=True, slots=True)
class WordList:
    """Sentences under a heading."""

    heading: str
    lines: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class SessionPage:
    """One session.

    `labels` are rows of what and which, such as ("Tempo", "80 bpm"); `score` 0–100; `remarks` come before all figures,
    for they change how those are read. `hands` are set against the motion that both have in common, where sensors on
    the sticks tell it: late there is behind. `lists` are further words; `foot` small print.
    """

    title: str
    student: str
    when: str
    labels: tuple[tuple[str, str], ...]
    score: float | None
    right: int
    notes: int
    misses: int
    wrong: int
    extras: int
    unknown: int
    played_again: int
    headline: str
    praise: str | None
    next_steps: tuple[Advised, ...]
    choices: tuple[str, ...]
    remarks: tuple[str, ...]
    exam: ExamResult | None
    bars: JudgedBars
    timing: StrokeTiming
    pieces: tuple[GroupFigures, ...]
    limbs: tuple[GroupFigures, ...]
    hands: tuple[GroupFigures, ...]
    by_bar: tuple[BarFigures, ...]
    loudness: tuple[LoudnessRow, ...]
    tempo: TempoLine
    passes_heading: str
    passes: tuple[PassRow, ...]
    lists: tuple[WordList, ...]
    foot: tuple[str, ...]

    @property
    def played_again_words(self) -> str:
        """What is said of strokes that were nobody's fault: they belong to another attempt at the same bars."""
        strokes = "1 stroke" if self.played_again == 1 else f"{self.played_again} strokes"
        return f"{strokes} of bars that were played again, which do not count"
