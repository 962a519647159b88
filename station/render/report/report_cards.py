"""The cards of a result's page: every stroke over the bars, and piece by piece lean, spread and technique.

Units are the page's (`report_layout`).
"""

import numpy as np

from station.music.judgement import Label
from station.render.notation.screen.judgement_marks import timing_colour
from station.render.palette import BRAND, GOOD, INK, INK_FAINT, INK_SOFT, PANEL, PANEL_EDGE, with_opacity
from station.render.report.report_layout import ReportBox
from station.render.report.result_facts import PieceLean, ResultFacts, in_words, leans, ticks
from station.render.report.stroke_plot import AXIS_MS, LINES, StrokeKind, StrokeMark, by_kind, heights_ms
from station.render.text.draw_list import DrawList, TypeStyle
from station.render.text.fonts import Face

PADDING = 20.0
"""Units between a card's edge and what is in it."""
_LEAN_REACH_MS = 60.0
_ROW, _NAME, _SAID = 30.0, 130.0, 206.0
"""Of a piece: the height of its row, the width of its name, and of what is said of it."""
_COUNT = 84.0
"""Width of how many were hit, where there is room for it."""
_TECHNIQUE_LINE, _TECHNIQUE_WIDTH = 23.0, 500.0
_TECHNIQUE_FIRST = 1
"""So many lines of technique come before a further piece (our choice: what was played stands before how)."""


class Plot:
    """Every stroke over the bars, as `stroke_plot` says."""

    def __init__(self, facts: ResultFacts, draw_list: DrawList, box: ReportBox) -> None:
        self._facts, self._draw_list, self._box = facts, draw_list, box
        self._left, self._right = box.left + 92, box.right - 22
        self._top, self._low = box.top + 36, box.bottom - 28

    def draw(self) -> None:
        """The card, its lines, and the strokes."""
        paper(self._draw_list, self._box)
        self._draw_list.text(
            "Every stroke", (self._box.left + PADDING, self._box.top + 27), TypeStyle(18, INK, Face.BOLD)
        )
        on_time_ms = self._facts.on_time_ms
        band = self._height_of(-on_time_ms) - self._height_of(on_time_ms)
        left, width = self._left - 8, self._right - self._left + 16
        self._draw_list.box((left, self._height_of(on_time_ms)), (width, band), with_opacity(GOOD, 0.10))
        for ms, words in LINES.items():
            y = self._height_of(ms)
            self._draw_list.box((left, y - 0.5), (width, 1.0), INK_FAINT if ms else INK_SOFT)
            self._draw_list.text(words, (left - 8, y + 5), TypeStyle(15, INK_SOFT, Face.REGULAR, 1.0))
        self._bars()
        self._strokes()

    def _height_of(self, ms: float) -> float:
        return self._low - (self._low - self._top) * (ms - AXIS_MS[0]) / (AXIS_MS[1] - AXIS_MS[0])

    def _place_of(self, time_s: float) -> float:
        """Across the plot; what was struck before the first bar or after the last stands on its edge."""
        start, end = float(self._facts.bar_s[0]), float(self._facts.bar_s[-1])
        time_s = min(max(time_s, start), end)
        return self._left + (self._right - self._left) * (time_s - start) / max(end - start, 1e-9)

    def _bars(self) -> None:
        low, style = self._box.bottom - 12, TypeStyle(15, INK_SOFT, Face.REGULAR, 0.5)
        counted, marks = ticks(self._facts)
        for bar, number in marks:
            x = self._place_of(float(self._facts.bar_s[bar]))
            self._draw_list.box((x - 0.5, self._top), (1.0, self._low - self._top), with_opacity(INK_FAINT, 0.6))
            self._draw_list.text(number, (x, low), style)
        self._draw_list.text(counted, (self._left - 16, low), TypeStyle(15, INK_SOFT, Face.REGULAR, 1.0))

    def _strokes(self) -> None:
        facts, extras = self._facts, len(self._facts.extra_s)
        size = float(np.clip(900 / max(len(facts.label), 1), 2.6, 5.2))
        time_s = np.concatenate([facts.time_s, facts.extra_s])
        label = np.concatenate([facts.label, np.full(extras, Label.EXTRA, np.uint8)])
        asynchrony_ms = np.concatenate([facts.asynchrony_ms, np.full(extras, np.nan)])
        at_ms = heights_ms(label, asynchrony_ms)
        for kind, rows in by_kind(label, asynchrony_ms, facts.on_time_ms):
            for x, ms in zip(time_s[rows].tolist(), at_ms[rows].tolist(), strict=True):
                stroke(self._draw_list, kind, (self._place_of(x), self._height_of(ms)), size)


