"""A trial of daily plans on simulated learners: weeks of 20 minutes a day over a course, ours against two others.

Whoever plans the day says which lesson each block has; within a block the mastery policy teaches in every case, so that
only the choice differs. `plan` is the station's daily plan, `random` draws a lesson of the course for every block of
five minutes, `new` takes the course's next lesson every day and begins again behind the last. A learner has one memory
for each lesson; while one is played the others rest, and all rest over night. A week after the last day every lesson of
the course is played four times, blind, at its target. It validates the planner, not people.
"""

import math
from collections import Counter
from dataclasses import dataclass, field
from datetime import date, timedelta
from functools import lru_cache
from random import Random

from station.bench.rigs.mastery_tutors import FEEDBACK, FIRST_DAY, PADS_FEEDBACK
from station.core.units import s_from_ns
from station.drills.daily.daily_items import DailyItem, ItemKind, PastDay
from station.drills.daily.day_facts import MINUTES, DayFacts
from station.drills.daily.day_plan import daily_plan
from station.drills.library import find_lesson
from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import begin, new_item, next_step
from station.drills.mastery.pass_measures.pass_facts import measure_pass
from station.drills.mastery.practice_steps import PassKind, PracticeItem, item_of
from station.drills.mastery.rules import DEFAULT_RULES
from station.drills.mastery.tempo_ladder import TOP_PCT
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.simulation.learner import Exercise, Learner
from station.simulation.learner_kinds import LEARNERS
from station.simulation.student_limbs import limbs_of

COURSE = (
    *("rock-1", "rock-2", "rock-3", "rock-4", "rock-5", "rock-fill-1"),
    *("shuffle-fill-1", "half-time-fill-1", "bossa-fill-1", "linear-fill-1"),
)
"""Ten shipped lessons of two and four bars, about as a teacher would give them."""
PLANNERS = ("plan", "random", "new")
BLOCK_MINUTES = 5
DAY_S = 86_400.0
EXAM_PASSES = 4


@dataclass(frozen=True, slots=True)
class DailyOutcome:
    """What became of one learner after so many `days`: lessons held then, shares in percent, None where there is none.

    `week_pct` of the notes right a week later, over the whole course; `reviews` that came due while there was a day to
    play them, `on_day_pct` of them played on their day or the next; `minutes_pct` of the planned time that was played;
    `longest_wait` the days that something begun and not stable waited at most.
    """

    days: int
    held: int
    begun: int
    week_pct: float
    reviews: int
    on_day_pct: float | None
    minutes_pct: float
    longest_wait: int


def daily_trial(planner: str, kind: str, seed: int, days: int = 60) -> DailyOutcome:
    """Teach one learner for so many days."""
    trial = _Trial(planner, kind, seed)
    for number in range(days):
        trial.day(FIRST_DAY + timedelta(days=number), number)
    return trial.outcome(days)


