"""The scrolling score: engraved bars pass a fixed play line, and judgements appear on the notes.

A judged note bears a shape as well as a colour: a ring on time, an arrow that points left when early and right when
late, a hollow cross when missed, a question mark's square when the wrong piece was struck. The tick or arrow stands
where the hit fell, stretched by `TICK_ZOOM` so that a few milliseconds can be seen across a room.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.music.judgement import Label
from station.music.score import Score
from station.render import engraving, note_shapes
from station.render.atlas import Atlas
from station.render.engraving import Engraver
from station.render.ink import SHAPE_DTYPE, Colour, Ink
from station.render.ink_printer import InkPrinter, Sheet
from station.render.palette import (
    BRAND,
    EARLY,
    EXTRA,
    GOOD,
    LATE,
    MISSED,
    PANEL_EDGE,
    PAPER,
    PAPER_LOW,
    WRONG,
    with_opacity,
)
from station.render.snapshot import PENDING, Snapshot
from station.render.staff import PLACES, height

BEFORE_S = AFTER_S = 4.0
"""Seconds of music to the left and right of the play line (SMED, figure 4.4: the line stands in the middle)."""
ON_TIME_MS = 25.0
"""Within this a stroke counts as on time in the picture (HUMANS: mild to 25 ms)."""
TICK_ZOOM = 5.0
"""The tick's distance from its head is the asynchrony stretched so much (our choice: 10 ms is half a head)."""
_MARGIN_S = 1.5
_NEAREST_ARROW, _FARTHEST_ARROW = 1.65, 2.1
"""Spaces: beside the head, and still nearer to it than to the next."""


@dataclass(frozen=True, slots=True)
class Place:
    """Where the score lies in the picture, in pixels, y down."""

    left: float
    top: float
    width: float
    height: float

    @property
    def space(self) -> float:
        """Pixels a staff space."""
        return self.height / (engraving.BOTTOM_Y - engraving.TOP_Y)

    @property
    def middle_line(self) -> float:
        """Where the staff's middle line lies."""
        return self.top - engraving.TOP_Y * self.space


class ScoreView:
    """Keeps the engraved bars of the score that it drew last."""

    def __init__(self, printer: InkPrinter, atlas: Atlas) -> None:
        self._printer = printer
        self._atlas = atlas
        self._engraver: Engraver | None = None
        self._bars: dict[int, NDArray[np.void]] = {}
        self._limbs: NDArray[np.int8] | None = None

    def draw(self, snapshot: Snapshot, place: Place, size: tuple[int, int]) -> None:
        """Draw the score of `snapshot` at `place` in a picture of `size`."""
        engraver = self._engraved(snapshot)
        space = place.space
        clef_width = 7.0 * space
        line_x = place.left + clef_width + (place.width - clef_width) * BEFORE_S / (BEFORE_S + AFTER_S)
        per_s = (place.width - clef_width) / (BEFORE_S + AFTER_S)
        right = place.left + place.width
        plain = Sheet(size, (place.left, place.middle_line), space)
        fade = (place.left + clef_width - 1.2 * space, place.left + clef_width + space, right - 3 * space, right)
        rolling = Sheet(size, (line_x, place.middle_line), space, snapshot.position_s, per_s, fade)
        self._printer.fill((place.left, place.top, place.width, place.height), (PAPER, PAPER_LOW), plain)
        self._printer.fill((place.left, place.top, place.width, 1.2), (PANEL_EDGE, PANEL_EDGE), plain)
        glow = with_opacity(BRAND, 0.07)
        self._printer.fill((line_x - 1.6 * space, place.top, 3.2 * space, place.height), (glow, glow), plain)
        self._printer.draw(self._paper(snapshot, place, line_x), plain)
        first_s = snapshot.position_s - BEFORE_S - _MARGIN_S
        last_s = snapshot.position_s + AFTER_S + _MARGIN_S
        self._printer.draw(self._visible_bars(engraver, first_s, last_s), rolling)
        self._printer.draw(self._judgements(snapshot, (first_s, last_s), per_s / space), rolling)

    def _engraved(self, snapshot: Snapshot) -> Engraver:
        engraver = self._engraver
        if engraver is None or engraver.score is not snapshot.score or self._limbs is not snapshot.limbs:
            engraver = self._engraver = Engraver(snapshot.score, self._atlas, snapshot.limbs, snapshot.bar_numbers)
            self._limbs = snapshot.limbs
            self._bars.clear()
        return engraver

    def _visible_bars(self, engraver: Engraver, first_s: float, last_s: float) -> NDArray[np.void]:
        bars = visible_bars(engraver.score, first_s, last_s)
        for bar in bars:
            if bar not in self._bars:
                self._bars[bar] = engraver.bar(bar)
        return np.concatenate([self._bars[bar] for bar in bars] or [np.empty(0, SHAPE_DTYPE)])

    def _paper(self, snapshot: Snapshot, place: Place, line_x: float) -> NDArray[np.void]:
        ink, space = Ink(self._atlas), place.space
        width, line = place.width / space, (line_x - place.left) / space
        note_shapes.staff_lines(ink, width)
        ink.box((line - 0.14, engraving.TOP_Y), (0.28, place.height / space), with_opacity(BRAND, 0.95))
        note_shapes.clef(ink, 1.4)
        tick = max(int(snapshot.score.tempo_map.ticks_at(snapshot.position_s)), 0)
        note_shapes.time_signature(ink, snapshot.score.tempo_map.meter_at(tick), 4.6)
        return ink.shapes()

    # --- judgements ---------------------------------------------------------------------------------------------------

    def _judgements(self, snapshot: Snapshot, window_s: tuple[float, float], spaces_per_s: float) -> NDArray[np.void]:
        ink = Ink(self._atlas)
        score, marks = snapshot.score, snapshot.marks
        if marks is not None and len(score):
            ticks = score.tempo_map.ticks_at(list(window_s))
            first, last = np.searchsorted(score.notes["tick"], ticks)
            for i in range(int(first), int(last)):
                if marks["label"][i] != PENDING and not score.is_grace[i]:
                    ink.time_s = float(score.tempo_map.seconds_at(score.notes["tick"][i]))
                    y = height(PLACES[Piece(int(score.notes["piece"][i]))].step)
                    draw_mark(ink, marks[i], y, spaces_per_s)
        for extra in snapshot.extras:
            if window_s[0] <= extra.time_s <= window_s[1]:
                ink.time_s = extra.time_s
                ink.cross((0.0, height(PLACES[extra.piece].step)), (0.42, 0.42), 0.2, EXTRA)
        return ink.shapes()


