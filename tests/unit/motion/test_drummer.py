"""The whole drummer: every stroke on its drum, nothing through a drum, within the joints' limits, the same twice."""

from dataclasses import replace
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kinematics import frame
from station.motion.kinematics.collisions import collisions
from station.motion.kinematics.figure import Joint, figure_of
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.kit.kit import kit_names, load_kit
from station.motion.strokes.targets import Strike, target_of
from station.motion.style.style import Style
from station.motion.style.style_file import load_style, style_names
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from tests.unit.motion.patterns import ROCK, score_of, zone_of

Array = NDArray[np.float64]

FILL = [(i, (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)[i // 4]) for i in range(16)]
GROOVE = [*ROCK, *((16 + i, p) for i, p in FILL), (32, Piece.CRASH_1), (36, Piece.RIDE), (40, Piece.RIDE)]
SCORE = score_of(GROOVE, tempo_bpm=110)

EXACT = Style(variation=0.0)


def tips_at_strikes(drummer: Drummer) -> tuple[Array, Array]:
    """Where the tip is at each hand's stroke that a tip makes, and the point that it aims at."""
    limbs, score = drummer.assignment.limbs, drummer.score
    tips, points = [], []
    for i, note in enumerate(score):
        limb = Limb(limbs[i])
        target = (
            target_of(drummer.kit, Strike(note.piece, note.zone, note.articulation, limb)) if limb.is_hand else None
        )
        if target is not None and not target.shoulder:
            tips.append(drummer.pose(float(score.onset_s[i])).tip_m[int(limb)])
            points.append(target.point_m)
    return np.array(tips), np.array(points)


def grid(score: Score, rate_hz: float = 240) -> Array:
    return np.arange(-1.0, score.length_ns / 1e9 + 1.0, 1 / rate_hz)


@pytest.mark.parametrize(("kit", "style"), list(zip(cycle(kit_names()), style_names(), strict=False)))
def test_at_every_strike_the_tip_is_on_the_drum(kit: str, style: str) -> None:
    tips, points = tips_at_strikes(Drummer(SCORE, load_kit(kit), style=replace(load_style(style), variation=0.0)))
    assert len(tips) > 20
    assert np.linalg.norm(tips - points, axis=1).max() < 1e-9


@pytest.mark.parametrize("stature", [1.55, 1.759, 1.95])
def test_any_figure_reaches_the_very_point(stature: float) -> None:
    tips, points = tips_at_strikes(Drummer(SCORE, figure=figure_of(stature), style=EXACT))
    assert np.linalg.norm(tips - points, axis=1).max() < 1e-9


@pytest.mark.parametrize("held", ["stick", "brush", "mallet", "hand"])
@pytest.mark.parametrize("grip", ["american", "german", "french", "traditional"])
def test_whatever_is_held_touches(held: str, grip: str) -> None:
    style = replace(EXACT, held=held, grip_left=grip, grip_right="american" if grip == "traditional" else grip)
    tips, points = tips_at_strikes(Drummer(SCORE, style=style))
    assert np.linalg.norm(tips - points, axis=1).max() < 1e-9


def test_a_slider_of_the_body_moves_no_strike() -> None:
    wild = replace(
        EXACT, amplitude_back=100, amplitude_side=100, amplitude_twist=0, wing_deg=20, stand=1, posture_deg=12
    )
    tips, points = tips_at_strikes(Drummer(SCORE, style=wild))
    assert np.linalg.norm(tips - points, axis=1).max() < 1e-9


def test_the_tip_meets_the_plane_at_the_strike_and_not_before() -> None:
    """≤ 0.1 ms: just before and just after the strike the tip is over the surface."""
    drummer = Drummer(score_of([(8 * i, Piece.SNARE) for i in range(4)], velocity=100))
    for i, onset in enumerate(drummer.score.onset_s.tolist()):
        limb = int(drummer.assignment.limbs[i])
        snare = drummer.kit.pieces[Piece.SNARE]
        for off in (-1e-4, 1e-4):
            above = (drummer.pose(onset + off).tip_m[limb] - snare.centre) @ snare.normal
            assert 0 < above < 0.0015


@pytest.mark.parametrize("style", style_names())
def test_no_stick_passes_through_a_drum_or_cymbal(style: str) -> None:
    drummer = Drummer(SCORE, style=load_style(style))
    found = collisions(drummer.rows(grid(SCORE)), drummer.kit)
    for piece, depth in found.pieces.items():
        assert depth.max() <= 0.003, piece


def test_joints_stay_within_their_limits() -> None:
    drummer = Drummer(SCORE, load_kit("seven_piece"))
    angles = dict(zip(ANGLE_NAMES, drummer.rows(grid(SCORE))[:, frame.ANGLES].T, strict=True))
    limits = drummer.figure.limits
    for side in ("right", "left"):
        assert angles[f"{side}_elbow"].max() <= limits.elbow_flexion + 1e-9
        assert angles[f"{side}_elbow"].min() >= -1e-6
        assert angles[f"{side}_wrist"].max() <= limits.wrist_extension
        assert angles[f"{side}_wrist"].min() >= -limits.wrist_flexion
        assert angles[f"{side}_wrist_side"].max() <= limits.wrist_radial
        assert angles[f"{side}_wrist_side"].min() >= -limits.wrist_ulnar
        assert angles[f"{side}_shoulder"].max() <= limits.shoulder_flexion
        assert angles[f"{side}_shoulder"].min() >= -limits.shoulder_extension
        assert angles[f"{side}_knee"].max() <= limits.knee_flexion
        assert angles[f"{side}_hip"].max() <= limits.hip_flexion
    assert np.abs(angles["head_turn"]).max() <= limits.neck_rotation


def test_one_pose_and_many_agree() -> None:
    drummer = Drummer(SCORE, style=Style(flourish=100, heel="up"))
    at = np.linspace(-2.0, 9.0, 56)
    rows = drummer.rows(at)
    for t, row in zip(at.tolist(), rows, strict=True):
        assert drummer.pose(t).row[: frame.PLAYED] == pytest.approx(row, abs=1e-9)


def test_the_same_score_gives_the_same_motion() -> None:
    first, second = (Drummer(SCORE, style=Style(flourish=60, look_around=80)) for _ in range(2))
    at = grid(SCORE, 30)
    assert (first.rows(at) == second.rows(at)).all()


def test_without_variation_another_seed_moves_no_stick() -> None:
    score = score_of([(0, Piece.SNARE), (64, Piece.SNARE), (128, Piece.SNARE)])
    one, two = (Drummer(score, style=Style(seed=seed, look_around=100, variation=0)) for seed in (1, 2))
    at = grid(score, 30)
    assert (one.rows(at)[:, frame.TIP] == two.rows(at)[:, frame.TIP]).all()
    assert not (one.rows(at) == two.rows(at)).all()


def test_out_of_reach_names_the_piece_the_note_and_the_lack(tmp_path: Path) -> None:
    text = Path("station/motion/data/kits/four_piece.toml").read_text()
    far = tmp_path / "far.toml"
    far.write_text(text.replace("centre_m = [0.63, 0.70, 0.94]", "centre_m = [1.40, 1.30, 1.40]"))
    score = score_of([(0, Piece.SNARE), (20, Piece.RIDE)])
    with pytest.raises(BadInput) as caught:
        Drummer(score, load_kit(far))
    assert caught.value.source == "far"
    assert caught.value.place == "note 2, bar 2, beat 2"
    assert "the right hand cannot reach ride" in caught.value.fault
    assert "cm are missing" in caught.value.fault


def test_a_rim_shot_lays_the_shaft_on_the_rim() -> None:
    note = Note(0, Piece.SNARE, Zone.RIM, 110, Articulation.RIM_SHOT, limb=Limb.RIGHT_HAND)
    drummer = Drummer(Score.from_notes([note], TempoMap.constant(100)))
    pose, snare = drummer.pose(0.0), drummer.kit.pieces[Piece.SNARE]
    stick = pose.butt_m[0] + np.linspace(0, 1, 2000)[:, None] * (pose.tip_m[0] - pose.butt_m[0])
    away = stick - snare.centre
    over = away @ snare.normal
    radial = np.linalg.norm(away - over[:, None] * snare.normal, axis=1)
    at_rim = over[np.abs(radial - snare.radius_m) < 0.002]
    assert at_rim.min() == pytest.approx(0.012, abs=0.001)
    assert over[-1] == pytest.approx(0.0, abs=1e-9)


def test_an_edge_is_struck_with_the_sticks_shoulder() -> None:
    note = Note(0, Piece.CRASH_1, Zone.EDGE, 120, limb=Limb.LEFT_HAND)
    drummer = Drummer(Score.from_notes([note], TempoMap.constant(100)))
    pose, crash = drummer.pose(0.0), drummer.kit.pieces[Piece.CRASH_1]
    point = crash.target(Zone.EDGE, Limb.LEFT_HAND).point_m
    along = (point - pose.butt_m[1]) / np.linalg.norm(pose.tip_m[1] - pose.butt_m[1])
    direction = (pose.tip_m[1] - pose.butt_m[1]) / np.linalg.norm(pose.tip_m[1] - pose.butt_m[1])
    share = float(along @ direction)
    assert np.linalg.norm(np.cross(point - pose.butt_m[1], direction)) < 1e-9
    assert 0.6 < share < 0.85


def test_a_crash_is_never_parked_on() -> None:
    notes = [
        Note(0, Piece.CRASH_1, Zone.EDGE, 120, limb=Limb.LEFT_HAND),
        Note(8 * PPQ, Piece.SNARE, limb=Limb.LEFT_HAND),
    ]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(100)))
    edge = drummer.kit.pieces[Piece.CRASH_1].target(Zone.EDGE, Limb.LEFT_HAND).point_m
    assert np.linalg.norm(drummer.pose(1.2).tip_m[1] - edge) > 0.3


def test_an_empty_score_is_a_drummer_who_waits() -> None:
    drummer = Drummer(Score.from_notes([], TempoMap.constant(100)))
    assert np.isfinite(drummer.pose(0.0).row).all()


def test_every_piece_of_the_general_set_can_be_played() -> None:
    pieces = [p for p in Piece if p not in (Piece.KICK, Piece.HIHAT_PEDAL)]
    score = Score.from_notes([Note(i * PPQ, p, zone_of(p)) for i, p in enumerate(pieces)], TempoMap.constant(80))
    for kit in kit_names():
        tips, points = tips_at_strikes(Drummer(score, load_kit(kit), style=EXACT))
        assert np.linalg.norm(tips - points, axis=1).max() < 1e-9


def test_travelling_tips_pass_ten_centimetres_over_the_rims() -> None:
    """From the snare to the floor tom with a second to do it."""
    notes = [Note(0, Piece.SNARE, limb=Limb.RIGHT_HAND), Note(2 * PPQ, Piece.FLOOR_TOM_1, limb=Limb.RIGHT_HAND)]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(100)))
    at = np.arange(0.05, 1.15, 0.005)
    tips = drummer.rows(at)[:, frame.TIP].reshape(-1, 2, 3)[:, 0]
    tom = drummer.kit.pieces[Piece.FLOOR_TOM_1]
    rim = tips[np.abs(np.hypot(tips[:, 0] - tom.centre[0], tips[:, 1] - tom.centre[1]) - tom.radius_m) < 0.02]
    assert len(rim)
    assert (rim[:, 2] - tom.centre[2]).min() >= 0.10


