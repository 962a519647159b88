"""Where the player stands, told match by match: expected values by hand."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import NS_PER_MS, PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.matching.assignment import Leaning, leaning_places
from station.scoring.matching.note_reach import reach_of
from station.scoring.matching.running_lean import RunningLean


def running(notes_per_beat: int, bars: int = 8, tempo_bpm: float = 120.0) -> RunningLean:
    """Of notes on the snare, so many a quarter."""
    notes = [Note(k * PPQ // notes_per_beat, Piece.SNARE) for k in range(4 * bars * notes_per_beat)]
    score = Score.from_notes(notes, TempoMap.constant(tempo_bpm))
    classes = score.notes["piece"].astype(np.int64)
    return RunningLean(Leaning(leaning_places(score), reach_of(score, classes)), classes)


def test_before_anything_is_heard_the_reach_is_what_the_music_leaves() -> None:
    """Eighths at 120 bpm, 250 ms apart: .6 of it to both sides, and nothing leans."""
    lean = running(2)
    assert (lean.due_ns(5), lean.reach_ns(5)) == (0, (150 * NS_PER_MS, 150 * NS_PER_MS))


def test_offbeats_lean_on_their_own() -> None:
    """Beats on time, offbeats 40 ms late: each place is believed as it is heard, the reach becomes that of a steady
    player, 60 ms."""
    lean = running(2)
    for note in range(60):
        lean.learn(note, 40 * NS_PER_MS if note % 2 else 0)
    assert abs(lean.due_ns(60)) < 10 * NS_PER_MS
    assert lean.due_ns(61) == pytest.approx(40 * NS_PER_MS, abs=10 * NS_PER_MS)
    assert lean.reach_ns(61) == (60 * NS_PER_MS, 60 * NS_PER_MS)


def test_no_place_leans_as_far_as_the_next_note() -> None:
    """Sixteenths 125 ms apart that seem 110 ms early answer the note before: half the way, 62.5 ms, is the most."""
    lean = running(4)
    for note in range(0, 64, 4):
        for other in range(note, note + 4):
            lean.learn(other, -110 * NS_PER_MS if other % 4 == 3 else 0)
    assert lean.due_ns(67) >= lean.common_ns - 62.5 * NS_PER_MS


def test_a_note_counts_once() -> None:
    once, twice = running(2), running(2)
    for note in range(10):
        once.learn(note, 20 * NS_PER_MS)
        twice.learn(note, 20 * NS_PER_MS)
        twice.learn(note, 90 * NS_PER_MS)
    assert once.due_ns(12) == twice.due_ns(12)
