"""What a drummer's eye looks for in strokes: full, down, tap, up; ghosts; crashes; chokes; heel-up; closing fingers.

The words are those of stick technique: a stroke's type is its own height and that of the next; inches by HUMANS.
"""

from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
STILL = Style(amplitude_back=0.0, amplitude_side=0.0, amplitude_twist=0.0, breathing=0.0, shrug=0.0, phrase=0.0)
ACCENT, TAP = 112, 49  # 12 and 3 inches


def drummer_of(notes: list[Note], tempo_bpm: float = 120, style: Style | None = None) -> Drummer:
    return Drummer(Score.from_notes(notes, TempoMap.constant(tempo_bpm)), style=style or Style())


def tips(drummer: Drummer, at: Array, limb: Limb = R) -> Array:
    return drummer.rows(at)[:, frame.TIP].reshape(-1, 2, 3)[:, int(limb)]


def angle(drummer: Drummer, name: str, at: Array) -> Array:
    return np.asarray(drummer.rows(at)[:, frame.ANGLES][:, ANGLE_NAMES.index(name)])


def heights_after(first: int, second: int, gap_s: float = 0.25) -> Array:
    """The tip over the head from the stroke of velocity `first` to that of `second`, in the middle of a row of such."""
    velocities = [first, first, first, first, second, second, second]
    notes = [Note(i * PPQ, Piece.SNARE, velocity=v, limb=R) for i, v in enumerate(velocities)]
    z = tips(drummer_of(notes, 60 / gap_s), 3 * gap_s + np.linspace(0.0, gap_s, 251))[:, 2]
    return np.asarray(z - z[0])


def test_full_and_up_strokes_end_high_down_strokes_and_taps_low() -> None:
    full, down, tap, up = (
        heights_after(*pair) for pair in ((ACCENT, ACCENT), (ACCENT, TAP), (TAP, TAP), (TAP, ACCENT))
    )
    for high in (full, up):
        assert high.max() == pytest.approx(12 * 0.0254, rel=0.12)
        assert high[125] > 0.2
    for low in (down, tap):
        assert low.max() == pytest.approx(3 * 0.0254, rel=0.12)
    assert down[:125].max() <= 1.1 * tap.max()  # an accent before a tap is stopped low


@pytest.mark.parametrize("velocity", [20, 30, 40])
def test_ghost_strokes_are_wrist_and_fingers_alone(velocity: int) -> None:
    notes = [Note(i * PPQ, Piece.SNARE, velocity=velocity, limb=R) for i in range(8)]
    drummer, at = drummer_of(notes, style=STILL), np.arange(1.0, 3.0, 0.002)
    for joint in ("shoulder", "elbow"):
        assert np.degrees(np.ptp(angle(drummer, f"right_{joint}", at))) < 2.0
    assert np.degrees(np.ptp(angle(drummer, "right_wrist", at))) > 2.0
    assert np.degrees(np.ptp(angle(drummer, "right_stick", at))) > 2.0


def test_fingers_open_while_the_stick_rises_and_close_for_the_stroke() -> None:
    drummer = drummer_of([Note(i * PPQ, Piece.SNARE, velocity=110, limb=R) for i in range(4)], 100)
    closed = np.array([drummer.pose(t).fingers[0] for t in np.arange(0.6, 1.2, 0.005).tolist()])
    assert 0.0 <= closed.min() < closed.max() - 0.1
    assert drummer.pose(1.2).fingers[0] == pytest.approx(closed.max(), abs=0.02)


def test_a_flams_grace_hand_stays_low() -> None:
    grace = Note(4 * PPQ, Piece.SNARE, velocity=60, limb=L, ornament=Ornament.FLAM, lead_ms=25)
    drummer = drummer_of([Note(4 * PPQ, Piece.SNARE, velocity=112, limb=R), grace])
    main_z, grace_z = (
        tips(drummer, np.arange(1.85, limb_s, 0.002), limb)[:, 2] for limb, limb_s in ((R, 2.0), (L, 1.975))
    )
    surface = drummer.kit.pieces[Piece.SNARE].centre[2]
    assert grace_z.max() - surface < 0.06  # a tap's height
    assert main_z.max() - surface > 0.25


