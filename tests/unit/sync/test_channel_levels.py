"""A channel as a controller's values, worked out by hand."""

import numpy as np

from station.sync.sonification.channel_levels import ChannelLevel, ControlCue, level_cues

KNEE = ChannelLevel("knee", 0.0, 127.0, 11)
AT_NS = np.arange(5) * 10


def cues(samples: list[float], sure: list[bool]) -> list[ControlCue]:
    return level_cues(KNEE, AT_NS[: len(samples)], np.array(samples), np.array(sure))


def test_the_range_is_stretched_and_clipped() -> None:
    assert ChannelLevel("knee", -10.0, 10.0).values(np.array([-99.0, -10.0, 0.0, 10.0, 99.0])).tolist() == [
        0, 0, 64, 127, 127,
    ]  # fmt: skip


def test_a_range_may_be_upside_down() -> None:
    assert ChannelLevel("knee", 10.0, -10.0).values(np.array([10.0, -10.0])).tolist() == [0, 127]


def test_only_changes_are_told() -> None:
    assert cues([5, 5, 7, 7.2, 6], [True] * 5) == [ControlCue(0, 11, 5), ControlCue(20, 11, 7), ControlCue(40, 11, 6)]


def test_where_sureness_ends_the_controller_falls_to_nothing() -> None:
    assert cues([5, 5, 5, 5], [False, True, True, False]) == [ControlCue(10, 11, 5), ControlCue(30, 11, 0)]
