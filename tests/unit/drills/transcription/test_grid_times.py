"""Times of takes onto the grid: takes made here of hand-set rows, with Gaussian errors of the literature's size."""

from collections.abc import Sequence

import numpy as np
import pytest

from station.core.pieces import Articulation, Piece
from station.core.units import NS_PER_S, PPQ
from station.drills.transcription.timing.grid_times import BeatCells, quantised_times
from station.music.score import Note, Score
from station.music.swing import Swing
from station.music.tempo import MeterChange, TempoChange, TempoMap

SPREAD_S = 0.012
Rhythm = Sequence[tuple[float, Piece]]

ROCK: Rhythm = [
    *((i / 2, Piece.HIHAT) for i in range(8)),
    *((beat, Piece.KICK) for beat in (0, 1.75, 2.5)),
    *((beat, Piece.SNARE) for beat in (1, 3)),
]
SHUFFLE: Rhythm = [
    *((beat + late, Piece.HIHAT) for beat in range(4) for late in (0, 2 / 3)),
    *((beat, Piece.KICK) for beat in (0, 2)),
    *((beat, Piece.SNARE) for beat in (1, 3)),
]


def score_of(bar: Rhythm, bars: int, tempo_map: TempoMap) -> Score:
    """The bar so many times, its strokes in quarters from the bar's start."""
    length = tempo_map.meter_at(0).bar_ticks
    notes = [Note(i * length + round(at * PPQ), piece) for i in range(bars) for at, piece in bar]
    return Score.from_notes(notes, tempo_map)


def played(score: Score, seed: int, lean_s: float = 0.0) -> Score:
    """A take of the score: every stroke so much late, and beside its time by a Gaussian error."""
    errors = np.random.default_rng(seed).normal(lean_s, SPREAD_S, len(score))
    times_s = np.maximum(score.onset_s + errors, 0)
    rows = score.notes.copy()
    rows["tick"] = score.tempo_map.ticks_at(times_s)
    return Score.from_array(rows, score.tempo_map)


def strokes(score: Score) -> list[tuple[int, int]]:
    return sorted(zip(score.notes["tick"].tolist(), score.notes["piece"].tolist(), strict=True))


def swung(ratio: float, unit: float) -> Rhythm:
    """Eighths on the hi-hat with every second of `unit` quarters late, so that long to short is `ratio`."""
    late = 2 * unit * ratio / (ratio + 1)
    pairs = np.arange(0, 4, 2 * unit).tolist()
    return [
        *((at + x, Piece.HIHAT) for at in pairs for x in (0, late)),
        *((b, Piece.KICK) for b in (0, 2)),
        *((b, Piece.SNARE) for b in (1, 3)),
    ]


@pytest.mark.parametrize("lean_s", [-0.02, 0.0, 0.02])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_take_comes_back_as_it_was_written(seed: int, lean_s: float) -> None:
    written = score_of(ROCK, 8, TempoMap.constant(110))
    found = quantised_times(played(written, seed, lean_s), is_played=True)
    assert strokes(found.score) == strokes(written)
    assert found.swing == Swing()
    assert found.lean_ms == pytest.approx(lean_s * 1000, abs=5)
    assert found.spread_ms == pytest.approx(SPREAD_S * 1000, abs=4)


