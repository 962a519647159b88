"""Zones by direction, learning them, and keeping them while the heading drifts."""

from math import degrees, radians
from statistics import NormalDist

import numpy as np
import pytest

from station.core.pieces import Limb, Piece, Zone
from station.sync.air.air_zones import AirZone, separation, shares, velocity_of
from station.sync.air.heading_tracker import HeadingTracker
from station.sync.air.zone_learning import AirAim, AskedZone, ZoneLearning, too_close, zone_of

S = 1_000_000_000
PIECES = (Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.RIDE)


def zone(piece: Piece, heading_deg: float, elevation_deg: float = 0.0, sd_deg: float = 6.0) -> AirZone:
    return AirZone(
        Limb.RIGHT_HAND,
        piece,
        Zone.HEAD,
        radians(heading_deg),
        radians(elevation_deg),
        radians(sd_deg),
        radians(sd_deg),
    )


def aims(*headings_deg: float, elevation_deg: float = 0.0) -> list[AirAim]:
    return [AirAim(radians(heading), radians(elevation_deg), 3.0) for heading in headings_deg]


ROW = tuple(zone(piece, heading) for piece, heading in zip(PIECES, (0.0, 35.0, -35.0, -70.0), strict=True))


def tracker(zones: tuple[AirZone, ...] = ROW) -> HeadingTracker:
    found = HeadingTracker(zones)
    found.fix(0, 0, zones[0].heading_rad)
    return found


class TestNaming:
    def test_a_stroke_in_the_middle_of_a_zone_names_it(self) -> None:
        hand = tracker()
        for each in ROW:
            assert hand.clear_zone(S, each.heading_rad, each.elevation_rad) is each

    def test_a_stroke_half_way_between_two_names_neither(self) -> None:
        assert tracker().clear_zone(S, radians(17.5), 0.0) is None

    def test_a_stroke_far_from_all_names_none(self) -> None:
        assert tracker().clear_zone(S, radians(120.0), 0.0) is None
        assert tracker().clear_zone(S, 0.0, radians(60.0)) is None

    def test_zones_lie_on_both_sides_of_the_seam(self) -> None:
        behind = (zone(Piece.SNARE, 178.0), zone(Piece.HIHAT, 140.0))
        assert tracker(behind).clear_zone(S, radians(-176.0), 0.0) is behind[0]

    def test_elevation_tells_a_cymbal_above_a_tom(self) -> None:
        tom, crash = zone(Piece.TOM_1, 0.0, -5.0), zone(Piece.CRASH_1, 0.0, 30.0)
        assert tracker((tom, crash)).clear_zone(S, 0.0, radians(27.0)) is crash

    def test_shares_are_bayes_rule(self) -> None:
        # two zones, one at 0 and one at 2 deviations, by the normal distribution's table: 0.3989 and 0.0540
        one, other = shares([(0.0, 0.1, 0.0, 0.1), (0.2, 0.1, 0.0, 0.1)])
        assert one / other == pytest.approx(0.39894 / 0.05399, rel=1e-3)
        assert one + other < 1.0

    def test_no_zones_name_nothing(self) -> None:
        assert HeadingTracker(()).strike(0, 0.0, 0.0) is None


class TestDrift:
    def test_the_first_stroke_of_all_finds_the_hand(self) -> None:
        hand = HeadingTracker(ROW)
        assert hand.clear_zone(0, 0.0, 0.0) is None
        found = hand.strike(0, radians(100.0), 0.0)
        assert found is not None
        assert found[0] is ROW[0]
        assert degrees(hand.drift_rad) == pytest.approx(100.0)
        assert hand.clear_zone(S, radians(135.0), 0.0) is ROW[1]

    @pytest.mark.parametrize("drift_deg_a_minute", [-8.0, 4.0, 10.0])
    def test_zones_stay_right_over_ten_minutes(self, drift_deg_a_minute: float) -> None:
        right, named, strokes, _ = drifting(drift_deg_a_minute, minutes=10.0)
        assert right / strokes >= 0.98
        assert right / named >= 0.99

    def test_without_correction_they_do_not(self) -> None:
        right, _, strokes, _ = drifting(4.0, minutes=10.0, corrects=False)
        assert right / strokes < 0.7

    def test_the_drift_goes_on_while_nobody_plays(self) -> None:
        _, _, _, hand = drifting(6.0, minutes=4.0)
        before = hand.drift_rad
        later = hand.clear_zone(int(300.0 * S), radians(6.0 * 5.0), 0.0)  # a minute's rest, 6° further
        assert later is ROW[0]
        assert hand.drift_rad == before

    def test_a_pad_is_an_absolute_fix(self) -> None:
        hand = tracker()
        hand.fix(S, 1, radians(35.0 - 60.0))  # its pad says hi-hat, the heading the ride: it has turned by 60°
        assert degrees(hand.drift_rad) == pytest.approx(-60.0, abs=1.0)
        assert hand.clear_zone(2 * S, radians(-60.0), 0.0) is ROW[0]

    def test_pads_that_agree_move_a_zone(self) -> None:
        hand = tracker()
        for beat in range(8):
            hand.fix(beat * S, 0, radians(12.0))
        assert hand.clear_zone(9 * S, radians(16.0), 0.0) is ROW[0]  # 4° on; half-way to the next is 17.5

    def test_a_lost_heading_is_doubt_without_end(self) -> None:
        hand = tracker()
        assert hand.doubt_rad is not None
        hand.lose()
        assert hand.doubt_rad is None

    def test_looking_changes_nothing(self) -> None:
        hand = tracker()
        before = (hand.drift_rad, hand.doubt_rad)
        hand.confidences(600 * S, 0.3, 0.0)
        assert (hand.drift_rad, hand.doubt_rad) == before


