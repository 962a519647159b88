"""The score below the picture: engraved bars pass a fixed play line, or the line crosses pages that stand still.

A third form, the highway of lanes, is for those who do not read music. Judgements appear on the notes
(`judgement_marks`).
"""

from bisect import bisect_right
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.music.score import Score
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.notation import note_shapes
from station.render.notation.engraving import Engraver
from station.render.notation.head_places import heads_x
from station.render.notation.screen.free_strip import strip_paper, strip_shapes
from station.render.notation.screen.highway import LINE_SHARE, NAMES_SHARE, SHOWN_S, Highway, lane_height, lanes
from station.render.notation.screen.judgement_marks import draw_dynamics, draw_mark, off_db
from station.render.notation.staff import PLACES, height
from station.render.notation.staff_rows import staff_rows
from station.render.palette import BRAND, EXTRA, PANEL_EDGE, PAPER, PAPER_LOW, with_opacity
from station.render.snapshot import PENDING, Snapshot, Strip
from station.render.text.atlas import Atlas
from station.render.text.draw_list import SHAPE_DTYPE, DrawList

BEFORE_S = AFTER_S = 4.0
"""Seconds of music to the left and right of the play line at most (SMED, figure 4.4: the line stands in the middle)."""
_LEAST_SHOWN_S = 1.5
"""The same at the least: a bar of 4/4 at 160 beats a minute (our choice)."""
_APART, _CLOSER = 1.6, 0.1
"""Staff spaces between strokes that follow each other, a head and a third of one, and how many of them may stand closer
(our choice)."""
_MARGIN_S = 1.5
_CLEF_X, _SIGNATURE_X = 1.4, 1.4 + note_shapes.CLEF_WIDTH + note_shapes.SIGNATURE_GAP
_LEAST_LEAD = 7.0
"""What the clef and the time signature take at the least; our choice."""
_AFTER_SIGNATURE = 1.6
"""Notes fade out from so far behind the time signature (`fade`), a little further than they do behind the clef."""
PAGE_S = BEFORE_S + AFTER_S
"""A page holds whole bars of at most so many seconds, at least one bar; what scrolling shows too."""


_LEAST_SPACES = 48.0
"""So many staff spaces are as wide as the score: eighths at 150 beats a minute stay apart (our choice)."""


_USUAL_REACH = (-8.3, 7.5)
"""What a staff with sticking and accents takes up and down of its middle line, in staff spaces."""


@dataclass(frozen=True, slots=True)
class ScorePlace:
    """Where the score lies in the picture, in pixels, y down; how far up and down its staff reaches (`staff_rows`)."""

    left: float
    top: float
    width: float
    height: float
    reach: tuple[float, float] = _USUAL_REACH

    @property
    def space(self) -> float:
        """Pixels a staff space: the height holds what is engraved, and the width enough of them to tell notes apart."""
        return min(self.height / (self.reach[1] - self.reach[0]), self.width / _LEAST_SPACES)

    @property
    def middle_line(self) -> float:
        """Where the staff's middle line lies."""
        return self.top + self.height / 2 - sum(self.reach) / 2 * self.space

    @property
    def top_y(self) -> float:
        """The upper edge in staff spaces from the middle line."""
        return (self.top - self.middle_line) / self.space


class ScoreForm(IntEnum):
    """How the score is shown."""

    SCROLLING = 0
    PAGED = 1
    HIGHWAY = 2


@dataclass(frozen=True, slots=True)
class ScorePage:
    """Bars that stand still together: from when on the page is up, and what it shows: them and the bar after them."""

    start_s: float
    shown_s: tuple[float, float]


