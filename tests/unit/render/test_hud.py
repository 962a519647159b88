"""The words over the scene: what is counted are letters, so that none is lost where there is little room."""

import pytest

from station.drills.library import find_lesson, lesson_names
from station.render.hud import hud_lines
from station.render.snapshot import Hud
from station.render.text.atlas import Atlas

SMALL = (640.0, 252.0)  # the scene of a picture of 640x360, over the score
TITLES = sorted((find_lesson(name).title for name in lesson_names()), key=len)


@pytest.fixture(scope="module")
def atlas() -> Atlas:
    return Atlas()


def letters(hud: Hud, atlas: Atlas, size: tuple[float, float]) -> int:
    return len(hud_lines(hud, atlas, size))


@pytest.mark.parametrize("title", TITLES[-5:])
def test_no_title_of_ours_is_cut_in_a_small_picture(title: str, atlas: Atlas) -> None:
    hud = Hud(title, "Pass 1 of 4", 2, 1, 4, 2, 120.0)
    assert letters(hud, atlas, SMALL) == letters(hud, atlas, (9999.0, SMALL[1]))


def test_what_is_far_too_long_ends_in_dots(atlas: Atlas) -> None:
    title = "endless " * 40
    short, wide = (letters(Hud(title, "Ready"), atlas, size) for size in (SMALL, (9999.0, SMALL[1])))
    assert 20 < short < wide
