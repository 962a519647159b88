"""The colours of everything: one dark room, light draw_list, and signal colours that colour-blind people tell apart.

Signals are those of Okabe and Ito, "Color Universal Design" (2008); each also has a shape of its own.
Values are as on a screen (sRGB, 0–1).

Whatever draws names the night's colours; a `Theme` is a table that says what stands for each of them, looked up when
they reach the screen. The themes' signals were sought for the greatest least distance (CIELAB) of any two of them as
seen with normal sight and by protanopes, deuteranopes and tritanopes (Machado 2009), each at 4.6 : 1 or more on the
theme's paper; by day, where they are dark, each is 25 or more from the ink, too.
"""

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.render.text.draw_list import Colour


def _hex(code: str, opacity: float = 1.0) -> Colour:
    r, g, b = (int(code[i : i + 2], 16) / 255 for i in (0, 2, 4))
    return r, g, b, opacity


INK = _hex("F2EDE4")
INK_SOFT = _hex("F2EDE4", 0.66)
INK_FAINT = _hex("F2EDE4", 0.30)
STAFF_LINE = _hex("F2EDE4", 0.36)
NIGHT = _hex("0B0D12")
PANEL = _hex("12151D", 0.86)
PAPER = _hex("11141B")
PAPER_LOW = _hex("0A0C11")
PANEL_EDGE = _hex("FFFFFF", 0.07)
BRAND = _hex("FF9A3C")

GOOD = _hex("56B4E9")
EARLY = _hex("F0E442")
LATE = _hex("E69F00")
MISSED = _hex("FF6B4A")
WRONG = _hex("D989B5")
EXTRA = _hex("D989B5")


def with_opacity(colour: Colour, opacity: float) -> Colour:
    """The same colour, `opacity` times as opaque."""
    return (*colour[:3], colour[3] * opacity)


def mixed(a: Colour, b: Colour, share: float) -> Colour:
    """`a` at share 0, `b` at share 1."""
    r, g, bl, o = (x + (y - x) * share for x, y in zip(a, b, strict=True))
    return r, g, bl, o


class Theme(StrEnum):
    """Which colours are shown."""

    NIGHT = "night"
    DAY = "day"
    CONTRAST = "contrast"
    APART = "apart"


THEME_NAMES: Mapping[Theme, str] = MappingProxyType(
    {Theme.NIGHT: "Night", Theme.DAY: "Day", Theme.CONTRAST: "High contrast", Theme.APART: "Colour-blind"}
)

_INSTEAD: tuple[tuple[Colour, str, str, str], ...] = (
    # of the night, by day, in high contrast, for the colour-blind
    (INK, "1B1E26", "FFFFFF", "F2EDE4"),
    (NIGHT, "F4F1EA", "000000", "0B0D12"),
    (PANEL, "FFFFFF", "000000", "12151D"),
    (PAPER, "F6F3EC", "000000", "11141B"),
    (PAPER_LOW, "F4F1EA", "000000", "0A0C11"),
    (PANEL_EDGE, "000000", "FFFFFF", "FFFFFF"),
    (BRAND, "9A4A00", "FFB000", "FF9A3C"),
    (GOOD, "0067E5", "189BFA", "6070FC"),
    (EARLY, "4E2400", "CEFF10", "B2FFD3"),
    (LATE, "A45C00", "C58B06", "FF9E00"),
    (MISSED, "CF2459", "FF5B76", "F22D51"),
    (WRONG, "87569D", "FFC9F4", "CDAAED"),
)
"""What stands for each colour of the night."""
_OF_PIECES: tuple[tuple[tuple[Piece, ...], str, str, str, str], ...] = (
    # by night, by day, in high contrast, for the colour-blind
    ((Piece.KICK,), "A253FF", "7928C7", "23A6F5", "9875CB"),
    ((Piece.SNARE,), "FDB7E9", "BA4263", "C48694", "F878AC"),
    ((Piece.HIHAT, Piece.HIHAT_PEDAL), "33FFB0", "0D74A5", "05FFAB", "0CEDFF"),
    ((Piece.RIDE, Piece.RIDE_2), "B0FF7B", "1C046F", "A8FF7E", "A2F205"),
    ((Piece.CRASH_1, Piece.CRASH_2, Piece.SPLASH, Piece.CHINA), "E9F709", "D03109", "F8DE1F", "FDCB8C"),
    ((Piece.TOM_1, Piece.TOM_2), "6C81D0", "2600FF", "AEBDE4", "666DFC"),
    ((Piece.TOM_3, Piece.TOM_4), "20B500", "1B000C", "E87C10", "2FB316"),
    ((Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2), "AD6B87", "661D58", "9C9A60", "A97757"),
    ((Piece.COWBELL, Piece.TAMBOURINE, Piece.CLAP, Piece.PERCUSSION), "8B9157", "710A08", "FEFFFF", "FFFFE5"),
)
"""The colours of pieces, wherever one tells them apart: sought as the themes' signals are, for names to be read in."""
_PIECE_COLOURS = {piece: _hex(night) for pieces, night, *_ in _OF_PIECES for piece in pieces}