@dataclass
class _Trial:
    planner: str
    kind: str
    seed: int
    states: dict[str, ItemState] = field(default_factory=dict)
    history: list[PastDay] = field(default_factory=list)
    late: list[int] = field(default_factory=list)
    waits: Counter[str] = field(default_factory=Counter)
    longest_wait: int = 0
    played_s: float = 0.0

    def __post_init__(self) -> None:
        self.items: dict[str, PracticeItem] = {name: item_of(find_lesson(name)) for name in COURSE}
        self.learners = {
            name: Learner(LEARNERS[self.kind], 100 * self.seed + n, len(item.bar_notes))
            for n, (name, item) in enumerate(self.items.items())
        }

    def outcome(self, days: int) -> DailyOutcome:
        """What has become of it after so many days, and a week later."""
        for learner in self.learners.values():
            learner.rest(6 * DAY_S)
        right = [self._exam(name, learner) for name, learner in self.learners.items()]
        return DailyOutcome(
            days=days,
            held=sum(state.is_settled(DEFAULT_RULES) for state in self.states.values()),
            begun=len(self.states),
            week_pct=100.0 * sum(right) / len(right),
            reviews=len(self.late),
            on_day_pct=100.0 * sum(late <= 1 for late in self.late) / len(self.late) if self.late else None,
            minutes_pct=100.0 * self.played_s / (60.0 * MINUTES * days),
            longest_wait=self.longest_wait,
        )

    # --- a day -------------------------------------------------------------------------------------------------------

    def day(self, today: date, number: int) -> None:
        """One day and the night after it."""
        practised = set()
        for item in self._items(today, number):
            practised.add(item.lesson)
            if item.follows or self.planner != "plan":
                self._teach(item, today)
            else:
                self._let_play(item)
        for name, state in self.states.items():
            is_waiting = not state.is_settled(DEFAULT_RULES) and name not in practised
            self.waits[name] = self.waits[name] + 1 if is_waiting else 0
        self.longest_wait = max([self.longest_wait, *self.waits.values()])
        for learner in self.learners.values():
            learner.rest(DAY_S - 60.0 * MINUTES)

    def _items(self, today: date, number: int) -> tuple[DailyItem, ...]:
        if self.planner == "plan":
            plan = daily_plan(self._facts(today)).items
            blocks = tuple((item.kind, item.lesson) for item in plan)
            self.history.append(PastDay(today, blocks, frozenset(lesson for _, lesson in blocks)))
            return plan
        draw = Random(f"{self.seed}/{number}")
        names = [draw.choice(COURSE) if self.planner == "random" else COURSE[number % len(COURSE)] for _ in range(4)]
        return tuple(
            DailyItem(ItemKind.GO_ON, name, name, (0, 0), TOP_PCT, 0.0, "", BLOCK_MINUTES, 1, "") for name in names
        )

    def _facts(self, today: date) -> DayFacts:
        ahead = tuple(n for n in COURSE if n not in self.states or not self.states[n].is_settled(DEFAULT_RULES))
        return DayFacts(
            today=today,
            states=tuple(self.states.values()),
            item_of=lambda name, _bars: self.items.get(name),
            course="the course",
            course_lessons=ahead,
            history=tuple(self.history),
            seed=self.seed,
        )

    # --- a block -----------------------------------------------------------------------------------------------------

    def _teach(self, block: DailyItem, today: date) -> None:
        """Pass after pass by the mastery policy, until the minutes are over or it says enough."""
        item = self.items[block.lesson]
        known = self.states.get(block.lesson)
        if known is not None and known.review.due is not None and known.review.due <= today:
            self.late.append((today - known.review.due).days)
        state = new_item(item, today) if known is None else begin(known, today)
        left_s = 60.0 * block.minutes
        while left_s > 0 and state.step.kind is not PassKind.LEAVE:
            step = state.step
            score = self._score(item, step.bar_names, step.pct)
            played = self._practise(block.lesson, score, step.bar_names, step.pct, FEEDBACK[step.feedback])
            alignment = align(score, played, clocked=True)
            state, _ = next_step(state, measure_pass(score, played, alignment, step.bar_names))
            left_s -= s_from_ns(score.length_ns)
        self.states[block.lesson] = state

    def _let_play(self, block: DailyItem) -> None:
        """A block that nobody judges: from its tempo on, halfway up where it rises."""
        if block.lesson not in self.items:
            self.played_s += 60.0 * block.minutes
            return
        item, left_s = self.items[block.lesson], 60.0 * block.minutes
        top = float(block.rise.partition(":")[2]) if block.rise else block.beats_a_minute
        pct = block.tempo_pct * math.sqrt(top / block.beats_a_minute)
        bars = tuple(range(block.bars[0], block.bars[1] + 1))
        score = self._score(item, bars, pct)
        while left_s > 0:
            self._practise(block.lesson, score, bars, pct, PADS_FEEDBACK)
            left_s -= s_from_ns(score.length_ns)

    def _practise(self, name: str, score: Score, bars: tuple[int, ...], pct: float, feedback: float) -> Performance:
        first = self.items[name].first_bar
        exercise = Exercise(score, tuple(bar - first for bar in bars), pct / 100.0, feedback)
        played = self.learners[name].practise(exercise).performance
        length_s = s_from_ns(score.length_ns)
        self.played_s += length_s
        for other, learner in self.learners.items():
            if other != name:
                learner.rest(length_s)
        return played

    def _exam(self, name: str, learner: Learner) -> float:
        """The share of notes right, blind, at the target tempo, as the station hears them."""
        item = self.items[name]
        bars = tuple(range(item.bars[0], item.bars[1] + 1)) * EXAM_PASSES
        score = self._score(item, bars, TOP_PCT)
        exercise = Exercise(score, tuple(bar - item.first_bar for bar in bars), 1.0)
        played = learner.examined(exercise).performance
        result = measure_pass(score, played, align(score, played, clocked=True), bars)
        return result.right / result.notes

    def _score(self, item: PracticeItem, bars: tuple[int, ...], pct: float) -> Score:
        return _score_of(item.name, bars, round(pct, 3))


_lesson = lru_cache(maxsize=len(COURSE))(find_lesson)
"""A shipped lesson, read once."""


@lru_cache(maxsize=1024)
def _score_of(name: str, bars: tuple[int, ...], pct: float) -> Score:
    """Bars of a lesson, in runs as often as they are named, at a share of the target tempo, with limbs."""
    lesson = _lesson(name)
    once = sorted(set(bars))
    speed = pct / 100.0 * lesson.target_tempo_bpm / lesson.tempo_bpm
    score = lesson.score.bars(once[0], once[-1]).at_speed(speed).repeated(len(bars) // len(once))
    return score.with_limbs(limbs_of(score))
