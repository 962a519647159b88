"""Finds in what imgui has drawn what a user cannot read: letters that are cut off, letters over letters.

Every letter is a rectangle with a place in the fonts' texture. One that shows less of the texture than its font has for
it was cut by a control's frame; one that reaches past what its draw command may fill is cut by the graphics card. A cut
exactly between two letters is not seen, so look at several sizes. What can be scrolled to is not cut off, and the
picture behind the panels is not imgui's.
"""

import ctypes
import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from station.gui import theme

_VERTEX = np.dtype([("at", "<f4", 2), ("uv", "<f4", 2), ("colour", "<u4")])
_SLACK = 1.0
"""Pixels that a letter's soft edge may lose."""
_SOFT = 0.5
"""Pixels of a letter's rectangle on each side that its soft edge alone has: they are whole pixels, letters are not.
An l or a ; of 14 pixels is two wide, and shares one with an f or a k before it."""
_MOST_SHARED = 0.35
"""How much of a letter another may cover: neighbours touch by less."""
_RECTANGLE = np.array([0, 1, 2, 0, 2, 3])
_NONE = " "
LEFT, TOP, RIGHT, BOTTOM = range(4)

Boxes = NDArray[np.float64]
"""n × left, top, right, bottom."""


@dataclass(frozen=True, slots=True)
class Letters:
    """What one window shows: letters on the screen, in the texture (`uv`), and what may be filled where they are."""

    window: str
    at: Boxes
    uv: Boxes
    clip: Boxes


class Font:
    """Where each letter that was ever drawn is in the fonts' texture."""

    def __init__(self, sizes: Iterable[float]) -> None:
        glyphs = [glyph for size in sizes for glyph in imgui.get_font().get_font_baked(size).glyphs]
        self._letters = [chr(glyph.get_codepoint()) for glyph in glyphs]
        self._uv = np.array([(glyph.u0, glyph.v0, glyph.u1, glyph.v1) for glyph in glyphs]).reshape(-1, 4)

    def read(self, uv: Boxes) -> tuple[str, NDArray[np.bool_]]:
        """The letters at these places, and which of them are not whole; what is none, a mouse pointer, is a blank."""
        if not len(self._uv) or not len(uv):
            return _NONE * len(uv), np.zeros(len(uv), np.bool_)
        pixel = 1e-5
        inside = (uv[:, None, :2] >= self._uv[:, :2] - pixel) & (uv[:, None, 2:] <= self._uv[:, 2:] + pixel)
        is_of = np.asarray(inside.all(axis=2))
        which = is_of.argmax(axis=1)
        known = is_of[np.arange(len(uv)), which]
        text = "".join(
            self._letters[index] if is_known else _NONE for index, is_known in zip(which, known, strict=True)
        )
        lost = (self._uv[which] - uv) * (-1, -1, 1, 1)
        high = np.maximum(uv[:, 3] - uv[:, 1], pixel)
        return text, known & (lost.max(axis=1) / high > 0.12)


def letters(data: imgui.ImDrawData) -> Iterator[Letters]:
    """The letters of each window, in the order in which windows are drawn."""
    for drawn in data.cmd_lists:
        if not drawn.vtx_buffer.size() or drawn._owner_name.startswith("##"):  # the foreground has the mouse pointer
            continue
        corners = _array(drawn.vtx_buffer, _VERTEX)
        order = _array(drawn.idx_buffer, np.dtype(f"<u{imgui.INDEX_SIZE}")).astype(np.int64)
        parts = [
            _of_command(corners, order[first : first + count] + offset, clip)
            for first, count, offset, clip in (
                (command.idx_offset, command.elem_count, command.vtx_offset, command.clip_rect)
                for command in drawn.cmd_buffer
            )
        ]
        at, uv, clip = (np.concatenate(part) for part in zip(*parts, strict=True))
        yield Letters(drawn._owner_name, at, uv, clip)


def _array(vector: "imgui.ImVector_ImDrawVert | imgui.ImVector_ImDrawIdx", kind: "np.dtype[Any]") -> NDArray[Any]:
    held = (ctypes.c_ubyte * (vector.size() * kind.itemsize)).from_address(vector.data_address())
    return np.frombuffer(bytes(held), kind)


