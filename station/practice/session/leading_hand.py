"""Whose hand leads, and the kit that the drummer plays for it: as lessons are built, right-handed, left-handed, open.

A left-handed drummer sits at the lesson's kit mirrored; an open-handed one at a right-handed kit, whose hi-hat the left
hand plays uncrossed. The student reads the same hands (`plan`).
"""

from station.core.errors import BadInput
from station.core.settings import Settings, settings_path
from station.drills.lesson import Lesson
from station.motion.kit.kit import DEFAULT_KIT, Kit, load_kit
from station.motion.sticking.hand_notes import Hands


def hands_of(settings: Settings) -> Hands | None:
    """Who leads by the settings, None for as the kit is built; raises `BadInput` that names the setting."""
    words = [hands.value for hands in Hands]
    if settings.hands and settings.hands not in words:
        expected = f"expected one of {', '.join(words)}, or nothing, found {settings.hands!r}"
        raise BadInput(settings_path(), "hands", expected)
    return Hands(settings.hands) if settings.hands else None


def drummers_kit(lesson: Lesson, hands: Hands | None, stands: str = "") -> Kit:
    """The kit that `stands` names, else the lesson's, mirrored where it is built for the other hand.

    Raises `BadInput` for a kit that is none.
    """
    kit = load_kit(stands or lesson.kit or DEFAULT_KIT)
    if hands is None or kit.left_handed == (hands is Hands.LEFT):
        return kit
    return kit.mirrored
