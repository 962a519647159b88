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
from station.music.tempo import TempoMap

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
    with pytest.raises(BadInput, match="expected a meter"):
        transcribe(read_dtx(b"#TITLE: a\n#BPM: 120\n" + bars + b"#29912: 01\n", "x.dtx"), "x")