def test_a_shuffle_swings_by_triplets() -> None:
    written = score_of(SHUFFLE, 4, TempoMap.constant(96))
    found = quantised_times(played(written, 4), is_played=True)
    assert strokes(found.score) == strokes(written)
    assert found.swing == Swing(2.0, PPQ // 2)
    late = found.score.notes["swing_ticks"][found.score.notes["tick"] % PPQ > 0]
    assert late.tolist() == [PPQ // 6] * 16  # from a half to two thirds of the beat
    assert {beat.cells for beat in found.beats} == {2}


@pytest.mark.parametrize(("ratio", "unit", "tempo"), [(1.5, 0.5, 120), (2.5, 0.5, 72), (1.5, 0.25, 76)])
def test_a_swing_is_named_and_its_notes_know_where_they_are_written(ratio: float, unit: float, tempo: float) -> None:
    written = score_of(swung(ratio, unit), 8, TempoMap.constant(tempo))
    found = quantised_times(played(written, 5), is_played=True)
    assert found.swing == Swing(ratio, round(unit * PPQ))
    assert strokes(found.score) == strokes(written)
    straight = (found.score.notes["tick"] - found.score.notes["swing_ticks"]) % round(unit * PPQ)
    assert not straight.any()


def test_an_editors_swing_is_found_exactly() -> None:
    written = score_of(swung(1.5, 0.5), 2, TempoMap.constant(120))  # 0.6 of a beat, which five cells would hold too
    found = quantised_times(written, is_played=False)
    assert found.swing == Swing(1.5, PPQ // 2)
    assert strokes(found.score) == strokes(written)


def test_quintuplets_are_no_swing() -> None:
    fives = [(beat + k / 5, Piece.SNARE) for beat in range(4) for k in range(5)]
    written = score_of(fives, 2, TempoMap.constant(60))
    for score, is_played in ((written, False), (played(written, 6), True)):
        found = quantised_times(score, is_played)
        assert found.swing == Swing()
        assert strokes(found.score) == strokes(written)
        assert {beat.cells for beat in found.beats} == {5}


@pytest.mark.parametrize("cells", [9, 16, 24, 64])
def test_an_editors_finest_cells_stay(cells: int) -> None:
    notes = [Note(round(k * PPQ / cells), Piece.SNARE) for k in range(cells)]
    written = Score.from_notes(notes, TempoMap.constant(40))
    found = quantised_times(written, is_played=False)
    assert strokes(found.score) == strokes(written)
    assert found.spread_ms == 0


def test_no_beat_of_a_take_is_cut_finer_than_its_music() -> None:
    written = score_of(ROCK, 8, TempoMap.constant(110))
    found = quantised_times(played(written, 7), is_played=True)
    assert {beat.cells for beat in found.beats} == {2, 4}  # sixteenths where the kick has one
    assert found.beats[0] == BeatCells(0, PPQ, 2)


def test_six_eight_stays_six_eight() -> None:
    bar = [*((i / 2, Piece.HIHAT) for i in range(6)), (0, Piece.KICK), (1.5, Piece.SNARE), (2.75, Piece.KICK)]
    written = score_of(bar, 8, TempoMap.constant(100, 6, 8))
    found = quantised_times(played(written, 8), is_played=True)
    assert strokes(found.score) == strokes(written)
    assert str(found.score.tempo_map.meter_at(0)) == "6/8"


def test_the_last_stroke_played_early_belongs_to_the_next_bar() -> None:
    tempo_map = TempoMap.constant(100)
    notes = [Note(i * PPQ, Piece.SNARE) for i in range(8)]
    early = Note(8 * PPQ - int(tempo_map.ticks_at(0.015)), Piece.KICK)
    found = quantised_times(Score.from_notes([*notes, early], tempo_map), is_played=True)
    assert strokes(found.score)[-1] == (8 * PPQ, Piece.KICK)
    assert found.score.bar_count == 3


def test_grace_strokes_go_with_their_main_stroke() -> None:
    tempo_map = TempoMap.constant(100)
    mains = [Note(i * PPQ + 700, Piece.SNARE) for i in range(8)]
    graces = [Note(n.tick, n.piece, lead_ms=30.0, velocity=30) for n in mains]
    found = quantised_times(Score.from_notes([*mains, *graces], tempo_map), is_played=True)
    assert found.score.notes["tick"].tolist() == [i * PPQ for i in range(8) for _ in range(2)]
    assert found.score.is_grace.tolist() == [True, False] * 8


def test_every_row_says_where_it_came_from() -> None:
    take = played(score_of(ROCK, 4, TempoMap.constant(110)), 9)
    found = quantised_times(take, is_played=True)
    assert sorted(found.origin.tolist()) == list(range(len(take)))
    assert np.array_equal(take.notes["piece"][found.origin], found.score.notes["piece"])


def test_a_buzz_ends_on_a_cell() -> None:
    tempo_map = TempoMap.constant(100)
    steady = [Note(i * PPQ, Piece.KICK) for i in range(8)]
    buzz = Note(2 * PPQ + 900, Piece.SNARE, articulation=Articulation.BUZZ, duration_ticks=round(0.97 * PPQ))
    found = quantised_times(Score.from_notes([*steady, buzz], tempo_map), is_played=True)
    (row,) = found.score.notes[found.score.notes["duration_ticks"] > 0]
    assert (int(row["tick"]), int(row["duration_ticks"])) == (2 * PPQ, PPQ)


def test_nothing_comes_back_as_nothing() -> None:
    for is_played in (False, True):
        found = quantised_times(Score.from_notes([], TempoMap.constant(100), 4 * PPQ), is_played)
        assert (len(found.score), found.beats, found.score.end_tick) == (0, (), 4 * PPQ)


def test_tempo_changes_of_the_file_are_heard() -> None:
    tempo_map = TempoMap.build(
        [TempoChange.from_bpm(0, 90), TempoChange.from_bpm(8 * PPQ, 130)], [MeterChange(0, 4, 4)]
    )
    written = score_of(ROCK, 4, tempo_map)
    found = quantised_times(played(written, 10), is_played=True)
    assert strokes(found.score) == strokes(written)
    assert found.score.tempo_map.tempos == tempo_map.tempos


def test_the_triplets_of_a_shuffle_stay_triplets() -> None:
    fill = [(k / 3, Piece.SNARE) for k in range(12)]
    bar = [*SHUFFLE, *((4 + at, piece) for at, piece in SHUFFLE), *((8 + at, piece) for at, piece in fill)]
    tempo_map = TempoMap.constant(96)
    written = Score.from_notes([Note(round(at * PPQ), piece) for at, piece in bar], tempo_map)
    found = quantised_times(played(written, 15), is_played=True)
    assert strokes(found.score) == strokes(written)
    assert found.swing == Swing(2.0, PPQ // 2)
    in_fill = found.score.notes["tick"] >= 8 * PPQ
    assert not found.score.notes["swing_ticks"][in_fill].any()


def test_a_take_that_says_no_tempo_is_heard_at_its_own() -> None:
    written = score_of(ROCK, 8, TempoMap.constant(92))
    take = played(written, 14)
    rows = take.notes.copy()
    rows["tick"] = TempoMap().ticks_at_ns(take.onset_ns)  # MIDI's 120 a minute
    found = quantised_times(Score.from_array(rows, TempoMap()), is_played=True)
    assert found.score.tempo_map.bpm_at(0) == pytest.approx(92, abs=0.01)
    assert strokes(found.score) == strokes(written)


@pytest.mark.parametrize("seed", [15, 16])
def test_a_take_that_says_no_tempo_and_has_no_click_is_heard_at_its_own(seed: int) -> None:
    """It rushes by 4 % a minute: on the beats of one tempo nothing gathers in all of it, in its first bars it does."""
    written = score_of(ROCK, 16, TempoMap.constant(104))
    take = played(written, seed)
    rows = take.notes.copy()
    rows["tick"] = TempoMap().ticks_at(take.onset_s * (1 - 0.04 * take.onset_s / 60))
    found = quantised_times(Score.from_array(rows, TempoMap()), is_played=True)
    assert found.score.tempo_map.bpm_at(0) == pytest.approx(104, rel=0.03)
    assert strokes(found.score) == strokes(written)


def slowed(take: Score, by: float) -> Score:
    """The take of a player who keeps to another tempo than the file says."""
    rows = take.notes.copy()
    rows["tick"] = np.rint(rows["tick"] * by).astype(np.int64)
    return Score.from_array(rows, take.tempo_map)


@pytest.mark.parametrize("by", [0.99, 1.01])
def test_a_take_without_a_click_that_runs_away_comes_back(by: float) -> None:
    written = score_of(ROCK, 16, TempoMap.constant(110))  # its last bar lies a third of a second off
    found = quantised_times(slowed(played(written, 11), by), is_played=True)
    assert strokes(found.score) == strokes(written)


@pytest.mark.parametrize("by", [0.98, 1.02])
def test_a_short_take_at_another_tempo_comes_back(by: float) -> None:
    written = score_of(ROCK, 3, TempoMap.constant(110))  # 39 strokes; the last lie 130 ms off
    found = quantised_times(slowed(played(written, 11), by), is_played=True)
    assert strokes(found.score) == strokes(written)


def test_a_beat_that_wanders_is_followed() -> None:
    written = score_of(ROCK, 16, TempoMap.constant(110))
    take = played(written, 12)
    away_s = 0.06 * np.sin(2 * np.pi * take.onset_s / 32)  # at its fastest 1.2 % off the tempo
    rows = take.notes.copy()
    rows["tick"] = take.tempo_map.ticks_at(np.maximum(take.onset_s + away_s, 0))
    found = quantised_times(Score.from_array(rows, take.tempo_map), is_played=True)
    assert strokes(found.score) == strokes(written)


def test_five_minutes_come_back() -> None:
    written = score_of(ROCK, 150, TempoMap.constant(120))
    assert written.length_ns == 300 * NS_PER_S
    found = quantised_times(played(written, 13), is_played=True)
    wrong = set(strokes(found.score)) ^ set(strokes(written))
    assert len(wrong) <= 0.01 * len(written)
