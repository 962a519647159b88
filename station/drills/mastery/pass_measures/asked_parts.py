"""The parts of a lesson of which its goals ask something besides: a limb, or some bars."""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.labels import limb_name
from station.core.pieces import Limb
from station.drills.lesson import BarGoals, Lesson, PartGoals, Section


@dataclass(frozen=True, slots=True)
class Part:
    """A `limb`, or `bars` (first, last, from 0, inclusive), the other None; `name` is how a sentence calls it."""

    name: str
    limb: Limb | None = None
    bars: tuple[int, int] | None = None


@dataclass(frozen=True, slots=True)
class AskedPart:
    """What is asked of a part."""

    part: Part
    goals: PartGoals


def asked_parts(lesson: Lesson) -> tuple[AskedPart, ...]:
    """All parts of which the lesson's goals ask something: limbs in their own order, then bars as they are written."""
    limbs = [AskedPart(_of_limb(limb), lesson.goals.limbs[limb]) for limb in sorted(lesson.goals.limbs)]
    return (*limbs, *(AskedPart(_of_bars(each, lesson.sections), each.goals) for each in lesson.goals.bars))


def _of_limb(limb: Limb) -> Part:
    return Part(limb_name(limb), limb=limb)


def _of_bars(asked: BarGoals, sections: Sequence[Section]) -> Part:
    first, last = asked.first_bar, asked.last_bar
    return Part(bars_called(first, last, sections), bars=(first, last))


def bars_called(first: int, last: int, sections: Sequence[Section]) -> str:
    """Bars `first` to `last`, from 0, as people call them: `bars 3–4`, with their section where they lie in one."""
    numbers = f"bar {first + 1}" if first == last else f"bars {first + 1}–{last + 1}"
    name = next((each.name for each in sections if each.first_bar <= first and last <= each.last_bar), "")
    return f"{name} ({numbers})" if name else numbers
