"""Hits in milliseconds against the rules of `station.devices.mapping.device_map`; expected verdicts by hand."""

from types import MappingProxyType

from station.core.events import Choke, DeviceEvent, Hit, PedalMoved
from station.core.note_map import GENERAL_MIDI
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import Crosstalk, DeviceMap, Foot, Pad
from station.devices.mapping.trigger_filter import HeldBack, TriggerFilter

SNARE, KICK, TOM, HAT, FOOT, CRASH = (
    Piece.SNARE,
    Piece.KICK,
    Piece.TOM_1,
    Piece.HIHAT,
    Piece.HIHAT_PEDAL,
    Piece.CRASH_1,
)
KICK_IN_SNARE = Crosstalk(KICK, SNARE, 0.4, 30 * NS_PER_MS, 5 * NS_PER_MS)


def kit(**said: object) -> DeviceMap:
    return DeviceMap("own", "own", GENERAL_MIDI, **said)  # type: ignore[arg-type] # the tests' own words


def pads(**said: Pad) -> MappingProxyType[Piece, Pad]:
    return MappingProxyType({Piece[name.upper()]: pad for name, pad in said.items()})


def hit(ms: float, piece: Piece, velocity: int) -> Hit:
    foot = piece is FOOT
    zone, how = (Zone.PEDAL, Articulation.CHICK) if foot else (Zone.HEAD, Articulation.NORMAL)
    return Hit(round(ms * NS_PER_MS), piece, zone, velocity, how)


def certain(trigger_filter: TriggerFilter, *events: DeviceEvent) -> list[tuple[float, Piece, int]]:
    """The hits that are told of `events` in the end: ms, piece, velocity."""
    found = []
    for event in events:
        trigger_filter.feed(event)
        found += trigger_filter.certain()
    found += trigger_filter.flush()
    return [(e.at_ns / NS_PER_MS, e.piece, e.velocity) for e in found if isinstance(e, Hit)]


def why(trigger_filter: TriggerFilter) -> list[HeldBack]:
    return [ghost.why for ghost in trigger_filter.false_triggers]


def test_a_kit_of_which_nothing_is_known_passes_at_once() -> None:
    trigger_filter = TriggerFilter(kit())
    for event in (hit(0, SNARE, 100), hit(1, SNARE, 1), hit(2, KICK, 3), Choke(3, CRASH), PedalMoved(4, 0.5)):
        assert trigger_filter.feed(event)
        assert trigger_filter.certain() == [event]
    assert trigger_filter.settle(10**12) == []


def test_softer_than_the_threshold_is_no_stroke() -> None:
    trigger_filter = TriggerFilter(kit(pads=pads(snare=Pad(threshold=10))))
    assert certain(trigger_filter, hit(0, SNARE, 9), hit(100, SNARE, 10), hit(200, KICK, 1)) == [
        (100, SNARE, 10),
        (200, KICK, 1),
    ]
    assert why(trigger_filter) == [HeldBack.TOO_SOFT]


def test_a_pad_hears_no_second_stroke_within_its_mask_time() -> None:
    trigger_filter = TriggerFilter(kit(pads=pads(snare=Pad(mask_ns=9 * NS_PER_MS))))
    events: list[DeviceEvent] = [
        hit(0, SNARE, 90),
        hit(8.9, SNARE, 60),
        hit(9, SNARE, 50),
        hit(10, KICK, 80),
        hit(12, KICK, 70),
    ]
    assert [ms for ms, _, _ in certain(trigger_filter, *events)] == [0, 9, 10, 12]
    assert why(trigger_filter) == [HeldBack.DOUBLE]


def test_crosstalk_after_the_stroke_does_not_even_sound() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    assert trigger_filter.feed(hit(0, KICK, 100))
    assert not trigger_filter.feed(hit(30, SNARE, 40))
    assert trigger_filter.feed(hit(30, SNARE, 41))  # louder than crosstalk ever is
    assert trigger_filter.feed(hit(31, SNARE, 20))  # later


def test_crosstalk_before_the_stroke_sounds_but_is_not_told() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    assert trigger_filter.feed(hit(0, SNARE, 30))
    assert trigger_filter.certain() == []
    trigger_filter.feed(hit(5, KICK, 100))
    assert [event for event in trigger_filter.certain() if isinstance(event, Hit)] == [hit(5, KICK, 100)]
    assert why(trigger_filter) == [HeldBack.CROSSTALK]
    assert trigger_filter.false_triggers[0].source is KICK


def test_a_soft_stroke_that_no_other_claims_is_told_with_its_own_time() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    assert certain(trigger_filter, hit(0, SNARE, 30), hit(5.1, KICK, 100)) == [(0, SNARE, 30), (5.1, KICK, 100)]


def test_the_clock_lets_go_what_is_certain() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    trigger_filter.feed(hit(0, SNARE, 30))
    assert trigger_filter.settle(8 * NS_PER_MS) == []  # a driver may still hold a kick of 5 ms
    assert trigger_filter.settle(8 * NS_PER_MS + 1) == [hit(0, SNARE, 30)]


def test_a_loud_stroke_waits_for_nobody() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    trigger_filter.feed(hit(0, SNARE, 51))  # more than 0.4 × 127
    assert trigger_filter.certain() == [hit(0, SNARE, 51)]


