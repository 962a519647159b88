"""The examiner of `benchmarks/drummer_check.py`: solids by hand calculation, poses that are spoilt on purpose."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from benchmarks.examiner.anatomy import measured
from benchmarks.examiner.body import Capsule, overlap_m
from benchmarks.examiner.cases import Case, drummer_of, pairwise
from benchmarks.examiner.checks_contact import contacts
from benchmarks.examiner.checks_joints import kinks, ranges_and_speeds
from benchmarks.examiner.findings import Findings
from benchmarks.examiner.kit_solids import Solid
from benchmarks.examiner.scores import random_score
from benchmarks.examiner.take import Array, Sampled, Take
from station.motion.kinematics.figure import Joint

UP = np.array([0.0, 0.0, 1.0])


def capsule(a: list[float], b: list[float], radius_m: float = 0.01) -> Capsule:
    return Capsule("x", np.array([a], float), np.array([b], float), radius_m, radius_m)


@pytest.mark.parametrize(
    ("a", "b", "deep_m"),
    [
        ([0, 0, 0.015], [1, 0, 0.015], 0.005),  # parallel, 15 mm apart, 2 × 10 mm thick
        ([0.5, -1, 0.03], [0.5, 1, 0.03], -0.010),  # across, 30 mm over it
        ([1.02, 0, 0], [2, 0, 0], 0.0),  # end to end
        ([0.5, -1, 0], [0.5, 1, 0], 0.020),  # through the middle
    ],
)
def test_overlap_of_capsules(a: list[float], b: list[float], deep_m: float) -> None:
    assert overlap_m(capsule([0, 0, 0], [1, 0, 0]), capsule(a, b))[0] == pytest.approx(deep_m, abs=1e-9)


def test_stick_in_a_drum_and_through_a_cymbal() -> None:
    drum = Solid("drum", "drum", np.zeros(3), UP, 0.20, 0.15)
    cymbal = replace(drum, kind="cymbal", depth_m=0.002)
    over = capsule([-0.5, 0, 0.012], [0, 0, 0.012])
    pushed = capsule([-0.5, 0, -0.03], [0, 0, -0.03])
    assert drum.depth_of(over)[0] == pytest.approx(-0.002, abs=1e-6)
    assert drum.depth_of(pushed)[0] == pytest.approx(0.04, abs=1e-6)  # 30 mm under the head and 10 mm thick
    poked = capsule([0.15, 0, 0.30], [0.15, 0, -0.30])
    assert cymbal.depth_of(poked)[0] == pytest.approx(0.05, abs=1e-6)  # 5 cm inside the edge is the nearest way out


def bent(elbow_deg: float, wrist_deg: float) -> Sampled:
    """A right arm whose upper arm hangs, palm down, the elbow and the wrist bent by so much.

    The fulcrum is 105 mm ahead of the wrist, 34 to the thumb's side and 21 under the palm.
    """
    points = np.zeros((1, 21, 3))
    e, w = np.radians(elbow_deg), np.radians(elbow_deg + wrist_deg)
    points[0, Joint.NECK], points[0, Joint.SPINE] = [0, 0, 1.4], [0, 0, 1.0]
    points[0, Joint.RIGHT_SHOULDER], points[0, Joint.LEFT_SHOULDER] = [0.18, 0, 1.4], [-0.18, 0, 1.4]
    points[0, Joint.RIGHT_ELBOW] = [0.18, 0, 1.1]
    points[0, Joint.RIGHT_WRIST] = points[0, Joint.RIGHT_ELBOW] + 0.26 * np.array([0, np.sin(e), -np.cos(e)])
    points[0, Joint.RIGHT_HAND] = points[0, Joint.RIGHT_WRIST] + [-0.034, 0, 0]
    points[0, Joint.RIGHT_HAND] += 0.105 * np.array([0, np.sin(w), -np.cos(w)])
    points[0, Joint.RIGHT_HAND] -= 0.021 * np.array([0, np.cos(w), np.sin(w)])
    back = np.zeros((1, 2, 3))
    back[0, 0] = [0, np.cos(w), np.sin(w)]
    tip = np.tile(points[:, None, Joint.RIGHT_HAND], (1, 2, 1)) + 0.3 * UP
    none = np.zeros((1, 2))
    return Sampled(np.zeros(1), points, tip, tip - UP, back, np.zeros((1, 28)), none, np.zeros(1), np.zeros(1), none)


@pytest.mark.parametrize(("elbow_deg", "wrist_deg"), [(90, 0), (100, 30), (70, -40)])
def test_angles_are_measured_from_positions(elbow_deg: float, wrist_deg: float) -> None:
    angles, _ = measured(bent(elbow_deg, wrist_deg), "right")
    assert angles["elbow"][0] == pytest.approx(elbow_deg)
    assert angles["wrist extension"][0] == pytest.approx(wrist_deg, abs=3)
    assert angles["wrist to the thumb"][0] == pytest.approx(0, abs=3)
    assert angles["forearm pronation"][0] == pytest.approx(90, abs=6)  # palm down, from thumb up
    assert angles["shoulder inward rotation"][0] == pytest.approx(0, abs=1e-6)


@pytest.fixture(scope="module")
def take() -> Take:
    return Take(drummer_of(Case("rock-1")), 0.0, 1.5)


def faults(take: Take, poses: Sampled, check: Callable[[Take, Findings], None]) -> set[str]:
    """What `check` says of `poses` in place of the take's own, and not of these."""
    spoilt = Take(take.drummer, take.start_s, take.length_s)
    spoilt.__dict__["poses"] = poses
    before, after = Findings(take.bar_at), Findings(take.bar_at)
    check(take, before)
    check(spoilt, after)
    return {f"{f.kind} {f.what}" for f in after} - {f"{f.kind} {f.what}" for f in before}


