"""What a newcomer plays first: quarters at two tempi, so that their first minute tells a lag of equipment from a habit.

Two tempi five to three apart: over them a lag of the equipment stays what it is, and one that is a share of the beat
moves by half of itself. Six bars of each are 38 s (docs/calibration.md has what four bars and six can tell).
"""

from dataclasses import replace

from station.core.settings import Settings
from station.drills.library import find_lesson
from station.motion.sticking.hand_notes import Hands
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.rising_tempo import Rise

FIRST_GROOVE = "first-groove"
_SLOW_BPM, _FAST_BPM, _BARS = 60.0, 100.0, 6
FIRST_TIME = PlanOptions(tempo_bpm=_SLOW_BPM, loops=_BARS, rise=Rise(_FAST_BPM - _SLOW_BPM, _BARS, _FAST_BPM))


def first_groove(settings: Settings, hands: Hands | None = None) -> Plan:
    """The first session of a student: heard once, then played at both tempi; of two bars six are six at each tempo."""
    return plan_practice(find_lesson(FIRST_GROOVE), replace(FIRST_TIME, hands=hands, stands=settings.stands))
