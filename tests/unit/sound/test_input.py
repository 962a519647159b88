from dataclasses import dataclass

import pytest

from station.core.errors import DeviceError
from station.sound.output.card_input import reported_adc_ns
from station.sound.output.card_stream import SoundDevice
from station.sound.output.sound_output import choose_device

NOW_NS = 1_000_000_000_000


@dataclass
class Times:
    """What a driver would tell a callback."""

    currentTime: float = 0.0  # noqa: N815
    inputBufferAdcTime: float = 0.0  # noqa: N815


@pytest.mark.parametrize(
    ("stream_s", "times", "ago_ms"),
    [
        # The stream's clock says 50.002 s when the callback reads it: the block was heard 12 ms before.
        (50.002, Times(50.000, 49.990), 12.0),
        # The stream's clock cannot be read, or counts from elsewhere: the callback's own time counts.
        (0.0, Times(50.000, 49.990), 10.0),
        (1.7e9, Times(50.000, 49.990), 10.0),
        # Drivers that report zeros, or nonsense: the stream's latency.
        (50.002, Times(0.0, 0.0), 20.0),
        (50.002, Times(50.000, 90.0), 20.0),
        (50.002, Times(50.000, 12.0), 20.0),
    ],
)
def test_a_blocks_time_by_the_drivers_report(stream_s: float, times: Times, ago_ms: float) -> None:
    assert reported_adc_ns(NOW_NS, stream_s, times, latency_s=0.020) == pytest.approx(NOW_NS - ago_ms * 1e6, abs=10)


def test_an_unknown_input_is_refused_with_the_known_ones() -> None:
    there = [SoundDevice(0, "Built-in Microphone", "ALSA", 1, 48_000, is_default=True)]
    assert choose_device(there, "micro", "input") is there[0]
    with pytest.raises(DeviceError, match="no sound input is called 'line'; there are 'Built-in Microphone'"):
        choose_device(there, "line", "input")
    with pytest.raises(DeviceError, match="no input device"):
        choose_device([], "", "input")