def draw_mark(ink: Ink, row: np.void, y: float, spaces_per_s: float) -> None:
    """The judgement of one note whose head stands at height `y`."""
    label = Label(int(row["label"]))
    if label is Label.MISS:
        ink.ellipse((0.0, y), (1.05, 1.05), MISSED, 0.0, (0.0, 0.2, 0.0))
        ink.line((-0.75, y + 0.75), (0.75, y - 0.75), 0.2, MISSED)
    elif label is Label.WRONG_PIECE:
        ink.box((-1.0, y - 1.0), (2.0, 2.0), WRONG, None, (0.3, 0.2, 0.0))
    else:
        _draw_timing(ink, float(row["asynchrony_ms"]), y, spaces_per_s)


def _draw_timing(ink: Ink, asynchrony_ms: float, y: float, spaces_per_s: float) -> None:
    colour = timing_colour(asynchrony_ms)
    shift = asynchrony_ms / 1000 * spaces_per_s * TICK_ZOOM
    if abs(asynchrony_ms) <= ON_TIME_MS:
        ink.ellipse((0.0, y), (1.0, 0.86), colour, 0.0, (0.0, 0.22, 0.0))
        ink.line((shift, y - 0.95), (shift, y + 0.95), 0.24, colour)
    else:
        way = 1.0 if asynchrony_ms > 0 else -1.0
        tip = way * min(max(abs(shift), _NEAREST_ARROW), _FARTHEST_ARROW)
        ink.ellipse((0.0, y), (1.0, 0.86), with_opacity(colour, 0.5), 0.0, (0.0, 0.16, 0.0))
        ink.triangle((tip, y), (0.52, 0.66), colour, 0.0 if way > 0 else np.pi)


def timing_colour(asynchrony_ms: float) -> Colour:
    """The signal colour of an asynchrony."""
    if abs(asynchrony_ms) <= ON_TIME_MS:
        return GOOD
    return EARLY if asynchrony_ms < 0 else LATE


def visible_bars(score: Score, first_s: float, last_s: float) -> range:
    """The bars of the score that a stretch of time touches, and the bar line after the last."""
    ticks = score.tempo_map.ticks_at([max(first_s, 0.0), max(last_s, 0.0)])
    first, last = score.tempo_map.bars_at(ticks).tolist()
    return range(first, min(last, score.bar_count) + 1) if last_s >= 0 else range(0)
