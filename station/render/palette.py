"""The colours of everything: one dark room, light ink, and signal colours that colour-blind people tell apart.

Signals are those of Okabe and Ito, "Color Universal Design" (2008); each also has a shape of its own.
Values are as on a screen (sRGB, 0–1).
"""

from station.render.ink import Colour


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
BRAND_SOFT = _hex("FF9A3C", 0.22)

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
