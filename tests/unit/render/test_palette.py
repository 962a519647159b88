"""The themes by numbers: contrast by WCAG 2.2 (1.4.3), colour-blind sight by Machado and others (2009), CIELAB.

The formulas are written out here from their publications; the colours are the code's.
"""

from itertools import combinations

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.render.palette import (
    BRAND,
    EARLY,
    GOOD,
    INK,
    INK_SOFT,
    LATE,
    MISSED,
    NIGHT,
    PANEL,
    PAPER,
    PAPER_LOW,
    WRONG,
    Theme,
    over_picture,
    piece_colour,
    themed,
    themed_bytes,
    with_opacity,
)
from station.render.text.draw_list import Colour

GRAB = 0.55
"""Opacity of a slider's grab (`app.theme`)."""
SIGNALS = (GOOD, EARLY, LATE, MISSED, WRONG)
SIGHT = {
    "normal": np.eye(3),
    "protanope": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    "deuteranope": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "tritanope": [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
}
TO_XYZ = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]]
LEAST_APART = {Theme.NIGHT: 15, Theme.DAY: 30, Theme.CONTRAST: 30, Theme.APART: 40}
"""2.3 is just noticeable; the night's are Okabe and Ito's, the others were sought."""

LEAST_FROM_INK = 25
"""Ten times what is just noticeable; the ink is no signal."""


def linear(colour: Colour) -> NDArray[np.float64]:
    c = np.array(colour[:3])
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def over(colour: Colour, paper: Colour) -> Colour:
    r, g, b = (x * colour[3] + y * (1 - colour[3]) for x, y in zip(colour[:3], paper[:3], strict=True))
    return r, g, b, 1.0


def contrast(colour: Colour, paper: Colour) -> float:
    low, high = sorted(float(linear(c) @ [0.2126, 0.7152, 0.0722]) for c in (over(colour, paper), paper))
    return (high + 0.05) / (low + 0.05)


def lab(rgb: NDArray[np.float64]) -> NDArray[np.float64]:
    x, y, z = np.array(TO_XYZ) @ np.clip(rgb, 0, 1) / [0.95047, 1.0, 1.08883]
    fx, fy, fz = (np.cbrt(t) if t > (6 / 29) ** 3 else t * (29 / 6) ** 2 / 3 + 4 / 29 for t in (x, y, z))
    return np.array([116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)])


@pytest.mark.parametrize("theme", Theme)
@pytest.mark.parametrize("paper", [PAPER, PAPER_LOW, NIGHT, PANEL], ids=["paper", "low paper", "night", "panel"])
def test_every_text_and_signal_reads_on_every_paper(theme: Theme, paper: Colour) -> None:
    ground = with_opacity(themed(paper, theme), 1.0 / paper[3])
    for colour in (INK, INK_SOFT, BRAND, *SIGNALS):
        assert contrast(themed(colour, theme), ground) >= 4.5, (theme, colour)


def test_high_contrast_is_high() -> None:
    ground = themed(PAPER, Theme.CONTRAST)
    assert contrast(themed(INK, Theme.CONTRAST), ground) == pytest.approx(21.0), "white on black"
    for colour in (INK_SOFT, BRAND, *SIGNALS):
        assert contrast(themed(colour, Theme.CONTRAST), ground) >= 7.0, "WCAG's enhanced contrast"


@pytest.mark.parametrize("theme", Theme)
@pytest.mark.parametrize("sight", SIGHT)
def test_signals_are_told_apart_by_everybody(theme: Theme, sight: str) -> None:
    seen = [lab(np.array(SIGHT[sight]) @ linear(themed(colour, theme))) for colour in SIGNALS]
    least = min(float(np.linalg.norm(one - other)) for one, other in combinations(seen, 2))
    assert least >= LEAST_APART[theme]


@pytest.mark.parametrize("sight", SIGHT)
def test_no_signal_is_taken_for_ink_by_day(sight: str) -> None:
    ink = lab(np.array(SIGHT[sight]) @ linear(themed(INK, Theme.DAY)))
    for colour in SIGNALS:
        seen = lab(np.array(SIGHT[sight]) @ linear(themed(colour, Theme.DAY)))
        assert float(np.linalg.norm(seen - ink)) >= LEAST_FROM_INK, colour


@pytest.mark.parametrize("theme", Theme)
def test_a_button_s_letters_read_on_it(theme: Theme) -> None:
    assert contrast(themed(NIGHT, theme), themed(BRAND, theme)) >= 4.5


@pytest.mark.parametrize("theme", Theme)
def test_a_slider_s_number_reads_on_its_grab(theme: Theme) -> None:
    grab = over(with_opacity(themed(BRAND, theme), GRAB), themed(PAPER, theme))
    assert contrast(themed(INK, theme), grab) >= 4.5


def test_opacity_stays_and_a_colour_of_no_theme_too() -> None:
    assert themed(INK_SOFT, Theme.CONTRAST) == (1.0, 1.0, 1.0, INK_SOFT[3])
    assert themed((0.2, 0.4, 0.6, 0.5), Theme.DAY) == pytest.approx((0.2, 0.4, 0.6, 0.5))
    assert themed_bytes(np.array([[1, 2, 3], [0xF2, 0xED, 0xE4]], np.uint8), Theme.DAY).tolist() == [
        [1, 2, 3],
        [0x1B, 0x1E, 0x26],
    ]


def test_words_over_the_dark_room_are_light_by_day() -> None:
    assert over_picture(Theme.DAY) is Theme.NIGHT
    assert over_picture(Theme.APART) is Theme.APART


PIECE_COLOURS = sorted({piece_colour(piece) for piece in Piece})


@pytest.mark.parametrize("theme", Theme)
def test_names_of_pieces_read_on_the_score_s_paper_and_letters_on_their_notes(theme: Theme) -> None:
    for colour in PIECE_COLOURS:
        for paper in (PAPER, PAPER_LOW):
            assert contrast(themed(colour, theme), themed(paper, theme)) >= 4.5, (theme, colour)
        assert contrast(themed(NIGHT, theme), themed(colour, theme)) >= 4.5


@pytest.mark.parametrize("theme", Theme)
@pytest.mark.parametrize("sight", SIGHT)
def test_kinds_of_pieces_are_told_apart_by_everybody(theme: Theme, sight: str) -> None:
    """Ten times what is just noticeable."""
    assert len(PIECE_COLOURS) == 9
    seen = [lab(np.array(SIGHT[sight]) @ linear(themed(colour, theme))) for colour in PIECE_COLOURS]
    assert min(float(np.linalg.norm(one - other)) for one, other in combinations(seen, 2)) >= 23


@pytest.mark.parametrize("theme", Theme)
def test_no_piece_has_the_colour_of_a_judgement(theme: Theme) -> None:
    for colour in PIECE_COLOURS:
        assert all(themed(colour, theme) != themed(signal, theme) for signal in SIGNALS)
