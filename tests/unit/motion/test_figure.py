import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Articulation, Limb, Piece, Zone
from station.motion.drummer import Drummer
from station.motion.kinematics.arm import Offsets, solve
from station.motion.kinematics.figure import PARENT, Joint, figure_names, figure_of, load_figure
from station.motion.kinematics.frame import ANGLES
from station.motion.kinematics.maths import ONE
from station.motion.kinematics.pose import ANGLE_NAMES
from station.motion.kit.kit import load_kit
from station.motion.motion_plan import holds
from station.motion.strokes.contact_pose import lie_of
from station.motion.strokes.targets import Strike
from station.motion.style.style import Style
from tests.unit.motion.patterns import score_of


def test_segments_are_the_published_shares_of_the_stature() -> None:
    figure = figure_of(2.0)  # HUMANS, Body
    assert figure.upper_arm_m == pytest.approx(0.372)
    assert figure.forearm_m == pytest.approx(0.292)
    assert figure.thigh_m == pytest.approx(0.490)
    assert figure.shank_m == pytest.approx(0.492)
    assert figure.trunk_m == pytest.approx(0.576)
    assert figure_of(1.70).shoulder_breadth_m == pytest.approx(0.34)  # Rajagopal 2016, a man of 1.70 m


def test_limits_are_the_published_ones() -> None:
    limits = figure_of().limits
    assert math.degrees(limits.elbow_flexion) == pytest.approx(150)
    assert math.degrees(limits.wrist_extension) == pytest.approx(70)
    assert math.degrees(limits.wrist_radial) == pytest.approx(20)


def test_shipped_drummers_are_of_different_build_and_look() -> None:
    figures = [load_figure(name) for name in figure_names()]
    assert len(figures) >= 3
    assert figure_of() in figures, "who plays where nobody is asked for has a name"
    looks = {(f.look.hair, f.look.top, f.look.colours.skin, f.look.colours.top) for f in figures}
    assert len(looks) == len({f.stature_m for f in figures}) == len(figures)


@pytest.mark.parametrize("name", figure_names())
def test_breadths_are_of_people(name: str) -> None:
    """Pheasant (Bodyspace): from the 5th of a hundred women to the 95th of a hundred men.

    Stature 1505 to 1855 mm, from acromion to acromion 325 to 430 mm; the joints lie .2 of .23 as far apart.
    """
    figure = load_figure(name)
    assert 1.505 <= figure.stature_m <= 1.90
    assert 0.325 <= figure.shoulder_breadth_m * 0.23 / 0.20 <= 0.442


def test_a_look_says_what_differs_from_the_default(tmp_path: Path) -> None:
    path = tmp_path / "me.toml"
    path.write_text('stature_m = 1.7\n[look]\nhair = "curls"\nworn = ["glasses"]\n[look.colours]\nskin = "#804020"\n')
    look = load_figure(path).look
    assert (look.hair, look.worn, look.top) == ("curls", ("glasses",), "tee")
    assert look.colours.skin == pytest.approx((128 / 255, 64 / 255, 32 / 255))


def test_a_file_sets_segments_and_limits(tmp_path: Path) -> None:
    path = tmp_path / "me.toml"
    path.write_text("stature_m = 1.8\n[segments]\nforearm_m = 0.3\n[limits]\nwrist_extension = 50\n")
    figure = load_figure(path)
    assert figure.forearm_m == 0.3
    assert figure.upper_arm_m == pytest.approx(0.186 * 1.8)
    assert math.degrees(figure.limits.wrist_extension) == pytest.approx(50)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("stature_m = 5", "stature_m"),
        ("title = 'x'", "stature_m"),
        ("stature_m = 1.8\n[limits]\nwrist = 3", "no such limit: wrist"),
        ("stature_m = 1.8\n[segments]\nforearm_m = 'long'", "segments.forearm_m"),
        ("stature_m = 1.8\n[look]\nhair = 'curl'", "look.hair"),
        ("stature_m = 1.8\n[look]\nworn = ['hat']", "look.worn"),
        ("stature_m = 1.8\n[look.colours]\nskin = 'brown'", 'a colour such as "#d94f2b"'),
        ("stature_m = 1.8\n[look.girths]\nwaist = 7", "look.girths.waist"),
    ],
)
def test_a_faulty_figure_names_the_place(tmp_path: Path, text: str, place: str) -> None:
    path = tmp_path / "me.toml"
    path.write_text(text)
    with pytest.raises(BadInput) as caught:
        load_figure(path)
    assert place in f"{caught.value.place} {caught.value.fault}"


def test_every_joint_hangs_from_the_pelvis_in_the_end() -> None:
    for joint in Joint:
        seen = joint
        while (above := PARENT[seen]) is not None:
            seen = above
        assert seen is Joint.PELVIS


def test_limits_of_a_file_hold_in_the_motion(tmp_path: Path) -> None:
    """Large strokes on snare and crash: free elbows and necks pass what a stiff figure's file allows."""
    path = tmp_path / "stiff.toml"
    path.write_text("stature_m = 1.759\n[limits]\nelbow_flexion = 105\nneck_rotation = 15\n")
    score = score_of(
        [*((4 * i, Piece.SNARE) for i in range(8)), (32, Piece.CRASH_1), (40, Piece.FLOOR_TOM_1)], velocity=125
    )
    at = np.arange(-1.0, 8.0, 0.01)
    style = Style(amplitude_gain=100, amplitude_gaze=100, amplitude_twist=0)
    free, stiff = (
        np.degrees(Drummer(score, figure=f, style=style).rows(at)[:, ANGLES]) for f in (figure_of(), load_figure(path))
    )
    for name, most in (("right_elbow", 105.0), ("left_elbow", 105.0), ("head_turn", 15.0)):
        column = ANGLE_NAMES.index(name)
        assert np.abs(stiff[:, column]).max() <= most + 1e-6, name
    assert np.abs(free[:, ANGLE_NAMES.index("head_turn")]).max() > 15
    assert free[:, [ANGLE_NAMES.index("right_elbow"), ANGLE_NAMES.index("left_elbow")]].max() > 105


@pytest.mark.parametrize("piece", [Piece.HIHAT, Piece.TOM_1, Piece.RIDE])
@pytest.mark.parametrize("limb", [Limb.RIGHT_HAND, Limb.LEFT_HAND])
def test_a_stiff_wrist_is_held_so_that_it_is_not_bent_beyond_its_limit(piece: Piece, limb: Limb) -> None:
    """A free wrist is bent down by more than 17 degrees there; another elbow and hand serve a stiff one."""
    free = figure_of()
    stiff = replace(free, limits=replace(free.limits, wrist_flexion=math.radians(14)))
    zone = Zone.HEAD if piece is Piece.TOM_1 else Zone.BOW
    matched, _ = holds(Style())
    bent = []
    for figure in (free, stiff):
        lie = lie_of(load_kit(), figure, matched, Strike(piece, zone, Articulation.NORMAL, limb))
        lengths = matched.lengths(figure, limb is Limb.RIGHT_HAND)
        bent.append(-math.degrees(solve(ONE, lengths, lie.root, lie.contact, Offsets(0.0, 0.0, 0.0, 0.0)).extension))
    assert bent[0] > 17
    assert bent[1] <= 14
