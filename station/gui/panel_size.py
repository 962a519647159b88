"""How large the panels are: one function of the window's size, of the screen's density, and of what the user asks for.

The measure is the height of a small letter, as the eye sees it. Speed of reading no longer depends on size from twice
the acuity limit on (Bailey, Clear and Berman, J. Illuminating Engineering Soc. 22(2), 1993); young adults resolve 0.8
minutes of arc (visual acuity 20/16), which is a letter 4 minutes high. So what is read at the kit, the words in the
picture, has 8 minutes (`WORDS`). Panels are worked in with the mouse, and shall still show a list of lessons: they
have `GOAL_ARC_MIN`, 1.5 times the limit, and 7.5 at 125 % (our choice). On a 24-inch screen that the window fills, seen
from two metres, even that is more than proportional growth gives: a window of 1280 × 720 lies on a desk and keeps its
17 pixels, at 1920 × 1080 and beyond letters are `FULL` times as large. Between them, and a little below, the size is
a power of the window's. So a larger window has larger letters, and somewhat less beside each other.

Sizes of windows are logical pixels, of which a screen has 96 an inch by its own account: on one of 3840 × 2160 with
density 2 the window is 1920 × 1080, and the factor here is that of a screen of 1920 × 1080; `theme.points` then
multiplies by the density. Without density it is twice as large a window, and letters have as many pixels.
"""

from math import log, radians, tan

DESIGN = (1280.0, 720.0)
"""The window that the panels were designed for."""
DESIGN_LETTER_PX, LETTER_SHARE = 17.0, 0.528 / 1.172
"""A line's design pixels; a small letter's share of them in Roboto (its x-height, by ascender and descender)."""
GOAL_ARC_MIN, AWAY_M, SCREEN_HIGH_M = 6.0, 2.0, 0.299
"""What a small letter subtends at least in a window that fills a 24-inch screen (16:9), from there (see above)."""
_SCREEN = 1.5
"""How many times as high as `DESIGN` a window is that fills a screen: 1080 pixels."""
_LETTER_M = tan(radians(GOAL_ARC_MIN / 60)) * AWAY_M
FULL = _LETTER_M / SCREEN_HIGH_M * _SCREEN * DESIGN[1] / (DESIGN_LETTER_PX * LETTER_SHARE)
"""1.65: the factor at 1920 × 1080."""
_POWER = log(FULL) / log(_SCREEN)
WORDS = 0.97
"""Pixels a design pixel of the picture's words (`render.hud`), of the panels': their second size, an em of 20, then has
8 minutes."""
SMALLEST = 0.85
"""No smaller for the window's sake: 14 pixels are read at the desk where so small a window stands (our choice)."""
_LEAST_ROOM = (304.0, 192.0)
"""Design pixels that every window has: 760 × 480 at 250 %. What the user asks for beyond is not had (our choice)."""
_STEPS = 32
"""The factor goes by that fraction, for letters of every size have to be made (our choice: half a pixel of 17)."""

Size = tuple[float, float]
"""Width and height in logical pixels."""


def fit(window: Size) -> float:
    """How many times their design size the panels of `window` are before the user asks for more or less."""
    ratio = min(length / design for length, design in zip(window, DESIGN, strict=True))
    grown: float = min(ratio, _SCREEN) ** _POWER * max(ratio / _SCREEN, 1.0)
    return max(grown, SMALLEST)


def panel_factor(window: Size, user: float) -> float:
    """Pixels a design pixel, of logical ones; `user` is what the settings say, 1 for neither larger nor smaller."""
    most = min(length / least for length, least in zip(window, _LEAST_ROOM, strict=True))
    factor = min(fit(window) * user, most)
    return max(round(factor * _STEPS), 1) / _STEPS


def shares(window: Size, factor: float) -> Size:
    """How many times its usual share of the window's width, and of its height, a panel needs at that factor."""
    across, down = (factor * design / length for length, design in zip(window, DESIGN, strict=True))
    return across, down
