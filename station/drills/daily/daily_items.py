"""What a daily plan is made of, as values: blocks of a few minutes, each with its reason. Bars count from 0."""

from dataclasses import dataclass
from datetime import date
from enum import StrEnum


class ItemKind(StrEnum):
    """What a block is for."""

    WARM_UP = "warm-up"
    """Hands and pulse, slowly and then a little faster; nothing is asked."""
    DUE = "due"
    """A review: does what was mastered still stick?"""
    WEAK_BARS = "weak bars"
    """The bars that go wrong, slowly, before the whole."""
    GO_ON = "go on"
    """What was begun and is not stable yet."""
    NEW = "new"
    """What was never practised."""
    KEEP = "keep"
    """What is stable, in turn with others, so that it lasts."""
    PLAY = "play"
    """The end: something that goes well, or just playing."""

    @property
    def label(self) -> str:
        """It as a heading."""
        return self.value.capitalize()


FOLLOWED = frozenset({ItemKind.DUE, ItemKind.GO_ON, ItemKind.NEW, ItemKind.KEEP})
"""The kinds whose tempo follows the student from pass to pass."""


@dataclass(frozen=True, slots=True)
class DailyItem:
    """A block: `passes` over `bars` (first, last, from 0) of `lesson` in about `minutes`, and `why` in one sentence.

    Just playing has no lesson. `tempo_pct` is the share of the lesson's target at which it begins, `beats_a_minute` the
    same in the beat that counts, `tempo_why` the reason. `gap` and `rise` are what `quiet_bars.gap_of` and
    `rising_tempo.rise_of` read, empty for a click throughout and a tempo that stays.
    """

    kind: ItemKind
    lesson: str
    title: str
    bars: tuple[int, int]
    tempo_pct: float
    beats_a_minute: float
    tempo_why: str
    minutes: int
    passes: int
    why: str
    gap: str = ""
    rise: str = ""

    @property
    def follows(self) -> bool:
        """Whether the tempo follows the student from pass to pass, from the one that stands here."""
        return self.kind in FOLLOWED


@dataclass(frozen=True, slots=True)
class DailyPlan:
    """The blocks of a `day` in the order in which they are to be played."""

    day: date
    items: tuple[DailyItem, ...]

    @property
    def minutes(self) -> int:
        """How long all takes."""
        return sum(item.minutes for item in self.items)


@dataclass(frozen=True, slots=True)
class Assigned:
    """What a teacher wants of a student: a `lesson` until the day `due` (None: whenever); `bars` None: its loop."""

    lesson: str
    due: date | None
    bars: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class PastDay:
    """What was `planned` for a day (kind and lesson of each block), and the lessons that were `practised` then."""

    day: date
    planned: tuple[tuple[ItemKind, str], ...] = ()
    practised: frozenset[str] = frozenset()

    @property
    def left_over(self) -> frozenset[str]:
        """The lessons that were planned and not practised."""
        return frozenset(lesson for _, lesson in self.planned if lesson) - self.practised
