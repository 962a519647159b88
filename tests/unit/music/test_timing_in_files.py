"""A stroke's own timing in the formats: MIDI sounds as it was played, a text score keeps it, others say it is lost."""

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Ornament, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.drum_part import DrumPart
from station.music.formats.format_table import FORMATS
from station.music.formats.music_format import Feature, MusicFormat
from station.music.formats.part_features import features_of, without_a_word
from station.music.formats.smf.midi_part import read_midi_part, write_midi_part
from station.music.formats.text_score import parse_text_score, score_text
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.tempo import TempoMap

LATE = Note(PPQ, Piece.SNARE, late_ms=-12.5)
PART = DrumPart(
    Score.from_notes([Note(0, Piece.KICK), LATE, Note(2 * PPQ, Piece.KICK)], TempoMap.constant(120.0), 4 * PPQ, "T")
)


def test_midi_strikes_where_it_sounds_and_says_so() -> None:
    """At 120 beats a minute the second beat is at 500 ms, and sounds 12.5 ms earlier."""
    written = write_midi_part(PART)
    assert {Feature.TIMES, Feature.TIMING} <= {loss.feature for loss in written.lost}
    back = read_midi_part(written.data, "t.mid").score
    assert np.allclose(back.onset_ns / NS_PER_MS, [0, 487.5, 1000], atol=0.02)


def test_a_first_stroke_before_the_beat_puts_the_music_a_bar_later() -> None:
    early = DrumPart(Score.from_notes([Note(0, Piece.KICK, late_ms=-20)], TempoMap.constant(120.0), 4 * PPQ, "T"))
    back = read_midi_part(write_midi_part(early).data, "t.mid").score
    assert np.allclose(back.onset_ns / NS_PER_MS, [1980], atol=0.02)


def test_a_text_score_keeps_it() -> None:
    flam = with_graces(Note(2 * PPQ, Piece.SNARE, ornament=Ornament.FLAM, late_ms=7.25))
    score = Score.from_notes([LATE, *flam], TempoMap.constant(120.0), 4 * PPQ)
    text = score_text(score, score.notes["limb"])
    assert "late_ms=-12.5" in text
    assert parse_text_score(text).notes.tobytes() == score.notes.tobytes()
    with pytest.raises(BadInput, match="expected late_ms from -60 to 60"):
        parse_text_score(text.replace("late_ms=-12.5", "late_ms=-61"))


@pytest.mark.parametrize("form", [form for form in FORMATS if form.write is not None], ids=lambda form: form.name)
def test_every_other_format_says_that_it_is_lost(form: MusicFormat) -> None:
    assert form.write is not None
    written = form.write(PART)
    lost = {loss.feature for loss in written.lost} | set(without_a_word(form, PART, written))
    assert Feature.TIMING in lost
    assert Feature.TIMING in features_of(PART)
    assert Feature.TIMING not in features_of(DrumPart(PART.score.on_the_grid))


def test_grace_strokes_of_hydrogen_stand_before_their_note_as_it_is_written() -> None:
    hydrogen = next(form for form in FORMATS if form.name == "Hydrogen song")
    flam = with_graces(Note(PPQ, Piece.SNARE, ornament=Ornament.FLAM, late_ms=40))
    timed = DrumPart(Score.from_notes(flam, TempoMap.constant(120.0), 4 * PPQ, "T"))
    assert hydrogen.write is not None
    assert hydrogen.write(timed).data == hydrogen.write(DrumPart(timed.score.on_the_grid)).data
