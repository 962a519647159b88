"""All sticks together, on simulated ones that strike pads while an air kit is played. Expected: the simulated truth."""

from dataclasses import replace
from math import radians

import pytest

from station.core.events import Hit, SensorLost, SensorMounted, SensorSamples, StickPose, StickStroke
from station.core.pieces import Limb, Piece, Zone
from station.core.units import NS_PER_S
from station.simulation.sticks.stick_swing import SimulatedSticks, StickPair, play
from station.simulation.sticks.swing_sensor import SensorSpec
from station.simulation.sticks.swing_spec import StickStrokeSpec
from station.sync.air.air_zones import AirKit, AirZone
from station.sync.sticks import Sticks

HANDS = (Limb.RIGHT_HAND, Limb.LEFT_HAND)


def taps(count: int = 12) -> SimulatedSticks:
    """Both hands in turn on the snare, three strokes a second."""
    return play(
        [StickStrokeSpec(3.0 + index / 3, HANDS[index % 2], Piece.SNARE, Zone.HEAD, 4.0) for index in range(count)]
    )


def heard(sticks: Sticks, played: SimulatedSticks) -> list[object]:
    """Everything told, of samples and pads in the order of their times."""
    events: list[tuple[int, SensorSamples | Hit]] = []
    for stick in played.sticks.values():
        events += [(samples.at_ns, samples) for samples in stick.events()]
    events += [(hit.at_ns, hit) for hit in played.pad_hits]
    told: list[object] = []
    for stick in played.sticks.values():
        told += sticks.handle(SensorMounted(0, stick.device, stick.mounting))
    for _, event in sorted(events, key=lambda pair: pair[0]):
        if isinstance(event, Hit):
            sticks.struck(event)
        else:
            told += sticks.handle(event)
    return told


def test_both_sticks_are_told_by_their_hands_and_posed_sixty_times_a_second() -> None:
    played = taps()
    told = heard(Sticks(), played)
    strokes = [event for event in told if isinstance(event, StickStroke)]
    assert [stroke.limb for stroke in sorted(strokes, key=lambda stroke: stroke.at_ns)] == [*HANDS] * 6
    poses = [event for event in told if isinstance(event, StickPose) and event.limb is Limb.RIGHT_HAND]
    lasts_s = (poses[-1].at_ns - poses[0].at_ns) / NS_PER_S
    assert 50 < len(poses) / lasts_s <= 61


def test_a_piece_whose_pad_was_struck_makes_no_hit_in_the_air() -> None:
    zones = tuple(AirZone(hand, Piece.SNARE, Zone.HEAD, 0.0, 0.0, radians(8), radians(8)) for hand in HANDS)
    sticks, played = Sticks(), taps()
    sticks.play_air(AirKit(zones))
    late = [event for event in heard(sticks, played) if isinstance(event, Hit) and event.at_ns > 4 * NS_PER_S]
    assert late == [], "the second second's strokes sound by their pad alone"


def test_a_stick_that_went_is_forgotten_and_a_stranger_is_taken_in() -> None:
    played = taps(2)
    stick = next(iter(played.sticks.values()))
    sticks = Sticks()
    assert sticks.handle(SensorLost(5, "nobody")) == [SensorLost(5, "nobody")]
    stranger = [replace(samples, device="new") for samples in stick.events()]
    told = [event for samples in stranger for event in sticks.handle(samples)]
    assert {event.limb for event in told if isinstance(event, StickPose)} == {Limb.UNKNOWN}


@pytest.mark.parametrize("rate_hz", [200.0, 400.0, 1000.0])
def test_hard_strokes_with_a_gyro_of_1000_degrees_are_all_told_and_said_to_be_faster(rate_hz: float) -> None:
    sensor = SensorSpec(rate_hz, rate_range_dps=1000.0)
    strokes = [StickStrokeSpec(3.0 + 0.3 * index, HANDS[index % 2], speed_m_s=9.0) for index in range(32)]
    played = play(strokes, pair=StickPair(dict.fromkeys(HANDS, sensor)))
    told = [event for event in heard(Sticks(), played) if isinstance(event, StickStroke)]
    assert [stroke.limb for stroke in sorted(told, key=lambda stroke: stroke.at_ns)] == [*HANDS] * 16
    assert all(stroke.clipped for stroke in told)
