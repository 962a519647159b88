"""The words over the scene: what is counted are letters, so that none is lost where there is little room."""

import numpy as np
import pytest

from station.drills.library import lesson_names
from station.render.hud import BAND, band_height, free_line, hud_calls, hud_lines, scale
from station.render.snapshot import Hud, TimingCue
from station.render.text.atlas import Atlas
from station.render.text.draw_list import ShapeKind
from tests.shipped_lesson import shipped_lesson

SMALL = (640.0, 252.0)  # the scene of a picture of 640x360, over the score
SCENE = (1280.0, 504.0)  # that of a picture of 1280x720
TITLES = sorted((shipped_lesson(name).title for name in lesson_names()), key=len)


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


def test_the_hud_shows_what_there_is_and_no_more(atlas: Atlas) -> None:
    assert letters(Hud(), atlas, SCENE) == len(hud_calls(Hud(), atlas, SCENE)) == 0
    assert letters(Hud(title="Rock"), atlas, SCENE) == len("Rock"), "letters, and no halo on paper"
    assert (hud_calls(Hud(count_in=3), atlas, SCENE)["kind"] == ShapeKind.GLYPH).sum() == 1


def test_the_present_beat_is_the_largest_dot(atlas: Atlas) -> None:
    beats = hud_lines(Hud(bar=2, beat=3, beats=4), atlas, SCENE)
    dots = beats[beats["kind"] == ShapeKind.ELLIPSE]
    sizes, places = dots["half"][:, 0], dots["centre"][:, 0]
    assert len(dots) == 4
    assert (sizes == sizes.max()).sum() == 1
    assert places[np.argmax(sizes)] == pytest.approx(np.sort(places)[2])


def test_a_cue_fades(atlas: Atlas) -> None:
    def opacity(age_s: float) -> int:
        shapes = hud_calls(Hud(cue=TimingCue.LATE, cue_age_s=age_s), atlas, SCENE)
        return int(shapes["colour"][:, 3].max()) if len(shapes) else 0

    assert opacity(0.0) == 255
    assert 0 < opacity(0.8) < 255
    assert opacity(1.2) == 0


def test_a_count_in_stands_before_a_cue(atlas: Atlas) -> None:
    with_both = hud_calls(Hud(count_in=2, cue=TimingCue.EARLY), atlas, SCENE)
    assert (with_both["kind"] == ShapeKind.TRIANGLE).sum() == 0


def test_a_scene_too_small_for_words_has_none(atlas: Atlas) -> None:
    full = Hud("Rock", "Pass 1", bar=1, beat=1, count_in=3, message="Play")
    for shapes in (hud_lines, hud_calls):
        assert len(shapes(full, atlas, (240.0, 112.0))) > 0
        assert len(shapes(full, atlas, (64.0, 34.0))) == 0


FULL = Hud("Rock 2: the kick moves", "Pass 1 of 4", 2, 3, 4, 2, 84.0, right=25, judged=25)
PICTURES = (
    *((160.0, 190.0), (240.0, 120.0), (300.0, 200.0), (562.0, 190.0), (480.0, 900.0), (3840.0, 1200.0)),
    SMALL,
    SCENE,
)


def boxes(shapes: np.ndarray) -> np.ndarray:
    return np.concatenate([shapes["centre"] - shapes["half"], shapes["centre"] + shapes["half"]], axis=1)


@pytest.mark.parametrize("letters_px", [None, 0.9, 1.6, 4.0])
@pytest.mark.parametrize("size", PICTURES)
def test_all_lines_stand_in_the_band_and_in_the_picture(
    size: tuple[float, float], letters_px: float | None, atlas: Atlas
) -> None:
    seen = boxes(hud_lines(FULL, atlas, size, letters_px))
    band = band_height(FULL, size, letters_px)
    assert len(seen) > 0
    assert seen[:, 3].max() <= band
    assert band <= max(0.2 * size[1], 0.4 * BAND) + 1
    assert seen[:, 0].min() >= 0
    assert seen[:, 2].max() <= size[0]


@pytest.mark.parametrize("size", PICTURES)
def test_a_line_that_is_free_has_no_letters(size: tuple[float, float], atlas: Atlas) -> None:
    """A toast of the second line's height there touches nothing."""
    left, right, middle = free_line(FULL, atlas, size, 0.9)
    k = scale(size[1], 0.9)
    seen = boxes(hud_lines(FULL, atlas, size, 0.9))
    in_line = (seen[:, 1] < middle + 8 * k) & (seen[:, 3] > middle - 8 * k)
    assert not ((seen[:, 0] < right) & (seen[:, 2] > left) & in_line).any()
    assert middle < band_height(FULL, size, 0.9) <= BAND * k + 1


def test_without_words_there_is_no_band() -> None:
    assert band_height(Hud(message="Play", count_in=3), SCENE) == 0
