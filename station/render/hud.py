"""What is written over the scene: lesson, phase, tempo, beat, count-in, what halts it, the one coarse cue, a message.

Sizes are design pixels. They grow with the picture, which is 720 of them high, so that everything can be read two
metres away; or with the panels' letters beside it, as far as the picture is large enough (`scale`). Title, phase, tempo
and beat stand on a band of their own above the scene, which never lies over a drum.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.render.palette import (
    BRAND,
    EARLY,
    GOOD,
    INK,
    INK_FAINT,
    LATE,
    MISSED,
    NIGHT,
    PANEL,
    WRONG,
    with_opacity,
)
from station.render.snapshot import Hud, TimingCue
from station.render.standings import draw_standings
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

_DESIGN_HEIGHT = 720.0
_EDGE = 26.0
_HALO = with_opacity(NIGHT, 0.95)
_LINE = with_opacity(INK, 0.90)
"""The small lines: fainter than the title, and still read over a cymbal."""
_CUE_HOLD_S, _CUE_FADE_S = 0.45, 0.55
"""A cue stands and then fades (our choice: gone before the next bar at usual tempos)."""


@dataclass(frozen=True, slots=True)
class _CueLook:
    word: str
    colour: Colour
    way: int  # −1 arrow to the left, 1 to the right, 0 none


_CUES = {
    TimingCue.ON_TIME: _CueLook("on time", GOOD, 0),
    TimingCue.EARLY: _CueLook("early", EARLY, -1),
    TimingCue.LATE: _CueLook("late", LATE, 1),
    TimingCue.MISSED: _CueLook("missed", MISSED, 0),
    TimingCue.WRONG_PIECE: _CueLook("wrong pad", WRONG, 0),
}


def hud_lines(hud: Hud, atlas: Atlas, size: tuple[float, float], letters: float | None = None) -> NDArray[np.void]:
    """Of the HUD what stands in the band: letters alone, which change once a beat.

    The picture area has `size` pixels (width, height above the score), its origin top left; `letters` as for `scale`.
    """
    return _HudPage(hud, DrawList(atlas), size, letters).lines()


def corners(hud: Hud) -> Hud:
    """What `hud_lines` shows of `hud`, and nothing else."""
    return replace(hud, count_in=None, cue=TimingCue.NONE, cue_age_s=0.0, message="", say="", halt="", way_on="")


def hud_calls(hud: Hud, atlas: Atlas, size: tuple[float, float], letters: float | None = None) -> NDArray[np.void]:
    """Of the HUD what stands in the middle for a while: count-in, cue, message."""
    return _HudPage(hud, DrawList(atlas), size, letters).calls()


BAND = 78.0
"""Design pixels of the band of the upper lines."""
_BAND_SHARE = 0.2
"""The most of a picture's height that the band takes with the panels' letters (our choice)."""
_FIRST, _SECOND = 37.0, 65.0
"""Base lines of the band's two lines, below its upper edge."""
_SECOND_SIZE = 20.0


def scale(height: float, letters: float | None = None) -> float:
    """Pixels a design pixel where scene and band are `height` pixels high.

    `letters` is how large they are to be beside panels; None for as large as the picture is.
    """
    if letters is None:
        return max(height / (_DESIGN_HEIGHT * 0.70), 0.4)
    return max(min(letters, _BAND_SHARE * height / BAND), 0.4)


def band_height(hud: Hud, size: tuple[float, float], letters: float | None = None) -> int:
    """Pixels of the band above the scene; none where no words stand there. `size` as for `hud_lines`."""
    has_words = bool(hud.title or hud.phase or hud.standings or hud.bar is not None or hud.beats_a_minute is not None)
    return round(BAND * scale(size[1], letters)) if has_words and _has_room(size) else 0


FreeLine = tuple[float, float, float]
"""From x to x, and how far below the picture's upper edge its middle is; pixels."""


def free_line(hud: Hud, atlas: Atlas, size: tuple[float, float], letters: float | None) -> FreeLine:
    """Where the band's lower line has no words."""
    return _HudPage(hud, DrawList(atlas), size, letters).free_line()


_SAID, _SAID_LINES = 36.0, 2
"""A teacher's words are the largest after the count-in's number: they are read over the drums (our choice)."""

_HALT = 76.0
"""The word that stands while nothing moves: half the count-in's number, read across a room (our choice)."""

_NAMES = ("Demonstrator", "You")


def name_shapes(atlas: Atlas, size: tuple[float, float], band: float, letters: float | None) -> NDArray[np.void]:
    """Who is who in two pictures side by side, and the line between them below the band; else as `hud_lines`."""
    draw_list, (width, height), k = DrawList(atlas), size, scale(size[1], letters)
    draw_list.box((width / 2 - k, band), (2 * k, height - band), INK_FAINT)
    for name, middle in zip(_NAMES, (0.25, 0.75), strict=True):
        draw_list.text(name, (middle * width, height - 16 * k), TypeStyle(20 * k, INK, Face.BOLD, 0.5, _HALO))
    return draw_list.shapes()


