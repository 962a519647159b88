"""The drummer's full stroke, as it is exported, against the real one that was measured (Pearl 2023).

The measured player is 1.9 m tall and raises the tip by 56 cm at 100 bpm; time zero of the measurement is the tip's
lowest sample. The peaks' times are those of HUMANS, One real stroke.
"""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.export.npz import motion_arrays
from station.motion.kinematics.figure import figure_of
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.real_data import DATA

Array = NDArray[np.float64]

RATE_HZ = 960
BEAT_S = 0.6
NATURAL = Style(variation=0.0)
FULL = replace(NATURAL, amplitude_gain=90.0)
"""Raises velocity 127 from fff's 15 inches to the measured player's 22."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """One stroke between two others: times from the strike, the tip's height over the head, its arm's angles."""

    time_s: Array
    height_m: Array
    angles_rad: dict[str, Array]

    @property
    def struck_by(self) -> str:
        """Whose movement swings the stick where measured wrists do: a traditional hand's forearm rolls instead."""
        return max(("wrist", "forearm"), key=lambda joint: float(np.ptp(self.angles_rad[joint])))

    def peak_s(self, joint: str) -> float:
        """When `joint` comes down fastest."""
        falling = (self.time_s > -0.2) & (self.time_s < 0.0)
        speed = np.gradient(self.angles_rad[joint], 1 / RATE_HZ)[falling]
        return float(self.time_s[falling][np.argmin(speed)])


def exported(style: Style, stature_m: float, limb: Limb) -> Stroke:
    notes = [Note(i * PPQ, Piece.SNARE, velocity=127, limb=limb) for i in range(8)]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(100)), figure=figure_of(stature_m), style=style)
    time_s = np.arange(-600, 41) / RATE_HZ
    arrays = motion_arrays(drummer, 4 * BEAT_S + time_s)
    side = "right" if limb == Limb.RIGHT_HAND else "left"
    names = arrays["joint_names"].tolist()
    angles = {n: arrays["angles_rad"][:, names.index(f"{side}_{n}")] for n in ("elbow", "wrist", "forearm", "stick")}
    height = arrays["tip_m"][:, int(limb), 2]
    return Stroke(time_s, height - height[600], angles)


def measured() -> tuple[Array, Array]:
    """Times and tip heights of the real stroke."""
    x, y = (
        np.genfromtxt(DATA / f"stroke/JointCenters_{axis}Pose_cm.csv", delimiter=",", skip_header=1) for axis in "XY"
    )
    lowest = int(np.nanargmin(y[:, 5]))
    return x[:, 0] - x[lowest, 0], (y[:, 5] - y[lowest, 5]) / 100


CASES = pytest.mark.parametrize(
    ("style", "stature_m", "limb"),
    [
        pytest.param(FULL, 1.9, Limb.RIGHT_HAND, id="as high"),
        pytest.param(FULL, 1.9, Limb.LEFT_HAND, id="left as high"),
        pytest.param(NATURAL, 1.759, Limb.RIGHT_HAND, id="natural"),
        pytest.param(NATURAL, 1.759, Limb.LEFT_HAND, id="left natural"),
        pytest.param(replace(NATURAL, grip_right="german"), 1.759, Limb.RIGHT_HAND, id="german"),
        pytest.param(replace(NATURAL, grip_right="french"), 1.759, Limb.RIGHT_HAND, id="french"),
        pytest.param(replace(FULL, grip_left="french"), 1.9, Limb.LEFT_HAND, id="left french, as high"),
        pytest.param(replace(NATURAL, grip_left="traditional"), 1.759, Limb.LEFT_HAND, id="traditional"),
        pytest.param(replace(FULL, grip_left="traditional"), 1.9, Limb.LEFT_HAND, id="traditional, as high"),
    ],
)


@CASES
def test_the_tips_height_over_the_stroke_is_like_the_measured_one(style: Style, stature_m: float, limb: Limb) -> None:
    real_s, real_m = measured()
    ours = exported(style, stature_m, limb)
    assert np.corrcoef(ours.height_m, np.interp(ours.time_s, real_s, real_m))[0, 1] >= 0.97


@CASES
def test_elbow_wrist_and_stick_peak_in_this_order_when_the_measured_ones_do(
    style: Style, stature_m: float, limb: Limb
) -> None:
    ours = exported(style, stature_m, limb)
    peaks = [ours.peak_s(joint) for joint in ("elbow", ours.struck_by, "stick")]
    assert peaks == pytest.approx([-0.062, -0.023, -0.008], abs=0.015)
    assert peaks == sorted(peaks)


@CASES
def test_it_rebounds_with_about_half_its_speed(style: Style, stature_m: float, limb: Limb) -> None:
    ours = exported(style, stature_m, limb)
    speed = np.diff(ours.height_m) * RATE_HZ
    falling, rising = -speed[596:600].mean(), speed[600:615].max()
    assert 0.4 <= rising / falling <= (0.65 if "french" in (style.grip_right, style.grip_left) else 0.6)


@pytest.mark.parametrize(
    ("style", "limb"),
    [
        (FULL, Limb.RIGHT_HAND),
        (FULL, Limb.LEFT_HAND),
        (replace(FULL, grip_right="german"), Limb.RIGHT_HAND),
        (replace(FULL, grip_right="french"), Limb.RIGHT_HAND),
        (replace(FULL, grip_left="traditional"), Limb.LEFT_HAND),
    ],
)
def test_from_the_measured_height_the_tip_falls_as_fast_as_the_measured_one(style: Style, limb: Limb) -> None:
    ours = exported(style, 1.9, limb)
    assert ours.height_m.max() == pytest.approx(0.56, abs=0.02)
    # the measured hand is palm down: a stroke as high that the fingers of a French grip make whips more
    rel = 0.3 if style.grip_right == "french" else 0.2
    assert -(np.diff(ours.height_m) * RATE_HZ)[596:600].mean() == pytest.approx(9.4, rel=rel)
