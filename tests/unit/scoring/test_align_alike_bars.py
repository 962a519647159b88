"""Alignment without a click where bars are alike: a short lesson, looped. The truth is how the hits were made.

Which of two equal passes a hit belongs to nobody can say. But who played the whole score answered all its notes, so
that the notes that are matched must be as many as were played.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.scoring.align import align
from tests.fakes.played import played, with_noise

Rows = NDArray[np.int64]


def looped(lesson: str) -> Score:
    return find_lesson(lesson).score.repeated(8)


def take(score: Score, *parts: tuple[Rows, float], leave_out: float = 0.0) -> Performance:
    """Some notes, moved by some seconds, then others; `leave_out` is the share that is never struck."""
    rows = np.concatenate([rows for rows, _ in parts])
    at_s = np.concatenate([score.onset_s[rows] + by_s for rows, by_s in parts])
    kept = np.random.default_rng(5).random(len(rows)) >= leave_out
    return played(score, *with_noise(at_s[kept], rows[kept], 12.0))


def between(score: Score, first_bar: int, end_bar: int) -> Rows:
    return np.flatnonzero((score.bar >= first_bar) & (score.bar < end_bar))


def share_answered(score: Score, performance: Performance) -> float:
    """Matched notes, of all."""
    return align(score, performance, clocked=False).count(Label.MATCH) / len(score)


LESSONS = ("six-stroke-roll", "double-paradiddle", "jazz-waltz-1", "rock-1")


@pytest.mark.parametrize("lesson", LESSONS)
@pytest.mark.parametrize("start_s", [1.0, 1.34, 2.96])
def test_a_recording_that_was_started_before_the_music(lesson: str, start_s: float) -> None:
    """Some seconds of silence are no sign of bars that were left out, even where the beat comes out the same."""
    score = looped(lesson)
    performance = take(score, (np.arange(len(score)), start_s), leave_out=0.03)
    assert share_answered(score, performance) > 0.95


@pytest.mark.parametrize("lesson", LESSONS)
@pytest.mark.parametrize("pause_s", [3.0, 7.77])
def test_who_stops_goes_on_where_he_was(lesson: str, pause_s: float) -> None:
    score = looped(lesson)
    half = score.bar_count // 2
    stopped, rest = between(score, 0, half), between(score, half, score.bar_count)
    assert share_answered(score, take(score, (stopped, 1.2), (rest, 1.2 + pause_s))) > 0.95


@pytest.mark.parametrize("lesson", LESSONS)
def test_one_bar_more_is_one_bar_more(lesson: str) -> None:
    """A bar that is played once more must not send the rest of the music to the other end of the score."""
    score = looped(lesson)
    half, bar_s = score.bar_count // 2, float(score.tempo_map.seconds_at(score.tempo_map.bar_start(1)))
    first, again = between(score, 0, half), between(score, half - 1, score.bar_count)
    assert share_answered(score, take(score, (first, 1.2), (again, 1.2 + bar_s))) > 0.95


def test_who_leaves_out_half_a_bar_off_the_beat_still_began_at_the_beginning() -> None:
    """Three bars on, the rest of what was played would lie behind the end of the score, where no note is left out."""
    score = find_lesson("jazz-waltz-1").score.bars(0, 0).repeated(8)
    half_a_bar_s = float(score.tempo_map.seconds_at(score.tempo_map.bar_start(1))) / 2
    performance = take(score, (between(score, 0, 4), 0.5), (between(score, 5, 8), 0.5 - half_a_bar_s))
    assert align(score, performance, clocked=False).count(Label.MATCH) == len(performance.hits)


def nearly_alike(bars: int) -> Score:
    """Eighths on the hat, backbeats and a kick on one: bars differ by where one soft kick stands."""
    rng = np.random.default_rng(3)
    notes = []
    for bar in range(bars):
        start = bar * 4 * PPQ
        notes += [Note(start + k * PPQ // 2, Piece.HIHAT) for k in range(8)]
        notes += [Note(start + k * PPQ, Piece.SNARE) for k in (1, 3)] + [Note(start, Piece.KICK)]
        notes.append(Note(start + int(rng.choice([3, 6, 7, 10, 11, 14])) * PPQ // 4, Piece.KICK))
    return Score.from_notes(notes, TempoMap.constant(100))


@pytest.mark.parametrize("clocked", [True, False])
def test_a_bar_left_out_among_bars_that_are_nearly_alike(clocked: bool) -> None:
    """One note in twelve tells where he is: no few hits do, all that come after the bar do together."""
    score = nearly_alike(24)
    bar_s = float(score.tempo_map.seconds_at(score.tempo_map.bar_start(1)))
    performance = take(score, (between(score, 0, 6), 0.0), (between(score, 7, 24), -bar_s))
    missed = align(score, performance, clocked).note_label == Label.MISS
    assert np.unique(score.bar[missed]).tolist() in ([6], [5, 6], [6, 7])
    assert missed.sum() == 12