_LEAST = 150.0, 100.0
"""A scene smaller than that, in pixels, shows no words: they would cover it, and each other (our choice)."""


_SMALLEST = 0.65
"""How small letters are made where there is little room, of their size, before words are cut (our choice)."""


def _has_room(size: tuple[float, float]) -> bool:
    return size[0] >= _LEAST[0] and size[1] >= _LEAST[1]


_TEMPO_SHARE = 0.34
"""The most of the band's width that the words about the tempo take (our choice: the title has the rest)."""
_PLACE_SHARE = 0.62
"""The most of the band's width that bar, beat and what was right take (our choice: the phase has the rest)."""


def _places(hud: Hud) -> list[str]:
    """How much was right and which bar this is, in more words and in fewer."""
    bar = f"bar {hud.bar}"
    bars = f"{bar} of {hud.bar_count}" if hud.bar_count else bar
    if not hud.judged:
        return [bars, bar]
    right = f"{hud.right} of {hud.judged} right"
    return [f"{right} · {bars}", f"{right} · {bar}", right]


class _HudPage:
    def __init__(self, hud: Hud, draw_list: DrawList, size: tuple[float, float], letters: float | None) -> None:
        self._hud, self._draw_list = hud, draw_list
        self._k = scale(size[1], letters)
        self._size = self._width, self._height = size

    def lines(self) -> NDArray[np.void]:
        if _has_room(self._size) and self._hud.standings is not None:
            draw_standings(self._draw_list, self._hud, self._hud.standings, self._width, self._k)
        elif _has_room(self._size):
            self._title(self._tempo())
            self._phase(self._place())
        return self._draw_list.shapes()

    def free_line(self) -> FreeLine:
        """From the phase's end to where the place begins, and the middle of that line; nowhere between standings."""
        if self._hud.standings is not None:
            return self._width / 2, self._width / 2, (_SECOND - 0.35 * _SECOND_SIZE) * self._k
        right = self._place()
        return self._phase(right), right, (_SECOND - 0.35 * _SECOND_SIZE) * self._k

    def calls(self) -> NDArray[np.void]:
        if not _has_room(self._size):
            return self._draw_list.shapes()
        bottom = self._say() if self._hud.say else self._height
        if self._hud.halt:
            self._halt()
        elif self._hud.count_in is not None:
            self._count_in(self._hud.count_in)
        elif self._hud.cue is not TimingCue.NONE:
            self._cue(_CUES[self._hud.cue], bottom)
        if self._hud.message:
            self._message()
        return self._draw_list.shapes()

    def _title(self, right: float) -> None:
        """The title as far as `right`, in smaller letters before it is cut."""
        k = self._k
        title = TypeStyle(30 * k, INK, Face.BOLD)
        text, style = self._shrunk(self._hud.title, title, right - 2 * _EDGE * k)
        self._draw_list.text(text, (_EDGE * k, _FIRST * k), style)

    def _phase(self, right: float) -> float:
        """The phase under the title, as far as `right`; returns where it ends."""
        k, left = self._k, (_EDGE + 20) * self._k
        if not self._hud.phase:
            return _EDGE * k
        self._draw_list.ellipse(((_EDGE + 6) * k, (_SECOND - 7) * k), (6 * k, 6 * k), BRAND)
        phase = TypeStyle(_SECOND_SIZE * k, _LINE)
        words = " · ".join(filter(None, (self._hud.phase, self._hud.reason)))
        text, style = self._shrunk(words, phase, right - left - 12 * k)
        return left + self._draw_list.text(text, (left, _SECOND * k), style) + 12 * k

    def _shrunk(self, text: str, style: TypeStyle, room: float) -> tuple[str, TypeStyle]:
        """A line that has so much room, in letters as large as fit; cut where even the smallest do not."""
        ratio = min(room / max(self._draw_list.width(text, style), 1.0), 1.0)
        smaller = replace(style, size=style.size * max(ratio, _SMALLEST))
        return self._draw_list.fitted(text, smaller, room), smaller

    def _tempo(self) -> float:
        """The tempo in the corner, what explains it before it; returns where it begins."""
        k, hud = self._k, self._hud
        right = self._width - _EDGE * k
        if hud.beats_a_minute is None:
            return right
        right -= self._draw_list.text("bpm", (right, _FIRST * k), TypeStyle(17 * k, _LINE, align=1.0)) + 6 * k
        tempo = TypeStyle(34 * k, INK, Face.BOLD, 1.0)
        right -= self._draw_list.text(f"{hud.beats_a_minute:.0f}", (right, _FIRST * k), tempo)
        if not hud.tempo_words:
            return right
        right -= 14 * k
        words, style = self._shrunk(hud.tempo_words, TypeStyle(18 * k, _LINE, align=1.0), self._width * _TEMPO_SHARE)
        return right - self._draw_list.text(words, (right, _FIRST * k), style)

    def _place(self) -> float:
        """Beat, bar and how much was right, under the tempo; returns where they begin."""
        k, hud = self._k, self._hud
        right = self._width - _EDGE * k
        if hud.bar is None or hud.beat is None:
            return right
        x = right - 7 * k
        for beat in range(hud.beats, 0, -1):
            now = beat == hud.beat
            size = (7.5 if now else 5.0) * k
            self._draw_list.ellipse((x, (_SECOND - 6) * k), (size, size), (BRAND if now else INK_FAINT))
            x -= 21 * k
        style, room = TypeStyle(_SECOND_SIZE * k, _LINE, align=1.0), x - self._width * (1 - _PLACE_SHARE)
        words = next((words for words in _places(hud) if self._draw_list.width(words, style) <= room), "")
        return x - 6 * k - self._draw_list.text(words, (x - 6 * k, _SECOND * k), style) - 12 * k

    def _halt(self) -> None:
        """What is to be read from afar while nothing moves, and how to go on."""
        k, hud, middle = self._k, self._hud, (self._width / 2, self._height * 0.52)
        room = self._width - 4 * _EDGE * k
        word, style = self._shrunk(hud.halt, TypeStyle(_HALT * k, INK, Face.BOLD, 0.5), room)
        way, small = self._shrunk(hud.way_on, TypeStyle(26 * k, INK, Face.REGULAR, 0.5), room)
        widths = self._draw_list.width(word, style), self._draw_list.width(way, small)
        width, height = max(widths) + 2 * _EDGE * k, (158 if way else 112) * k
        top = middle[1] - height / 2
        self._draw_list.box((middle[0] - width / 2, top), (width, height), PANEL, None, (16 * k, 0.0, 0.0))
        self._draw_list.text(word, (middle[0], top + 82 * k), style)
        if way:
            self._draw_list.text(way, (middle[0], top + 130 * k), small)

    def _count_in(self, number: int) -> None:
        k, centre = self._k, (self._width / 2, self._height * 0.52)
        self._draw_list.ellipse(centre, (96 * k, 96 * k), with_opacity(NIGHT, 0.62))
        self._draw_list.ellipse(centre, (96 * k, 96 * k), with_opacity(BRAND, 0.9), 0.0, (0.0, 5 * k, 0.0))
        self._draw_list.text(str(number), (centre[0], centre[1] + 47 * k), TypeStyle(132 * k, INK, Face.BOLD, 0.5))

    def _cue(self, look: _CueLook, bottom: float) -> None:
        left = 1 - (self._hud.cue_age_s - _CUE_HOLD_S) / _CUE_FADE_S
        opacity = float(np.clip(left, 0.0, 1.0))
        if opacity <= 0:
            return
        k, style = self._k, TypeStyle(40 * self._k, with_opacity(look.colour, opacity), Face.BOLD, 0.5)
        text = self._draw_list.width(look.word, style)
        width = text + (2 * 46 if look.way else 52) * k
        x, y = self._width / 2, bottom - 52 * k
        panel = with_opacity(PANEL, opacity)
        self._draw_list.box((x - width / 2, y - 31 * k), (width, 62 * k), panel, None, (31 * k, 0.0, 0.0))
        self._draw_list.text(look.word, (x, y + 14 * k), style)
        if look.way:
            at = (x + look.way * (text / 2 + 20 * k), y)
            self._draw_list.triangle(at, (9 * k, 13 * k), style.colour, 0.0 if look.way > 0 else np.pi)

    def _say(self) -> float:
        """The teacher's words, large, in `_SAID_LINES` at the most, at the lower edge; returns where they begin."""
        k, style = self._k, TypeStyle(_SAID * self._k, INK, Face.BOLD, 0.5)
        room = self._width - 4 * _EDGE * k
        if len(self._draw_list.broken(self._hud.say, style, room)) > _SAID_LINES:
            style = replace(style, size=style.size * _SMALLEST)
        lines = self._draw_list.broken(self._hud.say, style, room)
        if len(lines) > _SAID_LINES:
            rest = " ".join(lines[_SAID_LINES - 1 :])
            lines = [*lines[: _SAID_LINES - 1], self._draw_list.fitted(rest, style, room)]
        step, width = 1.25 * style.size, max(self._draw_list.width(line, style) for line in lines) + 48 * k
        height = step * len(lines) + 0.35 * style.size
        top = self._height - 14 * k - height
        self._draw_list.box((self._width / 2 - width / 2, top), (width, height), PANEL, None, (12 * k, 0.0, 0.0))
        for row, line in enumerate(lines):
            self._draw_list.text(line, (self._width / 2, top + step * (row + 0.93)), style)
        return top

    def _message(self) -> None:
        k = self._k
        message = TypeStyle(21 * k, INK, Face.REGULAR, 0.5)
        text, style = self._shrunk(self._hud.message, message, self._width - 4 * _EDGE * k)
        width = self._draw_list.width(text, style) + 44 * k
        y = 132 * k
        self._draw_list.box((self._width / 2 - width / 2, y - 20 * k), (width, 42 * k), PANEL, None, (12 * k, 0.0, 0.0))
        self._draw_list.text(text, (self._width / 2, y + 8 * k), style)
