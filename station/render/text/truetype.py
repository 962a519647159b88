"""Reads glyph outlines from a TrueType font file.

Only what text on a screen needs: character map, advance widths, simple and compound outlines; no hinting, no kerning.
Outlines are closed polygons in em units, y up, baseline at 0; quadratic arcs are flattened.
Source: OpenType specification 1.9, tables cmap (formats 4 and 12), glyf, head, hhea, hmtx, loca, maxp.
"""

import struct
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput

Contours = tuple[NDArray[np.float64], ...]

_ARC_STEPS = 6
"""Chords an arc; our choice: at 50 pixels an em the chord leaves the arc by less than a twentieth of a pixel."""

_ON_CURVE, _X_SHORT, _Y_SHORT, _REPEAT, _X_SAME, _Y_SAME = 1, 2, 4, 8, 16, 32
_ARGS_ARE_WORDS, _ARGS_ARE_XY, _HAS_SCALE, _MORE, _HAS_XY_SCALE, _HAS_MATRIX = 1, 2, 8, 32, 64, 128


@dataclass(frozen=True, slots=True)
class Outline:
    """A glyph: `contours` are closed polygons (k, 2) in em units, `advance` the step to the next glyph in em."""

    contours: Contours
    advance: float


class TrueType:
    """One font face; raises `BadInput` where the file is not a TrueType font."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._data = path.read_bytes()
            self._tables = self._directory()
            self._units: int = self._unpack(">H", "head", 18)[0]
            self._long_loca = self._unpack(">h", "head", 50)[0] == 1
            self._widths: int = self._unpack(">H", "hhea", 34)[0]
            self.ascent: float = self._unpack(">h", "hhea", 4)[0] / self._units
            self.descent: float = -self._unpack(">h", "hhea", 6)[0] / self._units
        except (OSError, KeyError, struct.error) as fault:
            raise BadInput(path, "", f"not a readable TrueType font: {fault}") from fault

    def has(self, character: str) -> bool:
        """Whether the font knows this character."""
        return ord(character) in self._characters

    def outline(self, character: str) -> Outline:
        """The outline of one character; the font's own "missing" box where it lacks it."""
        glyph = self._characters.get(ord(character), 0)
        contours = tuple(_flatten(points, on) / self._units for points, on in self._contours(glyph))
        return Outline(contours, self._advance(glyph))

    # --- tables -------------------------------------------------------------------------------------------------------

    def _directory(self) -> dict[str, int]:
        (count,) = struct.unpack_from(">H", self._data, 4)
        entries = (struct.unpack_from(">4sIII", self._data, 12 + 16 * i) for i in range(count))
        return {tag.decode("latin-1"): offset for tag, _, offset, _ in entries}

    def _unpack(self, layout: str, table: str, offset: int = 0) -> tuple[int, ...]:
        return struct.unpack_from(layout, self._data, self._tables[table] + offset)

    def _array(self, kind: str, table: str, offset: int, count: int) -> NDArray[np.int64]:
        return np.frombuffer(self._data, kind, count, self._tables[table] + offset).astype(np.int64)

    @cached_property
    def _characters(self) -> dict[int, int]:
        """Glyph index of every character code."""
        (count,) = self._unpack(">H", "cmap", 2)
        subtables = {
            self._unpack(">H", "cmap", at)[0]: at
            for at in (self._unpack(">I", "cmap", 4 + 8 * i + 4)[0] for i in range(count))
        }
        if 12 in subtables:
            return self._segmented_coverage(subtables[12])
        if 4 in subtables:
            return self._segment_mapping(subtables[4])
        raise BadInput(self._path, "cmap", "no Unicode character map of format 4 or 12")

    def _segmented_coverage(self, at: int) -> dict[int, int]:
        (groups,) = self._unpack(">I", "cmap", at + 12)
        found: dict[int, int] = {}
        for i in range(groups):
            first, last, glyph = self._unpack(">III", "cmap", at + 16 + 12 * i)
            found |= {code: glyph + code - first for code in range(first, last + 1)}
        return found

    def _segment_mapping(self, at: int) -> dict[int, int]:
        count = self._unpack(">H", "cmap", at + 6)[0] // 2
        ends = self._array(">u2", "cmap", at + 14, count)
        starts = self._array(">u2", "cmap", at + 16 + 2 * count, count)
        deltas = self._array(">u2", "cmap", at + 16 + 4 * count, count)
        offsets = self._array(">u2", "cmap", at + 16 + 6 * count, count)
        found: dict[int, int] = {}
        for i, (first, last, delta, offset) in enumerate(zip(starts, ends, deltas, offsets, strict=True)):
            for code in range(int(first), int(last) + 1):
                glyph = code
                if offset:
                    place = at + 16 + 6 * count + 2 * i + int(offset) + 2 * (code - int(first))
                    glyph = self._unpack(">H", "cmap", place)[0]
                if glyph or not offset:
                    found[code] = (glyph + int(delta)) & 0xFFFF
        return found

    def _advance(self, glyph: int) -> float:
        row = min(glyph, self._widths - 1)
        return self._unpack(">H", "hmtx", 4 * row)[0] / self._units

    # --- outlines -----------------------------------------------------------------------------------------------------

    def _contours(self, glyph: int) -> list[tuple[NDArray[np.float64], NDArray[np.bool_]]]:
        """Points (k, 2) in font units and whether each is on the curve, contour by contour."""
        if self._long_loca:
            start, end = self._unpack(">II", "loca", 4 * glyph)
        else:
            start, end = (2 * v for v in self._unpack(">HH", "loca", 2 * glyph))
        if start == end:
            return []
        (count,) = self._unpack(">h", "glyf", start)
        return self._simple(start + 10, count) if count >= 0 else self._compound(start + 10)

    def _simple(self, at: int, count: int) -> list[tuple[NDArray[np.float64], NDArray[np.bool_]]]:
        ends = self._array(">u2", "glyf", at, count) + 1
        (instructions,) = self._unpack(">H", "glyf", at + 2 * count)
        cursor = at + 2 * count + 2 + instructions
        flags: list[int] = []
        while len(flags) < ends[-1]:
            flag = self._unpack(">B", "glyf", cursor)[0]
            repeats = self._unpack(">B", "glyf", cursor + 1)[0] if flag & _REPEAT else 0
            flags += [flag] * (repeats + 1)
            cursor += 2 if flag & _REPEAT else 1
        x, cursor = self._coordinates(flags, cursor, _X_SHORT, _X_SAME)
        y, _ = self._coordinates(flags, cursor, _Y_SHORT, _Y_SAME)
        points = np.stack([np.cumsum(x), np.cumsum(y)], axis=1).astype(np.float64)
        on = np.array([bool(f & _ON_CURVE) for f in flags])
        starts = [0, *ends[:-1].tolist()]
        return [(points[a:b], on[a:b]) for a, b in zip(starts, ends.tolist(), strict=True)]

    def _coordinates(self, flags: list[int], cursor: int, short: int, same: int) -> tuple[list[int], int]:
        steps: list[int] = []
        for flag in flags:
            if flag & short:
                step = self._unpack(">B", "glyf", cursor)[0]
                steps.append(step if flag & same else -step)
                cursor += 1
            elif flag & same:
                steps.append(0)
            else:
                steps.append(self._unpack(">h", "glyf", cursor)[0])
                cursor += 2
        return steps, cursor

    def _compound(self, at: int) -> list[tuple[NDArray[np.float64], NDArray[np.bool_]]]:
        parts: list[tuple[NDArray[np.float64], NDArray[np.bool_]]] = []
        more = True
        while more:
            flags, glyph = self._unpack(">HH", "glyf", at)
            words = bool(flags & _ARGS_ARE_WORDS)
            shift = self._unpack(">hh" if words else ">bb", "glyf", at + 4) if flags & _ARGS_ARE_XY else (0, 0)
            at += 8 if words else 6
            matrix, size = self._scale(flags, at)
            at += size
            parts += [(points @ matrix + np.array(shift), on) for points, on in self._contours(glyph)]
            more = bool(flags & _MORE)
        return parts

    def _scale(self, flags: int, at: int) -> tuple[NDArray[np.float64], int]:
        count = 1 if flags & _HAS_SCALE else 2 if flags & _HAS_XY_SCALE else 4 if flags & _HAS_MATRIX else 0
        v = [value / 16384 for value in self._unpack(f">{count}h", "glyf", at)]
        if count == 1:
            return np.diag([v[0], v[0]]), 2
        if count == 2:
            return np.diag(v), 4
        return (np.array(v).reshape(2, 2), 8) if count else (np.eye(2), 0)


def _flatten(points: NDArray[np.float64], on: NDArray[np.bool_]) -> NDArray[np.float64]:
    """A closed polygon (k, 2) from on-curve and quadratic control points; two controls in a row imply their middle."""
    full: list[tuple[NDArray[np.float64], bool]] = []
    for i in range(len(points)):
        if not on[i] and not on[i - 1]:
            full.append(((points[i - 1] + points[i]) / 2, True))
        full.append((points[i], bool(on[i])))
    first = next(i for i, (_, is_on) in enumerate(full) if is_on)
    full = full[first:] + full[: first + 1]
    polygon = [full[0][0]]
    t = np.linspace(0, 1, _ARC_STEPS + 1)[1:, None]
    for (before, _), (middle, is_on), (after, _) in zip(full, full[1:], [*full[2:], full[1]], strict=False):
        if not is_on:
            polygon.extend((1 - t) ** 2 * before + 2 * t * (1 - t) * middle + t**2 * after)
        elif not np.array_equal(middle, polygon[-1]):
            polygon.append(middle)
    return np.array(polygon)
