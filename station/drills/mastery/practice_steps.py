"""What is asked of a student: an item to practise, and the next pass over it.

Tempi are percent of the target tempo; bars count from 0.
"""

import math
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from station.core.units import NS_PER_S, PPQ
from station.drills.lesson import Lesson
from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.rules import Rules
from station.drills.orchestration import can_reorchestrate


class PassKind(StrEnum):
    """What a pass is for."""

    WHOLE = "whole"
    """All bars at the ladder's tempo."""
    CHUNK = "chunk"
    """A weak bar alone."""
    PROBE = "probe"
    """All bars at the ladder's tempo, blind."""
    TARGET_PROBE = "target_probe"
    """All bars at the target tempo, blind, tried once on the way up."""
    REVIEW = "review"
    """All bars at the target tempo, blind, another day."""
    VARIATION = "variation"
    """All bars of a stable item, a little slower or faster than the target, or on the other cymbal."""
    LEAVE = "leave"
    """Nothing more today; who plays on all the same plays the whole."""


PROBES = frozenset({PassKind.PROBE, PassKind.TARGET_PROBE, PassKind.REVIEW})


@dataclass(frozen=True, slots=True)
class PracticeItem:
    """Something to practise: bars `first_bar` … of a lesson, looped.

    `bar_notes` and `bar_s` have the strokes and the length in seconds at the target tempo of each bar. `target_bpm`
    counts quarter notes, `beat_quarters` says how many of them make the beat that a student counts, and
    `can_reorchestrate` whether there is timekeeping that can move to another cymbal.
    """

    name: str
    target_bpm: float
    first_bar: int
    bar_notes: tuple[int, ...]
    bar_s: tuple[float, ...]
    beat_quarters: float = 1.0
    can_reorchestrate: bool = False

    @property
    def bars(self) -> tuple[int, int]:
        """First and last bar."""
        return self.first_bar, self.first_bar + len(self.bar_notes) - 1

    def bpm(self, pct: float) -> float:
        """Quarter notes a minute at `pct` of the target tempo."""
        return self.target_bpm * pct / 100.0

    def beats(self, pct: float) -> str:
        """The tempo as a student reads it."""
        return f"{self.bpm(pct) / self.beat_quarters:.0f} bpm"

    def repeats(self, bars: tuple[int, int], rules: Rules, gap: tuple[int, int] | None = None) -> int:
        """How often `bars` are played a pass so that it says something, and so that a click with a `gap` comes back."""
        notes = sum(self.bar_notes[bars[0] - self.first_bar : bars[1] - self.first_bar + 1])
        least = max(rules.least_bars / (bars[1] - bars[0] + 1), rules.least_notes / max(notes, 1))
        often = math.ceil(min(least, rules.least_notes))
        return often if gap is None else max(often, math.ceil((sum(gap) + 1) / (bars[1] - bars[0] + 1)))


@dataclass(frozen=True, slots=True)
class PracticeStep:
    """The next pass: `bars` (first, last) played `repeats` times at `tempo_bpm` (quarter notes), `pct` of the target.

    `why` is one sentence. `notice` is what the student should read once besides, such as a fault of the
    equipment. `gap` is how many bars the click sounds and is silent in turn, None where it sounds throughout.
    `reorchestrated` whether the timekeeping moves to the other cymbal.
    """

    kind: PassKind
    pct: float
    tempo_bpm: float
    bars: tuple[int, int]
    repeats: int
    feedback: Feedback
    why: str
    notice: str | None = None
    gap: tuple[int, int] | None = None
    reorchestrated: bool = False

    @property
    def is_probe(self) -> bool:
        """Whether the pass is blind and moves mastery."""
        return self.kind in PROBES

    @property
    def bar_names(self) -> tuple[int, ...]:
        """The lesson's bar of each bar that is played."""
        return tuple(range(self.bars[0], self.bars[1] + 1)) * self.repeats


def item_of(lesson: Lesson, bars: tuple[int, int] | None = None) -> PracticeItem:
    """The `bars` (first, last) of a lesson, its loop if None, as an item."""
    first, last = lesson.loop if bars is None else bars
    score = lesson.score.at_speed(lesson.target_tempo_bpm / lesson.tempo_bpm)
    starts = score.tempo_map.ns_at([score.tempo_map.bar_start(bar) for bar in range(first, last + 2)])
    notes = np.bincount(score.bar, minlength=last + 1)[first : last + 1]
    return PracticeItem(
        name=lesson.name,
        target_bpm=lesson.target_tempo_bpm,
        first_bar=first,
        bar_notes=tuple(notes.tolist()),
        bar_s=tuple((np.diff(starts) / NS_PER_S).tolist()),
        beat_quarters=lesson.beat_ticks / PPQ,
        can_reorchestrate=can_reorchestrate(lesson.score),
    )
