"""A stream fades in and out; expected steps are the fade's own, whatever the blocks."""

import numpy as np
import pytest

from station.sound.drum_kit import Frames
from station.sound.output.fade_gate import FADE_S, Gate


def passed(gate: Gate, frames: int, block: int) -> Frames:
    blocks = [gate.through(np.ones((block, 2), np.float32)) for _ in range(frames // block)]
    return np.concatenate(blocks)


@pytest.mark.parametrize("rate_hz", [44_100, 48_000, 96_000])
@pytest.mark.parametrize("block", [16, 64, 1000])
def test_it_opens_and_shuts_in_a_straight_line(rate_hz: int, block: int) -> None:
    gate = Gate(rate_hz)
    shut = passed(gate, 2 * block, block)
    gate.open()
    opening = passed(gate, 3000, block)
    gate.shut()
    assert not gate.wait_until_shut(0.0)
    shutting = passed(gate, 3000, block)
    assert gate.wait_until_shut(0.0)
    sound = np.concatenate([shut, opening, shutting])
    assert not shut.any()
    assert opening[-1].tolist() == [1.0, 1.0]
    assert not shutting[-1].any()
    assert np.abs(np.diff(sound[:, 0])).max() <= 1.01 / (FADE_S * rate_hz)
    assert np.count_nonzero(np.diff(opening[:, 0])) == pytest.approx(FADE_S * rate_hz, abs=2)


def test_it_turns_back_half_way() -> None:
    gate = Gate(48_000)
    gate.open()
    opening = passed(gate, 64, 64)
    gate.shut()
    shutting = passed(gate, 192, 64)
    sound = np.concatenate([opening, shutting])[:, 0]
    assert np.abs(np.diff(sound)).max() <= 1.01 / (FADE_S * 48_000)
    assert 0.2 < sound.max() < 0.4
    assert sound[-1] == 0.0


def test_one_that_never_opened_is_shut() -> None:
    assert Gate(48_000).wait_until_shut(0.0)
