"""The result of a session as a page: points, every stroke's timing, each piece's lean and spread, what to do next.

The window shows the page behind its buttons and `draw_report_png` writes it to a file, both by the same shapes.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.music.judgement import Label
from station.render.atlas import Atlas
from station.render.fonts import Face
from station.render.gl import Target, standalone_context
from station.render.ink import LINE_HEIGHT, Ink, Type
from station.render.ink_printer import InkPrinter, Sheet
from station.render.judgement_marks import ON_TIME_MS, timing_colour
from station.render.palette import (
    BRAND,
    EXTRA,
    GOOD,
    INK,
    INK_FAINT,
    INK_SOFT,
    MISSED,
    NIGHT,
    PANEL,
    PANEL_EDGE,
    WRONG,
    with_opacity,
)
from station.render.png import write_png
from station.render.results import Lean, ResultFacts, headline, in_words, leans, ticks

_WIDTH, _HEIGHT = 1280.0, 800.0
"""The page is designed in these units and scaled to fit."""
_REACH_MS = 80.0
"""The plot's half height; strokes farther out stand on its edge (our choice)."""
_LEAN_REACH_MS = 60.0
_TICKS = 56
_MAX_ROWS = 8
_ADVICE_SIZES = (15.5, 14.0, 12.5, 11.0)
_MOST_ROW, _LEAST_ROW = 30.0, 24.0
"""Height of a piece's row, as craft leaves room."""
_CRAFT_LINE, _CRAFT_COLUMNS = 19.0, 2


@dataclass(frozen=True, slots=True)
class _Box:
    left: float
    top: float
    width: float
    height: float


_PLOT = _Box(356, 132, 884, 236)
_ROWS = _Box(356, 414, 884, 346)
_SIDE = _Box(40, 108, 276, 652)


def report_shapes(facts: ResultFacts, atlas: Atlas) -> NDArray[np.void]:
    """The page in its own units, 1280 × 800, origin top left."""
    return _Page(facts, Ink(atlas)).shapes()


def report_sheet(size: tuple[int, int]) -> Sheet:
    """How the page fits into a picture of `size`: as large as it can be, in the middle."""
    unit = min(size[0] / _WIDTH, size[1] / _HEIGHT)
    return Sheet(size, ((size[0] - unit * _WIDTH) / 2, (size[1] - unit * _HEIGHT) / 2), unit)


def draw_report_png(facts: ResultFacts, path: Path, size: tuple[int, int] = (1280, 800)) -> None:
    """Write the page to `path`; raises `DeviceError` without OpenGL or if the disk refuses."""
    ctx = standalone_context()
    with ctx:
        target, atlas = Target(ctx, size), Atlas()
        printer = InkPrinter(ctx, atlas)
        target.framebuffer.use()
        target.framebuffer.clear(*NIGHT)
        printer.draw(report_shapes(facts, atlas), report_sheet(size))
        picture = target.read()
        target.release()
    ctx.release()
    write_png(picture, path)


