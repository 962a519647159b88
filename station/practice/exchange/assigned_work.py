"""What a student has done of an assignment that they took: per lesson the sessions, the best score, the goals."""

from dataclasses import dataclass
from datetime import date

from station.core.settings import Settings
from station.practice.exchange.assignment_file import AssignedLesson
from station.practice.exchange.lesson_goals import GoalState, goal_states
from station.practice.exchange.student_return import practised
from station.practice.exchange.student_store import TakenAssignment


@dataclass(frozen=True, slots=True, eq=False)
class LessonWork:
    """A lesson that was asked, what it is called `here`, and what was done of it; `best` is a score, None for none."""

    asked: AssignedLesson
    here: str
    sessions: int
    best: float | None
    goals: tuple[GoalState, ...]

    @property
    def is_done(self) -> bool:
        """Whether something was played, and no goal that the station can tell is left."""
        return self.sessions > 0 and all(state.reached is not False for state in self.goals)


def lesson_work(one: TakenAssignment, settings: Settings) -> tuple[LessonWork, ...]:
    """Every lesson of an assignment with what the student of `settings` did of it since they took it."""
    played = practised(settings, one)
    found = []
    for asked in one.assignment.lessons:
        figures = [each.figures for each in played if each.name == asked.name]
        best = max((each.score for each in figures if each.score is not None), default=None)
        here = one.taken.here(asked.name) or asked.name
        found.append(LessonWork(asked, here, len(figures), best, tuple(goal_states(asked.goals, figures))))
    return tuple(found)


def due_words(one: TakenAssignment, today: date) -> str:
    """When it is due, and how long that is."""
    due, left = one.assignment.due, one.days_left(today)
    if due is None or left is None:
        return "no due date"
    when = {0: "today", 1: "tomorrow"}.get(left) or (f"{left} days left" if left > 0 else f"{-left} days late")
    return f"due {due:%A}, {due.day} {due:%B}, {'1 day late' if left == -1 else when}"
