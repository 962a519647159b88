"""The words over the scene: what is counted are letters, so that none is lost where there is little room."""

import pytest

from station.drills.library import find_lesson, lesson_names
from station.render.hud import hud_calls, hud_lines
from station.render.snapshot import Hud, TimingCue
from station.render.text.atlas import Atlas

SMALL = (640.0, 252.0)  # the scene of a picture of 640x360, over the score
SCENE = (1280.0, 504.0)  # that of a picture of 1280x720
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


def test_a_teacher_s_words_stand_large_at_the_lower_edge(atlas: Atlas) -> None:
    shapes = hud_calls(Hud(say="Ghosts low"), atlas, SCENE)
    assert len(shapes) == 1 + len("Ghostslow"), "a panel and its letters"
    assert shapes["centre"][:, 1].min() > 0.8 * SCENE[1]


def test_words_too_long_for_two_lines_end_in_dots(atlas: Atlas) -> None:
    shapes = hud_calls(Hud(say="very long words " * 30), atlas, SCENE)
    assert shapes["centre"][:, 1].min() > 0.7 * SCENE[1]
    assert 60 < len(shapes) < 200


def test_the_cue_stands_above_the_words(atlas: Atlas) -> None:
    alone, both = (hud_calls(Hud(say=say, cue=TimingCue.LATE), atlas, SCENE) for say in ("", "Ghosts low"))
    lowest_cue = both["centre"][10:, 1].max()
    assert lowest_cue < both["centre"][:10, 1].min()
    assert len(both) == len(alone) + 10
