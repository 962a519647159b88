"""A take is written on the screen where its sheet has it: places counted by hand, and a recording."""

from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.drum_part import DrumPart
from station.music.formats.format_table import read_part
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.engraving import Engraver
from station.render.text.paper import OutlineAtlas
from station.scenes.sheets import written_down
from station.scenes.take_spelling import take_spelling

GMD = Path(__file__).parents[3].parent / "shared" / "data" / "gmd"
STRAYS_MS = (7, -9, 4, -12, 10, -5, 13, -8, 3, -6, 9, -11, 5, -3, 12, -7)
TICKS_A_MS = PPQ * 2 / 1000
"""At 120 quarters a minute."""


def take(*quarters: float) -> DrumPart:
    """Snare strokes near those places of two bars, as an amateur has them."""
    ticks = [max(round(q * PPQ + STRAYS_MS[k % 16] * TICKS_A_MS), 0) for k, q in enumerate(quarters)]
    tempo_map = TempoMap.constant(120.0)
    score = Score.from_notes([Note(t, Piece.SNARE, velocity=90) for t in ticks], tempo_map, tempo_map.bar_start(2))
    return DrumPart(score, is_played=True)


def test_strokes_stand_where_they_were_meant() -> None:
    meant = [k / 2 for k in range(16)]
    found = take_spelling(take(*meant))
    assert found is not None
    assert [tick / PPQ for tick in found.tick.tolist()] == meant


def test_a_part_on_the_grid_needs_none() -> None:
    notes = [Note(k * PPQ // 2, Piece.SNARE) for k in range(16)]
    assert take_spelling(DrumPart(Score.from_notes(notes, TempoMap.constant(120.0)))) is None


@pytest.mark.skipif(not GMD.is_dir(), reason="the recordings lie beside the project")
def test_the_screen_has_the_rhythm_of_the_sheet() -> None:
    part = read_part(GMD / "drummer7/session1/15_jazz_112_beat_4-4.mid")
    spelling, paper = take_spelling(part), written_down(part).score.as_written.notes
    assert spelling is not None
    strokes = Engraver(part.score, OutlineAtlas()).of_take(spelling).strokes
    on_paper = set(zip(paper["tick"].tolist(), paper["piece"].tolist(), strict=True))
    shown = list(zip(strokes.tick.tolist(), part.score.notes["piece"].tolist(), strict=True))
    assert np.mean([stroke in on_paper for stroke in shown]) > 0.97, "but for strokes that the import writes otherwise"
