import pytest

from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.port_watch import PortWatch, choose_port
from station.devices.transport import Packet
from tests.fakes.ports import FakeDriver

SNARE = bytes.fromhex("99 26 64")
PORTS = ["Midi Through:Midi Through Port-0 14:0", "USB Keyboard 20:0", "TD-17 24:0"]


@pytest.mark.parametrize(
    ("ports", "wanted", "chosen"),
    [
        (PORTS, "td-17", "TD-17 24:0"),
        (PORTS, "keyb", "USB Keyboard 20:0"),
        (PORTS, "through", "Midi Through:Midi Through Port-0 14:0"),
        (PORTS, "nitro", None),
        (PORTS, "", "TD-17 24:0"),
        (PORTS[:2], "", "USB Keyboard 20:0"),
        (PORTS[:1], "", None),
        ([], "", None),
        ([], "td-17", None),
    ],
)
def test_a_port_is_chosen_by_part_of_its_name(ports: list[str], wanted: str, chosen: str | None) -> None:
    assert choose_port(ports, wanted) == chosen


def test_the_kit_is_found_at_once_and_heard() -> None:
    driver = FakeDriver(*PORTS)
    watch = PortWatch(driver, "TD-17")
    first = watch.poll(0)
    assert (first.found, first.device) == (True, "TD-17")
    driver.play("TD-17 24:0", SNARE, 7)
    heard = watch.poll(NS_PER_MS)
    assert (heard.device, heard.packets) == ("TD-17", [Packet(SNARE, 7)])


def test_a_kit_that_is_plugged_in_later_is_found_within_a_second() -> None:
    driver = FakeDriver()
    watch = PortWatch(driver, "TD-17")
    assert not watch.poll(0).found
    driver.plug("TD-17 24:0")
    found = [at_ms for at_ms in range(1000) if watch.poll(at_ms * NS_PER_MS).found]
    assert len(found) == 1


def test_a_kit_that_goes_and_comes_back_under_another_address_plays_on() -> None:
    driver = FakeDriver("TD-17 24:0")
    watch = PortWatch(driver, "td")
    watch.poll(0)
    driver.play("TD-17 24:0", SNARE, 3)
    driver.unplug("TD-17 24:0")
    gone = watch.poll(NS_PER_S)
    assert (gone.lost, gone.device, gone.packets) == (True, "TD-17", [Packet(SNARE, 3)])
    assert driver.open_connections == 0
    assert watch.device == ""
    driver.plug("TD-17 28:0")
    assert watch.poll(2 * NS_PER_S).found
    driver.play("TD-17 28:0", SNARE, 9)
    assert watch.poll(2 * NS_PER_S + 1).packets == [Packet(SNARE, 9)]


def test_the_kit_that_was_lost_is_preferred_to_another_that_fits() -> None:
    driver = FakeDriver("Kit B 20:0")
    watch = PortWatch(driver, "kit")
    watch.poll(0)
    driver.unplug("Kit B 20:0")
    watch.poll(NS_PER_S)
    driver.plug("Kit A 21:0")
    driver.plug("Kit B 22:0")
    assert watch.poll(2 * NS_PER_S).device == "Kit B"


def test_a_kit_that_another_program_holds_is_tried_again() -> None:
    driver = FakeDriver("TD-17 24:0")
    driver.taken.add("TD-17 24:0")
    watch = PortWatch(driver)
    assert not watch.poll(0).found
    driver.taken.clear()
    assert watch.poll(NS_PER_S).found


def test_a_hundred_plug_cycles_leave_no_connection_behind() -> None:
    driver = FakeDriver()
    watch = PortWatch(driver)
    changes = 0
    for cycle in range(100):
        driver.plug(f"TD-17 {cycle}:0")
        changes += watch.poll((2 * cycle + 1) * NS_PER_S).found
        driver.unplug(f"TD-17 {cycle}:0")
        changes += watch.poll((2 * cycle + 2) * NS_PER_S).lost
    assert changes == 200
    assert driver.open_connections == 0


def test_closing_lets_go_of_the_port() -> None:
    driver = FakeDriver("TD-17 24:0")
    watch = PortWatch(driver)
    watch.poll(0)
    watch.close()
    assert driver.open_connections == 0
