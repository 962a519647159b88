import subprocess
import sys
import textwrap
from dataclasses import dataclass

import numpy as np
import pytest

from station.core.errors import DeviceError
from station.sound.output.card_output import fit_channels, reported_dac_ns
from station.sound.output.card_stream import SoundDevice
from station.sound.output.sound_output import choose_output, open_output


def device(index: int, name: str, host: str = "ALSA") -> SoundDevice:
    return SoundDevice(index, name, host, channels=2, rate_hz=48_000, is_default=index == 0)


DEVICES = [
    device(0, "HDA Intel PCH: ALC257 Analog (hw:0,0)"),
    device(1, "USB Audio CODEC"),
    device(2, "USB Audio"),
    device(3, "system", "JACK Audio Connection Kit"),
]


@pytest.mark.parametrize(
    ("part", "index"),
    [("", 0), ("analog", 0), ("usb audio codec", 1), ("CODEC", 1), ("USB", 1), ("usb audio", 2), ("jack", 3)],
)
def test_an_output_is_found_by_part_of_its_name(part: str, index: int) -> None:
    assert choose_output(DEVICES, part).index == index


def test_an_unknown_output_is_refused_with_the_known_ones() -> None:
    with pytest.raises(DeviceError, match=r"'speaker'.*'USB Audio CODEC'.*'system'"):
        choose_output(DEVICES, "speaker")


def test_no_output_at_all_says_what_to_do() -> None:
    with pytest.raises(DeviceError, match="connect one"):
        choose_output([], "")


@pytest.mark.parametrize("block_frames", [-5, 1, 15, 8_193, 10**9])
def test_a_block_that_no_card_plays_is_refused(block_frames: int) -> None:
    with pytest.raises(DeviceError, match=rf"blocks of {block_frames} frames: ask for 16 to 8192"):
        open_output(block_frames=block_frames)


@dataclass
class Times:
    """What a driver would tell a callback."""

    currentTime: float = 0.0  # noqa: N815
    outputBufferDacTime: float = 0.0  # noqa: N815


NOW_NS = 1_000_000_000_000


@pytest.mark.parametrize(
    ("stream_s", "times", "ahead_ms"),
    [
        # The stream's clock says 50.002 s when the callback reads it: the block is heard 8 ms later.
        (50.002, Times(50.000, 50.010), 8.0),
        # The stream's clock cannot be read: the callback's own time counts.
        (0.0, Times(50.000, 50.010), 10.0),
        # Another epoch than the callback's times: no use either.
        (1.7e9, Times(50.000, 50.010), 10.0),
        # The block was due a moment ago.
        (50.015, Times(50.000, 50.010), -5.0),
        # Drivers that report zeros, or nonsense: the stream's latency.
        (50.002, Times(0.0, 0.0), 20.0),
        (0.0, Times(0.0, 0.0), 20.0),
        (50.002, Times(50.000, 90.0), 20.0),
        (50.002, Times(50.000, 12.0), 20.0),
    ],
)
def test_a_blocks_time_by_the_drivers_report(stream_s: float, times: Times, ahead_ms: float) -> None:
    assert reported_dac_ns(NOW_NS, stream_s, times, latency_s=0.020) == pytest.approx(NOW_NS + ahead_ms * 1e6, abs=10)


def test_one_channel_gets_the_mean_of_both() -> None:
    stereo = np.array([[0.2, 0.4], [1.0, -1.0]], np.float32)
    mono, two = np.empty((2, 1), np.float32), np.empty((2, 2), np.float32)
    fit_channels(stereo, mono)
    fit_channels(stereo, two)
    assert mono[:, 0].tolist() == pytest.approx([0.3, 0.0])
    assert two.tolist() == stereo.tolist()


def run_python(program: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=100, check=False
    )


def test_a_missing_portaudio_says_what_to_install() -> None:
    done = run_python("""
        import sys

        class NoLibrary:  # sounddevice raises OSError where the library is missing
            def find_spec(self, name, path=None, target=None):
                if name == "sounddevice":
                    raise OSError("PortAudio library not found")

        sys.meta_path.insert(0, NoLibrary())
        from station.core.errors import DeviceError
        from station.sound.output.sound_output import list_outputs, open_output
        for ask in (list_outputs, open_output):
            try:
                ask()
            except DeviceError as fault:
                assert "libportaudio2" in str(fault), fault
            else:
                raise AssertionError("there is no PortAudio")
    """)
    assert done.returncode == 0, done.stderr


def test_the_library_is_loaded_only_when_sound_is_wanted() -> None:
    done = run_python("""
        import sys
        import station.sound.output.sound_output, station.sound.mixer, station.sound.synth.synth_kits
        assert "sounddevice" not in sys.modules
    """)
    assert done.returncode == 0, done.stderr
