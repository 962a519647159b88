"""The pedal's messages as PROTOCOLS of the modules describe them; expected openness by hand."""

import pytest

from station.core.events import DeviceEvent, Hit, PedalMoved
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import Foot, PedalRange
from station.devices.mapping.hihat_pedal import Hihat

BOW = NoteMeaning(Piece.HIHAT, Zone.BOW)
OPEN_BOW = NoteMeaning(Piece.HIHAT, Zone.BOW, openness=1.0)
HALF_BOW = NoteMeaning(Piece.HIHAT, Zone.BOW, openness=0.5)
BY_CONTROLLER = Foot(by_controller=True)


def hihat(pedal: PedalRange | None, *values: int, foot: Foot = BY_CONTROLLER) -> Hihat:
    """A hi-hat whose pedal has said `values`."""
    found = Hihat(pedal, foot, "kit")
    for at_ms, value in enumerate(values):
        found.moved(value, at_ms * NS_PER_MS)
    return found


def stomps(ms_and_values: list[tuple[int, int]], pedal: PedalRange) -> list[Hit]:
    found = Hihat(pedal, BY_CONTROLLER, "kit")
    events: list[DeviceEvent] = []
    for at_ms, value in ms_and_values:
        events += found.moved(value, at_ms * NS_PER_MS)
    return [event for event in events if isinstance(event, Hit)]


def test_without_pedal_and_telling_note_it_cannot_tell() -> None:
    assert hihat(None).openness_of(BOW) is None
    assert hihat(PedalRange()).openness_of(BOW) is None


def test_a_one_note_kit_is_as_open_as_its_pedal() -> None:
    assert hihat(PedalRange(0, 90), 45).openness_of(BOW) == pytest.approx(0.5)
    assert hihat(PedalRange(), 127).openness_of(BOW) == 0.0


def test_a_controller_that_only_ever_said_127_does_not_outdo_a_half_open_note() -> None:
    assert hihat(PedalRange(), 127, 127).openness_of(HALF_BOW) == 0.5
    assert hihat(PedalRange(), 0, 127).openness_of(HALF_BOW) == 0.0  # one that moves does


def test_a_pedal_of_three_values_knows_three_places() -> None:
    pedal = PedalRange(steps=(0, 56, 127))
    assert [hihat(pedal, value).openness_of(BOW) for value in (0, 54, 56, 60, 127)] == [1.0, 0.5, 0.5, 0.5, 0.0]


def test_an_inverted_pedal_is_open_at_127() -> None:
    pedal = PedalRange(wide_open=127, shut=0)
    assert [hihat(pedal, value).openness_of(BOW) for value in (127, 0)] == [1.0, 0.0]
    assert PedalRange(steps=(127, 60, 0)).openness(120) == 1.0


@pytest.mark.parametrize("pedal", [PedalRange(), PedalRange(0, 90), PedalRange(127, 0), PedalRange(steps=(0, 56, 127))])
def test_the_value_of_an_openness_reads_back(pedal: PedalRange) -> None:
    for openness in (0.0, 0.5, 1.0):
        assert pedal.openness(pedal.value(openness)) == pytest.approx(openness, abs=0.01)


def test_a_pedal_brought_down_fast_is_a_stomp() -> None:
    (stomp,) = stomps([(0, 0), (100, 70), (110, 100), (130, 127)], PedalRange())
    assert (stomp.piece, stomp.articulation, stomp.at_ns) == (Piece.HIHAT_PEDAL, Articulation.CHICK, 130 * NS_PER_MS)
    assert stomp.velocity == round(127 * 15 / 30)


def test_a_pedal_brought_down_slowly_is_none() -> None:
    assert stomps([(0, 0), (100, 70), (400, 127)], PedalRange()) == []


def test_every_stomp_needs_the_pedal_up_before() -> None:
    down_up = [(0, 0), (10, 127), (50, 90), (60, 127), (200, 0), (210, 127)]
    assert [hit.at_ns // NS_PER_MS for hit in stomps(down_up, PedalRange())] == [10, 210]


def test_a_pedal_of_three_values_stomps_too_though_it_cannot_tell_how_hard() -> None:
    pedal = PedalRange(steps=(0, 56, 127))
    assert [hit.velocity for hit in stomps([(0, 0), (400, 127)], pedal)] == [64]
    assert [hit.velocity for hit in stomps([(0, 0), (400, 56), (420, 127)], pedal)] == [64]


def test_the_same_place_is_told_once() -> None:
    found = Hihat(PedalRange(), Foot(), "kit")
    (moved,) = found.moved(64, 5)
    assert isinstance(moved, PedalMoved)
    assert moved.openness == pytest.approx(63 / 127)
    assert found.moved(64, 6) == []
