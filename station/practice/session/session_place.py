"""Where in the lesson a session is, as people count it, and what the teacher's cues say there."""

from station.drills.directions import NO_DIRECTION, Direction, direction_at
from station.practice.session.plan import Phase
from station.practice.session.session import Session


def place_of(session: Session) -> tuple[int | None, int | None]:
    """The lesson's bar and its beat, from 1, None where none is played; a count-in has beats alone."""
    state, plan = session.state(), session.plan
    segment = state.segment
    if state.transport_ns is None or state.transport_ns < segment.start_ns or segment.phase is Phase.OVER:
        return None, None
    music, start_ns = plan.music_of(segment)
    at = music.tempo_map.position_at(int(music.tempo_map.ticks_at_ns(state.transport_ns - start_ns)))
    if segment.phase is Phase.COUNT_IN:
        return None, at.beat + 1
    within = at.bar - segment.index * plan.section.bar_count if segment.phase is Phase.PASS else at.bar
    return plan.first_bar + within + 1, at.beat + 1


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
