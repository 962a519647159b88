"""How measured hits are matched to what was sent; by hand."""

import pytest

from station.bench.rows.input_timing_rows import paired


def test_what_was_heard_is_found_among_what_was_sent() -> None:
    assert paired([1, 2, 3, 4], [1, 2, 3, 4]) == [(0, 0), (1, 1), (2, 2), (3, 3)]
    assert paired([1, 2, 3, 4], [2, 4]) == [(1, 0), (3, 1)]
    assert paired([1, 2, 1, 2], [2, 1]) == [(1, 0), (2, 1)]
    assert paired([1, 2], []) == []


@pytest.mark.parametrize("heard", [[3], [2, 1], [1, 1]])
def test_what_was_never_sent_is_no_measurement(heard: list[int]) -> None:
    with pytest.raises(ValueError, match="was not sent"):
        paired([1, 2], heard)
