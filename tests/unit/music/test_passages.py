"""Expected rows are counted by hand from the written music."""

import numpy as np
import pytest

from station.core.pieces import Articulation, Limb, Ornament, Piece
from station.core.units import PPQ
from station.music import passages
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from tests.fakes import scores


def test_a_fill_is_where_the_hat_stops_and_the_toms_go_on() -> None:
    score = scores.beat_and_fill(2)
    rows = score.notes[passages.fills(score)]
    assert rows["tick"].tolist() == [start + 14 * PPQ + i * PPQ // 4 for start in (0, 16 * PPQ) for i in range(8)]


def test_a_groove_without_a_timekeeper_has_no_fills() -> None:
    assert not passages.fills(scores.double_strokes(4)).any()


def test_a_groove_of_toms_under_a_hat_on_one_is_no_fill() -> None:
    notes = [Note(i * PPQ // 2, Piece.FLOOR_TOM_1) for i in range(8)] + [Note(0, Piece.HIHAT)]
    assert not passages.fills(Score.from_notes(notes, TempoMap.constant(120))).any()


def test_long_waits_are_the_strokes_after_a_gap() -> None:
    notes = [Note(i * PPQ // 2, Piece.SNARE) for i in (0, 1, 2, 3, 4, 6, 7)]
    score = Score.from_notes(notes, TempoMap.constant(120))
    assert score.notes["tick"][passages.long_waits(score)].tolist() == [3 * PPQ]


def test_a_slower_tempo_is_a_long_wait_everywhere() -> None:
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 120), TempoChange.from_bpm(8 * PPQ, 90)])
    score = Score.from_notes([Note(i * PPQ, Piece.SNARE) for i in range(12)], tempo_map)
    assert score.notes["tick"][passages.long_waits(score)].tolist() == [i * PPQ for i in (9, 10, 11)]


def test_swung_offbeats_of_a_ride_pattern() -> None:
    score = scores.swing_ride(2)
    swung = passages.swung(score)
    assert score.notes["tick"][swung.flags].tolist() == [
        bar * 4 * PPQ + b * PPQ + 2 * PPQ // 3 for bar in (0, 1) for b in (1, 3)
    ]
    assert set(swung.span_ms[swung.flags]) == {60_000 / score.tempo_map.bpm_at(0)}
    np.testing.assert_allclose(swung.places[swung.flags], 2 / 3)


def test_full_triplets_straight_eighths_and_dotted_figures_do_not_swing() -> None:
    for places in ((0, 1 / 3, 2 / 3), (0, 1 / 2), (0, 3 / 4), (0, 1 / 4, 1 / 2, 3 / 4)):
        notes = [Note(beat * PPQ + round(x * PPQ), Piece.HIHAT) for beat in range(4) for x in places]
        assert not passages.swung(Score.from_notes(notes, TempoMap.constant(100))).flags.any(), places


def test_swung_sixteenths_swing_in_eighths() -> None:
    half = PPQ // 2
    notes = [Note(i * half + x, Piece.HIHAT) for i in range(8) for x in (0, 2 * half // 3)]
    swung = passages.swung(Score.from_notes(notes, TempoMap.constant(60)))
    assert swung.flags.tolist() == [False, True] * 8
    assert swung.span_ms.tolist() == [0, 500] * 8


def test_second_strokes_of_double_strokes() -> None:
    score = scores.double_strokes(1)
    assert passages.second_of_doubles(score).tolist() == [False, True] * 8


def test_paradiddles_have_one_double_each() -> None:
    sticking = "RLRRLRLL"
    notes = [
        Note(i * PPQ // 4, Piece.SNARE, limb=Limb.RIGHT_HAND if s == "R" else Limb.LEFT_HAND)
        for i, s in enumerate(sticking)
    ]
    flags = passages.second_of_doubles(Score.from_notes(notes, TempoMap.constant(80)))
    assert np.flatnonzero(flags).tolist() == [3, 7]


def test_one_hand_on_the_hat_plays_no_doubles() -> None:
    groove = [
        (0, "R"), (1, "R"), (2, "R"), (2, "L"), (3, "R"), (4, "R"), (5, "R"), (6, "R"), (6, "L"), (7, "R"),
    ]  # fmt: skip
    notes = [
        Note(
            i * PPQ // 2, Piece.HIHAT if s == "R" else Piece.SNARE, limb=Limb.RIGHT_HAND if s == "R" else Limb.LEFT_HAND
        )
        for i, s in groove
    ]
    assert not passages.second_of_doubles(Score.from_notes(notes, TempoMap.constant(140))).any()


def test_slow_strokes_of_one_hand_are_no_doubles() -> None:
    score = scores.double_strokes(1, tempo_bpm=45)  # sixteenths 333 ms apart
    assert not passages.second_of_doubles(score).any()


def test_diddles_without_sticking_pair_up() -> None:
    notes = [Note(i * PPQ // 8, Piece.SNARE, ornament=Ornament.DIDDLE) for i in range(4)]
    score = Score.from_notes([*notes, Note(PPQ // 2, Piece.SNARE)], TempoMap.constant(100))
    assert passages.second_of_doubles(score).tolist() == [False, True, False, True, False]


@pytest.mark.parametrize("ornament", [Ornament.DIDDLE, Ornament.ROLL])
def test_pairs_on_two_pieces_at_once_pair_up_on_each(ornament: Ornament) -> None:
    """Rows in order: snare and tom on the first place, both on the second."""
    notes = [Note(i * PPQ // 8, piece, ornament=ornament) for i in range(2) for piece in (Piece.SNARE, Piece.TOM_1)]
    score = Score.from_notes(notes, TempoMap.constant(100))
    assert passages.second_of_doubles(score).tolist() == [False, False, True, True]


def test_buzz_rolls_are_no_pairs() -> None:
    notes = [Note(i * PPQ, Piece.SNARE, articulation=Articulation.BUZZ, ornament=Ornament.ROLL) for i in range(4)]
    assert not passages.second_of_doubles(Score.from_notes(notes, TempoMap.constant(100))).any()


def test_grace_strokes_are_never_flagged() -> None:
    score = scores.flams(1)
    for flags in (passages.fills(score), passages.long_waits(score), passages.swung(score).flags):
        assert not flags[score.is_grace].any()


def test_an_empty_score_has_no_passages() -> None:
    score = Score.from_notes([], TempoMap(), 4 * PPQ)
    assert len(passages.fills(score)) == len(passages.long_waits(score)) == len(passages.second_of_doubles(score)) == 0
    assert len(passages.swung(score).flags) == 0


def test_offbeats_of_a_grouped_meter_count_from_its_groups_in_every_bar() -> None:
    """Two bars of 7/8 as 2+2+3: the eighths beside the groups' first are 1, 3, 5, 6 of each bar."""
    eighth = PPQ // 2
    tempo_map = TempoMap.build([TempoChange(0, 500_000)], [MeterChange(0, 7, 8, (2, 2, 3))])
    found = passages.offbeats(Score.from_notes([Note(i * eighth, Piece.SNARE) for i in range(14)], tempo_map))
    assert np.flatnonzero(found.all).tolist() == [1, 3, 5, 6, 8, 10, 12, 13]
    assert np.flatnonzero(found.ands).tolist() == [1, 3, 8, 10]
