"""What a teacher asks of a lesson in an assignment, and what a student's sessions have reached of it."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import floor

from station.core.toml.schema import Field, Fields, choice, number, optional, whole
from station.music.tempo import MAX_BPM, MIN_BPM
from station.practice.exchange.plain_words import or_none, words
from station.practice.exchange.session_figures import MOST_PASSES, SessionFigures
from station.scoring.matching.hit_windows import OUR_LEVELS, Level

MOST_MINUTES = 10_000
"""Our choice: an hour a day for half a year."""


@dataclass(frozen=True, slots=True)
class LessonGoals:
    """What is asked: None and an empty text ask nothing.

    `tempo_bpm` in the lesson's beats, to be reached in a session without a missed goal; `level` how strictly that is
    judged at least; `passes` and `minutes` of practice in all; `words` what no program can tell.
    """

    tempo_bpm: float | None = None
    level: Level | None = None
    passes: int | None = None
    minutes: float | None = None
    words: str = ""


GOAL_FIELDS: Fields = {
    "tempo_bpm": optional(or_none(number(MIN_BPM, MAX_BPM))),
    "level": optional(or_none(choice(OUR_LEVELS, "level"))),
    "passes": optional(or_none(whole(1, MOST_PASSES))),
    "minutes": optional(or_none(number(0.1, MOST_MINUTES))),
    "words": Field(words, ""),
}


@dataclass(frozen=True, slots=True)
class GoalState:
    """A goal in `words`, and whether it is `reached`; None where only the teacher can tell."""

    words: str
    reached: bool | None


def goal_states(goals: LessonGoals, sessions: Iterable[SessionFigures]) -> list[GoalState]:
    """Every goal that is asked, and whether these sessions of the lesson have reached it together."""
    played = list(sessions)
    states: list[GoalState] = []
    if goals.tempo_bpm is not None or goals.level is not None:
        states.append(GoalState(_played_words(goals), any(_is_reached(goals, one) for one in played)))
    if goals.passes is not None:
        passes = sum(one.passes for one in played if one.complete)
        states.append(GoalState(f"{passes} of {goals.passes} passes", passes >= goals.passes))
    if goals.minutes is not None:
        minutes = sum(one.seconds for one in played) / 60
        states.append(GoalState(f"{_minutes(minutes)} of {goals.minutes:g} minutes", minutes >= goals.minutes))
    if goals.words:
        states.append(GoalState(goals.words, None))
    return states


def _minutes(minutes: float) -> str:
    """Cut off, so that no goal looks reached before it is; a short time to a tenth."""
    return f"{floor(minutes)}" if minutes >= 1 else f"{floor(10 * minutes) / 10:g}"


def _played_words(goals: LessonGoals) -> str:
    tempo = "" if goals.tempo_bpm is None else f" at {goals.tempo_bpm:g} bpm"
    level = "" if goals.level is None else f", judged as {goals.level} or more strictly"
    return f"clean{tempo}{level}"


_SAME_BPM = 0.01
"""Tempi that nobody tells apart: what the rounding of a report leaves (our choice)."""


def _is_reached(goals: LessonGoals, session: SessionFigures) -> bool:
    """Whether this session alone has tempo and level, was played to its end and missed none of the lesson's goals.

    A teacher who has ruled on it has the last word.
    """
    if session.ruled is not None:
        return session.ruled
    order = list(OUR_LEVELS.values())
    fast = goals.tempo_bpm is None or session.beats_a_minute >= goals.tempo_bpm - _SAME_BPM
    strict = goals.level is None or order.index(session.level) >= order.index(goals.level)
    return fast and strict and session.is_clean
