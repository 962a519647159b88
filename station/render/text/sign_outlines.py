"""Outlines of the musical signs: Bravura's, in a cut that `tools/music_signs.py` makes.

Units are staff spaces (the distance between two staff lines), y up. The code points, where each glyph's origin lies,
and that an em is four staff spaces: Standard Music Font Layout (SMuFL) 1.4. Some signs are moved here so that their
origin is their middle, which is how what draws them thinks of them. Licence of the outlines: `music_signs_license.txt`.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from station.render.text.truetype import Contours, TrueType

FONT_FILE = Path(__file__).with_name("music_signs.ttf")
_SPACES_PER_EM = 4.0
"""SMuFL 1.4, "Metrics and glyph registration"."""

STAFF_LINE, STEM, BEAM, BEAM_STEP = 0.13, 0.12, 0.5, 0.75
LEDGER_LINE, LEDGER_OUT, BRACKET_LINE, HAIRPIN_LINE, SLUR_END, SLUR_MIDDLE = 0.16, 0.4, 0.16, 0.16, 0.1, 0.22
"""Thicknesses that Bravura's metadata advise with its signs (`engravingDefaults`), the step from one beam to the
next, and how far a ledger line passes a head."""


@dataclass(frozen=True, slots=True)
class Sign:
    """A sign's code point in SMuFL, and whether its origin is moved to the middle of its width and of its height."""

    code: int
    middle_x: bool = False
    middle_y: bool = False


def _numbered(name: str, first: int) -> dict[str, Sign]:
    """Ten figures."""
    return {f"{name}_{k}": Sign(first + k) for k in range(10)}


SIGNS: dict[str, Sign] = {
    "clef": Sign(0xE069),
    # figures of time signatures (origin: left, their middle) and of tuplets (left, on the baseline)
    **_numbered("meter", 0xE080),
    "meter_plus": Sign(0xE08C),
    **_numbered("tuplet", 0xE880),
    # note heads; origin in their middle
    "head_round": Sign(0xE0A4, True, True),
    "head_half": Sign(0xE0A3, True, True),
    "head_whole": Sign(0xE0A2, True, True),
    "head_cross": Sign(0xE0A9, True, True),
    "head_heavy_cross": Sign(0xE0F8, True, True),
    "head_slashed": Sign(0xE0CF, True, True),
    "head_half_cross": Sign(0xE0A8, True, True),
    "head_half_diamond": Sign(0xE0D9, True, True),
    "head_half_triangle": Sign(0xE0C6, True, True),
    "head_half_ringed_cross": Sign(0xE0B2, True, True),
    "head_ringed_cross": Sign(0xE0B3, True, True),
    "head_ornate_cross": Sign(0xE0AA, True, True),
    "head_diamond": Sign(0xE0DB, True, True),
    "head_hollow_diamond": Sign(0xE0DD, True, True),
    "head_triangle": Sign(0xE0C7, True, True),
    # brackets of ghost notes; origin in their middle
    "bracket_left": Sign(0xE0F5, True, True),
    "bracket_right": Sign(0xE0F6, True, True),
    # flags; origin at the stem's tip, on its left edge
    **{f"flag_{8 << k}": Sign(0xE240 + 2 * k) for k in range(5)},
    **{f"flag_{8 << k}_down": Sign(0xE241 + 2 * k) for k in range(5)},
    # rests; origin in the middle of their width, on the line from which a whole rest hangs or else the middle line
    **{f"rest_{1 << k}": Sign(0xE4E3 + k, True) for k in range(8)},
    # on a stem; origin in their middle
    **{f"tremolo_{k}": Sign(0xE21F + k, True, True) for k in range(1, 6)},
    "buzz": Sign(0xE22A, True, True),
    # above or below a note; origin in their middle
    "accent": Sign(0xE4A0, True, True),
    "hat_open": Sign(0xE7F8, True, True),
    "hat_half": Sign(0xE7F7, True, True),
    "hat_closed": Sign(0xE5E5, True, True),
    "choke": Sign(0xE805, True, True),
    # how loud; origin in the middle of their width, on the baseline
    "loud_ppp": Sign(0xE52A, True),
    "loud_pp": Sign(0xE52B, True),
    "loud_p": Sign(0xE520, True),
    "loud_mp": Sign(0xE52C, True),
    "loud_mf": Sign(0xE52D, True),
    "loud_f": Sign(0xE522, True),
    "loud_ff": Sign(0xE52F, True),
    "loud_fff": Sign(0xE530, True),
    "dot": Sign(0xE1E7, True, True),
    # the beat that a tempo counts; origin left on the baseline
    "beat_1": Sign(0xECA2),
    "beat_2": Sign(0xECA3),
    "beat_4": Sign(0xECA5),
    "beat_8": Sign(0xECA7),
    "beat_16": Sign(0xECA9),
    "beat_dot": Sign(0xECB7),
}


@dataclass(frozen=True, slots=True)
class SignBox:
    """What a sign covers, in staff spaces from its origin, y up, and the step from it to the next sign of a row."""

    left: float
    bottom: float
    right: float
    top: float
    advance: float

    @property
    def width(self) -> float:
        """From edge to edge."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """From edge to edge."""
        return self.top - self.bottom


@cache
def _font() -> TrueType:
    return TrueType(FONT_FILE)


@cache
def sign(name: str) -> Contours:
    """The closed polygons (k, 2) of a sign of the table; they fill by the non-zero rule."""
    entry = SIGNS[name]
    contours = tuple(c * _SPACES_PER_EM for c in _font().outline(chr(entry.code)).contours)
    points = np.concatenate(contours)
    middle = (points.min(axis=0) + points.max(axis=0)) / 2 * (entry.middle_x, entry.middle_y)
    return tuple(contour - middle for contour in contours)


@cache
def sign_box(name: str) -> SignBox:
    """What a sign of the table covers."""
    points = np.concatenate(sign(name))
    (left, bottom), (right, top) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
    return SignBox(left, bottom, right, top, _font().outline(chr(SIGNS[name].code)).advance * _SPACES_PER_EM)