class Pieces:
    """Piece by piece its lean and spread, and below what hands and feet did."""

    def __init__(self, facts: ResultFacts, draw_list: DrawList, box: ReportBox) -> None:
        self._facts, self._draw_list, self._box = facts, draw_list, box
        self._said = box.right - _SAID
        has_counts = self._said - box.left - PADDING - _NAME - _COUNT > 200
        first = box.left + PADDING + _NAME + (_COUNT if has_counts else 0.0)
        self._count = first if has_counts else None
        self._centre, self._reach = (first + self._said) / 2, (self._said - first) / 2 - 18

    def draw(self) -> None:
        """The card; the pieces with the most notes come first."""
        box, technique = self._box, self._facts.words.technique
        paper(self._draw_list, box)
        heading = "Piece by piece: where it leans, and how far it spreads"
        self._draw_list.text(heading, (box.left + PADDING, box.top + 28), TypeStyle(18, INK, Face.BOLD))
        top = box.top + 42
        for_technique = min(len(technique), _TECHNIQUE_FIRST) * _TECHNIQUE_LINE + 34 if technique else 8.0
        most = max(int((box.bottom - top - for_technique) / _ROW), 1)
        rows = sorted(leans(self._facts), key=lambda lean: -lean.notes)[:most]
        self._draw_list.box((self._centre - 0.75, top), (1.5, _ROW * len(rows)), INK_SOFT)
        for i, lean in enumerate(rows):
            self._row(lean, top + _ROW * (i + 0.5))
        self._technique(technique, top + _ROW * len(rows))

    def _row(self, lean: PieceLean, y: float) -> None:
        name, said = TypeStyle(18, INK), TypeStyle(16, INK_SOFT)
        left = self._box.left + PADDING
        self._draw_list.text(self._draw_list.fitted(lean.name, name, _NAME - 8), (left, y + 6), name)
        if self._count is not None:
            counted = TypeStyle(16, INK_SOFT, Face.REGULAR, 1.0)
            self._draw_list.text(f"{lean.hits} of {lean.notes}", (self._count, y + 6), counted)
        if lean.mean_ms is None:
            return
        scale = self._reach / _LEAN_REACH_MS
        at = self._centre + scale * float(np.clip(lean.mean_ms, -_LEAN_REACH_MS, _LEAN_REACH_MS))
        colour = timing_colour(lean.mean_ms, self._facts.on_time_ms)
        if lean.sd_ms is not None:  # what spreads farther ends where the counts and the words begin
            left = max(at - lean.sd_ms * scale, self._centre - self._reach)
            right = min(at + lean.sd_ms * scale, self._centre + self._reach)
            self._draw_list.box((left, y - 6), (right - left, 12), with_opacity(colour, 0.30), None, (6.0, 0.0, 0.0))
        self._draw_list.ellipse((at, y), (6.5, 6.5), colour)
        self._draw_list.text(self._draw_list.fitted(in_words(lean), said, _SAID - 12), (self._said, y + 6), said)

    def _technique(self, lines: tuple[str, ...], top: float) -> None:
        """As many lines as there is room for, column by column."""
        columns = max(int((self._box.width - 2 * PADDING) / _TECHNIQUE_WIDTH), 1)
        fit = int((self._box.bottom - 10 - top - 24) / _TECHNIQUE_LINE)
        left, width = self._box.left + PADDING, (self._box.width - 2 * PADDING) / columns
        style = TypeStyle(16, INK_SOFT)
        broken = [part for line in lines for part in self._draw_list.broken(line, style, width - 10)]
        shown = broken[: max(fit, 0) * columns]
        if not shown:
            return
        self._draw_list.text("HANDS AND FEET", (left, top + 18), TypeStyle(14, BRAND, Face.BOLD))
        each = -(-len(shown) // columns)
        for i, line in enumerate(shown):
            column, row = divmod(i, each)
            at = left + column * width, top + 24 + (row + 0.75) * _TECHNIQUE_LINE
            self._draw_list.text(line, at, style)


def paper(draw_list: DrawList, box: ReportBox) -> None:
    """A card: its ground and its edge."""
    draw_list.box((box.left, box.top), (box.width, box.height), PANEL, None, (14.0, 0.0, 0.0))
    draw_list.box((box.left, box.top), (box.width, box.height), PANEL_EDGE, None, (14.0, 1.2, 0.0))


def stroke(draw_list: DrawList, kind: StrokeKind, at: tuple[float, float], size: float) -> None:
    """The mark of a stroke; `size` is a dot's radius."""
    radius, half = kind.radius * size, kind.radius * size / np.sqrt(2)
    match kind.mark:
        case StrokeMark.DISC:
            draw_list.ellipse(at, (radius, radius), kind.colour)
        case StrokeMark.SQUARE:
            draw_list.box((at[0] - half, at[1] - half), (2 * half, 2 * half), kind.colour, None, (1.0, 1.8, 0.0))
        case StrokeMark.BARRED_RING:
            barred_ring(draw_list, at, max(radius, 4.0), kind.colour)
        case StrokeMark.CROSS:
            draw_list.cross(at, (half, half), 1.6, kind.colour)
        case StrokeMark.RING:
            draw_list.ellipse(at, (max(radius, 4.0),) * 2, kind.colour, 0.0, (0.0, 1.2, 0.0))
        case StrokeMark.UP | StrokeMark.DOWN:
            turn = -np.pi / 2 if kind.mark is StrokeMark.UP else np.pi / 2
            draw_list.triangle(at, (0.9 * radius, 0.9 * radius), kind.colour, turn)


def badge(draw_list: DrawList, kind: int, at: tuple[float, float], colour: tuple[float, float, float, float]) -> None:
    """The shapes that judgements have in the score."""
    if kind == 0:
        draw_list.ellipse(at, (7, 7), colour, 0.0, (0.0, 2.4, 0.0))
    elif kind == 1:
        barred_ring(draw_list, at, 7.0, colour)
    elif kind == 2:
        draw_list.box((at[0] - 7, at[1] - 7), (14, 14), colour, None, (2.0, 2.2, 0.0))
    elif kind == 3:
        draw_list.cross(at, (5, 5), 2.6, colour)
    else:
        draw_list.ellipse(at, (7, 7), colour, 0.0, (0.0, 1.4, 0.0))


def barred_ring(
    draw_list: DrawList, at: tuple[float, float], radius: float, colour: tuple[float, float, float, float]
) -> None:
    """The sign of a miss."""
    thick, reach = 0.29 * radius, 0.71 * radius
    draw_list.ellipse(at, (radius, radius), colour, 0.0, (0.0, thick, 0.0))
    draw_list.line((at[0] - reach, at[1] + reach), (at[0] + reach, at[1] - reach), thick, colour)
