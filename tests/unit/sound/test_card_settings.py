"""Which channels and rate a device is opened with, by a PortAudio that refuses as real ones do."""

from types import ModuleType
from typing import Literal

import numpy as np
import pytest

from station.sound.output.card_output import fit_channels
from station.sound.output.card_stream import SoundDevice, accepted_settings


class PortAudioError(Exception):
    pass


def portaudio(channels: set[int], rates_hz: set[int]) -> ModuleType:
    """Takes these numbers of channels and these rates, and nothing else."""

    def check(device: int, channels: int, dtype: str, samplerate: int) -> None:
        if channels not in allowed or samplerate not in rates_hz:
            raise PortAudioError

    allowed = channels
    module = ModuleType("sounddevice")
    vars(module).update(PortAudioError=PortAudioError, check_output_settings=check, check_input_settings=check)
    return module


def device(channels: int, rate_hz: int) -> SoundDevice:
    return SoundDevice(3, "a card", "ALSA", channels, rate_hz, is_default=True)


@pytest.mark.parametrize(
    ("has", "own_hz", "takes", "rates_hz", "opened"),
    [
        (2, 44_100, {1, 2}, {44_100, 48_000}, (2, 48_000)),  # as wished
        (2, 44_100, {1, 2}, {44_100}, (2, 44_100)),  # its own rate
        (1, 48_000, {1}, {48_000}, (1, 48_000)),  # one channel
        (8, 96_000, {8}, {48_000, 96_000}, (8, 48_000)),  # all of its channels or none
        (18, 96_000, {18}, {96_000}, (18, 96_000)),
        (2, 44_100, set(), set(), (2, 44_100)),  # nothing: opening it will tell
    ],
)
def test_a_device_is_opened_as_it_can_be(
    has: int, own_hz: int, takes: set[int], rates_hz: set[int], opened: tuple[int, int]
) -> None:
    directions: tuple[Literal["output", "input"], ...] = ("output", "input")
    for direction in directions:
        assert accepted_settings(portaudio(takes, rates_hz), device(has, own_hz), 48_000, direction) == opened


@pytest.mark.parametrize("channels", [1, 2, 3, 8])
def test_any_number_of_channels_gets_the_sound(channels: int) -> None:
    out = np.full((4, channels), 9.0, np.float32)
    fit_channels(np.tile(np.array([0.2, 0.6], np.float32), (4, 1)), out)
    expected = [0.4] if channels == 1 else [0.2, 0.6, *[0.0] * (channels - 2)]
    assert out[2].tolist() == pytest.approx(expected)