def test_what_follows_a_doubtful_hit_keeps_its_turn() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,)))
    trigger_filter.feed(hit(0, SNARE, 30))
    trigger_filter.feed(hit(2, TOM, 100))
    assert trigger_filter.certain() == []
    trigger_filter.feed(hit(6, TOM, 100))
    assert trigger_filter.certain() == [hit(0, SNARE, 30), hit(2, TOM, 100), hit(6, TOM, 100)]


def test_a_ghost_masks_no_stroke() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,), pads=pads(snare=Pad(mask_ns=9 * NS_PER_MS))))
    assert certain(trigger_filter, hit(0, SNARE, 30), hit(3, KICK, 100), hit(6, SNARE, 90)) == [
        (3, KICK, 100),
        (6, SNARE, 90),
    ]
    trigger_filter = TriggerFilter(kit(crosstalk=(KICK_IN_SNARE,), pads=pads(snare=Pad(mask_ns=9 * NS_PER_MS))))
    assert certain(trigger_filter, hit(0, SNARE, 30), hit(2, SNARE, 90), hit(4, KICK, 100)) == [
        (2, SNARE, 90),
        (4, KICK, 100),
    ]


def test_a_stomp_that_fires_the_hat_is_crosstalk_of_the_pedal() -> None:
    trigger_filter = TriggerFilter(kit(crosstalk=(Crosstalk(FOOT, HAT, 0.6),)))
    assert certain(trigger_filter, hit(0, HAT, 40), hit(3, FOOT, 90), hit(12, HAT, 30), hit(200, HAT, 30)) == [
        (3, FOOT, 90),
        (200, HAT, 30),
    ]


# --- the foot --------------------------------------------------------------------------------------------------------


def pedal(ms: float, openness: float) -> PedalMoved:
    return PedalMoved(round(ms * NS_PER_MS), openness)


def test_a_stomp_beside_a_stroke_for_which_the_pedal_hardly_moved_is_false() -> None:
    trigger_filter = TriggerFilter(kit(foot=Foot(least_travel=0.3)))
    swinging: list[DeviceEvent] = [pedal(0, 0.5), hit(1000, HAT, 100), pedal(1005, 0.45), hit(1010, FOOT, 40)]
    assert [piece for _, piece, _ in certain(trigger_filter, *swinging)] == [HAT]
    assert why(trigger_filter) == [HeldBack.FALSE_STOMP]


def test_a_stomp_for_which_it_moved_is_true() -> None:
    trigger_filter = TriggerFilter(kit(foot=Foot(least_travel=0.3)))
    stamped: list[DeviceEvent] = [
        pedal(0, 0.9),
        hit(1000, HAT, 100),
        pedal(1005, 0.5),
        pedal(1009, 0.1),
        hit(1010, FOOT, 40),
    ]
    assert [piece for _, piece, _ in certain(trigger_filter, *stamped)] == [HAT, FOOT]


def test_a_stomp_alone_is_true_whatever_the_pedal_says() -> None:
    trigger_filter = TriggerFilter(kit(foot=Foot(least_travel=0.3)))
    assert len(certain(trigger_filter, pedal(0, 0.5), hit(500, HAT, 100), hit(561, FOOT, 40))) == 2


def splashes(*events: DeviceEvent) -> list[Articulation]:
    trigger_filter = TriggerFilter(kit(foot=Foot(splash_ns=100 * NS_PER_MS)))
    for event in events:
        trigger_filter.feed(event)
    return [event.articulation for event in trigger_filter.flush() if isinstance(event, Hit)]


def test_a_pedal_that_opens_again_at_once_made_a_splash() -> None:
    assert splashes(pedal(0, 0.4), hit(1, FOOT, 90), pedal(5, 0.0), pedal(80, 0.31)) == [Articulation.SPLASH]


def test_a_pedal_still_on_its_way_down_made_none() -> None:
    assert splashes(pedal(0, 0.7), hit(1, FOOT, 90), pedal(5, 0.4), pedal(30, 0.0)) == [Articulation.CHICK]


def test_a_pedal_that_opens_later_made_none() -> None:
    assert splashes(hit(1, FOOT, 90), pedal(5, 0.0), pedal(102, 1.0)) == [Articulation.CHICK]


# --- grabs -----------------------------------------------------------------------------------------------------------


def test_the_grabbing_hands_own_stroke_is_none() -> None:
    trigger_filter = TriggerFilter(kit(grab_velocity=25))
    events: list[DeviceEvent] = [
        hit(0, CRASH, 110),
        hit(380, CRASH, 20),
        Choke(400 * NS_PER_MS, CRASH),
        hit(440, CRASH, 15),
    ]
    assert certain(trigger_filter, *events) == [(0, CRASH, 110)]
    assert why(trigger_filter) == [HeldBack.GRAB, HeldBack.GRAB]


def test_a_stroke_before_and_after_a_grab_is_one() -> None:
    trigger_filter = TriggerFilter(kit(grab_velocity=25))
    events: list[DeviceEvent] = [
        hit(0, CRASH, 20),
        Choke(400 * NS_PER_MS, CRASH),
        hit(461, CRASH, 20),
        hit(465, CRASH, 26),
    ]
    assert [ms for ms, _, _ in certain(trigger_filter, *events)] == [0, 461, 465]
