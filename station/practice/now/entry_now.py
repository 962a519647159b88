"""Whether a student plays beside the click, steadily, and by how much: said while they play."""

from station.core.units import PPQ
from station.drills.mastery.feedback_fading import Feedback
from station.practice.session.session import Session
from station.scoring.analysis.entries import in_words


def entry_words(session: Session) -> str:
    """That the student came in late or early, empty where they did not, or where they are shown nothing of it."""
    quarters = session.beats_behind
    if not quarters or session.feedback is Feedback.NONE:
        return ""
    meter = session.plan.section.tempo_map.meter_at(0)
    by = in_words(abs(quarters), session.plan.lesson.beat_ticks, meter.bar_ticks)
    if quarters * PPQ % meter.bar_ticks == 0:
        return f"You are {by} {'behind' if quarters > 0 else 'ahead of'} the click: your strokes count there"
    return f"You came in {by} {'late' if quarters > 0 else 'early'}: your strokes count there"