def test_a_stick_put_through_the_snare_is_found(take: Take) -> None:
    tip = take.poses.tip_m.copy()
    tip[np.searchsorted(take.poses.time_s, 0.6), 1, 2] -= 0.25  # just before the backbeat: before that it lies down
    assert "through left stick in snare" in faults(take, replace(take.poses, tip_m=tip), contacts)


def test_a_stick_put_through_the_other_is_found(take: Take) -> None:
    tip, butt = take.poses.tip_m.copy(), take.poses.butt_m.copy()
    tip[700, 1], butt[700, 1] = butt[700, 0] + [0, 0.2, 0], tip[700, 0] - [0, 0.2, 0]
    poses = replace(take.poses, tip_m=tip, butt_m=butt)
    assert "through right stick in left stick" in faults(take, poses, contacts)


def test_a_head_that_jumps_and_one_that_nods_too_far_are_found(take: Take) -> None:
    angles = take.poses.angles_deg.copy()
    angles[700:, 3] += 60
    said = faults(take, replace(take.poses, angles_deg=angles), ranges_and_speeds)
    assert {"jump head_nod", "limit head_nod over 50"} <= said


@dataclass(frozen=True, eq=False)
class Pushed(Take):
    """A take whose crown goes `way_m` to the right, of the time since `since_s`."""

    since_s: float
    way_m: Callable[[Array], Array]

    @property
    def sample(self) -> Callable[[Array], Sampled]:
        return self._pushed

    def _pushed(self, time_s: Array) -> Sampled:
        poses = super().sample(time_s)
        points = poses.points_m.copy()
        points[:, Joint.CROWN, 0] += self.way_m(time_s - self.since_s)
        return replace(poses, points_m=points)


@pytest.mark.parametrize(
    ("way_m", "breaks"),
    [
        (lambda t: np.maximum(t, 0.0), True),  # 1 m/s from one instant on
        (lambda t: np.clip(t, 0, 0.2) ** 2 / 0.4 + np.maximum(t - 0.2, 0.0), False),  # 1 m/s within 0.2 s
    ],
)
def test_a_velocity_that_breaks_is_found(take: Take, way_m: Callable[[Array], Array], breaks: bool) -> None:
    pushed = Pushed(take.drummer, take.start_s, take.length_s, float(take.poses.time_s[800]), way_m)
    pushed.__dict__["poses"] = pushed.sample(take.poses.time_s)
    found = Findings(take.bar_at)
    kinks(pushed, found)
    assert ("crown" in {f.what for f in found if f.kind == "kink"}) == breaks


def test_pairwise_rows_hold_every_pair() -> None:
    columns = [["a", "b", "c"], ["1", "2", "3", "4"], ["x", "y"]]
    rows = pairwise(columns, 100)
    seen = {(i, r[i], j, r[j]) for r in rows for i in range(3) for j in range(i + 1, 3)}
    assert len(seen) == 3 * 4 + 3 * 2 + 4 * 2
    assert len(rows) < 3 * 4 * 2


def test_random_scores_are_their_seeds() -> None:
    first, again, other = random_score(7), random_score(7), random_score(17)
    assert first.notes.tobytes() == again.notes.tobytes()
    assert first.notes.tobytes() != other.notes.tobytes()
    assert 50 <= first.tempo_map.bpm_at(0) <= 240
