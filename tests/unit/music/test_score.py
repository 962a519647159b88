"""Scores by hand: order, bars, joining, speed."""

import numpy as np
import pytest

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.score import NOTE_DTYPE, Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

GROOVE = [
    Note(0, Piece.KICK),
    Note(0, Piece.HIHAT, Zone.BOW, openness=0.0),
    Note(PPQ, Piece.SNARE, velocity=110, dynamic=Dynamic.ACCENT, limb=Limb.LEFT_HAND),
    Note(2 * PPQ, Piece.KICK),
    Note(3 * PPQ, Piece.SNARE, lead_ms=30, ornament=Ornament.FLAM, velocity=40),
    Note(3 * PPQ, Piece.SNARE, ornament=Ornament.FLAM),
]


def groove(tempo_bpm: float = 120, end_tick: int | None = None) -> Score:
    return Score.from_notes(reversed(GROOVE), TempoMap.constant(tempo_bpm), end_tick, "Groove")


def quarters(score: Score) -> list[float]:
    return [tick / PPQ for tick in score.notes["tick"].tolist()]


def test_strokes_are_ordered_by_tick_then_grace_then_piece() -> None:
    assert list(groove()) == GROOVE


def test_a_stroke_comes_back_as_it_was_written() -> None:
    note = Note(
        5, Piece.CRASH_1, Zone.EDGE, 99, lead_ms=0.0, openness=0.25, duration_ticks=7, choke_ticks=9, midi_note=49
    )
    assert Score.from_notes([note], TempoMap())[0] == note


def test_what_is_not_said_is_none() -> None:
    assert groove()[0].openness is None


def test_strokes_cannot_be_changed() -> None:
    with pytest.raises(ValueError, match="read-only"):
        groove().notes["velocity"] = 1
    with pytest.raises(ValueError, match="read-only"):
        groove().onset_ns[0] = 1


def test_the_rows_given_stay_the_callers() -> None:
    rows = np.zeros(2, NOTE_DTYPE)
    score = Score.from_array(rows, TempoMap())
    rows["velocity"] = 99
    assert score.notes["velocity"].tolist() == [0, 0]


def test_a_grace_stroke_sounds_before_its_tick_whatever_the_tempo() -> None:
    for bpm in (60, 120, 240):
        onsets = groove(bpm).onset_ns.tolist()
        assert onsets[-1] - onsets[-2] == 30_000_000
    assert groove(120).onset_s.tolist()[-1] == 1.5
    assert groove().is_grace.tolist() == [False] * 4 + [True, False]


def test_a_score_ends_with_the_bar_of_its_last_stroke() -> None:
    assert groove().end_tick == 4 * PPQ
    assert groove().bar_count == 1
    assert groove().length_beats == 4
    assert groove(60).length_ns == 4_000_000_000
    assert Score.from_notes([Note(4 * PPQ, Piece.KICK)], TempoMap()).bar_count == 2


def test_an_empty_score_is_one_bar_of_silence() -> None:
    score = Score.from_notes([], TempoMap.constant(60, 3, 4))
    assert (len(score), score.bar_count, score.length_ns) == (0, 1, 3_000_000_000)
    assert list(score.repeated(2)) == []


def test_bars_are_cut_out_and_moved_to_the_start() -> None:
    notes = [Note(q * PPQ, Piece.KICK, velocity=1 + q) for q in range(12)]
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 60), TempoChange.from_bpm(6 * PPQ, 120)])
    cut = Score.from_notes(notes, tempo_map).bars(1, 1)
    assert quarters(cut) == [0, 1, 2, 3]
    assert cut.notes["velocity"].tolist() == [5, 6, 7, 8]
    assert cut.onset_s.tolist() == [0, 1, 2, 2.5]
    assert cut.end_tick == 4 * PPQ


def test_bars_keep_their_meter() -> None:
    tempo_map = TempoMap.build([], [MeterChange(4 * PPQ, 3, 4), MeterChange(7 * PPQ, 2, 4)])
    cut = Score.from_notes([Note(8 * PPQ, Piece.KICK)], tempo_map).bars(1, 2)
    assert cut.tempo_map.meters == (MeterChange(0, 3, 4), MeterChange(3 * PPQ, 2, 4))
    assert (cut.bar_count, cut.end_tick, quarters(cut)) == (2, 5 * PPQ, [4])


def test_repeats_follow_without_a_gap() -> None:
    thrice = groove().repeated(3)
    assert len(thrice) == 18
    assert thrice.bar_count == 3
    assert thrice.bar.tolist() == [0] * 6 + [1] * 6 + [2] * 6
    assert thrice.onset_ns.tolist() == [t + r * 2_000_000_000 for r in range(3) for t in groove().onset_ns.tolist()]
    assert thrice.title == "Groove"


def test_each_repeat_starts_at_its_own_tempo() -> None:
    tempo_map = TempoMap.build([TempoChange.from_bpm(0, 60), TempoChange.from_bpm(2 * PPQ, 120)])
    twice = Score.from_notes(GROOVE, tempo_map).repeated(2)
    assert [twice.tempo_map.bpm_at(q * PPQ) for q in (0, 2, 4, 6)] == [60, 120, 60, 120]
    assert twice.length_ns == 6_000_000_000


def test_parts_of_different_meter_are_joined() -> None:
    waltz = Score.from_notes([Note(2 * PPQ, Piece.SNARE)], TempoMap.constant(60, 3, 4))
    both = Score.joined([waltz, groove(), waltz])
    assert [both.tempo_map.bar_start(bar) // PPQ for bar in range(4)] == [0, 3, 7, 10]
    assert quarters(both) == [2, 3, 3, 4, 5, 6, 6, 9]


def test_what_a_part_changes_after_its_end_does_not_reach_the_next() -> None:
    tempo_map = TempoMap.build(
        [TempoChange.from_bpm(0, 60), TempoChange.from_bpm(5 * PPQ, 200)],
        [MeterChange(0, 4, 4), MeterChange(6 * PPQ, 3, 4)],
    )
    first = Score.from_notes(GROOVE, tempo_map, 4 * PPQ)
    both = Score.joined([first, groove(120, 8 * PPQ)])
    assert [both.tempo_map.bpm_at(q * PPQ) for q in (0, 3, 4, 9, 11)] == [60, 60, 120, 120, 120]
    assert both.tempo_map.bar_start(2) == 8 * PPQ


def test_speed_leaves_ticks_and_grace_alone() -> None:
    quick = groove().at_speed(2)
    assert quarters(quick) == quarters(groove())
    assert quick.onset_ns[-1] - quick.onset_ns[-2] == 30_000_000
    assert quick.length_ns == 1_000_000_000


def test_limbs_are_written_on_a_copy() -> None:
    score = groove()
    limbs = np.arange(6, dtype=np.int8) % 4
    assert score.with_limbs(limbs).notes["limb"].tolist() == limbs.tolist()
    assert score.notes["limb"].tolist() == [-1, -1, 1, -1, -1, -1]