def test_near_strokes_are_one_motion_and_the_second_is_lower() -> None:
    """A double: 70 ms apart, then time to raise the next one."""
    ticks = [0, 7, 40, 47, 80, 87]
    notes = [Note(i * PPQ // 50, Piece.SNARE, velocity=80, limb=R) for i in ticks]
    drummer = drummer_of(notes, 120)  # a fiftieth of a beat is 10 ms
    z = tips(drummer, np.arange(0.0, 0.88, 0.001))[:, 2] - 0.66
    first, second = z[100:400].max(), z[400:470].max()
    assert 0.005 < second < 0.75 * first
    between = np.diff(z[402:469])
    assert np.sum(np.diff(np.sign(between)) != 0) == 1  # up once and down once


def test_a_crash_is_a_glancing_blow_that_follows_through_and_leaves() -> None:
    notes = [Note(0, Piece.CRASH_1, Zone.EDGE, 120, limb=L), Note(2 * PPQ, Piece.SNARE, limb=L)]
    drummer = drummer_of(notes, 100)
    hit, soon, later = tips(drummer, np.array([0.0, 0.06, 0.35]), L)
    assert np.linalg.norm(soon - hit) > 0.01
    assert np.linalg.norm(later - hit) > 0.15


def test_a_choke_grips_the_edge() -> None:
    notes = [Note(0, Piece.CRASH_1, Zone.EDGE, 120, limb=R, choke_ticks=2 * PPQ)]
    drummer = drummer_of(notes, 100)
    pose, crash = drummer.pose(1.2), drummer.kit.pieces[Piece.CRASH_1]
    hands = pose.joints_m[[8, 12]]  # right and left fulcrum
    away = hands - crash.centre
    over = away @ crash.normal
    radial = np.linalg.norm(away - over[:, None] * crash.normal, axis=1)
    gripping = int(np.argmin(np.abs(over) + np.abs(radial - crash.radius_m)))
    assert abs(over[gripping]) < 0.03
    assert radial[gripping] == pytest.approx(crash.radius_m, abs=0.03)


def test_heel_up_lifts_the_thigh_and_more_for_the_stroke() -> None:
    notes = [Note(i * PPQ, Piece.KICK) for i in range(4)]
    up, down = (drummer_of(notes, 100, replace(STILL, heel=heel)) for heel in ("up", "down"))
    at = np.arange(0.7, 1.3, 0.005)
    knee_up, knee_down = (d.rows(at)[:, 3 * 14 + 2] for d in (up, down))
    assert (knee_up - knee_down).min() > 0.01
    assert np.ptp(knee_up) > 0.01


@pytest.mark.parametrize(("grip", "limb"), [("traditional", L), ("french", L), ("french", R)])
def test_traditional_and_thumb_up_strokes_rotate_the_forearm(grip: str, limb: Limb) -> None:
    side = "right" if limb == R else "left"
    held = {"grip_right": grip} if limb == R else {"grip_left": grip}
    notes = [Note(i * PPQ, Piece.SNARE, velocity=96, limb=limb) for i in range(4)]
    drummer, at = drummer_of(notes, 100, replace(Style(), **held)), np.arange(0.6, 1.2, 0.005)  # type: ignore[arg-type]
    roll = angle(drummer, f"{side}_forearm", at)
    assert np.degrees(np.ptp(roll)) > 6.0
    assert roll.argmax() not in (0, len(roll) - 1)  # outward as the stick rises, and back for the stroke
    back = drummer.rows(at)[:, frame.PALM].reshape(-1, 2, 3)[:, int(limb)]
    assert np.degrees(np.arccos(np.clip(back @ back[0], -1, 1)).max()) > 6.0
    assert np.linalg.norm(back, axis=1) == pytest.approx(np.ones(len(back)))


@pytest.mark.parametrize("zone", [Zone.BOW, Zone.BELL])
def test_on_a_ride_the_thumb_comes_up_and_the_forearm_rolls(zone: Zone) -> None:
    drummer = drummer_of([Note(i * PPQ, Piece.RIDE, zone, 96, limb=R) for i in range(4)])
    at = np.arange(0.6, 1.2, 0.005)
    assert 3.0 < np.degrees(np.ptp(angle(drummer, "right_forearm", at))) < 30.0


def test_a_matched_palm_down_hand_does_not_roll() -> None:
    drummer = drummer_of([Note(i * PPQ, Piece.SNARE, velocity=96, limb=R) for i in range(4)])
    assert np.ptp(angle(drummer, "right_forearm", np.arange(0.5, 1.5, 0.01))) == 0.0
