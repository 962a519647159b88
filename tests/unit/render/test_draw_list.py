"""Flat shapes and text as tables."""

import numpy as np
import pytest

from station.render.hud import hud_shapes
from station.render.snapshot import Hud, TimingCue
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, ShapeKind, TypeStyle
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


def texts(hud: Hud) -> int:
    return int((hud_shapes(hud, ATLAS, (1280, 504))["kind"] == ShapeKind.GLYPH).sum())


def test_the_hud_shows_what_there_is_and_no_more() -> None:
    assert texts(Hud()) == 0
    assert texts(Hud(title="Rock")) == 2 * len("Rock"), "letters and their halo"
    assert texts(Hud(count_in=3)) == 1
    beats = hud_shapes(Hud(bar=2, beat=3, beats=4), ATLAS, (1280, 504))
    dots = beats[beats["kind"] == ShapeKind.ELLIPSE]
    assert len(dots) == 4
    assert np.sort(dots["half"][:, 0])[-1] > np.sort(dots["half"][:, 0])[-2], "the present beat is larger"
    assert dots["centre"][np.argmax(dots["half"][:, 0]), 0] == pytest.approx(np.sort(dots["centre"][:, 0])[2])


def test_a_cue_fades() -> None:
    def opacity(age_s: float) -> int:
        shapes = hud_shapes(Hud(cue=TimingCue.LATE, cue_age_s=age_s), ATLAS, (1280, 504))
        return int(shapes["colour"][:, 3].max()) if len(shapes) else 0

    assert opacity(0.0) == 255
    assert 0 < opacity(0.8) < 255
    assert opacity(1.2) == 0


def test_a_count_in_stands_before_a_cue() -> None:
    with_both = hud_shapes(Hud(count_in=2, cue=TimingCue.EARLY), ATLAS, (1280, 504))
    assert (with_both["kind"] == ShapeKind.TRIANGLE).sum() == 0


def test_a_scene_too_small_for_words_has_none() -> None:
    full = Hud("Rock", "Pass 1", bar=1, beat=1, count_in=3, message="Play")
    assert len(hud_shapes(full, ATLAS, (240.0, 112.0))) > 0
    assert len(hud_shapes(full, ATLAS, (64.0, 34.0))) == 0
