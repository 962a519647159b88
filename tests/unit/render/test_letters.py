"""Fonts and the letter texture: facts of the typeface, and distances that geometry gives."""

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.render.text.atlas import ATLAS_SIZE, Atlas, distance_field
from station.render.text.fonts import Face, font, font_path
from station.render.text.sign_outlines import SIGNS, sign, sign_box
from station.render.text.truetype import TrueType


def area(polygon: NDArray[np.float64]) -> float:
    """Shoelace formula, counter-clockwise positive."""
    x, y = polygon.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


def test_digits_are_as_wide_as_one_another() -> None:
    assert len({font(Face.REGULAR).outline(digit).advance for digit in "0123456789"}) == 1


def test_o_is_a_ring_and_l_is_not() -> None:
    ring = font(Face.BOLD).outline("O").contours
    assert len(ring) == 2
    assert np.sign(area(ring[0])) == -np.sign(area(ring[1])), "the hole runs the other way"
    assert len(font(Face.BOLD).outline("L").contours) == 1


def test_an_accented_letter_is_its_letter_and_more() -> None:
    plain, accented = (font(Face.REGULAR).outline(c) for c in "eé")
    assert accented.advance == plain.advance
    assert len(accented.contours) == len(plain.contours) + 1
    assert max(c[:, 1].max() for c in accented.contours) > max(c[:, 1].max() for c in plain.contours)


def test_capitals_stand_on_the_baseline_at_roboto_s_cap_height() -> None:
    points = np.concatenate(font(Face.REGULAR).outline("H").contours)
    assert points[:, 1].min() == 0
    assert points[:, 1].max() == pytest.approx(1456 / 2048)  # Roboto's OS/2 table: sCapHeight 1456 of 2048


def test_a_blank_has_width_and_no_outline() -> None:
    blank = font(Face.REGULAR).outline(" ")
    assert blank.contours == ()
    assert blank.advance > 0


@pytest.mark.parametrize("data", [b"", b"OTTO" + bytes(40), bytes(12)])
def test_what_is_no_font_is_bad_input(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "x.ttf").write_bytes(data)
    with pytest.raises(BadInput, match="not a readable TrueType font"):
        TrueType(tmp_path / "x.ttf")


def test_a_font_cut_short_is_bad_input(tmp_path: Path) -> None:
    (tmp_path / "x.ttf").write_bytes(font_path(Face.REGULAR).read_bytes()[:200])
    with pytest.raises(BadInput, match="not a readable TrueType font"):
        TrueType(tmp_path / "x.ttf")


def test_distances_to_a_square() -> None:
    square = np.array([[4.0, 4.0], [12.0, 4.0], [12.0, 12.0], [4.0, 12.0]])
    field = distance_field([square], 16, 16)
    assert field[8, 8] == pytest.approx(3.5)  # texel centres lie at one half
    assert field[8, 0] == pytest.approx(-3.5)
    assert field[0, 0] == pytest.approx(-np.hypot(3.5, 3.5))
    assert (field > 0).sum() == 64


@pytest.mark.parametrize("reverse", [False, True])
def test_a_hole_is_outside(reverse: bool) -> None:
    outer = np.array([[1.0, 1.0], [15.0, 1.0], [15.0, 15.0], [1.0, 15.0]])
    hole = np.array([[5.0, 5.0], [5.0, 11.0], [11.0, 11.0], [11.0, 5.0]])
    contours = [outer[::-1], hole[::-1]] if reverse else [outer, hole]
    field = distance_field(contours, 16, 16)
    assert field[8, 8] < 0 < field[8, 3]


def test_distances_to_a_circle() -> None:
    angle = np.linspace(0, 2 * np.pi, 721)[:-1]
    circle = 10 + 6 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    field = distance_field([circle], 20, 20)
    y, x = np.mgrid[0:20, 0:20] + 0.5
    assert np.allclose(field, 6 - np.hypot(x - 10, y - 10), atol=2e-3)


@pytest.mark.parametrize("name", sorted(SIGNS))
def test_every_sign_is_a_sign_s_size_and_inked(name: str) -> None:
    points = np.concatenate(sign(name))
    assert np.ptp(points[:, 1]) < 6, "the rest of a 128th is the tallest"
    assert np.ptp(points[:, 0]) < 5, "fff is the widest"
    assert sum(area(contour) for contour in sign(name)) < 0, "TrueType's outlines run clockwise round their ink"


@pytest.mark.parametrize(
    ("name", "width", "height"),
    # glyphBBoxes in the metadata of Bravura 1.392
    [
        ("head_round", 1.18, 1.0),
        ("head_cross", 1.16, 1.0),
        ("head_slashed", 1.82, 1.328),
        ("clef", 1.528, 2.0),
        ("accent", 1.356, 0.976),
        ("rest_4", 1.076, 2.992),
        ("hat_open", 1.144, 1.144),
        ("loud_f", 2.02, 2.384),
    ],
)
def test_signs_are_as_large_as_the_font_s_metadata_say(name: str, width: float, height: float) -> None:
    assert sign_box(name).width == pytest.approx(width, abs=0.01)
    assert sign_box(name).height == pytest.approx(height, abs=0.01)


def test_heads_have_their_origin_in_their_middle() -> None:
    for name in ("head_round", "head_cross", "bracket_left", "accent"):
        box = sign_box(name)
        assert box.left == pytest.approx(-box.right)
        assert box.bottom == pytest.approx(-box.top)


def test_the_texture_keeps_room_for_the_tallest_sign() -> None:
    atlas, tallest = Atlas(), 0.0
    for name in SIGNS:
        tallest = max(tallest, 2 * atlas.sign(name).half[1])
    top = max(sign_box(name).height for name in SIGNS)
    assert tallest == pytest.approx(top, abs=2 * 6 / 22), "5 texels of distance on each side, at 22 a space"


def test_letters_do_not_lie_on_one_another() -> None:
    atlas = Atlas()
    boxes = [atlas.letter(c, face).uv for face in Face for c in "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghij0123456789"]
    taken = np.zeros((ATLAS_SIZE, ATLAS_SIZE), np.int64)
    for left, top, right, bottom in boxes:
        x0, y0, x1, y1 = (round(v * ATLAS_SIZE) for v in (left, top, right, bottom))
        taken[y0:y1, x0:x1] += 1
    assert taken.max() == 1


def test_a_letter_that_the_font_lacks_is_a_question_mark() -> None:
    atlas = Atlas()
    assert atlas.letter("鼓", Face.REGULAR) == atlas.letter("?", Face.REGULAR)


def test_a_full_texture_still_answers() -> None:
    atlas = Atlas()
    for code in range(0x21, 0x600):
        atlas.letter(chr(code), Face.BOLD)
        atlas.letter(chr(code), Face.REGULAR)
    assert atlas.sign("rest_4").half[0] > 0, "there is room for the musical signs even then"