def drifting(
    deg_a_minute: float, minutes: float, corrects: bool = True, seed: int = 4
) -> tuple[int, int, int, HeadingTracker]:
    """Right, named and all strokes of a player who strikes ± 5° while the heading drifts; two strokes a second."""
    rng, hand = np.random.default_rng(seed), tracker()
    strokes = int(minutes * 120)
    right = named = 0
    for stroke in range(1, strokes + 1):
        at_s, meant = stroke * 0.5, ROW[int(rng.choice(4, p=(0.5, 0.4, 0.05, 0.05)))]
        heading = meant.heading_rad + radians(deg_a_minute * at_s / 60.0 + rng.normal(0.0, 5.0))
        elevation = radians(rng.normal(0.0, 5.0))
        if corrects:
            found = hand.strike(int(at_s * S), heading, elevation)
            said = None if found is None else found[0]
        else:
            said = hand.clear_zone(0, heading, elevation)
        named += said is not None
        right += said is meant
    return right, named, strokes, hand


class TestLearning:
    def test_a_zone_is_the_median_of_its_strokes(self) -> None:
        learnt = zone_of(AskedZone(Limb.LEFT_HAND, Piece.SNARE), aims(10, 12, 14, 11, 13, 12, 12, -60))
        assert degrees(learnt.heading_rad) == pytest.approx(12.0)
        assert learnt.limb is Limb.LEFT_HAND

    def test_it_may_lie_across_the_seam(self) -> None:
        learnt = zone_of(AskedZone(Limb.LEFT_HAND, Piece.SNARE), aims(178, -178, 180, 176, -176))
        assert abs(degrees(learnt.heading_rad)) == pytest.approx(180.0)

    def test_scatter_is_the_normal_deviation_of_the_median_one(self) -> None:
        # deviations 0, 10, 20, 30 either way: their median is 20 (of 8), the normal deviation 1.4826 times that
        learnt = zone_of(AskedZone(Limb.LEFT_HAND, Piece.SNARE), aims(-30, -20, -20, -10, 10, 20, 20, 30))
        assert degrees(learnt.heading_sd_rad) == pytest.approx(20.0 * 1.4826, rel=1e-3)

    def test_it_asks_for_one_after_the_other(self) -> None:
        asked = (AskedZone(Limb.RIGHT_HAND, Piece.SNARE), AskedZone(Limb.LEFT_HAND, Piece.HIHAT))
        learning = ZoneLearning(asked, strokes=2)
        (aim,) = aims(5.0)
        assert learning.now == asked[0]
        assert not learning.strike(Limb.LEFT_HAND, aim)
        assert learning.strike(Limb.RIGHT_HAND, aim)
        assert learning.left == 1
        assert learning.strike(Limb.RIGHT_HAND, aim)
        assert learning.now == asked[1]
        assert [each.piece for each in learning.learnt().kit.zones] == [Piece.SNARE]
        learning.strike(Limb.LEFT_HAND, aim._replace(speed_m_s=5.0))
        learning.strike(Limb.LEFT_HAND, aim._replace(speed_m_s=5.0))
        assert learning.left == 0
        assert not learning.strike(Limb.LEFT_HAND, aim)
        assert learning.learnt().kit.normal_speed_m_s == pytest.approx(4.0)

    def test_nothing_learnt_is_an_empty_kit(self) -> None:
        assert ZoneLearning(()).learnt().kit.zones == ()

    def test_two_zones_too_close_are_told(self) -> None:
        near, far = zone(Piece.TOM_1, 12.0), zone(Piece.RIDE, -60.0)
        (pair,) = too_close((ROW[0], near, far))
        assert (pair.one, pair.other) == (ROW[0], near)
        # 12° apart, 6° each: the border is one deviation away, 15.87 % lie beyond it
        assert pair.confused == pytest.approx(0.1587, abs=1e-4)

    def test_the_other_hands_zones_are_no_matter(self) -> None:
        left = AirZone(Limb.LEFT_HAND, Piece.TOM_1, Zone.HEAD, 0.0, 0.0, 0.1, 0.1)
        assert too_close((ROW[0], left)) == ()

    def test_separation_counts_deviations(self) -> None:
        assert separation(zone(Piece.SNARE, 0.0, 0.0, 5.0), zone(Piece.TOM_1, 15.0, 20.0, 5.0)) == pytest.approx(5.0)
        assert NormalDist().cdf(-2.5) < 0.01


def test_velocity_is_level_over_forty_decibels_a_decade() -> None:
    # HUMANS: 112 is −2.2 dB, 80 −8.0, 48 −16.9 below 127; 20·log10 of the speeds' ratio is the same
    full = 9.4
    normal = full * (78.0 / 127.0) ** 2
    for velocity, level_db in ((112.0, -2.2), (80.0, -8.0), (48.0, -16.9)):
        assert velocity_of(full * 10 ** (level_db / 20), normal) == pytest.approx(velocity, abs=0.5)
    assert velocity_of(full, normal) == pytest.approx(127.0)
    assert velocity_of(50.0, normal) == 127.0
    assert velocity_of(0.0, normal) == 1.0
