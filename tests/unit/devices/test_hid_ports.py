"""HID devices behind a fake hidapi: what is listed, opened and read, and what a user is told."""

import os
from pathlib import Path

import pytest

from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.devices.device_ports import DeviceRequest, ports_for
from station.devices.hid.hid_ports import LOOK_EVERY_NS, HidDirectory
from station.devices.port_watch import SCAN_EVERY_NS, PortWatch
from station.devices.transport import Packet
from tests.fakes.hid_devices import (
    FOOT_SWITCH,
    GUITAR_HERO,
    MOUSE,
    ROCK_BAND,
    FakeHid,
    drum_report,
    key_report,
)
from tests.fakes.ports import FakeDriver

DRUMS = "Rock Band drums (PS3) hid:/dev/hidraw3"
SNARE = drum_report("circle l3", b12=55)


@pytest.fixture
def api() -> FakeHid:
    return FakeHid()


@pytest.fixture
def directory(api: FakeHid) -> HidDirectory:
    return HidDirectory(api, lambda: 7, lambda: frozenset(path.decode() for path in api.plugged))


def test_known_devices_alone_are_listed_by_their_titles(api: FakeHid, directory: HidDirectory) -> None:
    assert directory.names() == []
    api.plug("/dev/hidraw3", ROCK_BAND)
    api.plug("/dev/hidraw4", MOUSE, ((1, 2),))
    api.plug("/dev/hidraw0", GUITAR_HERO)
    assert directory.names() == ["Guitar Hero drums (PS3) hid:/dev/hidraw0", DRUMS]
    api.unplug("/dev/hidraw3")
    assert directory.names() == ["Guitar Hero drums (PS3) hid:/dev/hidraw0"]


@pytest.mark.parametrize("usages", [((1, 6), (1, 2)), ((0, 0), (0, 0))])
def test_of_a_foot_switch_the_keyboard_is_listed_once(
    api: FakeHid, directory: HidDirectory, usages: tuple[tuple[int, int], ...]
) -> None:
    api.plug("/dev/hidraw5", FOOT_SWITCH, usages)
    api.plug("/dev/hidraw6", FOOT_SWITCH, ((0xFF00, 1),))
    assert directory.names() == ["Foot switch (PCsensor) hid:/dev/hidraw5"]


def test_without_files_to_look_at_the_system_is_asked_now_and_then(api: FakeHid) -> None:
    now_ns = NS_PER_S
    directory = HidDirectory(api, lambda: now_ns, lambda: None)
    assert directory.names() == []
    api.plug("DevSrvsID:4295", ROCK_BAND)
    now_ns += LOOK_EVERY_NS - 1
    assert directory.names() == []
    now_ns += 1
    assert directory.names() == ["Rock Band drums (PS3) hid:DevSrvsID:4295"]


def test_a_report_is_a_packet_and_one_that_says_nothing_new_is_none(api: FakeHid, directory: HidDirectory) -> None:
    api.plug("/dev/hidraw3", ROCK_BAND)
    port = directory.open(directory.names()[0])
    assert port.name == "Rock Band drums (PS3)"
    api.send("/dev/hidraw3", drum_report(), drum_report(), SNARE, SNARE, drum_report())
    assert port.read() == [Packet(drum_report(), 7), Packet(SNARE, 7), Packet(drum_report(), 7)]
    api.send("/dev/hidraw3", drum_report())
    assert port.read() == []


def test_what_was_sent_before_the_plug_was_pulled_is_read_and_then_the_device_is_gone(
    api: FakeHid, directory: HidDirectory
) -> None:
    api.plug("/dev/hidraw3", ROCK_BAND)
    port = directory.open(DRUMS) if directory.names() else None
    assert port is not None
    api.send("/dev/hidraw3", SNARE)
    api.unplug("/dev/hidraw3")
    assert port.read() == [Packet(SNARE, 7)]
    with pytest.raises(DeviceError, match="the HID device has gone"):
        port.read()


def test_who_may_not_open_it_is_told_the_rule_that_lets_them(
    api: FakeHid, directory: HidDirectory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    node = tmp_path / "hidraw3"
    node.touch()
    api.plug(str(node), ROCK_BAND)
    (port,) = directory.names()
    assert directory.no_access(port) is None
    api.denied.add(str(node).encode())
    with pytest.raises(DeviceError, match="another program has it"):
        directory.open(port)
    monkeypatch.setattr(os, "access", lambda *_: False)  # a superuser may open everything
    rule = 'KERNEL=="hidraw*", ATTRS{idVendor}=="12ba", ATTRS{idProduct}=="0210", TAG+="uaccess"'
    with pytest.raises(DeviceError, match="permission denied") as refused:
        directory.open(port)
    assert rule in str(refused.value)
    assert "70-drum-station.rules" in str(refused.value)


@pytest.mark.parametrize(
    ("midi", "part", "found"),
    [
        (["TD-17 20:0"], "", "TD-17"),
        (["my synth 20:0"], "", "my synth"),
        (["Midi Through 14:0"], "", "Rock Band drums (PS3)"),
        ([], "", "Rock Band drums (PS3)"),
        (["TD-17 20:0"], "rock band", "Rock Band drums (PS3)"),
        (["TD-17 20:0"], "foot", "Foot switch (PCsensor)"),
        (["TD-17 20:0"], "hid:/dev/hidraw1", "Foot switch (PCsensor)"),
    ],
)
def test_game_drums_come_after_midi_kits_and_foot_switches_by_name_alone(
    api: FakeHid, directory: HidDirectory, midi: list[str], part: str, found: str
) -> None:
    api.plug("/dev/hidraw1", FOOT_SWITCH, ((1, 6),))
    api.plug("/dev/hidraw3", ROCK_BAND)
    api.plug("/dev/hidraw10", GUITAR_HERO)
    drums_last = ports_for(DeviceRequest(part), FakeDriver(*midi), directory)
    watch = PortWatch(drums_last, part)
    expected = "Guitar Hero drums (PS3)" if found.startswith("Rock") and not part else found
    assert watch.poll(0).device == expected


def test_no_foot_switch_is_taken_for_a_kit(api: FakeHid, directory: HidDirectory) -> None:
    api.plug("/dev/hidraw1", FOOT_SWITCH, ((1, 6),))
    assert PortWatch(ports_for(DeviceRequest(""), None, directory)).poll(0).device == ""


def test_a_kit_that_comes_back_at_another_path_is_the_same_kit(api: FakeHid, directory: HidDirectory) -> None:
    watch = PortWatch(ports_for(DeviceRequest(""), None, directory))
    api.plug("/dev/hidraw3", ROCK_BAND)
    assert watch.poll(0).found
    api.unplug("/dev/hidraw3")
    lost = watch.poll(1)
    assert (lost.lost, lost.device) == (True, "Rock Band drums (PS3)")
    api.plug("/dev/hidraw0", GUITAR_HERO)
    api.plug("/dev/hidraw7", ROCK_BAND)
    back = watch.poll(SCAN_EVERY_NS)
    assert (back.found, back.device) == (True, "Rock Band drums (PS3)")
    api.send("/dev/hidraw7", SNARE)
    assert [packet.data for packet in watch.poll(SCAN_EVERY_NS + 1).packets] == [SNARE]


def test_two_kits_of_one_model_have_names_of_their_own(api: FakeHid, directory: HidDirectory) -> None:
    api.plug("/dev/hidraw3", ROCK_BAND)
    api.plug("/dev/hidraw4", ROCK_BAND)
    assert len(set(directory.names())) == 2
    api.send("/dev/hidraw3", key_report())  # nobody listens
    assert api.handles == []
