"""Flat shapes and text as tables."""

import pytest

from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

WHITE = (1.0, 1.0, 1.0, 1.0)
ATLAS = Atlas()


def test_a_box_from_its_corner() -> None:
    draw_list = DrawList(ATLAS)
    draw_list.time_s, draw_list.span_s = 1.5, 0.25
    draw_list.box((10, 20), (30, 40), (1.0, 0.5, 0.0, 1.0), (0.0, 0.0, 0.0, 0.5))
    row = draw_list.shapes()[0]
    assert row["centre"].tolist() == [25, 40]
    assert row["half"].tolist() == [15, 20]
    assert row["time_s"].tolist() == [1.5, 0.25]
    assert row["colour"].tolist() == [255, 128, 0, 255]
    assert row["colour_2"].tolist() == [0, 0, 0, 128]


def test_a_line_lies_between_its_ends() -> None:
    draw_list = DrawList(ATLAS)
    draw_list.line((0, 0), (3, 4), 0.5, WHITE)
    row = draw_list.shapes()[0]
    assert row["centre"].tolist() == [1.5, 2.0]
    assert row["half"].tolist() == [2.5, 0.25]
    assert row["axis"].tolist() == pytest.approx([0.6, 0.8])


@pytest.mark.parametrize(("align", "left"), [(0.0, 100.0), (0.5, 90.0), (1.0, 80.0)])
def test_text_is_aligned(align: float, left: float) -> None:
    draw_list = DrawList(ATLAS)
    size = 20 / ATLAS.text_width("HHH", Face.BOLD)
    assert draw_list.text("HHH", (100, 50), TypeStyle(size, WHITE, Face.BOLD, align)) == pytest.approx(20)
    edges = draw_list.shapes()["centre"][:, 0] - draw_list.shapes()["half"][:, 0]
    assert edges.min() == pytest.approx(left, abs=0.35 * size), "but for the letter's own margin"


def test_text_is_fitted() -> None:
    draw_list, style = DrawList(ATLAS), TypeStyle(10, WHITE)
    assert draw_list.fitted("short", style, 500) == "short"
    cut = draw_list.fitted("a title that is far too long", style, 60)
    assert cut.endswith("…")
    assert draw_list.width(cut, style) <= 60
    assert draw_list.fitted("abc", style, 1) == ""


def test_text_is_broken_at_blanks() -> None:
    draw_list, style = DrawList(ATLAS), TypeStyle(10, WHITE)
    lines = draw_list.broken("one two three four five six seven", style, 60)
    assert " ".join(lines) == "one two three four five six seven"
    assert len(lines) > 1
    assert all(draw_list.width(line, style) <= 60 for line in lines)


def test_a_halo_lies_under_its_letters() -> None:
    draw_list = DrawList(ATLAS)
    draw_list.text("ab", (0, 0), TypeStyle(10, WHITE, halo=(0.0, 0.0, 0.0, 1.0)))
    assert draw_list.shapes()["colour"][:, 0].tolist() == [0, 0, 255, 255]
