"""The window watched from outside: when it closes, and what it tells."""

import itertools

import pytest

from station.app.opening import Watch

SECOND_NS = 1_000_000_000


@pytest.fixture
def told() -> list[dict[str, object]]:
    return []


def test_it_closes_after_so_many_frames_and_tells_of_each(told: list[dict[str, object]]) -> None:
    watch = Watch(3, None, told.append)
    assert [watch.shown(None) for _ in range(3)] == [True, True, False]
    watch.close()
    opened, seen = told
    shown_ns = seen["shown_ns"]
    assert isinstance(shown_ns, list)
    assert len(shown_ns) == 3
    assert shown_ns[0] == opened["open_ns"]
    assert seen["lit"] == []


def test_it_closes_after_so_many_seconds(told: list[dict[str, object]], monkeypatch: pytest.MonkeyPatch) -> None:
    clock = itertools.count(0, SECOND_NS)
    monkeypatch.setattr("station.app.opening.monotonic_ns", lambda: next(clock))
    watch = Watch(None, 2.0, told.append)
    assert [watch.shown(None) for _ in range(3)] == [True, True, False]
