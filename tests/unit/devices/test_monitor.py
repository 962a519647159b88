"""What a page of a kit keeps of the bytes that it shows."""

from dataclasses import replace
from pathlib import Path

from station.core.pieces import Piece
from station.core.units import NS_PER_MS
from station.devices.mapping.device_map import Crosstalk
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.devices.monitor import DeviceMonitor

KIT = "a kit"
SNARE, ITS_END = bytes.fromhex("99 26 10"), bytes.fromhex("89 26 00")


def test_bytes_are_kept_no_longer_than_their_strokes_are_in_doubt(tmp_path: Path) -> None:
    """A soft snare waits for a kick that may have made it; its end comes meanwhile and says nothing."""
    monitor = DeviceMonitor(tmp_path)
    monitor.found(KIT, 0)
    monitor.trial(KIT, replace(GENERAL_MIDI_PRESET, crosstalk=(Crosstalk(Piece.KICK, Piece.SNARE, 0.3),)))
    shown = []
    for stroke in range(100):
        at_ns = stroke * 100 * NS_PER_MS
        shown += monitor.bytes_came(KIT, SNARE, at_ns)
        shown += monitor.bytes_came(KIT, ITS_END, at_ns + NS_PER_MS)
        shown += monitor.settle(at_ns + 50 * NS_PER_MS)
    assert [line.raw for line in shown if line.event is not None] == ["99 26 10"] * 100
    assert sum(len(raw) for raw in monitor._raw.values()) <= 2


def test_a_serial_ports_single_bytes_are_shown_as_the_stroke_that_they_are(tmp_path: Path) -> None:
    """The second stroke leaves its status out (running status); what is no message is shown all the same."""
    monitor = DeviceMonitor(tmp_path)
    monitor.found(KIT, 0)
    stream = bytes.fromhex("99 26 5a 24 50 b9 f7 01 02 03")
    lines = [line for at, byte in enumerate(stream) for line in monitor.bytes_came(KIT, bytes([byte]), at)]
    shown = [(line.raw, type(line.event).__name__) for line in lines]
    assert shown == [("99 26 5a", "Hit"), ("24 50", "Hit"), ("b9 f7 01", "NoneType")]
