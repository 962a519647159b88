"""How far a day's plan is: which blocks were played, which was left out, which comes next. Pure."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from station.drills.daily.daily_items import DailyItem, DailyPlan
from station.practice.book.book_day import BookDay
from station.practice.book.practised import PractisedSession

DONE_SHARE = 0.5
"""A block that was stopped early is done with half of its minutes (our choice: passes are counted generously)."""


class BlockState(StrEnum):
    """What became of a block."""

    OPEN = "open"
    DONE = "done"
    LEFT_OUT = "left out"


@dataclass(frozen=True, slots=True)
class Block:
    """A block of the plan, its place in it from 0, what became of it, and the seconds that were played of it."""

    place: int
    item: DailyItem
    state: BlockState
    played_s: float = 0.0


@dataclass(frozen=True, slots=True)
class DayProgress:
    """The blocks of a day in order, and `beside`, the sessions that belong to none of them."""

    blocks: tuple[Block, ...]
    beside: tuple[PractisedSession, ...] = ()

    @property
    def next(self) -> Block | None:
        """The block to play now; None where all were played or left out."""
        return next((block for block in self.blocks if block.state is BlockState.OPEN), None)

    @property
    def done(self) -> int:
        """How many blocks were played."""
        return sum(block.state is BlockState.DONE for block in self.blocks)

    @property
    def minutes(self) -> float:
        """Minutes played on the day, of whatever."""
        return (sum(b.played_s for b in self.blocks) + sum(s.played_s for s in self.beside)) / 60.0

    @property
    def is_over(self) -> bool:
        """Whether a plan was there and nothing of it is open."""
        return bool(self.blocks) and self.next is None


def day_progress(day: BookDay, sessions: Sequence[PractisedSession]) -> DayProgress:
    """How far a day is; each session counts for the first block of its lesson that is still open."""
    played_s = [0.0] * len(day.items)
    done = [False] * len(day.items)
    beside = []
    for session in sessions:
        places = (at for at, item in enumerate(day.items) if item.lesson == session.lesson and not done[at])
        at = next((at for at in places if at not in day.left_out), None)
        if at is None:
            beside.append(session)
            continue
        played_s[at] += session.played_s
        done[at] = session.complete or played_s[at] >= DONE_SHARE * 60.0 * day.items[at].minutes
    states = [_state(at in day.left_out, done[at]) for at in range(len(day.items))]
    blocks = (Block(at, item, states[at], played_s[at]) for at, item in enumerate(day.items))
    return DayProgress(tuple(blocks), tuple(beside))


def _state(is_left_out: bool, is_done: bool) -> BlockState:
    if is_left_out:
        return BlockState.LEFT_OUT
    return BlockState.DONE if is_done else BlockState.OPEN


def plan_in(day: BookDay) -> DailyPlan | None:
    """The plan that a day has; None where none was made."""
    return DailyPlan(day.day, day.items) if day.items else None
