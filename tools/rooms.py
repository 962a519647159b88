"""Draws the rooms of the house: `python tools/rooms.py` writes docs/pictures/rooms.svg from the code's own imports.

A box is a room (a package of `station`), as wide as it has lines, with the smaller rooms inside it; rows are the layers
that import-linter keeps (`pyproject.toml`), the top first. An arrow runs from a room to each room below that it imports
and that no other import of its own reaches already. `--check` prints the figures alone: rooms, levels, arrows back up,
circles, the largest folder, lines.
"""

import argparse
import ast
import sys
import textwrap
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from html import escape
from pathlib import Path

import grimp

ROOT = Path(__file__).parent.parent
PICTURE = ROOT / "docs" / "pictures" / "rooms.svg"
WIDTH, MARGIN, ROW, GAP, HEAD = 1400, 20, 128, 18, 60
"""Pixels: the picture, its rim, a row of boxes with the space below it, between boxes, above the first row."""
LEAST, BOX = 300, 84
"""A box's least width, and its height."""
SHIFTS = (-190, 480, -190, 190, -190, 190, 0, 190, 0, 190, -190)
"""How far right of the middle a row of one box stands, so that no arrow runs behind a box that it skips."""
INK, PAPER, FILL, FAINT = "#20242c", "#fbfaf7", "#f0e6d6", "#b08a5a"


@dataclass(frozen=True, slots=True)
class Box:
    """A room on the picture: its corner and width in pixels, what is written in it."""

    name: str
    x: float
    y: float
    width: float
    lines: int
    purpose: str
    inside: tuple[str, ...]


def layers() -> list[list[str]]:
    """The layers of the house from the top down, as import-linter keeps them."""
    table = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    contract = next(c for c in table["tool"]["importlinter"]["contracts"] if c["type"] == "layers")
    return [[room.strip() for room in layer.split("|")] for layer in contract["layers"]]


def lines_of(folder: Path) -> int:
    """Lines of Python below `folder`."""
    return sum(len(path.read_text(encoding="utf-8").splitlines()) for path in folder.rglob("*.py"))


def imports(graph: grimp.ImportGraph, rooms: Iterable[str]) -> dict[str, set[str]]:
    """For each room the rooms whose modules its own import."""
    rooms = list(rooms)
    below: dict[str, set[str]] = {room: set() for room in rooms}
    for module in graph.modules:
        room = _room(module)
        if room in below:
            below[room] |= {_room(found) for found in graph.find_modules_directly_imported_by(module)} & set(rooms)
    return {room: found - {room} for room, found in below.items()}


def needed(below: dict[str, set[str]]) -> list[tuple[str, str]]:
    """The arrows that no way through other rooms makes superfluous."""

    def reach(room: str) -> set[str]:
        return below[room].union(*(reach(other) for other in below[room])) if below[room] else set()

    return [
        (room, other)
        for room, others in below.items()
        for other in sorted(others)
        if not any(other in reach(third) for third in others - {other})
    ]


def back_up(below: dict[str, set[str]], levels: list[list[str]]) -> list[tuple[str, str]]:
    """Arrows that do not go down."""
    level = {room: row for row, layer in enumerate(levels) for room in layer}
    return [(room, other) for room, others in below.items() for other in others if level[other] <= level[room]]


def boxes(levels: list[list[str]]) -> dict[str, Box]:
    """Where every room lies, rows from the top."""
    placed: dict[str, Box] = {}
    for row, layer in enumerate(levels):
        lines = [lines_of(ROOT / "station" / room) for room in layer]
        free = WIDTH - 2 * MARGIN - GAP * (len(layer) - 1)
        shares = [max(LEAST, min(free / len(layer), free * count / 16_000)) for count in lines]
        x = (WIDTH - sum(shares) - GAP * (len(layer) - 1)) / 2
        if len(layer) == 1:
            x += SHIFTS[row]
        for room, width, count in zip(layer, shares, lines, strict=True):
            folder = ROOT / "station" / room
            inside = tuple(sorted(p.parent.name for p in folder.glob("*/__init__.py")))
            placed[room] = Box(room, x, HEAD + row * ROW, width, count, _purpose(folder), inside)
            x += width + GAP
    return placed


