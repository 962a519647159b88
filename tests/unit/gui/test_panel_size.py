"""How large letters are in windows of all sizes."""

from math import atan, degrees

import pytest

from station.gui.panel_size import WORDS, fit, panel_factor, shares

X_HEIGHT_OF_ROBOTO = 1082 / 2048
EM_OF_IMGUI = 2048 / (1900 + 500)
"""By Roboto's tables; imgui's size of a font is ascender + descender, the picture's is the em."""
SIZES = ((760, 480), (1280, 720), (1366, 768), (1600, 900), (1920, 1080), (2560, 1440), (3840, 2160), (3440, 1440))


def test_letters_are_read_from_two_metres_on_a_24_inch_screen() -> None:
    """531 × 299 mm: a small letter of at least 6 minutes of arc, 3.49 mm, in panels, and of 8 in the picture.

    On every full screen from 1080 lines; words in the picture have an em of 20 design pixels, panels a height of 17.
    """
    for width, height in ((1920, 1080), (2560, 1440), (3840, 2160)):
        for pixels, arc_min in ((17.0 * EM_OF_IMGUI, 6.0), (20 * WORDS, 8.0)):
            letter_m = pixels * fit((width, height)) * X_HEIGHT_OF_ROBOTO * 0.299 / height
            assert degrees(atan(letter_m / 2.0)) * 60 >= arc_min - 0.05


def test_the_designed_window_has_the_designed_size() -> None:
    assert panel_factor((1280, 720), 1.0) == 1.0
    assert shares((1280, 720), 1.0) == (1.0, 1.0)


def test_a_larger_window_has_larger_letters() -> None:
    factors = [panel_factor((16 * k, 9 * k), 1.0) for k in range(50, 400, 5)]
    assert factors == sorted(factors)


@pytest.mark.parametrize("pixels", SIZES)
def test_density_and_pixels_give_the_same_letters(pixels: tuple[int, int]) -> None:
    """A full screen of 3840 × 2160 has as many pixels a letter whether the system calls it dense or large."""
    if pixels[1] < 2160:
        return
    plain = panel_factor(pixels, 1.0)
    dense = 2 * panel_factor((pixels[0] / 2, pixels[1] / 2), 1.0)
    assert plain == pytest.approx(dense, abs=0.05)


@pytest.mark.parametrize("pixels", SIZES)
@pytest.mark.parametrize("user", [0.75, 1.0, 1.5, 2.5])
def test_every_window_keeps_room(pixels: tuple[int, int], user: float) -> None:
    factor = panel_factor(pixels, user)
    assert factor >= 0.6
    assert pixels[0] / factor >= 300
    assert pixels[1] / factor >= 188
