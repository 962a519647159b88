"""Whose hand leads, and the kit that the drummer plays for it: as lessons are built, right-handed, left-handed, open.

A left-handed drummer sits at the lesson's kit mirrored; an open-handed one at a right-handed kit, whose hi-hat the left
hand plays uncrossed. The student reads the same hands: every stroke of a plan has its limb.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.settings import Settings, settings_path
from station.drills.lesson import Lesson
from station.motion.kit.kit import DEFAULT_KIT, Kit, load_kit
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import as_led, limbs_and_reasons
from station.music.score import Score


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


def with_sticking(section: Score, kit: Kit, hands: Hands | None) -> Score:
    """The section with a limb for every stroke: the written one, else the one that the drummer takes.

    So the demonstration, the per-limb figures and the advice all speak of the same hands.
    """
    led = as_led(section, kit, hands)
    limbs, _ = limbs_and_reasons(led, kit, hands=hands)
    return led.with_limbs(limbs)


def led_to_landing(
    section: Score, landing: NDArray[np.void], kit: Kit, hands: Hands | None
) -> tuple[Score, NDArray[np.void]]:
    """Both with a limb for every stroke; the hands land as they come out of the section."""
    led = with_sticking(section.landing_on(landing), kit, hands).notes
    rows = led[len(section) :].copy()
    rows["tick"] = 0
    return replace(section, notes=led[: len(section)]), rows
