"""Who may teach a simulated learner: the mastery policy, and the rivals that it is compared with.

A tutor says what to play next and hears each pass. Tempi are percent of the target. The learners' own word for live
feedback is a share from 0 (blind) to 1 (every stroke is commented on); `FEEDBACK` says what ours stands for.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import date, timedelta
from types import MappingProxyType
from typing import Protocol

import numpy as np

from station.drills.mastery.equipment_faults import rewired
from station.drills.mastery.feedback_fading import Feedback
from station.drills.mastery.next_pass import begin, new_item, next_step
from station.drills.mastery.pass_measures.pass_facts import measure_pass
from station.drills.mastery.practice_steps import PassKind, PracticeItem
from station.drills.mastery.rules import DEFAULT_RULES, Rules
from station.drills.mastery.tempo_ladder import TOP_PCT
from station.drills.mastery.verdict import judge
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.simulation.learner import Learner

FULL_FEEDBACK = 1.0
PADS_FEEDBACK = 0.25
"""Only wrong pads and misses: about the share of strokes that go wrong on a bad pass (our choice)."""
FEEDBACK: Mapping[Feedback, float] = MappingProxyType(
    {Feedback.TIMING: FULL_FEEDBACK, Feedback.PADS: PADS_FEEDBACK, Feedback.NONE: 0.0}
)

FIRST_DAY = date(2024, 1, 1)
LETTER_RULES = Rules(broken_right=0.0, loose_share=0.0)
"""Without what our policy adds to its sources: no quick way down, no climbing with a loose pass."""


@dataclass(frozen=True, slots=True)
class TutorRequest:
    """A pass: bars (first, last), how often, percent of the target tempo, share of feedback.

    `on_ladder` whether it counts for the oscillation of the tempo (probes, weak bars and variations do not).
    """

    bars: tuple[int, int]
    repeats: int
    pct: float
    feedback: float
    on_ladder: bool = True


class Tutor(Protocol):
    """A teaching policy for one learner and one item."""

    chunks: set[int]
    """Bars that were practised alone."""

    def ask(self) -> TutorRequest | None:
        """The next pass; None: enough for today."""

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """What was played of it."""

    def new_day(self, day: int) -> None:
        """The `day`-th day (from 0) begins."""


class Mastery:
    """The policy of `station.drills.mastery`, fed by the station's own alignment."""

    def __init__(self, item: PracticeItem, rules: Rules = DEFAULT_RULES) -> None:
        self._rules = rules
        self.state = new_item(item, FIRST_DAY, rules)
        self.chunks: set[int] = set()

    def ask(self) -> TutorRequest | None:
        """What the policy asks for."""
        step = self.state.step
        if step.kind is PassKind.LEAVE:
            return None
        if step.kind is PassKind.CHUNK:
            self.chunks.add(step.bars[0])
        on_ladder = step.kind in (PassKind.WHOLE, PassKind.PROBE)
        return TutorRequest(step.bars, step.repeats, step.pct, FEEDBACK[step.feedback], on_ladder)

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """Align and measure the pass as the station does, and take the next step."""
        played = rewired(played, self.state.equipment.swap)
        result = measure_pass(score, played, align(score, played, clocked=True), bars)
        self.state, _ = next_step(self.state, result, self._rules)

    def new_day(self, day: int) -> None:
        """Open the next day."""
        self.state = begin(self.state, FIRST_DAY + timedelta(days=day), self._rules)