class ScoreView:
    """Keeps the engraved bars of the score that it drew last."""

    def __init__(self, printer: ShapeRenderer, atlas: Atlas) -> None:
        self._printer = printer
        self._atlas = atlas
        self._engraver: Engraver | None = None
        self._bars: dict[int, NDArray[np.void]] = {}
        self._limbs: NDArray[np.int8] | None = None
        self._paged: tuple[Score, float] | None = None
        self._pages: list[ScorePage] = []
        self._halved: tuple[Score, float, float] | None = None
        self._led: Score | None = None
        self._reached: tuple[Score, NDArray[np.int8] | None] | None = None
        self._reach = _USUAL_REACH
        self._headed: Score | None = None
        self._heads_x = np.zeros(0)
        self._lead = _LEAST_LEAD

    def reach(self, snapshot: Snapshot) -> tuple[float, float]:
        """How far up and down the staff of the snapshot's score reaches (`staff_rows`)."""
        if self._reached is None or self._reached[0] is not snapshot.score or self._reached[1] is not snapshot.limbs:
            self._reached = snapshot.score, snapshot.limbs
            self._reach = staff_rows(snapshot.score, snapshot.limbs).reach
        return self._reach

    def draw_paper(self, place: ScorePlace, size: tuple[int, int], is_staff: bool) -> None:
        """Draw what a score lies on and what of it never moves, at `place` in a picture of `size`.

        `is_staff`: a staff is what the score shows (`shows_staff`).
        """
        sheet = Transform(size)
        self._printer.fill((place.left, place.top, place.width, place.height), (PAPER, PAPER_LOW), sheet)
        self._printer.fill((place.left, place.top, place.width, 1.2), (PANEL_EDGE, PANEL_EDGE), sheet)
        if is_staff:
            draw_list = DrawList(self._atlas)
            note_shapes.staff_lines(draw_list, place.width / place.space)
            note_shapes.clef(draw_list, _CLEF_X)
            self._printer.draw(draw_list.shapes(), Transform(size, (place.left, place.middle_line), place.space))

    def draw(
        self, snapshot: Snapshot, place: ScorePlace, size: tuple[int, int], form: ScoreForm = ScoreForm.SCROLLING
    ) -> None:
        """Draw the score of `snapshot` over its paper at `place` in a picture of `size`."""
        plain = Transform(size, (place.left, place.middle_line), place.space)
        if snapshot.strip is not None:
            self._draw_strip(snapshot.strip, snapshot.position_s, place, size)
            return
        if form is ScoreForm.HIGHWAY:
            self._draw_highway(snapshot, place, size)
            return
        engraver, space = self._engraved(snapshot), place.space
        clef_x = place.left + self._lead_spaces(snapshot.score) * space
        across, right = place.left + place.width - clef_x, place.left + place.width
        half_s = self._half_s(snapshot.score, across / space)
        if form is ScoreForm.PAGED:
            page = self._page(snapshot, 2 * half_s)
            per_s = (across - 2 * space) / (page.shown_s[1] - page.shown_s[0])
            line_x = clef_x + 2 * space + (max(snapshot.position_s, page.shown_s[0]) - page.shown_s[0]) * per_s
            fade = (place.left, place.left + 1.0, right - space, right)
            rolling = Transform(size, (clef_x + 2 * space, place.middle_line), space, page.shown_s[0], per_s, fade)
            window_s = page.shown_s
        else:
            per_s = across / (2 * half_s)
            line_x = clef_x + half_s * per_s
            fade = (clef_x - 1.2 * space, clef_x + space, right - 3 * space, right)
            rolling = Transform(size, (line_x, place.middle_line), space, snapshot.position_s, per_s, fade)
            reach_s = half_s + _MARGIN_S
            window_s = snapshot.position_s - reach_s, snapshot.position_s + reach_s
        glow = with_opacity(BRAND, 0.07)
        self._printer.fill((line_x - 1.6 * space, place.top, 3.2 * space, place.height), (glow, glow), plain)
        self._printer.draw(self._paper(snapshot, place, line_x), plain)
        self._printer.draw(self._visible_bars(engraver, *window_s), rolling)
        self._printer.draw(self._judgements(snapshot, window_s, per_s / space), rolling)

    def _draw_strip(self, strip: Strip, position_s: float, place: ScorePlace, size: tuple[int, int]) -> None:
        """What was played passes the line, as the score does when it scrolls."""
        space = place.space
        per_s, line_x = place.width / (BEFORE_S + AFTER_S), place.left + place.width / 2
        plain = Transform(size, (place.left, place.middle_line), space)
        self._printer.draw(strip_paper(self._atlas, place.width / space, (place.top_y, place.height / space)), plain)
        fade = (place.left, place.left + 3 * space, place.left + place.width - 3 * space, place.left + place.width)
        rolling = Transform(size, (line_x, place.middle_line), space, position_s, per_s, fade)
        window_s = position_s - BEFORE_S - _MARGIN_S, position_s + AFTER_S + _MARGIN_S
        self._printer.draw(strip_shapes(strip, window_s, self._atlas), rolling)

    def _half_s(self, score: Score, spaces: float) -> float:
        if self._halved is None or self._halved[0] is not score or self._halved[1] != spaces:
            self._halved = score, spaces, shown_s(score, spaces)
        return self._halved[2]

    def _page(self, snapshot: Snapshot, page_s: float) -> ScorePage:
        """The page that holds the snapshot's place; the first before the score, the last after it."""
        if self._paged is None or self._paged[0] is not snapshot.score or self._paged[1] != page_s:
            self._paged, self._pages = (snapshot.score, page_s), pages(snapshot.score, page_s)
        starts = [page.start_s for page in self._pages]
        return self._pages[max(bisect_right(starts, snapshot.position_s) - 1, 0)]

    def _draw_highway(self, snapshot: Snapshot, place: ScorePlace, size: tuple[int, int]) -> None:
        count = len(lanes(snapshot.score))
        lane_px = lane_height(place.height, count)
        top = place.top + (place.height - count * lane_px) / 2
        per_s = place.width / SHOWN_S
        line_x = place.left + place.width * LINE_SHARE
        right = place.left + place.width
        highway = Highway(snapshot, self._atlas, lane_px)
        plain = Transform(size, (place.left, top), lane_px)
        self._printer.draw(highway.paper(place.width), plain)
        names_x = place.left + place.width * NAMES_SHARE
        fade = (names_x, names_x + lane_px, right - lane_px, right)
        rolling = Transform(size, (line_x, top), lane_px, snapshot.position_s, per_s, fade)
        window_s = snapshot.position_s - LINE_SHARE * SHOWN_S, snapshot.position_s + SHOWN_S
        self._printer.draw(highway.rolling(window_s), rolling)
        line = with_opacity(BRAND, 0.95)
        self._printer.fill((line_x - 2.0, place.top, 4.0, place.height), (line, line), plain)

    def _engraved(self, snapshot: Snapshot) -> Engraver:
        engraver = self._engraver
        if engraver is None or engraver.score is not snapshot.score or self._limbs is not snapshot.limbs:
            engraver = self._engraver = Engraver(
                snapshot.score,
                self._atlas,
                snapshot.limbs,
                snapshot.bar_numbers,
                snapshot.beat_ticks,
            )
            if snapshot.spelling is not None:
                engraver = self._engraver = engraver.of_take(snapshot.spelling)
            self._limbs = snapshot.limbs
            self._bars.clear()
        return engraver

    def _lead_spaces(self, score: Score) -> float:
        if self._led is not score:
            self._led, self._lead = score, lead_spaces(score)
        return self._lead

    def _visible_bars(self, engraver: Engraver, first_s: float, last_s: float) -> NDArray[np.void]:
        bars = visible_bars(engraver.score, first_s, last_s)
        for bar in bars:
            if bar not in self._bars:
                self._bars[bar] = engraver.bar(bar)
        return np.concatenate([self._bars[bar] for bar in bars] or [np.empty(0, SHAPE_DTYPE)])

    def _paper(self, snapshot: Snapshot, place: ScorePlace, line_x: float) -> NDArray[np.void]:
        draw_list, space = DrawList(self._atlas), place.space
        line = (line_x - place.left) / space
        draw_list.box((line - 0.14, place.top_y), (0.28, place.height / space), with_opacity(BRAND, 0.95))
        tick = max(int(snapshot.score.tempo_map.ticks_at(snapshot.position_s)), 0)
        bar = int(snapshot.score.tempo_map.bars_at(tick))
        note_shapes.time_signature(draw_list, self._engraved(snapshot).signs.meter_of(bar), _SIGNATURE_X)
        return draw_list.shapes()

    def _heads(self, score: Score) -> NDArray[np.float64]:
        """Where each stroke's head stands beside its time."""
        if self._headed is not score:
            self._headed, self._heads_x = score, heads_x(score)
        return self._heads_x

    # --- judgements ---------------------------------------------------------------------------------------------------

    def _judgements(self, snapshot: Snapshot, window_s: tuple[float, float], spaces_per_s: float) -> NDArray[np.void]:
        draw_list = DrawList(self._atlas)
        score, marks = snapshot.score, snapshot.marks
        if marks is not None and len(score):
            ticks = score.tempo_map.ticks_at(list(window_s))
            first, last = np.searchsorted(score.notes["tick"], ticks)
            for i in range(int(first), int(last)):
                if marks["label"][i] != PENDING and not score.is_grace[i]:
                    draw_list.time_s = float(score.tempo_map.seconds_at(score.notes["tick"][i]))
                    at = float(self._heads(score)[i]), height(PLACES[Piece(int(score.notes["piece"][i]))].step)
                    draw_mark(draw_list, marks[i], at, spaces_per_s)
                    draw_dynamics(
                        draw_list, off_db(int(score.notes["velocity"][i]), float(marks["velocity_error"][i])), at
                    )
        for extra in snapshot.extras:
            if window_s[0] <= extra.time_s <= window_s[1]:
                draw_list.time_s = extra.time_s
                draw_list.cross((0.0, height(PLACES[extra.piece].step)), (0.42, 0.42), 0.2, EXTRA)
        return draw_list.shapes()


