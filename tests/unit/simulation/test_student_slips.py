"""How often and where a student slips. Counts are binomial: bounds are four of their standard errors."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.simulation.student_reading import main_of_rows
from station.simulation.student_slips import CLEAR_MS, PLAIN_VELOCITY
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualPerformance, play
from tests.fakes import scores

SLIPPING = "seed=3,sd_ms=0,miss_pct=3,extra_pct=2,wrong_piece_pct=4"


def _expect(count: int, draws: int, probability: float) -> None:
    assert abs(count - draws * probability) <= 4 * math.sqrt(draws * probability * (1 - probability))


def _extras(played: VirtualPerformance) -> NDArray[np.void]:
    return np.asarray(played.performance.hits[played.truth.hit_label == Label.EXTRA])


def _nearest_ms(times_ns: NDArray[np.int64], at_ns: int) -> float:
    return float(np.abs(times_ns - at_ns).min(initial=np.iinfo(np.int64).max)) / NS_PER_MS


def test_slips_are_as_frequent_as_said() -> None:
    score = scores.rock_beat(600)
    truth = play(score, parse_spec(SLIPPING)).truth
    hands = int(np.count_nonzero(score.notes["piece"] != Piece.KICK))
    _expect(truth.count(Label.MISS), len(score), 0.03)
    _expect(truth.count(Label.EXTRA), len(score), 0.02)
    _expect(truth.count(Label.WRONG_PIECE), hands, 0.04)


@pytest.mark.parametrize(("spec", "matched"), [("miss_pct=100", 0), ("miss_pct=0", 52)])
def test_all_or_nothing_is_missed(spec: str, matched: int) -> None:
    assert play(scores.rock_beat(4), parse_spec(spec)).truth.count(Label.MATCH) == matched


def test_feet_never_hit_a_wrong_piece() -> None:
    played = play(scores.swing_ride(50), parse_spec("wrong_piece_pct=100"))
    wrong = played.score.notes["piece"][played.truth.note_label == Label.WRONG_PIECE]
    assert set(wrong.tolist()) == {Piece.RIDE}


def test_a_wrong_piece_is_struck_in_time_where_nothing_is_written() -> None:
    score = scores.beat_and_fill(60)
    played = play(score, parse_spec(SLIPPING))
    rows = np.flatnonzero(played.truth.note_label == Label.WRONG_PIECE)
    assert len(rows) > 50
    for row in rows:
        hit = played.performance.hits[played.truth.hit_of_note[row]]
        assert hit["at_ns"] == score.onset_ns[row]
        assert hit["piece"] != score.notes["piece"][row]
        assert _nearest_ms(score.onset_ns[score.notes["piece"] == hit["piece"]], hit["at_ns"]) >= CLEAR_MS


def test_extras_are_clear_of_their_piece_and_of_every_unplayed_note() -> None:
    score = scores.rock_beat(300)
    played = play(score, parse_spec(SLIPPING))
    unplayed = score.onset_ns[played.truth.note_label != Label.MATCH]
    extras = _extras(played)
    assert len(extras) > 50
    for hit in extras:
        assert _nearest_ms(score.onset_ns[score.notes["piece"] == hit["piece"]], hit["at_ns"]) >= CLEAR_MS
        assert _nearest_ms(unplayed, hit["at_ns"]) >= CLEAR_MS


def test_extras_in_a_full_bar_stand_in_the_middle() -> None:
    """Every piece that could be brushed is written every 100 ms, so that the middle, 50 ms from both, is clearest."""
    pieces = (Piece.SNARE, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.HIHAT, Piece.TOM_2, Piece.CRASH_1)
    notes = [Note(i * PPQ // 4, piece) for i in range(64) for piece in pieces]
    score = Score.from_notes(notes, TempoMap.constant(150))
    extras = _extras(play(score, parse_spec("seed=5,extra_pct=5")))
    assert len(extras) > 5
    assert {round(at % (100 * NS_PER_MS) / NS_PER_MS) for at in extras["at_ns"].tolist()} == {50}


def test_extras_are_real_strokes() -> None:
    """Soft strokes, and the hi-hat foot, are things that nobody counts."""
    played = play(scores.swing_ride(300), parse_spec("seed=2,extra_pct=10,velocity_sd=20"))
    extras = _extras(played)
    assert extras["velocity"].min() >= PLAIN_VELOCITY
    assert Piece.HIHAT_PEDAL not in extras["piece"].tolist()
    assert set(extras["limb"].tolist()) == {Limb.UNKNOWN}


def test_commoner_pieces_get_more_extras() -> None:
    extras = _extras(play(scores.rock_beat(600), parse_spec("seed=2,extra_pct=10")))
    hat, kick = (int(np.count_nonzero(extras["piece"] == p)) for p in (Piece.HIHAT, Piece.KICK))
    _expect(hat, hat + kick, 8 / 10)  # eight strokes of the hat to two of the kick


def test_a_flam_is_missed_as_a_whole() -> None:
    played = play(scores.flams(100), parse_spec("seed=1,miss_pct=30,wrong_piece_pct=10"))
    labels = played.truth.note_label.reshape(-1, 2)  # rows: grace stroke, main stroke
    assert (labels[:, 0] == labels[:, 1]).all()
    rightly = played.performance.hits[played.truth.hit_label == Label.MATCH]
    assert set(rightly["piece"].tolist()) == {Piece.SNARE}
    assert {int(label) for label in np.unique(labels)} == {Label.MATCH, Label.MISS, Label.WRONG_PIECE}


def test_a_grace_stroke_belongs_to_the_stroke_of_its_own_piece() -> None:
    notes = [
        Note(0, Piece.KICK),
        Note(0, Piece.SNARE, lead_ms=30.0),
        Note(0, Piece.SNARE),
        Note(PPQ, Piece.TOM_1, lead_ms=30.0),
        Note(PPQ, Piece.SNARE),
        Note(2 * PPQ, Piece.SNARE, lead_ms=30.0),
    ]
    score = Score.from_notes(notes, TempoMap.constant(120))
    rows = {(n.tick // PPQ, n.piece, n.lead_ms > 0): i for i, n in enumerate(score)}
    mains = main_of_rows(score)
    assert mains[rows[0, Piece.SNARE, True]] == rows[0, Piece.SNARE, False]
    assert mains[rows[1, Piece.TOM_1, True]] == rows[1, Piece.SNARE, False]
    assert mains[rows[2, Piece.SNARE, True]] == rows[2, Piece.SNARE, True]
    assert (mains[~score.is_grace] == np.flatnonzero(~score.is_grace)).all()


def test_an_empty_score_has_no_slips() -> None:
    played = play(Score.from_notes([], TempoMap(), 4 * PPQ), parse_spec(SLIPPING))
    assert len(played.performance) == 0
    assert played.midi == []
