"""Drawn shapes as SVG: what a parser of XML finds in it."""

from xml.etree import ElementTree

import numpy as np
import pytest

from station.render.files.svg_file import SvgPaths, figures, picture, style_of
from station.render.palette import GOOD, INK, INK_SOFT, Theme, paper_bytes
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.paper import OutlineAtlas


def elements(markup: str) -> list[ElementTree.Element]:
    return list(ElementTree.fromstring(f"<svg>{markup}</svg>").iter())


def test_a_box_is_a_rectangle_in_a_named_colour() -> None:
    draw_list = DrawList(OutlineAtlas())
    draw_list.box((1.0, 2.0), (30.0, 4.0), GOOD)
    _, group, box = elements(SvgPaths(draw_list.atlas).areas(draw_list.shapes()))  # type: ignore[arg-type]
    assert group.get("fill") == "var(--good)"
    assert [float(box.get(name, "")) for name in ("x", "y", "width", "height")] == pytest.approx([1, 2, 30, 4])


def test_an_opacity_is_kept() -> None:
    draw_list = DrawList(OutlineAtlas())
    draw_list.ellipse((5.0, 6.0), (2.0, 3.0), INK_SOFT)
    _, group, ellipse = elements(SvgPaths(draw_list.atlas).areas(draw_list.shapes()))  # type: ignore[arg-type]
    assert group.get("fill") == "var(--ink)"
    assert float(group.get("fill-opacity", "")) == pytest.approx(0.66, abs=0.01)
    assert [float(ellipse.get(name, "")) for name in ("cx", "cy", "rx", "ry")] == pytest.approx([5, 6, 2, 3])


def test_a_letter_stands_once_and_is_used_where_it_comes() -> None:
    atlas = OutlineAtlas()
    draw_list, paths = DrawList(atlas), SvgPaths(atlas)
    draw_list.text("abba", (0.0, 0.0), TypeStyle(10.0, INK))
    uses = [each.get("href", "") for each in elements(paths.areas(draw_list.shapes())) if each.tag == "use"]
    known = {each.get("id") for each in elements(paths.definitions()) if each.tag == "path"}
    assert len(uses) == 4
    assert {use[1:] for use in uses} == known
    assert len(known) == 2


def test_letters_stand_where_text_puts_them() -> None:
    """A letter's outline, put where its matrix says, begins where the line of text begins and stands on its line."""
    atlas = OutlineAtlas()
    draw_list, paths = DrawList(atlas), SvgPaths(atlas)
    draw_list.text("H", (100.0, 50.0), TypeStyle(20.0, INK))
    use = next(each for each in elements(paths.areas(draw_list.shapes())) if each.tag == "use")
    path = next(each for each in elements(paths.definitions()) if each.tag == "path")
    points = np.array([pair.split() for pair in path.get("d", "").strip("MZ").replace("M", "L").split("L")], float)
    a, b, c, d, e, f = map(float, use.get("transform", "")[7:-1].split())
    x, y = a * points[:, 0] + c * points[:, 1] + e, b * points[:, 0] + d * points[:, 1] + f  # SVG 2, section 8.5
    assert y.max() == pytest.approx(50.0, abs=0.05), "an H stands on the line"
    assert 100.0 < x.min() < 103.0
    assert 12.0 < np.ptp(y) < 16.0, "and is about seven tenths of its em high"


def test_hostile_words_are_no_markup() -> None:
    words = "<script>alert(1)</script>\"'&]]>"
    svg = ElementTree.fromstring(
        picture(SvgPaths(OutlineAtlas()), DrawList(OutlineAtlas()).shapes(), (10.0, 10.0), words)
    )
    assert svg.get("aria-label") == words
    assert [each.tag for each in svg.iter()] == ["svg", "title"]


@pytest.mark.parametrize(("value", "text"), [(0.0, "0"), (-0.0, "-0"), (12.5, "12.5"), (3.0, "3"), (0.0123, "0.0123")])
def test_lengths_are_short(value: float, text: str) -> None:
    assert figures(value) == text


def test_day_and_night_give_every_colour_another_value() -> None:
    day, night = (
        dict(pair.split(":") for pair in style_of(theme).strip(";").split(";")) for theme in (Theme.DAY, Theme.NIGHT)
    )
    assert day.keys() == night.keys()
    assert day["--good"] == "#0067e5"
    assert night["--good"] == "#56b4e9"


def test_half_of_black_on_white_paper_is_grey() -> None:
    ink = np.array([[0xF2, 0xED, 0xE4, 255], [0xF2, 0xED, 0xE4, 0]], np.uint8)
    assert paper_bytes(ink).tolist() == [[0x1B, 0x1E, 0x26], [255, 255, 255]]
