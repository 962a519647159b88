"""The line that says how two drummers stand: names, points, lives, rounds, in the band above the scene.

The first side is on the left, as they sit; the one who plays has the warm colour of the play line and a mark before
their name. Nothing moves and nothing blinks: points change where they stand.
"""

from dataclasses import replace

from station.render.palette import BRAND, INK, INK_FAINT, with_opacity
from station.render.snapshot import Hud, ScoreLine, SideLine
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

_EDGE, _FIRST, _SECOND = 26.0, 37.0, 65.0
"""As the band's other lines stand: from its side, and their base lines below its upper edge."""
_NAME, _SMALL = 30.0, 20.0
_SIDE_SHARE = 0.36
"""The most of the width that a side takes; the middle has the rest (our choice)."""
_LINE = with_opacity(INK, 0.90)
_SMALLEST = 0.6


def draw_standings(draw_list: DrawList, hud: Hud, standings: ScoreLine, width: float, k: float) -> None:
    """Draw both sides and what is between them; `k` pixels are a design pixel."""
    for side, line in enumerate(standings.sides):
        _side(draw_list, line, side == 0, width, k)
    _middle(draw_list, hud, standings.words, width, k)


def _side(draw_list: DrawList, line: SideLine, is_left: bool, width: float, k: float) -> None:
    way = 1.0 if is_left else -1.0
    edge = _EDGE * k if is_left else width - _EDGE * k
    colour = BRAND if line.is_playing else INK
    if line.is_playing:
        at = (edge + way * 7 * k, (_FIRST - 10) * k)
        draw_list.triangle(at, (7 * k, 10 * k), BRAND, 0.0 if is_left else 3.14159265)
    room = width * _SIDE_SHARE - 24 * k
    name, style = _shrunk(draw_list, line.name, TypeStyle(_NAME * k, colour, Face.BOLD, 0.0 if is_left else 1.0), room)
    draw_list.text(name, (edge + way * 22 * k, _FIRST * k), style)
    x = edge + way * 22 * k
    for life in range(line.most_lives):
        is_left_over = life < line.lives
        radius = (6.5 if is_left_over else 4.5) * k
        draw_list.ellipse((x + way * 7 * k, (_SECOND - 7) * k), (radius, radius), INK if is_left_over else INK_FAINT)
        x += way * 20 * k
    x += way * (8 * k if line.most_lives else 0)
    draw_list.text(line.points, (x, _SECOND * k), TypeStyle(_SMALL * k, _LINE, align=0.0 if is_left else 1.0))


def _middle(draw_list: DrawList, hud: Hud, words: str, width: float, k: float) -> None:
    middle, room = width / 2, width * (1 - 2 * _SIDE_SHARE) - 16 * k
    text, style = _shrunk(draw_list, words, TypeStyle(_SMALL * k, _LINE, align=0.5), room)
    draw_list.text(text, (middle, (_FIRST - 4) * k), style)
    if hud.bar is None or hud.beat is None:
        return
    x = middle - 21 * k * (hud.beats - 1) / 2
    for beat in range(1, hud.beats + 1):
        now = beat == hud.beat
        radius = (7.5 if now else 5.0) * k
        draw_list.ellipse((x, (_SECOND - 8) * k), (radius, radius), BRAND if now else INK_FAINT)
        x += 21 * k


def _shrunk(draw_list: DrawList, text: str, style: TypeStyle, room: float) -> tuple[str, TypeStyle]:
    """A line that has so much room, in letters as large as fit; cut where even the smallest do not."""
    ratio = min(room / max(draw_list.width(text, style), 1.0), 1.0)
    smaller = replace(style, size=style.size * max(ratio, _SMALLEST))
    return draw_list.fitted(text, smaller, room), smaller
