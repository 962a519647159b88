"""Tapping the tempo; taps are played by hand at a tempo that is known."""

import pytest

from station.cli.input.tapping import tempo_of
from station.core.errors import BadInput
from station.core.units import NS_PER_S


def taps(*times_s: float | None) -> "list[int | None]":
    return [None if time_s is None else round(time_s * NS_PER_S) for time_s in times_s]


def tempo(given: "list[int | None]") -> float:
    left = iter(given)

    def next_tap(wait_s: float) -> int | None:
        try:
            return next(left)
        except StopIteration:
            raise EOFError from None

    return tempo_of(next_tap)


def test_whoever_stops_tapping_has_a_tempo() -> None:
    assert tempo(taps(10.0, 10.5, 11.0, 11.5, None)) == pytest.approx(120.0)


def test_whoever_hesitates_begins_anew() -> None:
    assert tempo(taps(1.0, 1.2, None, 10.0, 11.0, 12.0, 13.0, None)) == pytest.approx(60.0)


def test_nobody_who_taps_is_told() -> None:
    with pytest.raises(BadInput, match="expected 4 taps"):
        tempo(taps(1.0, 2.0))
