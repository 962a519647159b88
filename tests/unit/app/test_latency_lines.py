"""What the devices panel says of latency: numbers, intervals and doubts as the file has them."""

from datetime import date
from types import MappingProxyType

from station.app.equipment.latency_lines import LatencyLine, latency_lines
from station.core.measured_latency import DeviceLatency, MeasuredLatency, StoredCalibration
from station.core.pieces import Piece

DAY = date(2026, 11, 21)
ROUGH = "a rough number: measure once more"


def test_what_nobody_measured_says_how_to() -> None:
    assert latency_lines(StoredCalibration(), ["TD-17"]) == [
        LatencyLine("sound output", "not measured", "measure it below, best by Loopback", False),
        LatencyLine("TD-17", "not measured", "measure it below, best by Strike", False),
    ]


def test_a_number_comes_with_its_interval_and_with_whether_to_trust_it() -> None:
    pads = MappingProxyType({Piece.SNARE: MeasuredLatency(5.0, 3.1, "strike", DAY)})
    kit = DeviceLatency(MeasuredLatency(4.24, 0.3, "strike", DAY), pads)
    output = MeasuredLatency(-1.0, 0.2, "loopback", DAY, doubts="the chirp was heard in half of the tries")
    known = StoredCalibration().with_output("USB Audio", output).with_kit("TD-17", kit)
    assert latency_lines(known, ["TD-17"]) == [
        LatencyLine(
            "USB Audio",
            "-1.0 ± 0.2 ms, by loopback on 2026-11-21",
            "don't trust this: the chirp was heard in half of the tries",
            False,
        ),
        LatencyLine("TD-17", "+4.2 ± 0.3 ms, by strike on 2026-11-21", "sure", True),
        LatencyLine("TD-17, snare", "+5.0 ± 3.1 ms, by strike on 2026-11-21", ROUGH, False),
    ]
