"""The board below the picture while a battle runs: who is on, and what the turns of the last round were worth.

Letters grow with the picture, so that both who play and those who watch read them from two metres and more. Points and
lives stand above the stage, in the picture.
"""

from collections.abc import Sequence

from imgui_bundle import imgui

from station.app.battle.battle_shown import BoardShown, Evidence, Verdict
from station.gui import theme
from station.gui.widgets.large_letters import broken, cut, draw_text
from station.gui.widgets.picture_box import Box
from station.render import palette
from station.render.painter import Area

BOARD = "Battle board"
LARGE, LEAST = 0.052, 19.0
"""A line's height as a share of the picture's, and the least in design pixels: those of `choice_panel`."""
_BAND, _LEAST_BAND = 0.22, 112.0
"""The share of the picture's height that the board takes (our choice: five lines, and the stage above stays whole), and
the least in design pixels."""
_HEAD = 1.25
_SMALL, _LEAST_SMALL = 0.62, 15.0
"""What goes on, and what was seen, in heights of a line; the least of the latter."""
_AIR, _LINE = 12.0, 6.0
"""Design pixels around everything, and of the line that says how much of a turn is over."""
_MOST_LINES = 2
"""What was seen in a turn has so many lines (our choice: one looks up for a moment between two bars)."""


def board_height(picture: Area) -> int:
    """The pixels below `picture` that the board takes."""
    least = round(theme.points(_LEAST_BAND) * imgui.get_io().display_framebuffer_scale.y)
    return min(max(round(_BAND * picture[3]), least), picture[3] // 2)


def draw_board(board: BoardShown, box: Box, picture_height: float) -> None:
    """Draw it into the present window, which lies at `box` below a picture of that height."""
    large = max(LARGE * picture_height, theme.points(LEAST))
    small = max(_SMALL * large, theme.points(_LEAST_SMALL))
    air = theme.points(_AIR)
    inner = Box(box.left + air, box.top + air / 2, box.width - 2 * air, box.height - air)
    imgui.dummy(imgui.ImVec2(1, 1))
    top = inner.top + _head(board, inner, min(_HEAD * large, 0.4 * box.height), small)
    room = inner.top + inner.height - top
    if room < 2 * small:  # a window that is just being made smaller
        return
    wide = (inner.width - air) / max(len(board.verdicts), 1)
    for place, verdict in enumerate(board.verdicts):
        left = inner.left + place * (wide + air)
        _verdict(verdict, Box(left, top, wide - air, room), large, small)


def _head(board: BoardShown, box: Box, head: float, small: float) -> float:
    """What goes on, and how much of the turn is over; returns how high that is."""
    draw_text(cut(board.headline, box.width, head), imgui.ImVec2(box.left, box.top), head, theme.packed(palette.INK))
    _progress(board.share, Box(box.left, box.top + 1.12 * head, box.width, theme.points(_LINE)))
    return 1.12 * head + theme.points(_LINE) + 0.3 * small


def _progress(share: float | None, box: Box) -> None:
    """A thin line that fills as the turn goes by."""
    brush, round_ = imgui.get_window_draw_list(), box.height / 2
    low, foot = imgui.ImVec2(box.left, box.top), box.top + box.height
    ground = theme.packed(palette.with_opacity(palette.INK, 0.12))
    brush.add_rect_filled(low, imgui.ImVec2(box.left + box.width, foot), ground, round_)
    if share is not None and share > 0:
        right = box.left + max(share * box.width, box.height)
        brush.add_rect_filled(low, imgui.ImVec2(right, foot), theme.packed(palette.BRAND), round_)


def _verdict(verdict: Verdict, box: Box, large: float, small: float) -> None:
    """What a turn was worth and, of what was seen in it, the best and the worst."""
    size = min(0.9 * large, box.height / 2)
    at = imgui.ImVec2(box.left, box.top)
    draw_text(cut(f"{verdict.side}: {verdict.points}", box.width, size), at, size, theme.packed(palette.INK))
    top = box.top + 1.15 * size
    words = " · ".join(evidence_words(each) for each in telling_of(verdict.evidence))
    for text in broken(words, box.width, small)[:_MOST_LINES]:
        if top + small > box.top + box.height:
            return
        draw_text(text, imgui.ImVec2(box.left, top), small, theme.packed(palette.INK_SOFT))
        top += 1.15 * small


def telling_of(evidence: Sequence[Evidence]) -> tuple[Evidence, ...]:
    """What is strongest and what is weakest; the first where nothing has marks."""
    judged = [each for each in evidence if each.marks is not None]
    if len(judged) < _MOST_LINES:
        return tuple(judged or evidence[:_MOST_LINES])
    ranked = sorted(judged, key=lambda each: -(each.marks or 0.0))
    return ranked[0], ranked[-1]


def evidence_words(evidence: Evidence) -> str:
    """The part with its marks, and what was seen; that alone where nothing has marks."""
    if evidence.marks is None:
        return evidence.words
    return f"{evidence.title} {evidence.marks:.0f}{f': {evidence.words}' if evidence.words else ''}"
