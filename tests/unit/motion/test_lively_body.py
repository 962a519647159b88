"""The body answers the music: fills, crashes, the backbeat, the face and the eyes. Expected: what drummers look for."""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.motion.body.body_keys import CHANNELS, keys
from station.motion.body.face import HIGH, LOW
from station.motion.body.intensity import Intensity
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.joint_limits import FASTEST_RAD_S
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.style.style import WORDS, Style
from station.motion.style.style_file import load_style
from tests.unit.motion.patterns import ROCK, score_of

Array = NDArray[np.float64]

BEAT_S = 0.6
FILL = [(48 + i, (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)[i // 4]) for i in range(16)]
SONG = score_of(
    [*((16 * b + i, p) for b in range(3) for i, p in ROCK), *FILL, (64, Piece.CRASH_1), (64, Piece.KICK)], 100
)
"""Three bars of rock, a bar of fill, a crash on the first beat of bar 5."""
CRASH_S = 16 * BEAT_S
AT = np.arange(0.0, 11.0, 0.01)


def plain(**controls: float | str) -> Style:
    quiet = {"variation": 0.0, "phrase": 0.0, "look_around": 0.0}
    return Style(**{**quiet, **controls})  # type: ignore[arg-type] # numbers and words as they are


def angle(style: Style, name: str, at: Array = AT) -> Array:
    return np.asarray(Drummer(SONG, style=style).rows(at)[:, frame.ANGLES.start + ANGLE_NAMES.index(name)])


def test_a_fill_is_where_the_time_keeping_stops_and_a_crash_where_it_is() -> None:
    keys = np.arange(0.0, 20 * BEAT_S, BEAT_S / 2)
    notes = SONG.notes
    found = Intensity.of(keys, SONG.onset_s, notes["velocity"].astype(np.float64), notes["piece"])
    assert found.fill[(keys > 7.8) & (keys < 9.0)].min() > 0.6
    assert found.fill[keys < 6.5].max() == 0.0
    assert keys[np.flatnonzero(found.crash)].tolist() == pytest.approx([CRASH_S])
    assert found.fall[np.searchsorted(keys, CRASH_S - 0.31)] < 0 < found.fall[np.searchsorted(keys, CRASH_S - 0.01)]


def test_drums_alone_are_no_fill() -> None:
    keys, onsets = np.arange(0.0, 8.0, 0.25), np.arange(0.0, 8.0, 0.125)
    found = Intensity.of(keys, onsets, np.full(64, 80.0), np.full(64, Piece.SNARE, np.uint8))
    assert found.fill.max() < 0.1


def test_the_body_leans_into_a_fill_rises_before_the_crash_and_falls_onto_it() -> None:
    plan = Drummer(SONG, style=plain()).plan
    assert plan is not None
    at = plan.ground.time_s
    most, none = (keys(plan.ground, plain(fill_lean=f))[CHANNELS.index("lean")] for f in (100.0, 0.0))
    lean = np.degrees(most - none)  # before it reaches for anything
    assert np.abs(lean[(at > 1) & (at < 6)]).max() < 0.5
    assert lean[(at > 7.8) & (at < 8.8)].min() > 3.0
    before, on = lean[np.searchsorted(at, CRASH_S - 0.31)], lean[np.searchsorted(at, CRASH_S - 0.01)]
    assert on > before + 3.0


def test_the_breath_is_held_in_fills() -> None:
    deep, none = (Drummer(SONG, style=plain(breathing=b, shrug=0.0)).rows(AT) for b in (100.0, 0.0))
    height = (deep - none)[:, 3 * Joint.RIGHT_SHOULDER + 2]
    assert np.ptp(height[(AT > 8.1) & (AT < 8.8)]) < 0.25 * np.ptp(height[(AT > 1.0) & (AT < 6.0)])


@pytest.mark.parametrize(("backbeat", "deep"), [(100.0, (1, 3)), (0.0, (0, 2))])
def test_the_head_nods_on_the_beats_that_the_style_says(backbeat: float, deep: tuple[int, ...]) -> None:
    nod = angle(plain(backbeat=backbeat, amplitude_gaze=0.0), "head_nod", BEAT_S * np.arange(4))
    others = [k for k in range(4) if k not in deep]
    assert nod[list(deep)].min() > nod[others].max() + np.radians(2.0)


@pytest.mark.parametrize("late_ms", [-30.0, 45.0])
def test_the_head_lies_as_far_behind_the_beat_as_the_style_says(late_ms: float) -> None:
    at = 4 * BEAT_S + np.arange(-0.15, 0.15, 0.001)
    nod = angle(plain(lay_back_ms=late_ms, amplitude_gaze=0.0), "head_nod", at)
    assert 1000 * (at[np.argmax(nod)] - 4 * BEAT_S) == pytest.approx(late_ms, abs=4.0)


def test_the_chin_comes_forward_on_the_beat_and_the_face_stays_level() -> None:
    rows = [Drummer(SONG, style=plain(chin=c)).rows(BEAT_S * np.arange(1.0, 8.0)) for c in (0.0, 100.0)]
    head = [r[:, 3 * Joint.HEAD + 1] - r[:, 3 * Joint.NECK + 1] for r in rows]
    assert (head[1] - head[0]).min() > 0.02
    assert np.abs(rows[1][:, frame.FACING] - rows[0][:, frame.FACING]).max() < 1e-9


def test_head_banging_is_wild_and_within_what_a_neck_can_do() -> None:
    """Necks bend 50–60° each way; vigorous shaking reaches 540°/s (`joint_limits`)."""
    fast = score_of([*((16 * b + i, p) for b in range(4) for i, p in ROCK)], 190)
    for score in (SONG, fast):
        rows = Drummer(score, style=load_style("wild")).rows(np.arange(0.0, 5.0, 0.002))
        nod = rows[:, frame.ANGLES.start + ANGLE_NAMES.index("head_nod")]
        assert np.degrees(np.ptp(nod)) > 40
        assert -np.radians(60) < nod.min() < nod.max() < np.radians(60)
        assert np.abs(np.diff(nod)).max() / 0.002 <= FASTEST_RAD_S["head_nod"]


def test_a_wild_drummer_stands_up_for_crashes() -> None:
    rows = Drummer(SONG, style=plain(rise=100.0)).rows(np.array([5.0, CRASH_S]))
    assert rows[1, 3 * Joint.PELVIS + 2] - rows[0, 3 * Joint.PELVIS + 2] > 0.08


@pytest.mark.parametrize("mood", WORDS["mood"])
def test_faces_stay_within_their_ranges_and_strain_in_fills(mood: str) -> None:
    drummer = Drummer(SONG, style=plain(mood=mood, expression=100.0))
    rows = drummer.rows(AT)[:, frame.FACE]
    faces = np.array([drummer.pose(t).face for t in (3.0, 8.4, CRASH_S)])
    assert (faces >= LOW).all()
    assert (faces <= HIGH).all()
    assert faces[1, 3] > faces[0, 3] or faces[0, 3] == 1.0  # effort
    assert np.abs(np.diff(rows, axis=0)).max() < 0.08  # within a hundredth of a second: no face jumps


def test_moods_are_different_faces() -> None:
    faces = {m: Drummer(SONG, style=plain(mood=m)).pose(3.0).face for m in ("joyful", "intense", "calm")}
    assert faces["joyful"][2] > 0.4 > faces["calm"][2] > faces["intense"][2]
    assert faces["intense"][0] < -0.3 < faces["calm"][0] < faces["joyful"][0]


def test_eyes_stay_on_what_is_looked_at_while_the_head_nods() -> None:
    """The look in space is head and eyes together: as the head goes down the eyes go up by as much."""
    rows = Drummer(SONG, style=plain(amplitude_neck=100.0)).rows(np.arange(2.0, 4.0, 0.01))
    facing, down = rows[:, frame.FACING], rows[:, frame.GAZE.start + 1]
    head = np.arcsin(-facing[:, 2])
    assert np.degrees(np.ptp(head)) > 8
    assert np.degrees(np.ptp(head + down)) < 2


def test_the_crash_is_looked_at_a_quarter_second_before_it() -> None:
    drummer = Drummer(SONG, style=plain())
    rows = drummer.rows(CRASH_S + np.array([-0.25, 0.0]))
    eye = rows[:, 3 * Joint.HEAD : 3 * Joint.HEAD + 3]
    crash = drummer.kit.pieces[Piece.CRASH_1].centre - eye
    bearing = np.arctan2(-crash[:, 0], crash[:, 1])
    facing = np.arctan2(-rows[:, frame.FACING.start], rows[:, frame.FACING.start + 1])
    assert (
        np.degrees(np.abs(facing + rows[:, frame.GAZE.start] - bearing)).max() < 12
    )  # its edge is struck, not its middle


def test_each_style_looks_where_its_attention_is() -> None:
    def look(attention: str) -> Array:
        rows = Drummer(SONG, style=plain(attention=attention, look_around=100.0)).rows(AT)
        facing = rows[:, frame.FACING]
        return np.degrees([np.arctan2(-facing[:, 0], facing[:, 1]).mean(), np.arcsin(-facing[:, 2]).mean()])

    friend, hands, above = look("friend"), look("hands"), look("above")
    assert friend[0] > above[0] + 15
    assert hands[1] > above[1] + 15


def test_another_seed_sways_nods_and_looks_otherwise() -> None:
    one, two = (Drummer(SONG, style=Style(seed=s)).rows(AT)[:, frame.JOINTS].reshape(-1, 21, 3) for s in (1, 2))
    assert np.linalg.norm(one - two, axis=2)[:, Joint.CROWN].max() > 0.01


@pytest.mark.parametrize("style", ["wild", "funk", "natural"])
def test_trunk_and_head_turn_without_a_jerk(style: str) -> None:
    """Looked at 1000 times a second, from before the first stroke to long after the last, no speed jumps."""
    rows = Drummer(SONG, style=load_style(style)).rows(np.arange(-4.0, 16.0, 0.001))
    for name in ("torso_twist", "torso_lean", "torso_side", "head_nod", "head_turn", "head_tilt"):
        speed = np.degrees(np.diff(rows[:, frame.ANGLES.start + ANGLE_NAMES.index(name)])) / 0.001
        assert np.abs(np.diff(speed)).max() < 15, name  # a head that stops at once would jump by 300
