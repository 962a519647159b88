"""What a drummer looks like, as data that pictures are made from: hair, clothes, colours, girths. Nothing moves by it.

A figure file's table `look` holds it, each key with the default drummer's value where it is not said. Girths are
factors on a median man's, whose lengths the figure has already; colours are "#rrggbb", sRGB as one picks them on a
screen.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from types import MappingProxyType

from station.core.toml.schema import Field, Fields, Reader, list_of, number, one_of, optional, said, text
from station.core.toml.toml_faults import wrong

Colour = tuple[float, float, float]
"""sRGB, 0–1."""


@dataclass(frozen=True, slots=True)
class Girths:
    """How thick the body is beside a median man's: 1 is his, 0.7–1.4 are people's.

    `chin` is the breadth of the jaw, `brows` their thickness, `bust` how far breasts stand out (0 a man's … 1).
    """

    chest: float = 1.0
    waist: float = 1.0
    hips: float = 1.0
    arms: float = 1.0
    legs: float = 1.0
    neck: float = 1.0
    chin: float = 1.0
    brows: float = 1.0
    bust: float = 0.0


@dataclass(frozen=True, slots=True)
class Colours:
    """What is of which colour; `trim` are hems, collar, print and laces, `lips` a shade on the skin."""

    skin: Colour = (0.86, 0.62, 0.48)
    lips: Colour = (0.66, 0.36, 0.32)
    hair: Colour = (0.31, 0.19, 0.13)
    iris: Colour = (0.30, 0.42, 0.46)
    top: Colour = (0.91, 0.49, 0.20)
    trim: Colour = (0.10, 0.30, 0.36)
    legs: Colour = (0.21, 0.26, 0.38)
    shoes: Colour = (0.80, 0.22, 0.20)
    soles: Colour = (0.93, 0.92, 0.90)
    band: Colour = (0.06, 0.36, 0.42)


WORDS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "hair": ("quiff", "ponytail", "curls", "cropped"),
        "beard": ("none", "full"),
        "top": ("tee", "tank", "shirt", "hoodie"),
        "legs": ("jeans", "shorts"),
        "shoes": ("trainers", "boots"),
    }
)
"""What one of each there is to wear."""
WORN = ("headphones", "glasses", "beanie", "sweatbands")
"""What may be worn beside, any of it."""


@dataclass(frozen=True, slots=True)
class Look:
    """A drummer's hair, beard and clothes by the words of `WORDS`, what is `worn` beside, girths and colours."""

    hair: str = "quiff"
    beard: str = "none"
    top: str = "tee"
    legs: str = "jeans"
    shoes: str = "trainers"
    worn: tuple[str, ...] = ("headphones", "sweatbands")
    girths: Girths = field(default_factory=Girths)
    colours: Colours = field(default_factory=Colours)


_HEX = re.compile(r"#[0-9a-fA-F]{6}")
_LEAST_GIRTH, _GREATEST_GIRTH = 0.0, 2.0
"""Beyond these a body closes over itself (our choice)."""


def _colour(value: object) -> Colour:
    said_as = text(value)
    if not _HEX.fullmatch(said_as):
        raise wrong(f'expected a colour such as "#d94f2b", found {said_as}')
    red, green, blue = (int(said_as[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


_GIRTHS: Fields = {each.name: optional(number(_LEAST_GIRTH, _GREATEST_GIRTH)) for each in fields(Girths)}
_COLOURS: Fields = {each.name: optional(_colour) for each in fields(Colours)}
FIELDS: Fields = {
    **{name: optional(one_of(words, "word")) for name, words in WORDS.items()},
    "worn": optional(list_of(one_of(WORN, "thing to wear"), f"a list of {', '.join(WORN)}")),
    "girths": Field(said(_GIRTHS, "girth"), {}),
    "colours": Field(said(_COLOURS, "colour"), {}),
}
_CHANGES = said(FIELDS, "part of a look")


def read_look(raw: object) -> Look:
    """The look that a table describes; raises `Wrong` with all that is wrong in it."""
    changes = _CHANGES(raw)
    girths, colours = changes.pop("girths", {}), changes.pop("colours", {})
    return replace(Look(), girths=replace(Girths(), **girths), colours=replace(Colours(), **colours), **changes)


LOOK: Reader[Look] = read_look
"""The schema of the table."""