def shows_staff(snapshot: Snapshot, form: ScoreForm) -> bool:
    """Whether `form` shows the snapshot's score on a staff."""
    return snapshot.strip is None and form is not ScoreForm.HIGHWAY


def shown_s(score: Score, spaces: float) -> float:
    """Seconds of music on each side of the play line, so that strokes stand apart on `spaces` staff spaces in all."""
    gaps_ns = np.diff(np.unique(score.onset_ns[~score.is_grace]))
    if not len(gaps_ns):
        return AFTER_S
    apart_s = float(np.quantile(gaps_ns, _CLOSER)) / NS_PER_S
    return min(max(spaces * apart_s / _APART / 2, _LEAST_SHOWN_S), AFTER_S)


def pages(score: Score, page_s: float = PAGE_S) -> list[ScorePage]:
    """The score's pages in order, at least one, each of `page_s` seconds at most."""
    starts = score.tempo_map.seconds_at([score.tempo_map.bar_start(bar) for bar in range(score.bar_count + 1)]).tolist()
    found: list[ScorePage] = []
    first = 0
    while first < score.bar_count:
        after = first + 1
        while after < score.bar_count and starts[after + 1] - starts[first] <= page_s:
            after += 1
        found.append(ScorePage(starts[first], (starts[first], starts[min(after + 1, score.bar_count)])))
        first = after
    return found or [ScorePage(0.0, (0.0, PAGE_S))]


def lead_spaces(score: Score) -> float:
    """What the clef and the widest of the score's time signatures take on the left, in staff spaces."""
    widest = max(note_shapes.signature_width(meter) for meter in score.tempo_map.meters)
    return max(_LEAST_LEAD, _SIGNATURE_X + widest + _AFTER_SIGNATURE)


def visible_bars(score: Score, first_s: float, last_s: float) -> range:
    """The bars of the score that a span of time touches, and the bar line after the last."""
    ticks = score.tempo_map.ticks_at([max(first_s, 0.0), max(last_s, 0.0)])
    first, last = score.tempo_map.bars_at(ticks).tolist()
    return range(first, min(last, score.bar_count) + 1) if last_s >= 0 else range(0)
