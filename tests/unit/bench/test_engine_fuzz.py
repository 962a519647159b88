"""The fuzzer, shortened; and its account of a stream against streams written out by hand."""

import random

import pytest

from station.bench.rigs.devices.engine_fuzz import fuzz_captures, fuzz_engine
from station.bench.rigs.devices.midi_fuzz import cut_anywhere, hostile_bytes, invented, notes_in


@pytest.mark.parametrize(
    ("data", "notes"),
    [
        ("99 26 64", [(38, 100)]),
        ("99 26 64 24 50", [(38, 100), (36, 80)]),  # running status
        ("99 26 f8 64", [(38, 100)]),  # the clock ticks within a message
        ("99 26 00", []),
        ("99 26", []),
        ("26 64", []),
        ("f0 99 26 64 f7", [(38, 100)]),  # a status ends system exclusive that never ended
        ("f0 26 64 f7 26 64", []),
        ("99 26 64 f3 01 26 64", [(38, 100)]),  # system common ends the running status
        ("99 26 64 f5 26 64", [(38, 100)]),
        ("99 26 89 24 40 99 24 50", [(36, 80)]),
    ],
)
def test_the_notes_of_a_stream_by_the_grammar_of_midi(data: str, notes: list[tuple[int, int]]) -> None:
    assert notes_in(bytes.fromhex(data)) == notes


def test_an_invented_hit_shows() -> None:
    notes = [(38, 100), (36, 80), (38, 100)]
    assert not invented([(38, 100), (38, 100)], notes)
    assert invented([(36, 80), (36, 80)], notes)
    assert invented([(36, 80), (38, 100), (38, 100)], notes)
    assert invented([(38, 99)], notes)


def test_cutting_loses_nothing() -> None:
    chance = random.Random(1)
    for _ in range(200):
        data = hostile_bytes(chance)
        assert b"".join(cut_anywhere(data, chance)) == data


def test_hostile_bytes_neither_crash_nor_hang_nor_invent() -> None:
    result = fuzz_engine(4_000, seed=1)
    assert (result.inputs, result.faults) == (4_000, 0), result.told


def test_damaged_captures_are_read_up_to_the_damage() -> None:
    result = fuzz_captures(600, seed=2)
    assert (result.inputs, result.faults) == (600, 0), result.told
