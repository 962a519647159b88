"""A channel as a controller's values, worked out by hand."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.music.formats.smf.track_writer import ControlMove
from station.sync.signals.signal import Signal
from station.sync.sonification.channel_levels import ChannelLevel, level_cues, parse_level

KNEE = ChannelLevel("knee", 0.0, 127.0, 11)
AT_NS = np.arange(5) * 10


def cues(samples: list[float], sure: list[bool]) -> list[ControlMove]:
    return level_cues(KNEE, AT_NS[: len(samples)], np.array(samples), np.array(sure))


def test_the_range_is_stretched_and_clipped() -> None:
    assert ChannelLevel("knee", -10.0, 10.0).values(np.array([-99.0, -10.0, 0.0, 10.0, 99.0])).tolist() == [
        0, 0, 64, 127, 127,
    ]  # fmt: skip


def test_a_range_may_be_upside_down() -> None:
    assert ChannelLevel("knee", 10.0, -10.0).values(np.array([10.0, -10.0])).tolist() == [0, 127]


def test_only_changes_are_told() -> None:
    assert cues([5, 5, 7, 7.2, 6], [True] * 5) == [
        ControlMove(0, 11, 5),
        ControlMove(20, 11, 7),
        ControlMove(40, 11, 6),
    ]


def test_where_sureness_ends_the_controller_falls_to_nothing() -> None:
    assert cues([5, 5, 5, 5], [False, True, True, False]) == [ControlMove(10, 11, 5), ControlMove(30, 11, 0)]


SIGNAL = Signal(np.arange(3) / 10, ("knee", "rest"), np.array([[-5.0, 1.0], [40.0, 1.0], [15.0, 1.0]]))


def test_a_level_has_the_channels_own_range() -> None:
    assert parse_level("knee=74", SIGNAL, "--level") == ChannelLevel("knee", -5.0, 40.0, 74)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("knee", "--level: knee: expected CHANNEL=CONTROLLER"),
        ("knee=128", "0 to 127"),
        ("knee=" + "9" * 5_000, "0 to 127"),
        ("hip=1", "no such channel: hip"),
        ("rest=1", "never moves"),
    ],
)
def test_a_level_that_cannot_be_meant_is_said(text: str, fault: str) -> None:
    with pytest.raises(BadInput, match=fault):
        parse_level(text, SIGNAL, "--level")
