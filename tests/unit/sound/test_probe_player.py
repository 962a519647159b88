import numpy as np
import pytest

from station.sound.calibration.probe_player import LEAD_S, ProbePlayer

BEGIN_NS = 10**13
RATE_HZ = 48_000


@pytest.mark.parametrize("blocks", [[64] * 2_000, [1024] * 100, [100, 7, 4_000, 33] * 40])
def test_the_sound_comes_whole_after_the_lead_in_blocks_of_any_size(blocks: list[int]) -> None:
    sound = np.random.default_rng(1).uniform(-1, 1, 5_000).astype(np.float32)
    player = ProbePlayer(sound, RATE_HZ)
    heard = []
    for index, frames in enumerate(blocks):
        at_ns = BEGIN_NS + round(sum(blocks[:index]) * 1e9 / RATE_HZ)
        heard.append(player(frames, at_ns))
    both = np.concatenate(heard)
    lead = round(LEAD_S * RATE_HZ)
    assert not both[:lead].any()
    assert both[lead : lead + 5_000, 0].tolist() == sound.tolist()
    assert both[lead : lead + 5_000, 1].tolist() == sound.tolist()
    assert not both[lead + 5_000 :].any()
    assert player.is_over


def test_frames_are_heard_when_their_blocks_say() -> None:
    """A card that runs 100 parts in a million fast."""
    player = ProbePlayer(np.zeros(RATE_HZ, np.float32), RATE_HZ)
    true_hz = RATE_HZ * 1.0001
    for block in range(1_000):
        player(128, BEGIN_NS + round(block * 128 / true_hz * 1e9))
    (at_ns,) = player.heard_ns(np.array([24_000]))
    assert at_ns == pytest.approx(BEGIN_NS + (LEAD_S * RATE_HZ + 24_000) / true_hz * 1e9, abs=20)


def test_before_the_first_block_there_are_no_times() -> None:
    player = ProbePlayer(np.zeros(10, np.float32), RATE_HZ)
    assert player.timeline is None
    assert not player.is_over
