"""Strokes against the measured one and against the table of heights, for a plain arm."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.motion.kinematics.arm import ArmLengths
from station.motion.strokes.amplitudes import amplitudes
from station.motion.strokes.stroke import Sliders, StrokePlan, Strokes
from station.motion.strokes.stroke_heights import INCH_M, stroke_height_m
from tests.real_data import DATA

Array = NDArray[np.float64]

LENGTHS = ArmLengths(upper=0.353, fore=0.277, hand=0.163, ahead=0.27, behind=0.135)
CONTACT = np.radians([-20.0, 78.0, 80.0, 92.0])
"""Upper arm, forearm, hand, stick from hanging straight down: a plain posture over a snare."""
NATURAL = Sliders(np.ones((4, 1)), np.ones((4, 1)), np.ones((1, 1)))


def plan_of(times: list[float], heights: list[float], most: float = np.inf) -> StrokePlan:
    n = len(times)
    height = np.array(heights)
    amplitude = amplitudes(height, np.repeat(CONTACT[:, None], n, 1), LENGTHS, np.ones((4, 1)), np.ones(1))
    alone = np.zeros(n, bool)
    return StrokePlan(
        np.array(times), height, amplitude, alone, np.full((4, n), 3.0), np.full(n, most), 0.43, np.full(n, 0.045)
    )


def rise(strokes: Strokes, at: Array) -> Array:
    """How high the tip is over the contact: the chain's angles added up."""
    turned = CONTACT[:, None] + np.cumsum(np.array(strokes.many(at)), axis=0)
    lengths = np.array([[LENGTHS.upper], [LENGTHS.fore], [LENGTHS.hand], [LENGTHS.ahead]])
    return np.asarray((lengths * (np.cos(CONTACT)[:, None] - np.cos(turned))).sum(0))


@pytest.mark.parametrize(("velocity", "inches"), [(49, 3.0), (64, 4.5), (80, 6.0), (96, 9.0), (112, 12.0), (127, 15.0)])
def test_heights_follow_the_table_of_dynamics(velocity: int, inches: float) -> None:
    height = float(stroke_height_m(velocity))
    strokes = Strokes.of(plan_of([0.0], [height]), NATURAL)
    top = rise(strokes, np.linspace(-0.7, 0.0, 701)).max()
    assert top / INCH_M == pytest.approx(inches, rel=0.03)  # HUMANS, Heights


def test_at_the_strike_every_joint_is_at_the_contact() -> None:
    strokes = Strokes.of(plan_of([0.0, 0.1, 0.5, 0.56, 2.0], [0.3, 0.05, 0.4, 0.1, 0.2]), NATURAL)
    for t in (0.0, 0.1, 0.5, 0.56, 2.0):
        assert strokes.at(t) == pytest.approx((0.0, 0.0, 0.0, 0.0), abs=1e-12)


def test_between_strikes_the_tip_stays_over_the_head() -> None:
    gaps = [0.03, 0.05, 0.08, 0.125, 0.2, 0.35, 0.6, 1.5]
    times = np.cumsum([0.0, *gaps, *gaps[::-1]])
    heights = np.tile([0.38, 0.03, 0.15], 6)[: len(times)]
    strokes = Strokes.of(plan_of(times.tolist(), heights.tolist()), NATURAL)
    assert rise(strokes, np.arange(-1.0, times[-1] + 1.0, 1 / 960)).min() > -0.003


def test_one_instant_and_many_agree() -> None:
    strokes = Strokes.of(plan_of([0.0, 0.1, 0.5], [0.3, 0.05, 0.4]), NATURAL)
    at = np.linspace(-1.0, 1.5, 251)
    assert pytest.approx(np.array([strokes.at(t) for t in at.tolist()])) == np.array(strokes.many(at)).T


def test_near_strokes_shrink_in_proportion_to_the_gap() -> None:
    def top(gap: float) -> float:
        strokes = Strokes.of(plan_of([i * gap for i in range(9)], [0.15] * 9), NATURAL)
        return float(rise(strokes, np.linspace(4 * gap, 5 * gap, 201)).max())

    assert top(0.4) == pytest.approx(0.15, rel=0.1)
    assert top(0.06) / top(0.12) == pytest.approx(0.5, abs=0.1)
    assert top(0.04) < top(0.06) < top(0.08) < top(0.1) < top(0.2)


def test_taps_are_wrist_and_fingers_alone() -> None:
    strokes = Strokes.of(plan_of([0.0], [0.05]), NATURAL)
    offsets = strokes.many(np.linspace(-0.6, 0.2, 401))
    assert np.abs(offsets.shoulder).max() == 0.0
    assert np.abs(offsets.elbow).max() == 0.0
    assert np.abs(offsets.wrist).max() > 0.03


