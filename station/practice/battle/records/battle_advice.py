"""What to practise after a battle: what cost a player most, and a shipped lesson of it that fits them.

In repeat mode phrases ask for a kind of coordination and of dynamics; of the kinds whose answers were lost the one with
the lowest mean accuracy is named. Where next to nothing was right it tells of no kind: something else was played, and
easier phrases or a slower tempo come first. Of improvisations it is the component with the fewest points. The lesson is
the one with a tag of that kind whose difficulty is nearest to what the player has reached, or else to the level that
they are judged by, in the ground's style where one is.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from statistics import fmean
from types import MappingProxyType

from station.drills.library import LessonRow, lesson_rows
from station.practice.battle.battle_result import BattleResult, JudgedTurn, is_lost
from station.practice.battle.judging.improvisation_marks import Component, ImprovisationMarks
from station.practice.battle.repeating.answer_marks import AnswerMarks, percent_of
from station.practice.battle.repeating.demands import demand_at
from station.practice.battle.vocabulary.asked_of_limbs import Coordination, Dynamics, coordination_of, dynamics_of
from station.scoring.matching.hit_windows import Level
from station.scoring.report.advice import SLOWER

STEPS_A_LEVEL = 4
"""How much harder a lesson a level asks for where nothing tells more (our choice: intermediate a third of the way)."""
NEXT_TO_NOTHING = 0.25
"""With fewer right notes of those that were asked something else was played (our choice)."""
GOOD_POINTS = 70.0
"""A component with so many points needs no lesson (our choice)."""


@dataclass(frozen=True, slots=True)
class Advice:
    """A sentence for a `side`, and the lesson that it names, None where none has what is asked."""

    side: int
    text: str
    lesson: str | None


@dataclass(frozen=True, slots=True)
class _Kind:
    """What is asked, in words, and the tags of lessons that teach it, the nearest first."""

    words: str
    tags: tuple[str, ...]


_KINDS: Mapping[Enum, _Kind] = MappingProxyType(
    {
        Coordination.HANDS: _Kind("what the hands play alone", ("singles", "sticking", "hands")),
        Coordination.WITH_KICK: _Kind("the kick between the hands", ("kick", "coordination", "independence")),
        Coordination.KIT: _Kind("moving over the kit", ("orchestrated", "toms", "fill")),
        Coordination.FOUR_LIMBS: _Kind("four limbs at once", ("four-way", "hi-hat-foot", "independence")),
        Dynamics.ACCENTS: _Kind("accents", ("accents", "dynamics")),
        Dynamics.GHOSTS: _Kind("ghost notes", ("ghosts",)),
        Dynamics.ORNAMENTS: _Kind("flams, drags and rolls", ("flams", "drags", "diddles", "rolls")),
        Component.TIME: _Kind("keeping time", ("time", "tempo", "groove")),
        Component.DYNAMICS: _Kind("loud and soft", ("accents",)),
        Component.VOCABULARY: _Kind("more to say", ("fill", "linear", "paradiddle")),
        Component.DEVELOPMENT: _Kind("taking a motif further", ("trading", "form")),
        Component.KIT: _Kind("the whole kit", ("orchestrated", "toms")),
        Component.SPACE: _Kind("leaving space", ("rests", "trading")),
    }
)


def practise_next(result: BattleResult) -> tuple[Advice, ...]:
    """At most one sentence for each player, in order of their sides."""
    found = (_advice(result, side) for side in result.rules.player_sides)
    return tuple(one for one in found if one is not None)


def advice_lines(result: BattleResult) -> tuple[str, ...]:
    """The same as lines of a report, which say whose they are where several play."""
    rules = result.rules
    whose = {side: "" if rules.is_solo else f" for {rules.player_of(side).name}" for side in rules.player_sides}
    return tuple(f"Next{whose[one.side]}: {one.text}" for one in practise_next(result))


def _advice(result: BattleResult, side: int) -> Advice | None:
    turns = [turn for turn in result.turns if turn.planned.side == side and turn.marks is not None]
    if (easier := _easier(result, turns)) is not None:
        return Advice(side, easier, None)
    weakest = _weakest_answer(result, turns) or _weakest_component(turns)
    if weakest is None:
        return None
    kind, measured = weakest
    lesson = _lesson(_KINDS[kind].tags, result.rules.ground.style, _step_reached(result, turns))
    where = "" if lesson is None else f"; {lesson.title} ({lesson.name}) is about it"
    return Advice(side, f"practise {_KINDS[kind].words}: {measured}{where}", None if lesson is None else lesson.name)


def _easier(result: BattleResult, turns: Iterable[JudgedTurn]) -> str | None:
    """What makes phrases easier, where next to nothing of them was right."""
    answers = [turn for turn in turns if isinstance(turn.marks, AnswerMarks) and turn.planned.step is not None]
    marks = [turn.marks for turn in answers if isinstance(turn.marks, AnswerMarks)]
    right, known = sum(one.right for one in marks), sum(one.known for one in marks)
    if not known or right >= NEXT_TO_NOTHING * known:
        return None
    easier = "easier phrases, or " if any(turn.planned.step for turn in answers) else ""
    slow = f"a slower tempo such as {SLOWER * result.rules.ground.tempo_bpm:.0f} bpm"
    return f"begin with {easier}{slow}: {right} of {known} notes were right"


def _weakest_answer(result: BattleResult, turns: Iterable[JudgedTurn]) -> tuple[Enum, str] | None:
    accuracies: dict[Enum, list[float]] = {}
    lost: set[Enum] = set()
    for turn in turns:
        phrase, marks = turn.planned.phrase, turn.marks
        if phrase is None or not isinstance(marks, AnswerMarks) or marks.accuracy is None:
            continue
        rows = phrase.score.notes
        kinds: tuple[Enum, ...] = (coordination_of(rows), dynamics_of(rows))
        for kind in kinds:
            if kind in _KINDS:
                accuracies.setdefault(kind, []).append(marks.accuracy)
                lost |= {kind} if is_lost(result.rules, turn) else set()
    if not lost:
        return None
    worst = min(lost, key=lambda one: (fmean(accuracies[one]), list(_KINDS).index(one)))
    return worst, f"{percent_of(fmean(accuracies[worst]))} % accuracy where phrases asked for it"


def _weakest_component(turns: Iterable[JudgedTurn]) -> tuple[Enum, str] | None:
    points: dict[Component, list[float]] = {}
    for turn in turns:
        for one in turn.marks.components if isinstance(turn.marks, ImprovisationMarks) else ():
            if one.points is not None:
                points.setdefault(one.component, []).append(one.points)
    if not points:
        return None
    weakest = min(points, key=lambda one: (fmean(points[one]), list(_KINDS).index(one)))
    mean = fmean(points[weakest])
    return None if mean >= GOOD_POINTS else (weakest, f"{mean:.0f} of 100 points")


def _step_reached(result: BattleResult, turns: Iterable[JudgedTurn]) -> int:
    asked = [t for t in turns if t.planned.step is not None]
    won = [t.planned.step or 0 for t in asked if not is_lost(result.rules, t)]
    usual = STEPS_A_LEVEL * list(Level).index(result.rules.level)
    return max(won, default=min([usual, *(t.planned.step or 0 for t in asked)]))


def _lesson(tags: Sequence[str], style: str, step: int) -> LessonRow | None:
    difficulty = demand_at(step).difficulty
    rows = [row for row in lesson_rows() if row.difficulty is not None]
    tagged = next((found for tag in tags if (found := [row for row in rows if tag in row.tags])), [])
    in_style = [row for row in tagged if style in row.tags] or tagged
    return min(in_style, key=lambda row: (abs((row.difficulty or 0.0) - difficulty), row.name), default=None)