def _of_command(corners: NDArray[Any], order: NDArray[np.int64], clip: imgui.ImVec4) -> tuple[Boxes, Boxes, Boxes]:
    """The rectangles of one draw command that show a part of the texture; lines and plain surfaces show a point."""
    starts = np.arange(0, max(len(order) - 5, 0), 3)
    runs = order[starts[:, None] + np.arange(6)] if len(starts) else np.empty((0, 6), np.int64)
    runs = runs[(runs - runs[:, :1] == _RECTANGLE).all(axis=1)]
    four = corners[runs[:, :1] + np.arange(4)] if len(runs) else np.empty((0, 4), _VERTEX)
    boxes = [np.concatenate([four[name][:, 0], four[name][:, 2]], axis=1).astype(np.float64) for name in ("at", "uv")]
    wide = [(box[:, RIGHT] > box[:, LEFT]) & (box[:, BOTTOM] > box[:, TOP]) for box in boxes]
    upright = four["at"][:, 0, 1] == four["at"][:, 1, 1]
    kept = wide[0] & wide[1] & upright
    return boxes[0][kept], boxes[1][kept], np.tile(np.array([*clip], np.float64), (int(kept.sum()), 1))


def faults(data: imgui.ImDrawData, sizes: Sequence[float]) -> list[str]:
    """What a user cannot read in what was drawn last with fonts of these `sizes`, a line each."""
    font = Font(sizes)
    return [line for seen in letters(data) for line in [*_cut(seen, font), *_covered(seen, font)]]


def present_faults() -> list[str]:
    """What cannot be read of the frame that was drawn last."""
    grown = imgui.get_style().font_scale_main * imgui.get_style().font_scale_dpi
    plain = [theme.FONT_SIZE, theme.LARGE_FONT_SIZE]
    return faults(imgui.get_draw_data(), [size * grown for size in plain])


def _cut(seen: Letters, font: Font) -> Iterator[str]:
    text, is_cut = font.read(seen.uv)
    scrolls = _scrolls(seen.window)
    seen_at_all = (
        (seen.at[:, RIGHT] > seen.clip[:, LEFT])
        & (seen.at[:, LEFT] < seen.clip[:, RIGHT])
        & (seen.at[:, BOTTOM] > seen.clip[:, TOP])
        & (seen.at[:, TOP] < seen.clip[:, BOTTOM])
    )
    past_x = (seen.at[:, LEFT] < seen.clip[:, LEFT] - _SLACK) | (seen.at[:, RIGHT] > seen.clip[:, RIGHT] + _SLACK)
    past_y = (seen.at[:, TOP] < seen.clip[:, TOP] - _SLACK) | (seen.at[:, BOTTOM] > seen.clip[:, BOTTOM] + _SLACK)
    past_x &= ~((seen.at[:, RIGHT] > seen.clip[:, RIGHT]) & (seen.clip[:, RIGHT] >= _scrolled_edge(seen.window)))
    past = past_x | (past_y & (not scrolls))
    lost = past & ~seen_at_all & (past_x if scrolls else past)
    for index in np.flatnonzero((past & seen_at_all) | is_cut | lost).tolist():
        yield _told("cut off", seen, index, text)


def _covered(seen: Letters, font: Font) -> Iterator[str]:
    text, _ = font.read(seen.uv)
    at = np.concatenate([np.maximum(seen.at[:, :2], seen.clip[:, :2]), np.minimum(seen.at[:, 2:], seen.clip[:, 2:])], 1)
    at += np.array([_SOFT, _SOFT, -_SOFT, -_SOFT])
    area = np.prod(np.maximum(at[:, 2:] - at[:, :2], 0.0), axis=1)
    for index in np.flatnonzero(area > 0).tolist():
        rest = at[index + 1 :]
        both = np.minimum(at[index, 2:], rest[:, 2:]) - np.maximum(at[index, :2], rest[:, :2])
        shared = np.prod(np.maximum(both, 0.0), axis=1)
        if (shared > _MOST_SHARED * np.minimum(area[index], np.maximum(area[index + 1 :], 1e-6))).any():
            yield _told("written over", seen, index, text)


def _scrolls(name: str) -> bool:
    """Whether a window, or one that it is in, shows a part of what it has, and the rest by scrolling."""
    window: imgui.internal.Window | None = imgui.internal.find_window_by_name(name)
    while window is not None:
        if window.scroll_max.y > 0 and not window.flags & imgui.WindowFlags_.no_scrollbar:
            return True
        window = window.parent_window
    return False


def _scrolled_edge(name: str) -> float:
    """Where the right edge of a window lies behind which there is more to scroll to; infinity for others."""
    window: imgui.internal.Window | None = imgui.internal.find_window_by_name(name)
    if window is None or window.scroll_max.x <= 0:
        return math.inf
    return float(window.inner_clip_rect.max.x) - _SLACK


def _told(what: str, seen: Letters, index: int, text: str) -> str:
    x, y = seen.at[index, :2]
    near = text[max(index - 12, 0) : index + 6]
    return f"{seen.window.split('/')[0]}: {text[index]!r} is {what} at {x:.0f}, {y:.0f}, in …{near}…"
