"""Styles as files, and the eight slots that a user keeps.

A file holds the controls of `style.Style` by their names, each with its natural value where it is not said; a table
`pieces` of amplitudes by piece; and a table `automation` with, for a control, a list of [bar, value]. Reading names
every fault by its key; what is written reads back the same.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType

from station.core.errors import BadInput
from station.core.files import write_whole
from station.core.pieces import Piece, word
from station.core.toml_table import Table, find_shipped, located, read_toml, shipped
from station.motion.style.style import NUMBERS, WORDS, Automation, Style, checked, range_of

STYLES = Path(__file__).parents[1] / "data" / "styles"
SLOTS = 8
"""As many as SMED's window stored (thesis § 4.1.1)."""

_PIECES = {word(p): p for p in Piece}
_MAX_BAR = 100_000.0


def style_names() -> list[str]:
    """The styles that ship with the station."""
    return shipped(STYLES)


def load_style(name_or_path: str | Path) -> Style:
    """A shipped style by its name, or a style file; raises `BadInput` with the place of the first fault."""
    path = find_shipped(name_or_path, STYLES, "style")
    with located(path):
        return _style(Table(read_toml(path), path, ""), path.stem)


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


def _style(table: Table, name: str) -> Style:
    table.only({f.name for f in fields(Style)} - {"name"} | {"title"})
    style = Style(name=name)
    values: dict[str, object] = {}
    for key in table.raw:
        if key in NUMBERS:
            values[key] = table.number(key, *range_of(key))
        elif key in WORDS:
            values[key] = table.word(key, WORDS[key], "")
    values["seed"] = table.whole("seed", 0, 2**31, style.seed)
    values["pieces"] = _amplitudes(table.table("pieces", {}))
    values["automation"] = _automation(table.table("automation", {}))
    return checked(replace(style, **values))  # type: ignore[arg-type] # each was read as its field's type


def _amplitudes(table: Table) -> Mapping[Piece, float]:
    table.only(set(_PIECES))
    return MappingProxyType({_PIECES[key]: table.number(key, 0.0, 100.0) for key in table.raw})


def _automation(table: Table) -> Mapping[str, Automation]:
    table.only({*NUMBERS, *_PIECES})
    return MappingProxyType({key: _points(table, key) for key in table.raw})


def _points(table: Table, key: str) -> Automation:
    raw = table.raw[key]
    place = f"{table.place}.{key}"
    if not isinstance(raw, list) or not raw:
        raise BadInput(table.source, place, f"expected a list of [bar, value], found {raw!r}")
    points = []
    for point in raw:
        if not isinstance(point, list) or len(point) != 2:
            raise BadInput(table.source, place, f"expected [bar, value], found {point!r}")
        bar = Table({key: point[0]}, table.source, table.place).number(key, 1.0, _MAX_BAR)
        points.append((bar, Table({key: point[1]}, table.source, table.place).number(key, *range_of(key))))
    if any(a[0] >= b[0] for a, b in pairwise(points)):
        raise BadInput(table.source, place, "the bars must rise")
    return tuple(points)


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
        if not path.exists():
            return cls()
        filled = [f"slot_{i + 1}" for i in range(SLOTS)]
        with located(path):
            table = Table(read_toml(path), path, "")
            table.only(set(filled))
            return cls(tuple(_named(table.table(key), key) if key in table.raw else None for key in filled))

    def save(self, path: Path) -> None:
        """Write all slots whole to `path`; raises `DeviceError` if the disk refuses."""
        blocks = []
        for i, style in enumerate(self.styles):
            if style is not None:
                head = [f"[slot_{i + 1}]", f"title = {_quoted(style.name)}"]
                blocks.append("\n".join([*head, *_lines(style, f"slot_{i + 1}.")]))
        write_whole(path, ("\n\n".join(blocks) + "\n").encode())


def _named(table: Table, key: str) -> Style:
    style = _style(table, key)
    title = table.raw.get("title")
    return replace(style, name=title) if isinstance(title, str) else style


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"'