def test_amplitude_and_frequency_act_on_their_joint_alone() -> None:
    gain, speed = np.ones((4, 1)), np.ones((4, 1))
    gain[2], speed[1] = 1.5, 2.0
    natural = Strokes.of(plan_of([0.0], [0.3]), NATURAL)
    moved = Strokes.of(plan_of([0.0], [0.3]), Sliders(gain, speed, np.ones((1, 1))))
    at = np.linspace(-0.8, 0.0, 801)
    a, b = natural.many(at), moved.many(at)
    assert b.wrist.max() / a.wrist.max() == pytest.approx(1.5, rel=0.03)
    assert b.elbow.max() / a.elbow.max() == pytest.approx(1.0, rel=0.03)
    assert at[np.argmax(b.elbow)] / at[np.argmax(a.elbow)] == pytest.approx(0.5, abs=0.06)
    assert at[np.argmax(b.wrist)] / at[np.argmax(a.wrist)] == pytest.approx(1.0, abs=0.06)


def test_without_whip_the_joints_top_together() -> None:
    together = Strokes.of(plan_of([0.0], [0.4]), Sliders(np.ones((4, 1)), np.ones((4, 1)), np.zeros((1, 1))))
    at = np.linspace(-0.6, 0.0, 1201)
    tops = [at[np.argmax(joint)] for joint in together.many(at)]
    assert max(tops) - min(tops) < 0.05  # with it they lie 0.3 s apart


def test_a_cap_holds_whatever_the_sliders_say() -> None:
    loud = Sliders(np.full((4, 1), 2.5), np.ones((4, 1)), np.ones((1, 1)))
    capped = Strokes.of(plan_of([0.0], [0.3], most=0.5), loud)
    assert rise(capped, np.linspace(-0.7, 0.0, 701)).max() < 0.17


def measured() -> tuple[Array, Array]:
    """Times and tip heights of the measured stroke, its lowest point at 0."""
    table = [np.genfromtxt(DATA / f"stroke/JointCenters_{a}Pose_cm.csv", delimiter=",", skip_header=1) for a in "XY"]
    tip = table[1][:, 5] / 100
    lowest = int(np.nanargmin(tip))
    return table[0][:, 0] - table[0][lowest, 0], tip - tip[lowest]


def test_a_full_stroke_at_the_same_tempo_is_like_the_measured_one() -> None:
    seconds, height = measured()
    period = 0.6  # 100 bpm
    strokes = Strokes.of(plan_of([i * period for i in range(6)], [0.56] * 6), NATURAL)
    ours = rise(strokes, 3 * period + seconds)
    assert np.corrcoef(ours, height)[0, 1] >= 0.97


def test_the_peaks_come_from_elbow_to_stick_at_the_measured_times() -> None:
    strokes = Strokes.of(plan_of([i * 0.6 for i in range(6)], [0.56] * 6), NATURAL)
    at = 1.8 + np.arange(-0.2, -0.0005, 0.0005)
    speed = [np.gradient(joint, 0.0005) for joint in strokes.many(at)]
    peaks = [float(at[np.argmin(v)] - 1.8) for v in speed]
    assert peaks[1] == pytest.approx(-0.062, abs=0.015)  # HUMANS, One real stroke
    assert peaks[2] == pytest.approx(-0.023, abs=0.015)
    assert peaks[3] == pytest.approx(-0.008, abs=0.015)
    assert peaks[1] < peaks[2] < peaks[3]


def test_impact_and_rebound_speeds_are_the_measured_ones() -> None:
    strokes = Strokes.of(plan_of([i * 0.6 for i in range(6)], [0.56] * 6), NATURAL)
    step = 1e-4
    falling = np.gradient(rise(strokes, 1.8 + np.arange(-0.02, -step, step)), step).min()
    rising = np.gradient(rise(strokes, 1.8 + np.arange(step, 0.012, step)), step).max()
    assert -falling == pytest.approx(9.4, rel=0.20)
    assert rising / -falling == pytest.approx(0.5, abs=0.1)


@pytest.mark.parametrize("inches", [6.0, 9.0])
def test_fast_taps_stay_low(inches: float) -> None:
    """Sixteenths at 200 bpm, the hands in turn: 6.7 strokes a second of each, which players tap from 3–6 cm."""
    gap = 0.15
    strokes = Strokes.of(plan_of([i * gap for i in range(9)], [inches * INCH_M] * 9), NATURAL)
    assert 0.03 <= rise(strokes, np.linspace(4 * gap, 5 * gap, 201)).max() <= 0.065


def test_an_accent_still_stands_out_of_fast_taps() -> None:
    """Accent 12 inches, tap 3 (HUMANS): four times as high with time enough, and twice at 6.7 strokes a second."""

    def ratio(gap: float) -> float:
        strokes = Strokes.of(
            plan_of([i * gap for i in range(9)], ([3 * INCH_M] * 3 + [12 * INCH_M]) * 2 + [0.1]), NATURAL
        )
        before = [rise(strokes, np.linspace((i - 1) * gap, i * gap, 201)).max() for i in (6, 7)]
        return float(before[1] / before[0])

    assert ratio(0.6) == pytest.approx(4.0, rel=0.1)
    assert 1.6 < ratio(0.15) < 2.6