class _Page:
    def __init__(self, facts: ResultFacts, ink: Ink) -> None:
        self._facts, self._ink = facts, ink

    def shapes(self) -> NDArray[np.void]:
        self._head()
        self._points()
        self._counts()
        self._plot()
        self._rows()
        return self._ink.shapes()

    # --- words --------------------------------------------------------------------------------------------------------

    def _head(self) -> None:
        title = Type(34, INK, Face.BOLD)
        self._ink.text(self._ink.fitted(self._facts.words.title, title, 1200), (40, 58), title)
        line = Type(18, INK_SOFT)
        self._ink.text(self._ink.fitted(self._facts.words.subtitle, line, 1200), (40, 86), line)

    def _points(self) -> None:
        """A dial of ticks, as many lit as there are points."""
        x, y = _SIDE.left + _SIDE.width / 2, _SIDE.top + 122
        self._card(_SIDE)
        share = 0.0 if self._facts.words.points is None else self._facts.words.points / 100
        for k in range(_TICKS):
            a = 2 * np.pi * (k + 0.5) / _TICKS
            way = np.array([np.sin(a), -np.cos(a)])
            colour = BRAND if (k + 0.5) / _TICKS <= share else INK_FAINT
            inner, outer = (x + 78 * way[0], y + 78 * way[1]), (x + 94 * way[0], y + 94 * way[1])
            self._ink.line(inner, outer, 4.0, colour)
        number = "–" if self._facts.words.points is None else f"{self._facts.words.points:.0f}"
        self._ink.text(number, (x, y + 20), Type(66, INK, Face.BOLD, 0.5))
        self._ink.text("of 100", (x, y + 46), Type(16, INK_SOFT, Face.REGULAR, 0.5))

    def _counts(self) -> None:
        facts, y = self._facts, _SIDE.top + 262
        x = _SIDE.left + 26
        self._ink.paragraph(headline(facts).capitalize() + ".", (x, y), Type(20, INK, Face.BOLD), _SIDE.width - 52)
        y += 62
        rows = (
            (GOOD, f"{facts.count(Label.MATCH)} of {len(facts.label)} notes right"),
            (MISSED, f"{facts.count(Label.MISS)} missed"),
            (WRONG, f"{facts.count(Label.WRONG_PIECE)} on a wrong pad"),
            (EXTRA, f"{facts.count(Label.EXTRA)} not written"),
        )
        for i, (colour, text) in enumerate(rows):
            self._badge(i, (x + 9, y - 6), with_opacity(colour, 1.0))
            self._ink.text(text, (x + 30, y), Type(18, INK))
            y += 31
        if facts.words.advice:
            self._ink.text("WHAT TO DO NEXT", (x, y + 12), Type(13, BRAND, Face.BOLD))
            self._advice(facts.words.advice, (x, y + 38))

    def _advice(self, sentences: tuple[str, ...], at: tuple[float, float]) -> None:
        """The sentences, in the largest type in which they fit on the card."""
        width, room = _SIDE.width - 48, _SIDE.top + _SIDE.height - 12 - at[1]
        for size in _ADVICE_SIZES:
            style = Type(size, INK_SOFT)
            lines = [self._ink.broken(sentence, style, width) for sentence in sentences]
            gap = 0.6 * size
            if sum(map(len, lines)) * LINE_HEIGHT * size + gap * (len(lines) - 1) <= room:
                break
        y = at[1]
        for sentence in sentences:
            y += self._ink.paragraph(sentence, (at[0], y), style, width) + gap

    def _badge(self, kind: int, at: tuple[float, float], colour: tuple[float, float, float, float]) -> None:
        """The shapes that judgements have in the score."""
        if kind == 0:
            self._ink.ellipse(at, (7, 7), colour, 0.0, (0.0, 2.4, 0.0))
        elif kind == 1:
            self._barred_ring(at, 7.0, colour)
        elif kind == 2:
            self._ink.box((at[0] - 7, at[1] - 7), (14, 14), colour, None, (2.0, 2.2, 0.0))
        else:
            self._ink.cross(at, (5, 5), 2.6, colour)

    def _barred_ring(self, at: tuple[float, float], radius: float, colour: tuple[float, float, float, float]) -> None:
        """The sign of a miss."""
        thick, reach = 0.29 * radius, 0.71 * radius
        self._ink.ellipse(at, (radius, radius), colour, 0.0, (0.0, thick, 0.0))
        self._ink.line((at[0] - reach, at[1] + reach), (at[0] + reach, at[1] - reach), thick, colour)

    def _card(self, box: _Box) -> None:
        self._ink.box((box.left, box.top), (box.width, box.height), PANEL, None, (14.0, 0.0, 0.0))
        self._ink.box((box.left, box.top), (box.width, box.height), PANEL_EDGE, None, (14.0, 1.2, 0.0))

    # --- every stroke -------------------------------------------------------------------------------------------------

    def _plot(self) -> None:
        self._card(_Box(_PLOT.left, _PLOT.top - 24, _PLOT.width, _PLOT.height + 58))
        self._ink.text("Every stroke", (_PLOT.left + 22, _PLOT.top + 6), Type(16, INK, Face.BOLD))
        middle = self._height_of(0.0)
        band = self._height_of(-ON_TIME_MS) - self._height_of(ON_TIME_MS)
        left, width = _PLOT.left + 74, _PLOT.width - 96
        self._ink.box((left, middle - band / 2), (width, band), with_opacity(GOOD, 0.10))
        for ms in (-60, -30, 0, 30, 60):
            y = self._height_of(ms)
            self._ink.box((left, y - 0.5), (width, 1.0), INK_FAINT if ms else INK_SOFT)
            text = "0 ms" if ms == 0 else f"{abs(ms)} {'late' if ms > 0 else 'early'}"
            self._ink.text(text, (left - 10, y + 4.5), Type(13, INK_SOFT, Face.REGULAR, 1.0))
        self._bars()
        self._strokes()

    def _height_of(self, asynchrony_ms: float) -> float:
        """Late is up: later means more."""
        clipped = float(np.clip(asynchrony_ms, -_REACH_MS, _REACH_MS))
        return _PLOT.top + 24 + (_PLOT.height - 44) * (0.5 - clipped / (2 * _REACH_MS))

    def _place_of(self, time_s: float) -> float:
        """Across the plot; what was struck before the first bar or after the last stands on its edge."""
        start, end = float(self._facts.bar_s[0]), float(self._facts.bar_s[-1])
        time_s = min(max(time_s, start), end)
        return _PLOT.left + 84 + (_PLOT.width - 116) * (time_s - start) / max(end - start, 1e-9)

    def _bars(self) -> None:
        low = _PLOT.top + _PLOT.height + 4
        counted, marks = ticks(self._facts)
        for bar, number in marks:
            x = self._place_of(float(self._facts.bar_s[bar]))
            self._ink.box((x - 0.5, _PLOT.top + 24), (1.0, _PLOT.height - 44), with_opacity(INK_FAINT, 0.6))
            self._ink.text(number, (x, low + 14), Type(12.5, INK_SOFT, Face.REGULAR, 0.5))
        self._ink.text(counted, (_PLOT.left + 64, low + 14), Type(12.5, INK_SOFT, Face.REGULAR, 1.0))

    def _strokes(self) -> None:
        facts = self._facts
        size = float(np.clip(900 / max(len(facts.label), 1), 2.6, 5.2))
        floor = _PLOT.top + _PLOT.height - 10
        for time_s, label, late_ms in zip(facts.time_s, facts.label, facts.asynchrony_ms, strict=True):
            x = self._place_of(float(time_s))
            if label == Label.MISS:
                self._barred_ring((x, floor), max(size, 4.0), MISSED)
                continue
            at = (x, self._height_of(float(late_ms)))
            if label == Label.WRONG_PIECE:
                self._ink.box((at[0] - size, at[1] - size), (2 * size, 2 * size), WRONG, None, (1.0, 1.8, 0.0))
            elif abs(late_ms) <= ON_TIME_MS:
                self._ink.ellipse(at, (size, size), with_opacity(GOOD, 0.9))
            else:
                turn = -np.pi / 2 if late_ms > 0 else np.pi / 2
                self._ink.triangle(at, (size * 1.1, size * 1.15), timing_colour(float(late_ms)), turn)
        for time_s in facts.extra_s:
            self._ink.cross((self._place_of(float(time_s)), floor + 10), (size * 0.7, size * 0.7), 1.6, EXTRA)

    # --- pieces -------------------------------------------------------------------------------------------------------

    def _rows(self) -> None:
        self._card(_ROWS)
        self._ink.text(
            "Piece by piece: where it leans, and how far it spreads",
            (_ROWS.left + 22, _ROWS.top + 30),
            Type(16, INK, Face.BOLD),
        )
        rows = sorted(leans(self._facts), key=lambda lean: -lean.notes)[:_MAX_ROWS]
        step = _LEAST_ROW if len(rows) > _MAX_ROWS // 2 else _MOST_ROW
        centre = _ROWS.left + 430
        top, bottom = _ROWS.top + 48, _ROWS.top + 56 + step * len(rows)
        self._ink.box((centre - 0.75, top), (1.5, bottom - top), INK_SOFT)
        for i, lean in enumerate(rows):
            self._row(lean, _ROWS.top + 60 + step * (i + 0.5) - 6, centre)
        self._craft(bottom + 8)

    def _craft(self, top: float) -> None:
        """What hands and feet did, as many lines as there is room for, column by column."""
        fit = int((_ROWS.top + _ROWS.height - top - 30) / _CRAFT_LINE)
        lines = self._facts.words.craft[: fit * _CRAFT_COLUMNS]
        if not lines:
            return
        left, width = _ROWS.left + 22, (_ROWS.width - 44) / _CRAFT_COLUMNS
        self._ink.text("HANDS AND FEET", (left, top + 12), Type(13, BRAND, Face.BOLD))
        style = Type(14.5, INK_SOFT)
        each = -(-len(lines) // _CRAFT_COLUMNS)
        for i, line in enumerate(lines):
            column, row = divmod(i, each)
            at = left + column * width, top + 34 + row * _CRAFT_LINE
            self._ink.text(self._ink.fitted(line, style, width - 16), at, style)

    def _row(self, lean: Lean, y: float, centre: float) -> None:
        self._ink.text(lean.name, (_ROWS.left + 22, y + 6), Type(18, INK))
        count = f"{lean.hits} of {lean.notes}"
        self._ink.text(count, (_ROWS.left + 216, y + 6), Type(15, INK_SOFT, Face.REGULAR, 1.0))
        if lean.mean_ms is None:
            return
        scale = 190 / _LEAN_REACH_MS
        at = centre + scale * float(np.clip(lean.mean_ms, -_LEAN_REACH_MS, _LEAN_REACH_MS))
        colour = timing_colour(lean.mean_ms)
        if lean.sd_ms is not None:
            reach = _LEAN_REACH_MS * scale  # what spreads farther ends there: beyond stand the counts and the words
            left, right = max(at - lean.sd_ms * scale, centre - reach), min(at + lean.sd_ms * scale, centre + reach)
            self._ink.box((left, y - 6), (right - left, 12), with_opacity(colour, 0.30), None, (6.0, 0.0, 0.0))
        self._ink.ellipse((at, y), (6.5, 6.5), colour)
        self._ink.text(in_words(lean), (centre + 218, y + 6), Type(16, INK_SOFT))
