"""What a user may say to name a kit; the grammar stands in the head of `kit_ports`."""

import pytest

from station.core.errors import BadInput
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.device_ports import DeviceRequest, parse_device, parse_devices, ports_for
from station.devices.port_watch import ClaimedPorts, PortWatch, choose_port
from station.devices.serial.serial_names import device_of_port, serial_port
from station.devices.transport import Packet
from tests.fakes.ports import FakeDriver

USB0, USB1, USB10 = (serial_port(f"/dev/ttyUSB{number}", "CP2102 USB to UART") for number in (0, 1, 10))
SNARE = bytes.fromhex("99 26 64")


@pytest.mark.parametrize(
    ("text", "wish"),
    [
        ("", DeviceRequest("")),
        ("TD-17", DeviceRequest("TD-17")),
        ("  nitro ", DeviceRequest("nitro")),
        ("serial:/dev/ttyUSB0", DeviceRequest("serial:/dev/ttyUSB0", 31_250)),
        ("serial:/dev/ttyUSB0@115200", DeviceRequest("serial:/dev/ttyUSB0", 115_200)),
        ("CP2102@115200", DeviceRequest("CP2102", 115_200)),
        ("drums@home", DeviceRequest("drums@home")),
    ],
)
def test_a_kit_is_a_part_of_a_name_or_a_path_and_a_rate(text: str, wish: DeviceRequest) -> None:
    assert parse_device(text) == wish


@pytest.mark.parametrize(
    "text", ["serial:/dev/ttyUSB0@fast", "serial:/dev/ttyUSB0@", "serial:COM3@1", "CP2102@99999999"]
)
def test_a_rate_that_no_port_has_is_the_users_fault(text: str) -> None:
    with pytest.raises(BadInput, match="expected"):
        parse_device(text)


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("", [""]),
        ("TD-17; serial:/dev/ttyUSB0@115200", ["TD-17", "serial:/dev/ttyUSB0"]),
        (";TD-17", ["TD-17"]),
        ("TD-17;", ["TD-17"]),
        (";", [""]),
    ],
)
def test_several_kits_stand_apart_by_a_semicolon(text: str, parts: list[str]) -> None:
    assert [wish.part for wish in parse_devices(text)] == parts


@pytest.mark.parametrize(
    ("ports", "wanted", "chosen"),
    [
        (["TD-17 20:0", USB0], "", "TD-17 20:0"),
        ([USB0], "", None),
        ([USB0, USB1], "cp2102", USB0),
        ([USB10, USB1], "serial:/dev/ttyUSB1", USB1),
        ([USB10], "serial:/dev/ttyUSB1", None),
        (["serial:/dev/ttyS0"], "serial:/dev/ttyS0", "serial:/dev/ttyS0"),
    ],
)
def test_a_serial_port_is_opened_only_when_it_is_asked_for(ports: list[str], wanted: str, chosen: str | None) -> None:
    assert choose_port(ports, wanted) == chosen


def test_the_kit_goes_by_the_adapters_name_whatever_its_path() -> None:
    assert device_of_port(USB0) == device_of_port(USB10) == "CP2102 USB to UART"
    assert device_of_port("serial:/dev/ttyS0") == "serial:/dev/ttyS0"


def test_without_a_name_no_serial_port_is_looked_at() -> None:
    driver = FakeDriver("TD-17 20:0")
    drums = "Guitar Hero drums (PS3) hid:/dev/hidraw0"
    assert ports_for(DeviceRequest(""), driver, FakeDriver(drums)).names() == ["TD-17 20:0", drums]


def test_a_serial_kit_that_comes_back_under_another_path_is_the_same() -> None:
    driver = FakeDriver(USB0)
    watch = PortWatch(driver, "serial:/dev/ttyUSB0")
    assert watch.poll(0).found
    driver.unplug(USB0)
    assert watch.poll(NS_PER_S).lost
    driver.plug(USB1)
    assert watch.poll(2 * NS_PER_S).found


def test_two_modules_of_one_model_are_two_kits() -> None:
    """Neither takes the other's port, each is heard under a name of its own, and keeps it when the other goes."""
    driver, claims = FakeDriver("TD-17 20:0", "TD-17 24:0"), ClaimedPorts()
    first, second = (PortWatch(driver, "td-17", claims) for _ in range(2))
    assert [watch.poll(0).device for watch in (first, second)] == ["TD-17", "TD-17 (2)"]
    driver.play("TD-17 24:0", SNARE, 5)
    assert (first.poll(1).packets, second.poll(1).packets) == ([], [Packet(SNARE, 5)])
    driver.unplug("TD-17 20:0")
    assert [watch.poll(NS_PER_S).lost for watch in (first, second)] == [True, False]
    driver.plug("TD-17 28:0")
    assert first.poll(2 * NS_PER_S).device == "TD-17"
    assert second.poll(2 * NS_PER_S + NS_PER_MS).device == "TD-17 (2)"
