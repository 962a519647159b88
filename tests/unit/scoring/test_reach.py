"""How far from its note a hit may lie: music played with another feel than it is written, and music that is dense."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.judgement import Label
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from station.scoring.matching.note_reach import reach_of
from tests.fakes.played import played
from tests.fakes.takes import noise_ms

STRAIGHT, SHUFFLE = 1 / 2, 2 / 3


def groove(tempo_bpm: float, offbeat: float, bars: int = 8) -> Score:
    """Hat on beats and offbeats, kick on 1, 3 and after 3, snare on 2 and 4; `offbeat` is their place in the beat."""
    after = round(offbeat * PPQ)
    notes = [Note(beat * PPQ + late, Piece.HIHAT) for beat in range(4) for late in (0, after)]
    notes += [Note(at, Piece.KICK) for at in (0, 2 * PPQ, 2 * PPQ + after)]
    notes += [Note(beat * PPQ, Piece.SNARE) for beat in (1, 3)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def counts(score: Score, at_s: NDArray[np.float64], clocked: bool = True) -> tuple[int, int, int]:
    order = np.argsort(at_s, kind="stable")
    result = align(score, played(score, at_s[order], order), clocked)
    return result.count(Label.MATCH), result.count(Label.MISS), result.count(Label.EXTRA)


@pytest.mark.parametrize("tempo_bpm", [60, 90, 120, 180])
@pytest.mark.parametrize(("written", "heard"), [(SHUFFLE, STRAIGHT), (STRAIGHT, SHUFFLE), (STRAIGHT, 3 / 4)])
def test_another_feel_than_written_misses_nothing(tempo_bpm: float, written: float, heard: float) -> None:
    """A shuffle played straight and straight eighths swung: at 60 bpm 167 and 250 ms beside what is written."""
    score = groove(tempo_bpm, written)
    beat_s = 60 / tempo_bpm
    late_s = np.where(score.notes["tick"] % PPQ > 0, (heard - written) * beat_s, 0.0)
    at_s = score.onset_s + late_s + noise_ms(score, 15.0, np.random.default_rng(3)) / 1000
    assert counts(score, at_s) == (len(score), 0, 0)


def test_a_straight_shuffle_with_strokes_left_out_still_knows_which() -> None:
    """Every seventh stroke is left out: these are the misses, and nothing else."""
    score = groove(60, SHUFFLE)
    at_s = score.onset_s - np.where(score.notes["tick"] % PPQ > 0, 1 / 6, 0.0)
    rows = np.flatnonzero(np.arange(len(score)) % 7 != 3)
    rows = rows[np.argsort(at_s[rows], kind="stable")]
    result = align(score, played(score, at_s[rows], rows), clocked=True)
    assert np.flatnonzero(result.note_label == Label.MISS).tolist() == list(range(3, len(score), 7))
    assert result.count(Label.EXTRA) == 0


def sixteenths(tempo_bpm: float, bars: int = 4) -> Score:
    notes = [Note(k * PPQ // 4, Piece.SNARE) for k in range(16)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def test_sixteenths_at_160_are_not_stolen() -> None:
    """A pad that triggers twice in one place does not play the note after it, 94 ms on, that was left out."""
    score = sixteenths(160)
    rows = np.delete(np.arange(len(score)), [11, 30])
    at_s = np.concatenate((score.onset_s[rows], score.onset_s[[10, 29]] + 0.02))
    at_s = at_s + np.random.default_rng(1).normal(0, 0.008, len(at_s))
    rows = np.concatenate((rows, [10, 29]))
    order = np.argsort(at_s, kind="stable")
    result = align(score, played(score, at_s[order], rows[order]), clocked=True)
    assert np.flatnonzero(result.note_label == Label.MISS).tolist() == [11, 30]
    assert result.count(Label.EXTRA) == 2


def test_the_reach_of_a_note_is_a_share_of_the_way_to_the_next() -> None:
    """By hand: .6 of 333 and 667 ms in a shuffle at 60, a third of a beat where nothing is near, 60 ms in 16ths."""
    shuffle = groove(60, SHUFFLE, 1)
    hats = np.flatnonzero(shuffle.notes["piece"] == Piece.HIHAT)
    room = reach_of(shuffle, shuffle.notes["piece"].astype(np.int64))
    assert (room.early[hats] / NS_PER_MS).round().tolist()[1:5] == [333, 200, 333, 200]
    assert (room.late[hats] / NS_PER_MS).round().tolist()[1:5] == [200, 333, 200, 333]
    dense = sixteenths(160)
    room = reach_of(dense, np.zeros(len(dense), np.int64))
    assert (room.early[1:] / NS_PER_MS).round().tolist() == [60] * (len(dense) - 1)
    slow = Score.from_notes([Note(k * 4 * PPQ, Piece.CRASH_1) for k in range(3)], TempoMap.constant(60))
    assert (reach_of(slow, np.zeros(3, np.int64)).late / NS_PER_MS).round().tolist() == [333] * 3
