"""Alignment with a click, on scores small enough to pair by hand."""

from dataclasses import replace

import numpy as np
import pytest

from station.core.events import Hit
from station.core.pieces import Dynamic, Piece, Zone
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.following.warp import _segments
from station.scoring.matching.alignment import Alignment, Reference, judgements
from tests.fakes.scores import flams, rock_beat

EIGHTH_MS = 250  # at 120 bpm


def hit(at_ms: float, piece: Piece = Piece.SNARE, velocity: int = 80) -> Hit:
    return Hit(round(at_ms * NS_PER_MS), piece, Zone.HEAD, velocity)


def snares(count: int) -> Score:
    """Eighths on the snare at 120 bpm, 250 ms apart."""
    return Score.from_notes([Note(i * PPQ // 2, Piece.SNARE) for i in range(count)], TempoMap.constant(120))


def aligned(score: Score, hits: list[Hit]) -> Alignment:
    return align(score, Performance.from_hits(hits), clocked=True)


def played_exactly(score: Score) -> list[Hit]:
    return [Hit(int(at), note.piece, note.zone, note.velocity) for at, note in zip(score.onset_ns, score, strict=True)]


def test_each_hit_goes_to_its_note_with_its_sign() -> None:
    result = aligned(snares(4), [hit(-5), hit(262), hit(500), hit(741)])
    assert result.hit_of_note.tolist() == [0, 1, 2, 3]
    assert (result.asynchrony_ns / NS_PER_MS).tolist() == [-5, 12, 0, -9]
    assert result.reference is Reference.CLICK


def test_a_missed_and_an_added_stroke() -> None:
    result = aligned(snares(4), [hit(0), hit(500), hit(625), hit(750)])
    assert [Label(k) for k in result.note_label] == [Label.MATCH, Label.MISS, Label.MATCH, Label.MATCH]
    assert [Label(k) for k in result.hit_label] == [Label.MATCH, Label.MATCH, Label.EXTRA, Label.MATCH]


def test_the_closer_of_two_hits_wins() -> None:
    result = aligned(snares(4), [hit(0), hit(210), hit(248), hit(500), hit(750)])
    assert result.hit_of_note.tolist() == [0, 2, 3, 4]
    assert result.hit_label[1] == Label.EXTRA


def test_right_time_on_another_piece() -> None:
    result = aligned(snares(4), [hit(0), hit(255, Piece.TOM_1), hit(500), hit(750)])
    assert result.note_label[1] == Label.WRONG_PIECE
    assert result.hit_label[1] == Label.WRONG_PIECE
    assert result.asynchrony_ns[1] == 5 * NS_PER_MS


def test_another_piece_at_another_time_is_an_extra_beside_a_miss() -> None:
    result = aligned(snares(4), [hit(0), hit(370, Piece.TOM_1), hit(500), hit(750)])
    assert (result.count(Label.MISS), result.count(Label.EXTRA), result.count(Label.WRONG_PIECE)) == (1, 1, 0)


@pytest.mark.parametrize(("written", "struck"), [(Piece.CRASH_1, Piece.CRASH_2), (Piece.RIDE, Piece.RIDE_2)])
def test_alternates_match(written: Piece, struck: Piece) -> None:
    score = Score.from_notes([Note(i * PPQ, written) for i in range(4)], TempoMap.constant(120))
    result = aligned(score, [hit(500 * i, struck) for i in range(4)])
    assert result.count(Label.MATCH) == 4


def test_a_smaller_kit_folds() -> None:
    score = Score.from_notes([Note(i * PPQ, Piece.TOM_2) for i in range(4)], TempoMap.constant(120))
    played = Performance.from_hits([hit(500 * i, Piece.TOM_1) for i in range(4)])
    whole = align(score, played, clocked=True)
    small = align(score, played, clocked=True, kit={Piece.KICK, Piece.SNARE, Piece.TOM_1, Piece.FLOOR_TOM_1})
    assert (whole.count(Label.MATCH), whole.count(Label.WRONG_PIECE)) == (0, 4)
    assert small.count(Label.MATCH) == 4


@pytest.mark.parametrize("latency_ms", [-60, 60, 100])
def test_a_common_latency_costs_no_match(latency_ms: int) -> None:
    score = rock_beat(4)
    hits = [hit(at / NS_PER_MS + latency_ms, note.piece) for at, note in zip(score.onset_ns, score, strict=True)]
    result = aligned(score, hits)
    assert result.count(Label.MATCH) == len(score)
    assert set(result.asynchrony_ns.tolist()) == {latency_ms * NS_PER_MS}


def test_order_of_simultaneous_hits_does_not_matter() -> None:
    score = rock_beat(2)
    hits = played_exactly(score)
    rng = np.random.default_rng(1)
    for _ in range(5):
        shuffled = [hits[i] for i in rng.permutation(len(hits))]
        assert aligned(score, shuffled).count(Label.MATCH) == len(score)


def test_grace_strokes_pair_with_grace_strokes() -> None:
    score = flams(2)
    result = aligned(score, played_exactly(score))
    assert result.count(Label.MATCH) == len(score)
    assert not result.asynchrony_ns.any()


def test_a_flam_without_its_grace_misses_the_grace() -> None:
    score = flams(2)
    hits = [h for h, grace in zip(played_exactly(score), score.is_grace, strict=True) if not grace]
    result = aligned(score, hits)
    assert (result.note_label == Label.MISS).tolist() == score.is_grace.tolist()


def test_a_fast_roll_with_a_hole_and_a_bounce() -> None:
    """32nds at 120 bpm, 62.5 ms apart: the 11th is left out, the 21st bounces 30 ms later."""
    score = Score.from_notes([Note(i * PPQ // 8, Piece.SNARE) for i in range(32)], TempoMap.constant(120))
    wobble = [0, 8, -7, 5, -9, 4, 9, -3]
    times = [62.5 * i + wobble[i % 8] for i in range(32) if i != 10]
    result = aligned(score, [hit(t) for t in times] + [hit(62.5 * 20 + wobble[4] + 30)])
    assert np.flatnonzero(result.note_label == Label.MISS).tolist() == [10]
    assert result.count(Label.EXTRA) == 1


def test_what_nobody_counts() -> None:
    """Over a beat without the foot: chicks on 2 and 4, a feathered kick on 4 and a ghost beside the backbeat."""
    score = rock_beat(1)
    unwritten = [
        hit(500, Piece.HIHAT_PEDAL),
        hit(1500, Piece.HIHAT_PEDAL),
        hit(1500, Piece.KICK, velocity=25),
        hit(625, Piece.SNARE, velocity=30),
    ]
    result = aligned(score, played_exactly(score) + unwritten)
    assert (result.count(Label.MATCH), result.count(Label.IGNORED), result.count(Label.EXTRA)) == (len(score), 4, 0)


def test_loud_strokes_that_nobody_wrote_are_extras() -> None:
    score = rock_beat(1)
    unwritten = [hit(1500, Piece.KICK, velocity=90), hit(625, Piece.SNARE, velocity=80)]
    result = aligned(score, played_exactly(score) + unwritten)
    assert result.count(Label.EXTRA) == 2


def test_a_chick_that_closes_an_open_hat_is_ignored_even_beside_written_chicks() -> None:
    notes = [
        Note(0, Piece.HIHAT, Zone.BOW, openness=1.0),
        Note(PPQ, Piece.HIHAT, Zone.BOW, openness=0.0),
        Note(3 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL),
    ]
    score = Score.from_notes(notes, TempoMap.constant(120))
    closing, stray = hit(250, Piece.HIHAT_PEDAL), hit(1000, Piece.HIHAT_PEDAL)
    result = aligned(score, [*played_exactly(score), closing, stray])
    assert Label(result.hit_label[1]) is Label.IGNORED
    assert Label(result.hit_label[3]) is Label.EXTRA


def test_ghost_notes_that_are_written_are_answered_by_ghost_strokes() -> None:
    score = Score.from_notes(
        [Note(i * PPQ, Piece.SNARE, velocity=30, dynamic=Dynamic.GHOST) for i in range(4)], TempoMap.constant(120)
    )
    result = aligned(score, [hit(500 * i, velocity=25) for i in range(4)])
    assert result.count(Label.MATCH) == 4


def test_nothing_played_and_nothing_written() -> None:
    score = snares(3)
    silence = aligned(score, [])
    assert (silence.count(Label.MISS), silence.sd_ms) == (3, None)
    empty = Score.from_notes([], TempoMap())
    assert aligned(empty, [hit(0)]).count(Label.EXTRA) == 1
    assert len(aligned(empty, []).hit_of_note) == 0


def test_judgements_name_everyone_once() -> None:
    score, hits = snares(4), [hit(0), replace(hit(500, velocity=90), velocity_fraction=0.5), hit(625), hit(750)]
    performance = Performance.from_hits(hits)
    said = judgements(score, performance, align(score, performance, clocked=True))
    assert sorted(j.note_index for j in said if j.note_index is not None) == [0, 1, 2, 3]
    assert sorted(j.hit_index for j in said if j.hit_index is not None) == [0, 1, 2, 3]
    assert next(j for j in said if j.note_index == 2).velocity_error == 10.5
    assert next(j for j in said if j.label is Label.MISS).hit_index is None


def test_a_jump_behind_the_last_hit_begins_no_segment() -> None:
    """By hand: hits 0 and 1 before a jump at hit 2, hits 2 to 4 after it, none after a jump at hit 5."""
    assert _segments(np.array([2, 5]), 5).tolist() == [0, 0, 1, 1, 1]