@dataclass(eq=False)
class FixedLadder:
    """`up_pct` faster after every `passes_a_rung` passes, however they went, up to the target; the whole, always."""

    item: PracticeItem
    passes_a_rung: int = 8
    feedback: float = FULL_FEEDBACK
    start_pct: float = DEFAULT_RULES.start_pct
    up_pct: float = DEFAULT_RULES.up_pct

    def __post_init__(self) -> None:
        self.chunks: set[int] = set()
        self._passes = 0

    def ask(self) -> TutorRequest | None:
        """The rung that is due."""
        pct = min(self.start_pct + self.up_pct * (self._passes // self.passes_a_rung), TOP_PCT)
        return TutorRequest(self.item.bars, 1, pct, self.feedback)

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """Count."""
        self._passes += 1

    def new_day(self, day: int) -> None:
        """Go on where it was."""


@dataclass(eq=False)
class Ratchet:
    """Up after two clean passes, never down (Drum Game); the whole, always."""

    item: PracticeItem
    feedback: float = FULL_FEEDBACK

    def __post_init__(self) -> None:
        self.chunks: set[int] = set()
        self._pct, self._clean = DEFAULT_RULES.start_pct, 0

    def ask(self) -> TutorRequest | None:
        """The rung that was reached."""
        return TutorRequest(self.item.bars, 1, self._pct, self.feedback)

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """Judge the pass by the same rules as ours."""
        result = measure_pass(score, played, align(score, played, clocked=True), bars)
        self._clean = self._clean + 1 if judge(result, DEFAULT_RULES).is_clean else 0
        if self._clean >= DEFAULT_RULES.clean_to_climb:
            self._pct, self._clean = min(self._pct + DEFAULT_RULES.up_pct, TOP_PCT), 0

    def new_day(self, day: int) -> None:
        """Go on where it was."""


@dataclass(eq=False)
class RandomTempo:
    """Any rung from the floor to the target, by lot; the whole, always."""

    item: PracticeItem
    seed: int
    feedback: float = FULL_FEEDBACK

    def __post_init__(self) -> None:
        self.chunks: set[int] = set()
        self._rng = np.random.default_rng([self.seed, 7])
        self._rungs = np.arange(DEFAULT_RULES.floor_pct, TOP_PCT + 1.0, DEFAULT_RULES.up_pct)

    def ask(self) -> TutorRequest | None:
        """Draw a rung."""
        return TutorRequest(self.item.bars, 1, float(self._rng.choice(self._rungs)), self.feedback)

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """Listen to nothing."""

    def new_day(self, day: int) -> None:
        """Go on."""


@dataclass(eq=False)
class Oracle:
    """Knows the learner's comfortable speeds, as nobody does: the bar that is hardest now, alone, just below its own.

    No policy; it says what can be reached at all in the time.
    """

    item: PracticeItem
    learner: Learner

    def __post_init__(self) -> None:
        self.chunks: set[int] = set()

    def ask(self) -> TutorRequest | None:
        """The hardest bar at the speed at which most is learnt of it."""
        comfort = self.learner.comfort(PADS_FEEDBACK)
        hardest = int(comfort.argmin())
        self.chunks.add(hardest)
        pct = min(TOP_PCT, round(100.0 * 2.0 ** (float(comfort[hardest]) - ORACLE_EASE_OCTAVES)))
        bar = self.item.first_bar + hardest
        return TutorRequest((bar, bar), 2, pct, PADS_FEEDBACK, on_ladder=False)

    def hear(self, score: Score, played: Performance, bars: tuple[int, ...]) -> None:
        """Nothing that it did not know."""

    def new_day(self, day: int) -> None:
        """Go on."""


ORACLE_EASE_OCTAVES = 0.1
"""So much slower than comfortable most strokes are right, and nearly as much is learnt (`Nature.challenge_octaves`)."""

TUTORS: Mapping[str, Callable[[PracticeItem, int, Learner], Tutor]] = MappingProxyType(
    {
        "ours": lambda item, seed, learner: Mastery(item),
        "ours, sources only": lambda item, seed, learner: Mastery(item, LETTER_RULES),
        "fixed ladder": lambda item, seed, learner: FixedLadder(item),
        "fixed ladder, pads only": lambda item, seed, learner: FixedLadder(item, feedback=PADS_FEEDBACK),
        "ladder of 4": lambda item, seed, learner: FixedLadder(item, passes_a_rung=4),
        "ratchet": lambda item, seed, learner: Ratchet(item),
        "random": lambda item, seed, learner: RandomTempo(item, seed),
        "none": lambda item, seed, learner: FixedLadder(item, start_pct=TOP_PCT),
        "oracle": lambda item, seed, learner: Oracle(item, learner),
    }
)
"""Policies by name: a tutor for an item, a seed and a learner, into which only the oracle looks. The fixed ladder stays
on a rung for eight passes, which is what a lesson plays by default; none is the target tempo from the start."""
