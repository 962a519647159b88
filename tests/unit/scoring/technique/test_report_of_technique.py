"""Craft in the document and in words: every figure in its place, nothing said that the data cannot bear."""

import json
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Ornament, Piece
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.practice.records.report.session_report import assessment_text
from station.scoring.analysis.summary import SummaryView, summarise
from station.scoring.report.assessment_document import assessment
from station.scoring.report.technique_table import plain
from station.scoring.report.technique_text import technique_lines
from tests.fakes.answers import Played, take
from tests.fakes.scores import beat_and_fill, even_snare, flams, rock_beat


def document(score: Score, how: Played, view: SummaryView | None = None) -> dict[str, Any]:
    played = take(score, how)
    found = assessment(summarise(score, played.performance, played.alignment, view))
    assert json.loads(json.dumps(found, allow_nan=False)) == found
    return found


def noise(score: Score, sd_ms: float = 5.0) -> NDArray[np.float64]:
    return np.random.default_rng(9).normal(0, sd_ms, len(score))


def test_flams_in_the_document_and_in_words_by_hand() -> None:
    """Exactly as written: 30 ms apart, 35 before 100 is 18.2 dB softer."""
    found = document(flams(3), Played())
    flam = found["craft"]["ornaments"]["flam"]
    assert (flam["graces"], flam["heard"], flam["usual"], flam["softer"], flam["hand_order"]) == (12, 12, 12, 12, None)
    assert flam["spacing_ms"] == {"count": 12, "mean": 30.0, "sd": 0.0, "ci": [30.0, 30.0]}
    assert "Flams: strokes 30 ms (SD 0) apart, grace strokes 18.2 dB softer" in technique_lines(found)
    assert {"what": "which hand led", "count": 12, "why": "nothing says which stick struck", "judged": False} in found[
        "cannot_tell"
    ]


def test_fills_against_grooves() -> None:
    """Fills 14 ms ahead: two tables and a sentence with the number in it."""
    score = beat_and_fill(8)
    played = take(score)
    in_fill = summarise(score, played.performance, played.alignment).habits.strokes["fills"]
    found = document(score, Played(off_ms=noise(score) - 14.0 * in_fill))
    passages = found["per_passage"]
    assert set(passages) == {"groove", "fill"}
    assert passages["fill"]["notes"] == int(in_fill.sum()) == 8 * 8
    apart = passages["fill"]["timing"]["mean_signed_asynchrony_ms"]
    assert apart - passages["groove"]["timing"]["mean_signed_asynchrony_ms"] == pytest.approx(-14.0, abs=2.0)
    assert any(
        line.startswith("Fills: 1") and line.endswith("ms ahead of your groove") for line in technique_lines(found)
    )


def test_a_score_without_fills_has_no_passages() -> None:
    assert document(rock_beat(4), Played())["per_passage"] == {}


def test_few_strokes_make_no_words() -> None:
    """One bar: no interval anywhere, so no line but counts of what needs none."""
    found = document(even_snare(3, 500), Played(off_ms=np.array([0.0, 9.0, -4.0])))
    assert technique_lines(found) == []
    assert assessment_text(found).count("\n\n") <= 1


def test_silence_makes_no_words() -> None:
    score = flams(2)
    found = document(score, Played(left_out=tuple(range(len(score)))))
    assert technique_lines(found) == []
    assert found["craft"]["ornaments"]["flam"]["spacing_ms"] == {"count": 0, "mean": None, "sd": None, "ci": None}


def test_what_cannot_be_told_is_said() -> None:
    notes = [
        Note(4 * PPQ * k, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL, duration_ticks=2 * PPQ)
        for k in range(5)
    ]
    found = document(Score.from_notes(notes, TempoMap.constant(120)), Played())
    assert found["craft"]["buzz_rolls"]["continuous"] is None
    assert "Cannot tell how buzz rolls went on (5): the kit sent one hit for each" in technique_lines(found)


def test_bars_count_from_one() -> None:
    rise = [Note(i * PPQ, Piece.SNARE, velocity=round(v)) for i, v in enumerate(np.geomspace(40, 110, 12))]
    found = document(Score.from_notes(rise, TempoMap.constant(120)), Played())
    (crescendo,) = found["craft"]["shades"]["crescendos"]
    assert crescendo["bars"] == [1, 3]
    assert any(line.startswith("Snare, bars 1-3: +18 dB for +18") for line in technique_lines(found))


def test_keys_without_velocity_have_no_shades() -> None:
    assert document(rock_beat(4), Played(), SummaryView(hears_velocity=False))["craft"]["shades"] is None


def test_nothing_but_json() -> None:
    assert plain((1, None, True, 0.12345)) == [1, None, True, 0.123]
    assert plain({Piece.SNARE: np.array([1.5])}) == {"snare": [1.5]}
    with pytest.raises(AssertionError, match="no place"):
        plain(object())
