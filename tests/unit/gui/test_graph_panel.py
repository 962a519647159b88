"""What the graph shows: curves against single poses, bar numbers counted by hand, the student's strokes as marked."""

import numpy as np
import pytest

from station.core.pieces import Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.gui.panels.graph_axis import MOST_LINES, music_ticks
from station.motion.drummer import Drummer
from station.motion.kinematics.pose import ANGLE_NAMES
from station.music.judgement import Judgement, Label
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoMap
from station.render.snapshot import BarNumbers, mark, no_marks
from station.scenes.curves import played_of_marks
from station.scenes.joint_curves import CURVES, JointCurves

DRUMMER = Drummer(find_lesson("rock-1").score)


def test_curves_are_the_poses_angles_and_have_every_strike() -> None:
    """A pose is evaluated on floats, one at a time; the curves come from the way for many."""
    curves = JointCurves(DRUMMER)
    time_s, degrees = curves.between(0.5, 3.7)
    assert (time_s[0], time_s[-1] >= 3.7) == (0.0, True)
    assert np.all(np.diff(time_s) > 0)
    onsets = DRUMMER.score.onset_s
    assert np.isin(onsets[onsets < 4.0], time_s).all()
    for index in (0, 77, 200, len(time_s) - 1):
        pose = DRUMMER.pose(float(time_s[index]))
        expected = [np.degrees(pose.angles_rad[ANGLE_NAMES.index(curve.angle)]) for curve in CURVES]
        assert degrees[index] == pytest.approx(expected, abs=1e-6)


def test_curves_are_sampled_once_however_one_moves_along_them() -> None:
    curves = JointCurves(DRUMMER)
    first = curves.between(0.1, 1.9)[0]
    assert curves.between(0.2, 1.2)[0] is first
    joined = curves.between(0.1, 5.0)[0]
    assert joined[: len(first)].tolist() == first.tolist()
    assert len(np.unique(joined)) == len(joined)


def test_curves_of_hours_are_cut_short() -> None:
    curves = JointCurves(DRUMMER)
    for start_s in (0.0, 130.0, 400.0):
        assert curves.between(start_s, 10_000.0)[0][-1] < start_s + 131.0


def song(bars: int, beats: int = 4, unit: int = 4) -> Score:
    """At 120 beats a minute."""
    tempo_map = TempoMap.constant(120.0, beats, unit)
    return Score.from_notes([], tempo_map, bars * MeterChange(0, beats, unit).bar_ticks)


def test_lines_at_every_beat_bear_the_lesson_s_own_numbers() -> None:
    """Two bars from the lesson's bar 5 on, played over and over: bar 2 of the score is 6, bar 3 is 5 again."""
    values, words = music_ticks(song(4), BarNumbers(4, 2), 3.0, 4.6)
    assert values == [3.0, 3.5, 4.0, 4.5]
    assert words == ["6.3", "6.4", "5", "5.2"]


def test_lines_stay_within_the_score_and_are_never_too_many() -> None:
    assert music_ticks(song(2), BarNumbers(), -5.0, 90.0)[0] == [0.5 * beat for beat in range(8)]
    assert music_ticks(song(2), BarNumbers(), 50.0, 90.0) == ([], [])
    assert music_ticks(song(2), BarNumbers(), -9.0, -5.0)[0] in ([], [0.0])
    values, words = music_ticks(song(100), BarNumbers(), 0.0, 200.0)
    assert len(values) <= MOST_LINES
    assert words[:3] == ["1", "5", "9"]


def test_strokes_of_the_student_as_they_were_marked() -> None:
    notes = [Note(beat * PPQ, Piece.SNARE, velocity=80 + beat) for beat in range(4)]
    score = Score.from_notes(notes, TempoMap.constant(120.0))
    marks = no_marks(score)
    mark(marks, Judgement(Label.MATCH, 0, 0, asynchrony_ns=-12_000_000, velocity_error=5))
    mark(marks, Judgement(Label.MISS, 2, None))
    played = played_of_marks(score, marks, 25.0)
    assert played.time_s.tolist() == [0.0, 1.0]
    assert played.asynchrony_ms.tolist()[0] == -12.0
    assert (played.velocity.tolist()[0], played.written.tolist()) == (85.0, [80.0, 82.0])
    assert np.isnan([played.asynchrony_ms[1], played.velocity[1]]).all()
