"""Ticks and seconds against exact fractions, bars and beats against counting by hand."""

from bisect import bisect_right
from fractions import Fraction

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from station.core.units import PPQ
from station.music.tempo import MeterChange, TempoChange, TempoMap

HOUR_TICKS = 3600 * 4 * PPQ
"""An hour at 240 quarter notes a minute."""

us_per_quarter = st.integers(60_000, 6_000_000)
"""1000 down to 10 quarter notes a minute."""
tempo_changes = st.lists(st.builds(TempoChange, st.integers(0, HOUR_TICKS), us_per_quarter), max_size=12)
meter_changes = st.lists(
    st.builds(MeterChange, st.integers(0, HOUR_TICKS), st.integers(1, 19), st.sampled_from([1, 2, 4, 8, 16, 32])),
    max_size=8,
)
ticks = st.integers(0, 2 * HOUR_TICKS)


def exact_ns(tempo_map: TempoMap, tick: int) -> Fraction:
    """The definition: a sum over the segments of one tempo."""
    total = Fraction(0)
    changes = tempo_map.tempos
    for i, change in enumerate(changes):
        end = changes[i + 1].tick if i + 1 < len(changes) else None
        reached = tick if end is None or tick < end else end
        total += Fraction((reached - change.tick) * change.us_per_quarter * 1000, PPQ)
        if reached == tick:
            break
    return total


@given(tempo_changes, st.lists(ticks, min_size=1, max_size=20))
def test_time_is_exact_to_half_a_nanosecond(changes: list[TempoChange], at: list[int]) -> None:
    tempo_map = TempoMap.build(changes)
    for tick, ns in zip(at, tempo_map.ns_at(at).tolist(), strict=True):
        assert abs(ns - exact_ns(tempo_map, tick)) <= Fraction(1, 2)


@given(tempo_changes, st.lists(ticks, min_size=1, max_size=20))
def test_ticks_come_back_from_nanoseconds(changes: list[TempoChange], at: list[int]) -> None:
    tempo_map = TempoMap.build(changes)
    assert tempo_map.ticks_at_ns(tempo_map.ns_at(at)).tolist() == at


@given(tempo_changes, st.lists(ticks, min_size=1, max_size=20))
def test_ticks_come_back_from_seconds(changes: list[TempoChange], at: list[int]) -> None:
    tempo_map = TempoMap.build(changes)
    assert tempo_map.ticks_at(tempo_map.seconds_at(at)).tolist() == at


@given(tempo_changes, st.integers(0, 3600 * 10**9))
def test_a_time_between_ticks_goes_to_the_nearest(changes: list[TempoChange], ns: int) -> None:
    tempo_map = TempoMap.build(changes)
    tick = int(tempo_map.ticks_at_ns(ns))
    near = [abs(exact_ns(tempo_map, t) - ns) for t in (max(tick - 1, 0), tick, tick + 1)]
    assert near[1] <= min(near) + 1, "within the nanosecond to which times are rounded"


@given(tempo_changes, st.lists(ticks, min_size=2, max_size=20))
def test_time_never_runs_back(changes: list[TempoChange], at: list[int]) -> None:
    times = TempoMap.build(changes).ns_at(sorted(at))
    assert (np.diff(times) >= 0).all()


@given(tempo_changes, st.integers(-10 * PPQ, -1))
def test_before_the_start_the_first_tempo_holds(changes: list[TempoChange], tick: int) -> None:
    tempo_map = TempoMap.build(changes)
    expected = Fraction(tick * tempo_map.tempos[0].us_per_quarter * 1000, PPQ)
    assert abs(int(tempo_map.ns_at(tick)) - expected) <= Fraction(1, 2)
    assert int(tempo_map.ticks_at_ns(tempo_map.ns_at(tick))) == tick


@given(tempo_changes, meter_changes, st.data())
def test_a_section_sounds_as_it_does_in_the_whole(
    tempos: list[TempoChange], meters: list[MeterChange], data: st.DataObject
) -> None:
    whole = TempoMap.build(tempos, meters)
    start = data.draw(st.integers(0, HOUR_TICKS))
    end = data.draw(st.integers(start + 1, 2 * HOUR_TICKS))
    at = np.array(data.draw(st.lists(st.integers(start, end), min_size=1, max_size=10)))
    section = whole.section(start, end)
    in_whole = whole.ns_at(at) - whole.ns_at(start)
    assert (np.abs(section.ns_at(at - start) - in_whole) <= 1).all(), "two roundings of half a nanosecond"


@given(tempo_changes, st.floats(0.25, 4))
def test_twice_as_fast_takes_half_the_time(changes: list[TempoChange], factor: float) -> None:
    tempo_map = TempoMap.build(changes)
    quick = int(tempo_map.scaled(factor).ns_at(HOUR_TICKS))
    slow = int(tempo_map.ns_at(HOUR_TICKS))
    quarters = HOUR_TICKS / PPQ
    assert abs(quick - slow / factor) <= 500 * quarters + 1, "half a microsecond a quarter note, as MIDI rounds"


def bars_by_counting(tempo_map: TempoMap, until: int) -> list[int]:
    """First ticks of all bars up to `until`, one after the other: a new meter starts a new bar."""
    starts, tick = [], 0
    change_ticks = [m.tick for m in tempo_map.meters]
    while tick <= until:
        starts.append(tick)
        meter = tempo_map.meters[bisect_right(change_ticks, tick) - 1]
        following = [c for c in change_ticks if c > tick]
        tick = min([tick + meter.bar_ticks, *following[:1]])
    return starts


short_meters = st.lists(
    st.builds(MeterChange, st.integers(0, 40 * PPQ), st.integers(1, 9), st.sampled_from([2, 4, 8, 16])), max_size=6
)


@given(short_meters, st.lists(st.integers(0, 60 * PPQ), min_size=1, max_size=20))
def test_bars_are_counted_as_a_drummer_counts_them(meters: list[MeterChange], at: list[int]) -> None:
    tempo_map = TempoMap.build([], meters)
    starts = bars_by_counting(tempo_map, 60 * PPQ)
    assert [tempo_map.bar_start(i) for i in range(len(starts))] == starts
    assert tempo_map.bars_at(at).tolist() == [bisect_right(starts, t) - 1 for t in at]


@given(short_meters, st.integers(0, 50 * PPQ))
def test_a_position_adds_up_to_its_tick(meters: list[MeterChange], tick: int) -> None:
    tempo_map = TempoMap.build([], meters)
    place = tempo_map.position_at(tick)
    meter = tempo_map.meter_at(tick)
    assert tempo_map.bar_start(place.bar) + place.beat * meter.beat_ticks + place.tick == tick
    assert 0 <= place.beat < meter.beats
    assert 0 <= place.tick < meter.beat_ticks


@given(short_meters, st.integers(0, 30 * PPQ), st.integers(0, 30 * PPQ))
def test_beats_of_a_stretch_are_those_of_the_whole_within_it(
    meters: list[MeterChange], start: int, length: int
) -> None:
    tempo_map = TempoMap.build([], meters)
    every = tempo_map.beats_between(0, start + length)
    assert tempo_map.beats_between(start, start + length) == [b for b in every if b[0] >= start]
    bars = bars_by_counting(tempo_map, start + length)
    assert [t for t, beat in every if beat == 0] == [b for b in bars if b < start + length]