def piece_colour(piece: Piece) -> Colour:
    """The colour of a piece; those of one kind share it, and lanes and lines tell them apart."""
    return _PIECE_COLOURS[piece]


_COLUMNS = {Theme.DAY: 1, Theme.CONTRAST: 2, Theme.APART: 3}


def _key(colour: Colour) -> int:
    r, g, b = (round(255 * x) for x in colour[:3])
    return r << 16 | g << 8 | b


_ROWS = sorted(
    (*_INSTEAD, *((_hex(night), day, contrast, apart) for _, night, day, contrast, apart in _OF_PIECES)),
    key=lambda row: _key(row[0]),
)
_KEYS = np.array([_key(row[0]) for row in _ROWS])
_RGB = {
    theme: np.array([[*bytes.fromhex(str(row[column]))] for row in _ROWS], np.uint8)
    for theme, column in _COLUMNS.items()
}


def over_picture(theme: Theme) -> Theme:
    """What words over the room are printed in: the room is dark by day too."""
    return Theme.NIGHT if theme is Theme.DAY else theme


def themed(colour: Colour, theme: Theme) -> Colour:
    """What `theme` shows for a colour of the night, as opaque; one that is not the night's stays."""
    r, g, b = themed_bytes(np.array([[round(255 * x) for x in colour[:3]]], np.uint8), theme)[0] / 255
    return float(r), float(g), float(b), colour[3]


def themed_bytes(rgb: NDArray[np.uint8], theme: Theme) -> NDArray[np.uint8]:
    """The same of many: rows of red, green, blue 0–255, shape (n, 3)."""
    if theme is Theme.NIGHT:
        return rgb
    keys = rgb.astype(np.int64) @ np.array([1 << 16, 1 << 8, 1])
    at = np.minimum(np.searchsorted(_KEYS, keys), len(_KEYS) - 1)
    return np.where((_KEYS[at] == keys)[:, None], _RGB[theme][at], rgb)


def paper_bytes(rgba: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """What colours of the night, rows of red, green, blue and opacity, are on white paper by day, shape (n, 3)."""
    rgb, opacity = themed_bytes(rgba[:, :3], Theme.DAY).astype(np.float64), rgba[:, 3:] / 255
    return np.rint(rgb * opacity + 255.0 * (1 - opacity)).astype(np.uint8)


INK_NAMES: Mapping[str, Colour] = MappingProxyType(
    {
        "ink": INK,
        "night": NIGHT,
        "paper": PAPER,
        "edge": PANEL_EDGE,
        "brand": BRAND,
        "good": GOOD,
        "early": EARLY,
        "late": LATE,
        "missed": MISSED,
        "wrong": WRONG,
        **{f"piece-{names[0].name.lower().replace('_', '-')}": _hex(night) for names, night, *_ in _OF_PIECES},
    }
)
"""What pages that know day and night by themselves call the colours."""
