"""Which part of stick and hand is where at a strike: cross-sticks, bells, crashes, splashes; heights on every piece.

Heights in inches by HUMANS (marching practice); the rest is how these strokes are taught.
"""

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.audit import audit
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.figure import Joint
from station.motion.kinematics.grip import GRIPS, Grip
from station.motion.kit.kit import load_kit
from station.motion.strokes.stroke_heights import INCH_M, LEVELS
from station.motion.style.style import Style
from station.music.score import Note, Score
from station.music.tempo import TempoMap

Array = NDArray[np.float64]

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND
STICK_M = 0.406


def drummer_of(notes: list[Note], tempo_bpm: float = 100, kit: str = "four_piece") -> Drummer:
    return Drummer(Score.from_notes(notes, TempoMap.constant(tempo_bpm)), load_kit(kit), style=Style(variation=0.0))


def out_from(drummer: Drummer, piece: Piece, points: Array) -> tuple[Array, Array]:
    """How far each point is from the piece's axis, and over its plane."""
    middle = drummer.kit.pieces[piece]
    over = (points - middle.centre) @ middle.normal
    return np.linalg.norm(points - middle.centre - over[:, None] * middle.normal, axis=1), over


@pytest.mark.parametrize("kit", ["four_piece", "seven_piece", "left_handed"])
@pytest.mark.parametrize("limb", [L, R])
def test_a_cross_sticks_hand_is_on_the_head_and_its_shaft_on_the_rim(kit: str, limb: Limb) -> None:
    laid = [
        Note(i * PPQ, Piece.SNARE, Zone.RIM, 80, limb=limb, articulation=Articulation.CROSS_STICK) for i in range(4)
    ]
    drummer = drummer_of(laid, kit=kit)
    radius, pose = drummer.kit.pieces[Piece.SNARE].radius_m, drummer.pose(1.2)
    hand = pose.joints_m[Joint.LEFT_HAND if limb == L else Joint.RIGHT_HAND]
    out, over = out_from(drummer, Piece.SNARE, np.stack([hand, pose.tip_m[limb], drummer._plan.strike_m[2]]))
    assert out[0] < 0.5 * radius  # well on the head
    assert 0.0 < over[0] < 0.04  # resting on it, as thick as a hand is
    assert out[1] > radius  # the end is beyond the rim
    assert out[2] == pytest.approx(radius, abs=1e-6)
    assert over[2] == pytest.approx(0.012, abs=0.004)  # a counter-hoop's height
    along = (pose.tip_m[limb] - pose.butt_m[limb]) / STICK_M
    away = drummer._plan.strike_m[2] - pose.butt_m[limb]
    assert np.linalg.norm(away - (away @ along) * along) < 1e-6  # the shaft is on it
    tip = drummer.rows(np.arange(0.6, 1.2, 0.005))[:, frame.TIP].reshape(-1, 2, 3)[:, limb]
    assert 0.01 < np.ptp(out_from(drummer, Piece.SNARE, tip)[1]) < 0.15  # lifted, never high
    found = audit(drummer)
    assert found.kit_m.value < 0.003
    assert found.limit_rad.value < 0.02


@pytest.mark.parametrize(("zone", "share"), [(Zone.BELL, 0.75), (Zone.BOW, 1.0)])
def test_a_rides_bell_is_struck_by_the_sticks_shoulder_its_bow_by_the_tip(zone: Zone, share: float) -> None:
    drummer = drummer_of([Note(i * PPQ, Piece.RIDE, zone, 80, limb=R) for i in range(4)])
    pose, ride = drummer.pose(1.2), drummer.kit.pieces[Piece.RIDE]
    at = drummer._plan.strike_m[2]
    along = (pose.tip_m[0] - pose.butt_m[0]) / STICK_M
    place = (at - pose.butt_m[0]) @ along
    assert place / STICK_M == pytest.approx(share, abs=0.01)
    assert np.linalg.norm(at - pose.butt_m[0] - place * along) < 1e-6
    out, _ = out_from(drummer, Piece.RIDE, at[None])
    assert out[0] / ride.radius_m == pytest.approx(0.6 if zone == Zone.BOW else 0.15, abs=0.06)


@pytest.mark.parametrize("limb", [L, R])
def test_a_crash_is_struck_on_its_edge_by_the_shoulder_and_left_at_once(limb: Limb) -> None:
    drummer = drummer_of([Note(0, Piece.CRASH_1, Zone.EDGE, 120, limb=limb), Note(4 * PPQ, Piece.SNARE, limb=limb)])
    edge = drummer._plan.strike_m[0]
    out, _ = out_from(drummer, Piece.CRASH_1, edge[None])
    assert out[0] == pytest.approx(drummer.kit.pieces[Piece.CRASH_1].radius_m, abs=0.01)
    rows = drummer.rows(np.array([0.0, 0.1]))
    butt, tip = (rows[:, part].reshape(-1, 2, 3)[:, limb] for part in (frame.BUTT, frame.TIP))
    shoulder = butt + 0.75 * (tip - butt)
    assert shoulder[0] == pytest.approx(edge, abs=1e-6)
    assert np.linalg.norm(shoulder[1] - edge) > 0.03  # away within 100 ms
    assert audit(drummer).kit_m.value < 0.003


@pytest.mark.parametrize("piece", [Piece.SNARE, Piece.HIHAT, Piece.TOM_1, Piece.FLOOR_TOM_1, Piece.RIDE, Piece.CRASH_1])
def test_heights_over_every_piece_follow_the_table_at_a_moderate_tempo(piece: Piece) -> None:
    zone = Zone.HEAD if piece in (Piece.SNARE, Piece.TOM_1, Piece.FLOOR_TOM_1) else Zone.BOW
    notes = [Note((3 * k + i) * PPQ, piece, zone, v, limb=R) for k, (v, _) in enumerate(LEVELS) for i in range(3)]
    drummer = drummer_of(notes)
    for k, (_, inches) in enumerate(LEVELS):
        struck = (3 * k + 2) * 0.6
        tip = drummer.rows(np.linspace(struck - 0.55, struck, 300))[:, frame.TIP.start + 2]
        assert (tip.max() - tip[-1]) / INCH_M == pytest.approx(inches, abs=0.5)


def test_a_splash_closes_the_hat_for_a_moment_only() -> None:
    splash = Note(2 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, 90, articulation=Articulation.SPLASH)
    chick = Note(6 * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, 90, articulation=Articulation.CHICK)
    drummer = drummer_of([splash, chick, Note(10 * PPQ, Piece.SNARE, limb=R)])
    assert drummer.pose(1.2).hat_gap_m < 0.001
    assert drummer.pose(1.2 + 0.15).hat_gap_m > 0.01
    assert drummer.pose(3.6).hat_gap_m < 0.001
    assert drummer.pose(3.6 + 0.15).hat_gap_m < 0.001  # a chick stays shut


@pytest.mark.parametrize("grip", GRIPS.values(), ids=GRIPS)
@pytest.mark.parametrize("rise_deg", [-90, -75, 75, 90])
def test_the_steepest_stick_still_lies_in_the_hand(grip: Grip, rise_deg: float) -> None:
    """A kit may stand so that a stick comes straight down; no grip makes the hand follow it all the way."""
    lie = grip.lie(np.radians(rise_deg))
    assert np.isfinite([lie.palm, lie.crossing, lie.roll]).all()