def test_shoulders_breathe_and_eyes_blink_without_a_note() -> None:
    drummer = Drummer(Score.from_notes([], TempoMap.constant(100), end_tick=64 * PPQ))
    rows = drummer.rows(np.arange(0, 30, 0.02))
    assert np.ptp(rows[:, 3 * 5 + 2]) > 0.004  # the right shoulder's height
    assert rows[:, frame.EYES].min() < 0.2
    assert rows[:, frame.EYES].mean() > 0.9


FROM_FAR = (
    (60, [(0, Piece.CRASH_1), (3, Piece.HIHAT), (6, Piece.SNARE), (10, Piece.CRASH_1), (11, Piece.CRASH_1)]),
    (60, [(0, Piece.TOM_1), (3, Piece.FLOOR_TOM_1), (4, Piece.TOM_1), (7, Piece.CRASH_1), (8, Piece.FLOOR_TOM_1)]),
)
"""Home from a far piece past a waiting hand, and across the body, tempo and beats."""


@pytest.mark.parametrize(("bpm", "strokes"), FROM_FAR)
def test_a_hand_passes_in_front_of_its_shoulder(bpm: int, strokes: list[tuple[int, Piece]]) -> None:
    """An arm that folds at its shoulder would throw the elbow out."""
    notes = [Note(beat * PPQ, p, zone_of(p), 112) for beat, p in strokes]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(bpm)))
    joints = drummer.rows(np.arange(-1.0, 12.0, 1 / 480))[:, frame.JOINTS].reshape(-1, 21, 3)
    elbows = joints[:, [Joint.RIGHT_ELBOW, Joint.LEFT_ELBOW]]
    assert np.linalg.norm(np.diff(elbows, axis=0), axis=2).max() * 480 < 5.0
    for shoulder, wrist in ((Joint.RIGHT_SHOULDER, Joint.RIGHT_WRIST), (Joint.LEFT_SHOULDER, Joint.LEFT_WRIST)):
        assert np.linalg.norm(joints[:, shoulder] - joints[:, wrist], axis=1).min() > 0.17  # at the limit it is 0.166
