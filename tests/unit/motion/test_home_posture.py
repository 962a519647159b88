"""The leading hand on the hi-hat over the other on the snare: 8 cm between forearm and stick, backbeats stay under.

The distances are what drummers look for; they are measured on the poses themselves, 240 a second.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.drills.library import find_lesson
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.body_solids import segments_apart
from station.motion.kinematics.figure import Joint
from station.motion.kit.kit import load_kit
from station.motion.sticking.limbs import as_led
from station.motion.style.style_file import load_style

Array = NDArray[np.float64]
FOREARM_OVER_M = 0.08
TIMES = np.arange(0.0, 8.0, 1 / 240)


def over_where_they_cross(a: Array, b: Array, c: Array, d: Array) -> Array:
    """How far the line ab is above the line cd at each moment at which they cross as seen from above."""
    u, v, w = (b - a)[:, :2], (d - c)[:, :2], (c - a)[:, :2]
    turned = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    p = (w[:, 0] * v[:, 1] - w[:, 1] * v[:, 0]) / turned
    q = (w[:, 0] * u[:, 1] - w[:, 1] * u[:, 0]) / turned
    crosses = (p > 0) & (p < 1) & (q > 0) & (q < 1)
    over: Array = (a[:, 2] + p * (b - a)[:, 2]) - (c[:, 2] + q * (d - c)[:, 2])
    return over[crosses]


@pytest.mark.parametrize("kit", ["four_piece", "left_handed"])
@pytest.mark.parametrize("lesson", ["rock-1", "funk-1", "disco-1", "shuffle-1"])
@pytest.mark.parametrize("style", ["natural", "dramatic"])
def test_the_leading_forearm_and_stick_pass_over_the_backbeat(lesson: str, kit: str, style: str) -> None:
    played = load_kit(kit)
    drummer = Drummer(as_led(find_lesson(lesson).score, played), played, style=load_style(style))
    rows = drummer.rows(TIMES)
    lead, other = (1, 0) if played.left_handed else (0, 1)
    joints = rows[:, frame.JOINTS].reshape(-1, 21, 3)
    sides = ((Joint.RIGHT_ELBOW, Joint.RIGHT_WRIST), (Joint.LEFT_ELBOW, Joint.LEFT_WRIST))
    elbow, wrist = (joints[:, joint] for joint in sides[lead])
    butt, tip = (rows[:, part].reshape(-1, 2, 3) for part in (frame.BUTT, frame.TIP))
    assert segments_apart(butt[:, other], tip[:, other], elbow, wrist).min() >= FOREARM_OVER_M
    sticks = over_where_they_cross(butt[:, lead], tip[:, lead], butt[:, other], tip[:, other])
    assert len(sticks) > 0.2 * len(TIMES)  # they are crossed much of the time, else forearm and stick
    assert sticks.min() > 0.035  # and the backbeat's stick stays under the leading one