def svg(placed: dict[str, Box], arrows: list[tuple[str, str]]) -> str:
    """The picture."""
    height = max(box.y for box in placed.values()) + BOX + MARGIN
    body = [_arrow(placed[a], placed[b]) for a, b in arrows]
    body += [part for box in placed.values() for part in _drawn(box)]
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height:.0f}" font-family="sans-serif">',
            f'<rect width="100%" height="100%" fill="{PAPER}"/>',
            f'<text x="{MARGIN}" y="34" font-size="20" fill="{INK}">The rooms of the drum station: '
            "an arrow means “imports”, and goes only down</text>",
            *body,
            "</svg>\n",
        ]
    )


def _drawn(box: Box) -> list[str]:
    size = f'width="{box.width:.0f}" height="{BOX}" rx="6"'
    rect = f'<rect x="{box.x:.0f}" y="{box.y}" {size} fill="{FILL}" stroke="{INK}"/>'
    left, least = box.x + 10, 6.3
    words = [f'<text x="{left:.0f}" y="{box.y + 22}" font-size="16" fill="{INK}"><tspan font-weight="bold">{box.name}'
             f'</tspan> <tspan font-size="12">{box.lines:,} lines</tspan></text>']  # fmt: skip
    width = int((box.width - 20) / least)
    rows = textwrap.wrap(box.purpose, width, max_lines=2, placeholder=" …")
    rows += textwrap.wrap(", ".join(box.inside), width, max_lines=3 - len(rows), placeholder=" …")
    for row, text in enumerate(rows):
        y = box.y + 42 + 16 * row
        words.append(f'<text x="{left:.0f}" y="{y}" font-size="12" fill="{INK}">{escape(text)}</text>')
    return [rect, *words]


def _purpose(folder: Path) -> str:
    head = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
    return head.partition("\n")[0].replace("`", "").removesuffix(".")


def _arrow(top: Box, low: Box) -> str:
    x, y, to_x, to_y = top.x + top.width / 2, top.y + BOX, low.x + low.width / 2, low.y
    bend = 24 + 0.25 * (to_y - y)
    return (
        f'<path d="M{x:.0f} {y} C{x:.0f} {y + bend:.0f} {to_x:.0f} {to_y - bend:.0f} {to_x:.0f} {to_y}" '
        f'fill="none" stroke="{FAINT}" stroke-width="1.6"/><path d="M{to_x:.0f} {to_y} l-4 -9 h8 z" fill="{FAINT}"/>'
    )


def _room(module: str) -> str:
    return module.partition(".")[2].partition(".")[0]


def figures(graph: grimp.ImportGraph, levels: list[list[str]], below: dict[str, set[str]]) -> str:
    """The structure in numbers, a line each."""
    folders = {path.parent for path in (ROOT / "station").rglob("*.py")}
    counts = {folder: len([p for p in folder.glob("*.py") if p.name != "__init__.py"]) for folder in folders}
    largest = max(counts, key=lambda folder: counts[folder])
    circles = sum(
        len(graph.nominate_cycle_breakers(package)) > 0
        for package in sorted({m.rpartition(".")[0] for m in graph.modules} - {""})
    )
    return "\n".join(
        [
            f"rooms {sum(map(len, levels))}, with those inside {len(folders) - 1}",
            f"levels {len(levels)}",
            f"arrows back up {len(back_up(below, levels))}",
            f"packages with a circle {circles}",
            f"largest folder {largest.relative_to(ROOT)}: {counts[largest]} files",
            f"files {sum(counts.values())}, lines {lines_of(ROOT / 'station'):,}",
        ]
    )


def main() -> None:
    """Draw the picture, or print the figures."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--check", action="store_true", help="print the figures alone")
    levels = layers()
    graph = grimp.build_graph("station", cache_dir=None)
    below = imports(graph, [room for layer in levels for room in layer])
    if not parser.parse_args().check:
        down = {
            room: found - {other for up, other in back_up(below, levels) if up == room} for room, found in below.items()
        }
        PICTURE.write_text(svg(boxes(levels), needed(down)), encoding="utf-8")
    sys.stdout.write(f"{figures(graph, levels, below)}\n")


if __name__ == "__main__":
    main()
