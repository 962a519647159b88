"""Whether a student plays beside the click, steadily, and by how much: said while they play."""

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
    return f"You came in {by} {'late' if quarters > 0 else 'early'}: your strokes count there"
