"""A body beside its phase: what lights up when, and where its bones are."""

import numpy as np
import pytest

from station.core.pieces import Limb
from station.render.phase.phase_plot import PhaseMark, PhaseTrace
from station.render.phase.walker import Walker
from station.render.text.atlas import Atlas
from station.scenes.phase_view import FLASH_S, WalkingScene

NAMES = ("root", "rfemur", "rfoot", "lfemur", "lfoot")
BONES = ((0, 1), (1, 2), (0, 3), (3, 4))


def scene() -> WalkingScene:
    """A root that goes ahead by a metre a second, with straight legs."""
    time_s = np.arange(11) / 10
    places = np.zeros((11, 5, 3))
    places[:, :, 2] = time_s[:, None]
    places[:, :, 1] = [1.0, 0.9, 0.0, 0.9, 0.0]
    marks = (PhaseMark(0.5, Limb.RIGHT_FOOT, 0.25), PhaseMark(0.2, Limb.LEFT_FOOT))
    trace = PhaseTrace("a", time_s, time_s % 1.0, np.ones(11), np.ones(11, bool), marks)
    return WalkingScene(Walker.of(NAMES, BONES), places, trace)


def test_a_foot_lights_up_as_its_trigger_sounds_and_fades() -> None:
    assert scene().struck(0.49) == {}
    assert scene().struck(0.5) == {Limb.RIGHT_FOOT: 1.0}
    assert scene().struck(0.5 + FLASH_S / 2) == {Limb.RIGHT_FOOT: pytest.approx(0.5)}
    assert scene().struck(0.5 + FLASH_S) == {}


def test_a_footfall_alone_lights_nothing() -> None:
    assert scene().struck(0.21) == {}


def test_sides_are_told_by_the_near_ends_of_bones() -> None:
    right, left = Limb.RIGHT_FOOT, Limb.LEFT_FOOT
    assert Walker.of(NAMES, BONES).sides == (Limb.UNKNOWN, right, Limb.UNKNOWN, left)
    assert Walker.of(("Hips", "RightLeg", "RightFoot"), ((0, 1), (1, 2))).sides == (Limb.UNKNOWN, right)


def test_the_camera_goes_with_the_body() -> None:
    """The body stands in the same place of the picture at every time; the plot's line goes on."""
    atlas, seen = Atlas(), scene()
    _, axes = seen.still(atlas, "a")
    early, late = (seen.moving(atlas, axes, at_s) for at_s in (0.2, 0.4))
    lines = [shapes[(shapes["half"][:, 1] > 50)] for shapes in (early, late)]
    assert lines[1]["centre"][0, 0] > lines[0]["centre"][0, 0]
    dots = [shapes["centre"][shapes["kind"] == 1] for shapes in (early, late)]
    assert dots[0][:4] == pytest.approx(dots[1][:4], abs=1e-3)
