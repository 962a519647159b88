"""Styles as files, and the eight slots that a user keeps.

A file holds the controls of `style.Style` by their names, each with its natural value where it is not said; a table
`pieces` of amplitudes by piece; and a table `automation` with, for a control, a list of [bar, value]. Reading names
every fault by its place; what is written reads back the same.
"""

from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType

from station.core.disk.files import NoSuchFile, write_whole
from station.core.disk.shipped import find_shipped, shipped
from station.core.pieces import Piece, word
from station.core.toml.schema import (
    Fields,
    Reader,
    key_of,
    list_of,
    members_by_label,
    number,
    one_of,
    optional,
    read,
    record,
    row_of,
    said,
    table_of,
    text,
    whole,
)
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_text
from station.motion.style.style import NUMBERS, WORDS, Automation, Style, range_of

STYLES = Path(__file__).parents[1] / "data" / "styles"
SLOTS = 8
"""As many as SMED's window stored (thesis § 4.1.1)."""

_MAX_BAR = 100_000.0


def style_names() -> list[str]:
    """The styles that ship with the station."""
    return shipped(STYLES)


def load_style(name_or_path: str | Path) -> Style:
    """A shipped style by its name, or a style file; raises `BadInput` with the place of the first fault."""
    path = find_shipped(name_or_path, STYLES, "style")
    return read(read_source(path), style_reader(path.stem))


def save_style(style: Style, path: Path) -> None:
    """Write `style` whole to `path`; raises `DeviceError` if the disk refuses."""
    write_whole(path, style_text(style).encode())


def style_text(style: Style) -> str:
    """The file of `style`: only what differs from the natural drummer."""
    return "\n".join(_lines(style, "")) + "\n"


def _lines(style: Style, prefix: str) -> list[str]:
    natural = Style()
    lines = []
    for name in (*NUMBERS, *WORDS, "seed"):
        value = getattr(style, name)
        if value != getattr(natural, name):
            lines.append(f'{name} = "{value}"' if name in WORDS else f"{name} = {value!r}")
    if style.pieces:
        lines += ["", f"[{prefix}pieces]", *(f"{word(p)} = {v!r}" for p, v in sorted(style.pieces.items()))]
    if style.automation:
        lines += ["", f"[{prefix}automation]"]
        lines += [f"{name} = {[list(point) for point in points]}" for name, points in sorted(style.automation.items())]
    return lines


def _points(control: str) -> Reader[Automation]:
    """How a control changes over the bars: its value at some of them, which rise."""
    point = row_of([number(1.0, _MAX_BAR), number(*range_of(control))], "[bar, value]")
    points = list_of(point, "a list of [bar, value]")

    def read_points(raw: object) -> Automation:
        found = points(raw)
        if not found or any(a[0] >= b[0] for a, b in pairwise(found)):
            raise wrong("the bars must rise" if found else "expected a list of [bar, value], found none")
        return tuple((bar, value) for bar, value in found)

    return read_points


_PIECES = members_by_label(Piece)
FIELDS: Fields = {
    "title": optional(text),
    **{name: optional(number(*range_of(name))) for name in NUMBERS},
    **{name: optional(one_of(words, "word")) for name, words in WORDS.items()},
    "seed": optional(whole(0, 2**31)),
    "pieces": optional(table_of(key_of(_PIECES, "piece"), number(0.0, 100.0))),
    "automation": optional(said({name: optional(_points(name)) for name in (*NUMBERS, *_PIECES)}, "control")),
}
"""The schema of a style."""
_CHANGES = said(FIELDS)


def style_reader(name: str, titled: bool = False) -> Reader[Style]:
    """The schema of the style called `name` or, where it is `titled` and says one, by its title."""

    def read_style(raw: object) -> Style:
        changes = _CHANGES(raw)
        title = changes.pop("title", name)
        pieces, automation = (MappingProxyType(changes.pop(key, {})) for key in ("pieces", "automation"))
        style = Style(name=title if titled else name, pieces=pieces, automation=automation)
        return replace(style, **changes)

    return read_style


@dataclass(frozen=True, slots=True)
class Slots:
    """Eight places for styles, empty or not."""

    styles: tuple[Style | None, ...] = field(default=(None,) * SLOTS)

    def stored(self, slot: int, style: Style) -> "Slots":
        """The same with `style` in `slot`, counted from 0."""
        kept = list(self.styles)
        kept[slot] = style
        return Slots(tuple(kept))

    @classmethod
    def load(cls, path: Path) -> "Slots":
        """The slots in a file; all empty where there is none. Raises `BadInput` with the place of the first fault."""
        try:
            return read(read_source(path), SLOTS_FILE)
        except NoSuchFile:
            return cls()

    def save(self, path: Path) -> None:
        """Write all slots whole to `path`; raises `DeviceError` if the disk refuses."""
        blocks = []
        for i, style in enumerate(self.styles):
            if style is not None:
                head = [f"[slot_{i + 1}]", f"title = {toml_text(style.name)}"]
                blocks.append("\n".join([*head, *_lines(style, f"slot_{i + 1}.")]))
        write_whole(path, ("\n\n".join(blocks) + "\n").encode())


SLOT_FIELDS: Fields = {
    key: optional(style_reader(key, titled=True)) for key in (f"slot_{number}" for number in range(1, SLOTS + 1))
}
SLOTS_FILE: Reader[Slots] = record(lambda **styles: Slots(tuple(styles[key] for key in SLOT_FIELDS)), SLOT_FIELDS)
"""The schema of the file of slots."""
