"""Tempo words, by hand: bars of 4/4, ramps in steps of a sixteenth."""

import pytest

from station.core.units import PPQ
from station.music.tempo import TempoChange, TempoMap
from station.music.tempo_words import TempoWord, read_tempo_words, tempo_words

BAR = 4 * PPQ
STEP = PPQ // 4


def ramp(start: int, from_bpm: float, to_bpm: float, bars: int = 1) -> list[TempoChange]:
    steps = bars * 16
    return [TempoChange.from_bpm(start + k * STEP, from_bpm + (to_bpm - from_bpm) * k / steps) for k in range(steps)]


def told(changes: list[TempoChange]) -> list[TempoWord]:
    return [
        TempoWord(word.tick, round(word.tempo_bpm, 1), word.until, word.way)
        for word in tempo_words(TempoMap.build([TempoChange.from_bpm(0, 100.0), *changes]))
    ]


def test_one_tempo_needs_no_word() -> None:
    assert told([]) == []


def test_a_new_tempo_is_a_number() -> None:
    assert told([TempoChange.from_bpm(BAR, 120.0), TempoChange.from_bpm(2 * BAR, 140.0)]) == [
        TempoWord(BAR, 120.0),
        TempoWord(2 * BAR, 140.0),
    ]


@pytest.mark.parametrize(("target", "way"), [(70.0, -1), (130.0, 1)])
def test_a_ramp_is_one_word_with_its_target(target: float, way: int) -> None:
    assert told(ramp(BAR, 100.0, target)) == [TempoWord(BAR, target, 2 * BAR, way)]
    arrived = TempoChange.from_bpm(2 * BAR, target)
    assert told([*ramp(BAR, 100.0, target), arrived]) == [TempoWord(BAR, target, 2 * BAR, way)]


def test_a_tempo_after_a_ramp_and_another_ramp_are_words_of_their_own() -> None:
    changes = [*ramp(BAR, 100.0, 70.0), TempoChange.from_bpm(2 * BAR, 100.0), *ramp(3 * BAR, 100.0, 120.0, 2)]
    assert told(changes) == [
        TempoWord(BAR, 70.0, 2 * BAR, -1),
        TempoWord(2 * BAR, 100.0),
        TempoWord(3 * BAR, 120.0, 5 * BAR, 1),
    ]


def test_a_jump_at_the_end_of_a_ramp_is_no_part_of_it() -> None:
    assert told([*ramp(BAR, 100.0, 84.0), TempoChange.from_bpm(2 * BAR, 60.0)]) == [
        TempoWord(BAR, 84.0, 2 * BAR, -1),
        TempoWord(2 * BAR, 60.0),
    ]


def read(changes: list[TempoChange]) -> list[TempoWord]:
    whole = TempoMap.build([TempoChange.from_bpm(0, 100.0), *changes])
    return [TempoWord(word.tick, round(word.tempo_bpm, 1)) for word in read_tempo_words(whole)]


def test_how_a_played_tempo_wavers_is_nothing_to_read() -> None:
    wavering = [TempoChange.from_bpm(k * PPQ, 100.0 + (-1) ** k * 2) for k in range(1, 12)]
    assert read([*wavering, TempoChange.from_bpm(12 * PPQ, 100.0)]) == [TempoWord(12 * PPQ, 100.0)]
    jump = [TempoChange.from_bpm(5 * PPQ, 110.0), TempoChange.from_bpm(6 * PPQ, 102.0), *wavering[6:]]
    assert read([*wavering[:4], *jump])[:2] == [TempoWord(5 * PPQ, 110.0), TempoWord(6 * PPQ, 102.0)]
    small = [TempoChange.from_bpm(BAR, 102.0), TempoChange.from_bpm(3 * BAR, 104.0)]
    assert [word.tempo_bpm for word in read(small)] == [102.0, 104.0], "what holds for a bar is meant"
