"""What the teacher's cues say of where a session is."""

from station.drills.directions import NO_DIRECTION, Direction, direction_at
from station.practice.now.whereabouts import place_of
from station.practice.session.session import Session


def direction_of(session: Session) -> Direction:
    """What the teacher's cues say of the bar that is played.

    In a count-in the view of the first bar is taken already, and its words are still to come; on the landing what held
    in the bar that led to it goes on.
    """
    plan, (bar, beat) = session.plan, place_of(session)
    if beat is None:
        return NO_DIRECTION
    if bar is None:
        first = direction_at(plan.lesson.cues, plan.first_bar)
        return Direction(view=first.view, style=first.style)
    return direction_at(plan.lesson.cues, min(bar - 1, plan.bars[1]))
