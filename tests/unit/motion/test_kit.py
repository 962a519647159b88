import math
import re
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone
from station.core.units import PPQ
from station.motion.drummer import Drummer
from station.motion.kit.kit import kit_names, load_kit
from station.music.score import Note, Score
from station.music.tempo import TempoMap

SHIPPED = Path("station/motion/data/kits/four_piece.toml")


def rotated(epsilon: float, phi: float) -> list[float]:
    """R_y(φ) R_x(ε) ẑ by matrices (DESIGN § 5)."""
    rx = np.array([[1, 0, 0], [0, math.cos(epsilon), -math.sin(epsilon)], [0, math.sin(epsilon), math.cos(epsilon)]])
    ry = np.array([[math.cos(phi), 0, math.sin(phi)], [0, 1, 0], [-math.sin(phi), 0, math.cos(phi)]])
    return list((ry @ rx @ np.array([0.0, 0.0, 1.0])).tolist())


def edited(tmp_path: Path, old: str, new: str) -> Path:
    text = SHIPPED.read_text()
    assert old in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new))
    return path


@pytest.mark.parametrize("name", kit_names())
def test_every_shipped_kit_loads_and_has_kick_snare_hats_and_pedals(name: str) -> None:
    kit = load_kit(name)
    assert {Piece.KICK, Piece.SNARE, Piece.HIHAT} <= set(kit.pieces)
    assert set(kit.pedals) == {Piece.KICK, Piece.HIHAT_PEDAL}


@pytest.mark.parametrize("name", kit_names())
def test_normals_are_the_rotated_up_vector_and_face_the_player(name: str) -> None:
    for piece in load_kit(name).pieces.values():
        if piece.kind == "kick":
            continue
        assert piece.normal.tolist() == pytest.approx(rotated(piece.tilt_x_rad, piece.tilt_y_rad))
        towards_player = -piece.centre[:2]
        assert piece.normal[:2] @ towards_player >= -1e-9, piece.piece


@pytest.mark.parametrize("name", kit_names())
def test_every_zone_has_its_own_point_on_its_surface(name: str) -> None:
    for piece in load_kit(name).pieces.values():
        for zone in piece.spots:
            for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
                target = piece.target(zone, limb)
                away = target.point_m - target.centre_m
                assert away @ target.normal == pytest.approx(0.0, abs=1e-12)
                assert np.linalg.norm(away) <= target.radius_m + 1e-12


def test_a_bell_and_a_rim_are_no_discs_over_the_whole_piece() -> None:
    """A tip on the ride's bow is 2 cm lower than its bell, one on the head lower than the rim: in neither of them."""
    kit = load_kit()
    for piece, low, high in ((Piece.RIDE, Zone.BOW, Zone.BELL), (Piece.SNARE, Zone.HEAD, Zone.RIM)):
        for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND):
            under, over = kit.target(piece, low, limb), kit.target(piece, high, limb)
            assert np.linalg.norm(under.point_m - over.centre_m) > over.radius_m + 0.02
            assert np.linalg.norm(over.point_m - over.centre_m) <= over.radius_m


