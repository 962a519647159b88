"""Rhythm spelling: what a drummer's pen would write, by hand; and that every bar adds up."""

from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from station.core.units import PPQ
from station.music.tempo import MeterChange
from station.render.notation.rhythm import BeatGroup, Value, beat_groups, spell

Q = PPQ


def values(group: BeatGroup) -> list[tuple[int, int]]:
    return [(s.value.base, s.value.dots) for s in group.strokes]


def rests(group: BeatGroup) -> list[tuple[int, int]]:
    return [(r.tick, r.value.base) for r in group.rests]


@pytest.mark.parametrize(
    ("onsets", "written", "tuplet"),
    [
        ([0], [(4, 0)], 0),
        ([0, Q // 2], [(8, 0), (8, 0)], 0),
        ([0, 3 * Q // 4], [(8, 1), (16, 0)], 0),
        ([0, Q // 4], [(16, 0), (8, 1)], 0),
        ([0, Q // 4, Q // 2, 3 * Q // 4], [(16, 0)] * 4, 0),
        ([k * Q // 8 for k in range(8)], [(32, 0)] * 8, 0),
        ([0, Q // 3, 2 * Q // 3], [(8, 0)] * 3, 3),
        ([0, 2 * Q // 3], [(4, 0), (8, 0)], 3),
        ([k * Q // 6 for k in range(6)], [(16, 0)] * 6, 6),
        ([k * Q // 5 for k in range(5)], [(16, 0)] * 5, 5),
        ([k * Q // 7 for k in range(7)], [(16, 0)] * 7, 7),
    ],
)
def test_a_quarter(onsets: list[int], written: list[tuple[int, int]], tuplet: int) -> None:
    group = spell(onsets, 0, Q)
    assert values(group) == written
    assert group.tuplet == tuplet
    assert group.rests == ()


@pytest.mark.parametrize(
    ("onsets", "written", "pauses"),
    [
        ([], [], [(0, 4)]),
        ([Q // 2], [(8, 0)], [(0, 8)]),
        ([3 * Q // 4], [(16, 0)], [(0, 8), (Q // 2, 16)]),
        ([Q // 4], [(8, 1)], [(0, 16)]),
        ([Q // 3], [(4, 0)], [(0, 8)]),
    ],
)
def test_rests_in_a_quarter(onsets: list[int], written: list[tuple[int, int]], pauses: list[tuple[int, int]]) -> None:
    group = spell(onsets, 0, Q)
    assert values(group) == written
    assert rests(group) == pauses


def test_compound_time() -> None:
    dotted = 3 * Q // 2
    assert values(spell([0], 0, dotted)) == [(4, 1)]
    assert values(spell([0, Q], 0, dotted)) == [(4, 0), (8, 0)]
    assert values(spell([0, Q // 2, Q], 0, dotted)) == [(8, 0)] * 3
    assert values(spell([0, 3 * Q // 4], 0, dotted)) == [(8, 1)] * 2, "two against three as dotted eighths"


def test_groups_of_meters() -> None:
    def lengths(beats: int, unit: int, groups: tuple[int, ...] = ()) -> list[int]:
        meter = MeterChange(0, beats, unit, groups)
        return [(end - start) * 2 // Q for start, end in beat_groups(meter, meter.bar_ticks)]

    assert lengths(4, 4) == [2, 2, 2, 2]
    assert lengths(6, 8) == [3, 3]
    assert lengths(12, 8) == [3, 3, 3, 3]
    assert lengths(7, 8) == [2, 2, 3]
    assert lengths(5, 8) == [2, 3]
    assert lengths(7, 8, (3, 2, 2)) == [3, 2, 2]
    assert lengths(8, 8, (3, 3, 2)) == [3, 3, 2]
    assert lengths(5, 4, (3, 2)) == [2, 2, 2, 2, 2]


@pytest.mark.parametrize(("count", "base"), [(9, 32), (10, 32), (14, 32), (13, 32), (24, 64), (32, 128)])
def test_many_strokes_to_a_beat_are_all_written(count: int, base: int) -> None:
    """Nine, ten, fourteen take the place of eight thirty-seconds (Gould, Behind Bars, on tuplets)."""
    onsets = [round(k * Q / count) for k in range(count)]
    group = spell(onsets, 0, Q)
    assert [stroke.tick for stroke in group.strokes] == onsets
    assert {stroke.value.base for stroke in group.strokes} == {base}
    assert group.tuplet == (count if count & (count - 1) else 0)


def test_a_played_beat_is_written_as_what_was_meant() -> None:
    early = [0, Q // 4 - 2000, Q // 2 + 1500, 3 * Q // 4 + 2500]  # within 12 ms at 120 bpm
    assert values(spell(early, 0, Q)) == [(16, 0)] * 4


def test_beams_of_values() -> None:
    assert [Value(base).beams for base in (1, 2, 4, 8, 16, 32, 64)] == [0, 0, 0, 1, 2, 3, 4]


def length_of(value: Value) -> Fraction:
    """Whole notes."""
    return Fraction(2 ** (value.dots + 1) - 1, 2**value.dots) / value.base


@given(st.sets(st.integers(0, 15), min_size=0, max_size=16))
def test_a_binary_group_adds_up(slots: set[int]) -> None:
    group = spell([s * Q // 16 for s in sorted(slots)], 0, Q)
    if group.tuplet == 0:
        total = sum((length_of(t.value) for t in (*group.strokes, *group.rests)), Fraction(0))
        assert total == Fraction(1, 4)
        assert [s.tick for s in group.strokes] == [s * Q // 16 for s in sorted(slots)]
    else:
        raise AssertionError("sixteenth parts of a beat are no tuplet")


@given(st.sampled_from([3, 5, 6, 7, 12]), st.data())
def test_a_tuplet_adds_up(division: int, data: st.DataObject) -> None:
    slots = data.draw(st.sets(st.integers(0, division - 1), min_size=1))
    group = spell([round(s * Q / division) for s in sorted(slots)], 0, Q)
    total = sum((length_of(t.value) for t in (*group.strokes, *group.rests)), Fraction(0))
    written = group.tuplet or 4  # n in the time of the power of two below it
    in_time_of = 1 << (written.bit_length() - 1)
    assert total * Fraction(in_time_of, written) == Fraction(1, 4)
