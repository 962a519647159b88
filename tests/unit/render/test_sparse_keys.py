"""Few keyframes: lines through them stay near, what must be a key is one, and what is straight has no more."""

import numpy as np
import pytest

from station.render.model.sparse_keys import FARTHEST, sparse_keys

TIME = np.linspace(0.0, 8.0, 401)


def test_lines_between_keys_are_off_by_at_most_one() -> None:
    rng = np.random.default_rng(5)
    wave = np.stack([30 * np.sin(3 * TIME), 12 * np.cos(9 * TIME), np.cumsum(rng.normal(size=len(TIME)))], axis=1)
    keys = sparse_keys(TIME, wave, np.array([77, 78]))
    for channel in wave.T:
        assert np.abs(np.interp(TIME, TIME[keys], channel[keys]) - channel).max() <= 1
    assert {0, 77, 78, 400} <= set(keys.tolist())
    assert (np.diff(keys) > 0).all()
    assert len(keys) < 0.8 * len(TIME)


def test_what_is_straight_needs_few() -> None:
    straight = np.stack([5 * TIME, -3 * TIME], axis=1)
    assert len(sparse_keys(TIME, straight, np.array([], np.int64))) == -(-len(TIME) // FARTHEST) + 1


def test_a_corner_is_a_key() -> None:
    corner = np.abs(TIME - TIME[123])[:, None] * 100
    assert 123 in sparse_keys(TIME, corner, np.array([], np.int64))


@pytest.mark.parametrize("count", [2, 3])
def test_the_shortest_motions(count: int) -> None:
    keys = sparse_keys(TIME[:count], 1e5 * TIME[:count, None] ** 2, np.array([], np.int64))
    assert keys.tolist() == list(range(count))