def test_two_snare_spots_are_five_centimetres_apart() -> None:
    snare = load_kit().pieces[Piece.SNARE]
    right, left = (snare.target(Zone.HEAD, limb).point_m for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    assert np.linalg.norm(right - left) == pytest.approx(0.05)


def test_the_ride_is_struck_at_six_tenths_of_its_radius_on_the_near_side() -> None:
    ride = load_kit().pieces[Piece.RIDE]
    point = ride.target(Zone.BOW, Limb.RIGHT_HAND).point_m
    assert np.linalg.norm(point - ride.centre) == pytest.approx(0.6 * ride.radius_m, rel=0.02)
    assert point[1] < ride.centre[1]


@pytest.mark.parametrize(
    ("piece", "played"),
    [
        (Piece.CRASH_2, Piece.CRASH_1),
        (Piece.TOM_3, Piece.TOM_1),
        (Piece.FLOOR_TOM_2, Piece.FLOOR_TOM_1),
        (Piece.HIHAT_PEDAL, Piece.HIHAT),
        (Piece.PERCUSSION, Piece.RIDE),
        (Piece.SNARE, Piece.SNARE),
    ],
)
def test_a_missing_piece_has_a_stand_in(piece: Piece, played: Piece) -> None:
    assert load_kit("four_piece").stand_in(piece) is played


def test_in_a_kit_of_kick_and_snare_a_hand_has_the_snare_for_everything(tmp_path: Path) -> None:
    text = SHIPPED.read_text()
    path = tmp_path / "two.toml"
    path.write_text(text[: text.index("[hihat]\n")])
    kit = load_kit(path)
    for piece in Piece:
        assert kit.stand_in(piece) is (Piece.KICK if piece is Piece.KICK else Piece.SNARE)
    notes = [Note(i * PPQ, piece) for i, piece in enumerate((Piece.SNARE, Piece.HIHAT, Piece.CRASH_1, Piece.KICK))]
    drummer = Drummer(Score.from_notes(notes, TempoMap.constant(100)), kit)  # refused what no hand reaches
    assert np.linalg.norm(drummer.plan.strike_m[1:3] - kit.pieces[Piece.SNARE].centre, axis=1) == pytest.approx(
        0.025, abs=1e-3
    )


@pytest.mark.parametrize(
    ("old", "new", "there", "fault"),
    [
        ("radius_m = 0.178\ndepth_m", "radius_m = -1\ndepth_m", "-1\n", "snare.radius_m: expected a number from 0.02"),
        ("[snare]", "[snair]", "[snair]", "no such piece or key: snair; did you mean snare?"),
        ('kind = "hihat"', 'kind = "hat"', '"hat"', "hihat.kind: expected drum, cymbal, hihat, kick or block"),
        ("[-0.07, 0.45, 0.66]", "[-0.07, 0.45]", "[-0.07, 0.45]", "snare.centre_m: expected [right, forward, up]"),
        ("depth_m = 0.14", "deep_m = 0.14", "deep_m = 0.14", "no such key: deep_m; did you mean depth_m?"),
        ("[pedals.kick]", "[pedals.drum]", "[pedals.drum]", "no such key: drum; there are kick, hihat, slave"),
        ("[0.20, 0.71, 0.03]", "[0.20, 0.44, 0.03]", "[0.20, 0.44", "pedals.kick.toe_m: the toe end is 0.00 m from"),
        ("[-0.42, 0.62, 0.86]", "[-0.07, 0.46, 0.67]", "[-0.07, 0.46, 0.67]", "hihat.centre_m: overlaps the snare"),
        ("[-0.02, 0.80, 0.80]", "[0.45, 0.38, 0.58]", "[0.55, 0.38, 0.62]", "floor_tom_1.centre_m: overlaps the tom_1"),
        ("[ride]", "[ride.zones.top]\nright = 0\n\n[ride]", "[ride.zones.top]", "no such zone: top"),
    ],
)
def test_a_faulty_kit_names_the_place(tmp_path: Path, old: str, new: str, there: str, fault: str) -> None:
    path = edited(tmp_path, old, new)
    with pytest.raises(BadInput) as caught:
        load_kit(path)
    line, column = map(int, re.findall(r"\d+", caught.value.place))
    assert "\n".join(path.read_text().split("\n")[line - 1 :])[column - 1 :].startswith(there)
    assert fault in caught.value.fault


@pytest.mark.parametrize("piece", ["kick", "snare"])
def test_a_kit_without_kick_or_snare_is_none(tmp_path: Path, piece: str) -> None:
    with pytest.raises(BadInput, match=rf"line 1, column 1: {piece} is missing; expected a table \[{piece}\]"):
        load_kit(edited(tmp_path, f"[{piece}]", "[crash_2]"))


def test_an_unknown_kit_names_those_there_are() -> None:
    with pytest.raises(BadInput, match="four_piece"):
        load_kit("four_pieces")


@pytest.mark.parametrize(
    ("name", "of"),
    [
        ("left_handed", "four_piece"),
        ("left_handed_seven_piece", "seven_piece"),
        ("left_handed_electronic", "electronic"),
    ],
)
def test_a_left_handed_kit_is_the_other_in_a_mirror(name: str, of: str) -> None:
    left, right = load_kit(name), load_kit(of)
    assert (left.name, left.left_handed, left.make) == (name, True, right.make)
    assert "left-handed" in left.title.lower()
    for piece, there in right.pieces.items():
        for zone in there.spots:
            for limb, other in ((Limb.RIGHT_HAND, Limb.LEFT_HAND), (Limb.LEFT_HAND, Limb.RIGHT_HAND)):
                x, y, z = there.target(zone, limb).point_m
                assert left.target(piece, zone, other).point_m == pytest.approx([-x, y, z], abs=1e-12)
    assert left.mirrored.pieces == right.pieces
    assert left.mirrored.pedals == right.pedals
    assert left.mirrored.slave == right.slave


def test_a_file_that_mirrors_a_kit_says_nothing_else(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text('mirrors = "jazz"\n')
    assert load_kit(path).name == "mine"
    for text, fault in (
        ('mirrors = "jaz"', "did you mean jazz"),
        ('mirrors = "jazz"\nseat_m = [0, 0, 0.4]', "no such key: seat_m"),
    ):
        path.write_text(text)
        with pytest.raises(BadInput, match=fault):
            load_kit(path)
