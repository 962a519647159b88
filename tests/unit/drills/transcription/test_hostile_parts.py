"""Parts that no teacher would write become a lesson all the same, or are refused in words that blame no file."""

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.drills.transcription.transcribe import transcribe
from station.drills.writing.score_difference import score_difference
from station.music.drum_part import DrumPart
from station.music.formats.dtx.dtx_reader import read_dtx
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

_BOTH = (Limb.LEFT_FOOT, Limb.RIGHT_FOOT)


def _part(notes: list[Note], tempo_bpm: float = 60) -> DrumPart:
    return DrumPart(Score.from_notes(notes, TempoMap.constant(tempo_bpm)))


def _twins(velocities: tuple[int, int], limbs: tuple[Limb, Limb] = _BOTH) -> Score:
    pairs = zip(velocities, limbs, strict=True)
    return Score.from_notes([Note(0, Piece.KICK, velocity=v, limb=limb) for v, limb in pairs], TempoMap.constant(60))


def test_two_feet_on_one_kick_are_the_same_in_any_order() -> None:
    there = _twins((60, 100))
    assert score_difference(there, _twins((100, 60), (Limb.RIGHT_FOOT, Limb.LEFT_FOOT))) == ""
    assert "velocity" in score_difference(there, _twins((60, 90)))
    assert "limb" in score_difference(_twins((100, 100)), _twins((100, 100), (Limb.RIGHT_FOOT, Limb.RIGHT_FOOT)))


@pytest.mark.parametrize("cells", [17, 19, 23])
def test_feet_on_cells_that_no_grid_has_become_a_lesson(cells: int) -> None:
    notes = [
        Note(round(i * PPQ / cells), Piece.KICK, velocity=(80, 100, 60)[i % 3], limb=_BOTH[i % 2]) for i in range(60)
    ]
    lesson = transcribe(_part(notes), "x").lesson
    assert {note.limb for note in lesson.score} == set(_BOTH)
    assert len(lesson.score) + len(lesson.beyond) >= 60 * 0.7


@pytest.mark.parametrize("cells", [3, 5, 7, 11, 13])
def test_feet_in_turn_on_cells_of_any_number(cells: int) -> None:
    notes = [Note(round(i * PPQ / cells), Piece.KICK, limb=_BOTH[i % 2]) for i in range(3 * cells)]
    lesson = transcribe(_part(notes), "x").lesson
    assert [note.limb for note in lesson.score] == [_BOTH[i % 2] for i in range(3 * cells)]


def test_bars_of_a_meter_that_a_lesson_has_not() -> None:
    bars = b"".join(b"#%03d02: 0.%d\n" % (i, i + 1) for i in range(300))
    with pytest.raises(BadInput, match=r"^x: bar 300: a meter of \d+/64; a lesson has 1 to 32 beats of 1/1 to 1/32"):
        transcribe(read_dtx(b"#TITLE: a\n#BPM: 120\n" + bars + b"#29912: 01\n", "x.dtx"), "x")


@pytest.mark.parametrize(("beats", "unit"), [(255, 1), (33, 8), (3, 64)])
def test_a_meter_that_no_lesson_has_is_refused_with_its_bar(beats: int, unit: int) -> None:
    tempo_map = TempoMap.build([], [MeterChange(0, 4, 4), MeterChange(4 * PPQ, beats, unit)])
    notes = [Note(i * PPQ // 16, Piece.SNARE) for i in range(120)]
    with pytest.raises(BadInput, match=rf"^a\.mid: bar 2: a meter of {beats}/{unit}; a lesson has 1 to 32 beats"):
        transcribe(DrumPart(Score.from_notes(notes, tempo_map)), "x", "a.mid")


@pytest.mark.parametrize("us_per_quarter", [1, 16_777_215])
def test_a_tempo_that_no_lesson_has_is_refused_before_its_strokes_are_sorted(us_per_quarter: int) -> None:
    tempo_map = TempoMap.build([TempoChange(0, us_per_quarter)])
    notes = [Note(i * PPQ // 2, Piece.SNARE) for i in range(30)]
    with pytest.raises(BadInput, match=r"^a\.mid: .* quarter notes a minute from end to end; a lesson has 10 to 1000"):
        transcribe(DrumPart(Score.from_notes(notes, tempo_map)), "x", "a.mid")


@pytest.mark.parametrize("tempo_bpm", [10, 1000])
def test_the_slowest_and_the_fastest_tempo_of_a_lesson_are_none_of_them(tempo_bpm: int) -> None:
    notes = [Note(i * PPQ + 7, Piece.SNARE) for i in range(3)]
    assert transcribe(_part(notes, tempo_bpm), "x").lesson.score.tempo_map.bpm_at(0) == pytest.approx(tempo_bpm)
