"""Strokes with figures that the test lays down; what is remarked follows from them by hand."""

import math
from dataclasses import replace
from random import Random

import pytest

from station.core.events import Hit, StickStroke
from station.core.pieces import Limb, Piece, Zone
from station.scoring.analysis.fault_table import Asked
from station.sync.strokes.stick_remarks import Pair, StickReport, stick_report

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND


def pair(k: int, limb: Limb, height_m: float, speed_m_s: float = 4.0, velocity: int = 80) -> Pair:
    return (
        Hit(k * 10**8, Piece.SNARE, Zone.HEAD, velocity),
        StickStroke(k * 10**8, limb.name, limb, speed_m_s, height_m, 0.45, 0.0),
    )


def scattered(seed: int, right_m: float, left_m: float, count: int = 60) -> list[Pair]:
    """Strokes hand to hand whose heights scatter by a tenth."""
    random = Random(seed)
    return [
        pair(k, L if k % 2 else R, (left_m if k % 2 else right_m) * math.exp(random.gauss(0, 0.1)))
        for k in range(count)
    ]


def report(pairs: list[Pair], asked: Asked | None = None) -> StickReport:
    made = stick_report(pairs, asked)
    assert made is not None
    return made


def kinds(pairs: list[Pair], **asked: float | None) -> list[str]:
    """What is remarked; mute in any case is what would be."""
    said = [remark.kind for remark in report(pairs, Asked(asked)).remarks]
    assert not report(pairs, Asked({**asked, **dict.fromkeys(said)})).remarks
    return said


def test_even_hands_have_figures_and_no_remarks() -> None:
    made = report(scattered(1, 0.2, 0.2))
    assert made.remarks == ()
    assert made.hands[R].strokes == made.hands[L].strokes == 30
    assert made.hands[R].height_m == pytest.approx(0.2, rel=0.1)
    assert made.hands[L].speed_m_s == 4.0
    assert made.hands[L].rebound == 0.45
    assert made.hands[L].clipped == 0.0


def test_no_strokes_no_report() -> None:
    assert stick_report([]) is None


def test_a_left_stick_that_rises_half_as_high_is_told() -> None:
    (remark,) = report(scattered(2, 0.2, 0.1)).remarks
    assert remark.kind == "uneven_heights"
    assert remark.text.startswith("Your sticks rise unevenly: ")
    assert remark.effect == pytest.approx(2.0, rel=0.1)
    assert remark.ci[0] < 2.0 < remark.ci[1]


def test_a_lesson_says_from_which_size_a_remark_counts() -> None:
    """Right twice as high as left is 100 % higher; half the strokes are held back."""
    assert kinds(scattered(2, 0.2, 0.1), uneven_heights=70) == ["uneven_heights"]
    assert kinds(scattered(2, 0.2, 0.1), uneven_heights=130) == []
    held = [pair(k, R, 0.2, 1.4 if k % 2 else 3.0) for k in range(60)]
    assert kinds(held, wasted_motion=30) == ["wasted_motion"]
    assert kinds(held, wasted_motion=45) == []


def test_few_strokes_bear_no_remark() -> None:
    assert kinds(scattered(3, 0.2, 0.1, count=20)) == []


def test_rebound_that_differs_is_told() -> None:
    random = Random(4)
    pairs = [
        (hit, replace(stroke, rebound=random.gauss(0.5 if stroke.limb is R else 0.2, 0.05)))
        for hit, stroke in scattered(4, 0.2, 0.2)
    ]
    (remark,) = report(pairs).remarks
    assert remark.kind == "uneven_rebound"
    assert remark.text.startswith("Your right stick rebounds more freely")
    assert remark.effect == pytest.approx(0.3, abs=0.05)


def test_a_stick_that_falls_slower_than_by_its_weight_is_held_back() -> None:
    """From 20 cm a free fall reaches √(2 · 9.8 · 0.2) = 1.98 m/s; half of the strokes come at 1.4."""
    pairs = [pair(k, R, 0.2, 1.4 if k % 2 else 3.0) for k in range(60)]
    (remark,) = report(pairs).remarks
    assert remark.kind == "wasted_motion"
    assert remark.effect == pytest.approx(0.5)
    assert kinds([pair(k, R, 0.2, 2.1) for k in range(60)]) == []


def test_loudness_without_height_is_told_and_loudness_by_height_is_not() -> None:
    random = Random(5)
    flat = [pair(k, R, 0.2 * math.exp(random.gauss(0, 0.1)), velocity=50 if k % 2 else 110) for k in range(60)]
    assert kinds(flat) == ["same_height"]
    made = [pair(k, R, 0.06 if k % 2 else 0.25, velocity=50 if k % 2 else 110) for k in range(60)]
    assert kinds(made) == []


@pytest.mark.parametrize(("turned_deg", "said"), [(45, ["grip_changed"]), (10, [])])
def test_a_stick_that_turns_in_the_hand_is_told(turned_deg: float, said: list[str]) -> None:
    """Rolls lie about the wrap at 180°: they are taken on the circle."""
    random = Random(6)
    pairs = []
    for k, (hit, stroke) in enumerate(scattered(6, 0.2, 0.2, count=120)):
        roll = math.radians(170 + turned_deg * (k >= 60)) + random.gauss(0, 0.1) if stroke.limb is R else 0.0
        pairs.append((hit, replace(stroke, roll_rad=math.remainder(roll, math.tau))))
    assert kinds(pairs) == said
