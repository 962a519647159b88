"""The small words: clocks, units, events, pieces."""

import itertools
import runpy
import sys
import time
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from station.core import clock as clock_module
from station.core.clock import Clock, ManualClock, MonotonicClock, monotonic_ns
from station.core.events import Hit
from station.core.pieces import CYMBALS, HAND_PIECES, TOMS, Articulation, Limb, Piece, Zone, word
from station.core.units import NS_PER_MS, PPQ, ms_from_ns, ns_from_ms, ns_from_s, s_from_ns


def test_the_manual_clock_stands_still_until_it_is_moved() -> None:
    clock = ManualClock(5)
    assert (clock.now_ns(), clock.now_ns()) == (5, 5)
    clock.advance_to(5)
    clock.advance_to(70)
    assert clock.now_ns() == 70


def test_the_manual_clock_never_goes_back() -> None:
    with pytest.raises(AssertionError):
        ManualClock(5).advance_to(4)


@pytest.mark.parametrize("clock", [MonotonicClock(), ManualClock()])
def test_no_clock_goes_back(clock: Clock) -> None:
    times = [clock.now_ns() for _ in range(100)]
    assert times == sorted(times)


def test_session_time_moves_in_fine_steps() -> None:
    """A hit is judged by the millisecond; Windows' tick of 15.6 ms would hide it."""
    times = [monotonic_ns() for _ in range(200_000)]
    steps = [after - before for before, after in itertools.pairwise(times) if after > before]
    assert min(steps) < NS_PER_MS / 10


def test_windows_gets_its_fine_clock(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "platform", "win32")
    assert runpy.run_path(clock_module.__file__)["monotonic_ns"] is time.perf_counter_ns


def test_nobody_has_a_session_clock_of_their_own() -> None:
    sources = Path(clock_module.__file__).parents[1].rglob("*.py")
    assert [path.name for path in sources if "time.monotonic_ns" in path.read_text("utf-8")] == ["clock.py"]


def test_a_tick_divides_what_drummers_play() -> None:
    for parts in (1, 2, 3, 4, 5, 6, 7, 8, 12, 16, 24, 32, 48, 64, 96, 120, 192, 480, 960):
        assert PPQ % parts == 0, parts


@pytest.mark.parametrize(("seconds", "ns"), [(0.0, 0), (1.5, 1_500_000_000), (-0.25, -250_000_000), (1e-9, 1)])
def test_seconds_and_nanoseconds(seconds: float, ns: int) -> None:
    assert ns_from_s(seconds) == ns
    assert s_from_ns(ns) == seconds


def test_milliseconds_round_to_the_nearest_nanosecond() -> None:
    assert ns_from_ms(1.0000004) == 1_000_000
    assert ns_from_ms(1.0000006) == 1_000_001
    assert ms_from_ns(-8_500_000) == -8.5


def test_events_cannot_be_changed() -> None:
    hit = Hit(0, Piece.SNARE, Zone.HEAD, 80)
    with pytest.raises(FrozenInstanceError):
        hit.velocity = 81  # type: ignore[misc]


def test_what_a_kit_cannot_tell_is_none() -> None:
    hit = Hit(0, Piece.SNARE, Zone.HEAD, 80)
    assert (hit.openness, hit.position, hit.limb) == (None, None, Limb.UNKNOWN)


def test_numbers_in_captures_never_change_their_meaning() -> None:
    """Written down when the first captures were made; a new member gets a new number."""
    assert [p.name for p in Piece][:4] == ["KICK", "SNARE", "HIHAT", "HIHAT_PEDAL"]
    assert (Piece.FLOOR_TOM_2, Piece.PERCUSSION, Piece.RIDE_2) == (14, 18, 19)
    assert (Zone.PEDAL, Articulation.SPLASH, Limb.LEFT_FOOT, Limb.UNKNOWN) == (5, 5, 3, -1)


def test_the_groups_of_pieces() -> None:
    assert not HAND_PIECES & {Piece.KICK, Piece.HIHAT_PEDAL}
    assert Piece.HIHAT not in CYMBALS
    assert len(set(TOMS)) == 6
    assert not CYMBALS & set(TOMS)


def test_limbs_are_hands_or_feet() -> None:
    assert [limb.name for limb in Limb if limb.is_hand] == ["RIGHT_HAND", "LEFT_HAND"]


def test_words_as_files_write_them() -> None:
    assert (word(Piece.FLOOR_TOM_1), word(Limb.RIGHT_HAND)) == ("floor_tom_1", "right_hand")
