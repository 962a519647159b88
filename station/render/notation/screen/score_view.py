"""The score beside the picture: two lines of a page that the play line crosses, or bars that roll past it.

A third form, the highway of lanes (`highway`), is for those who do not read music. Judgements appear on the notes
(`staff_marks`), the same in all forms.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.notation import note_shapes
from station.render.notation.engraving import Engraver
from station.render.notation.head_places import heads_x
from station.render.notation.screen.free_strip import strip_paper, strip_shapes
from station.render.notation.screen.highway_view import HighwayView
from station.render.notation.screen.kept_values import KeptValues, same
from station.render.notation.screen.score_lines import (
    ROWS,
    ScoreLine,
    ShownLine,
    line_spaces,
    rows_of,
    score_lines,
    shown_lines,
)
from station.render.notation.screen.score_place import LEAST_SPACES, MOST_SPACES, ScoreForm, ScorePlace
from station.render.notation.screen.staff_legend import Legend, draw_legend, legend_of
from station.render.notation.screen.staff_marks import staff_marks
from station.render.notation.screen.time_span import (
    BEHIND_SHARE,
    MOST_AHEAD_S,
    ahead_s,
    rolling_spaces,
    visible_bars,
)
from station.render.notation.staff_rows import staff_rows
from station.render.palette import BRAND, PANEL_EDGE, PAPER, PAPER_LOW, with_opacity
from station.render.snapshot import Snapshot, Strip
from station.render.text.atlas import Atlas
from station.render.text.draw_list import SHAPE_DTYPE, DrawList

_MARGIN_S = 1.5
_CLEF_X, _SIGNATURE_X = 1.4, 1.4 + note_shapes.CLEF_WIDTH + note_shapes.SIGNATURE_GAP
_LEAST_LEAD = 7.0
"""What the clef and the time signature take at the least; our choice."""
_AFTER_SIGNATURE = 1.6
"""Notes fade out from so far behind the time signature (`fade`), a little further than they do behind the clef."""
_BEFORE_LINE, _AFTER_LINE = 2.0, 1.5
"""Staff spaces that a line of a page leaves free before its first beat, for its bar line, and after its last."""
_LINE_WIDTH, _GLOW_WIDTH = 0.28, 3.2

_NO_LEGEND = Legend((), 0.0)
_BarsKey = tuple[int, int]


@dataclass(frozen=True, slots=True)
class ScorePaper:
    """What stands still of a score: where it lies, its form, its legend; `lead` is what stands before the music."""

    place: ScorePlace
    form: ScoreForm
    legend: Legend = _NO_LEGEND
    lead: float = _LEAST_LEAD
    is_free: bool = False


class ScoreView:
    """Keeps what it has engraved of the score that it drew last."""

    def __init__(self, printer: ShapeRenderer, atlas: Atlas) -> None:
        self._printer, self._atlas = printer, atlas
        self._highway = HighwayView(printer, atlas)
        self._engraver: Engraver | None = None
        self._limbs: NDArray[np.int8] | None = None
        self._bars: dict[int, NDArray[np.void]] = {}
        self._lines: dict[_BarsKey, NDArray[np.void]] = {}
        self._marked: dict[_BarsKey, tuple[tuple[object, ...], NDArray[np.void]]] = {}
        self._kept = KeptValues()

    # --- what stands still --------------------------------------------------------------------------------------------

    def paper(
        self, snapshot: Snapshot, box: tuple[int, int, int, int], form: ScoreForm, has_legend: bool
    ) -> ScorePaper:
        """How the snapshot's score lies in `box` (left, top, width, height)."""
        left, top, width, height = map(float, box)
        if snapshot.strip is not None:
            return ScorePaper(ScorePlace(left, top, width, height), form, is_free=True)
        score = snapshot.score
        named = self._kept.once("legend", (score,), partial(legend_of, score, self._atlas))
        if not form.is_staff:
            return ScorePaper(ScorePlace(left, top, width, height), form, named)
        legend = named if has_legend else _NO_LEGEND
        lead = self._kept.once("lead", (score,), partial(lead_spaces, score)) + legend.width
        reach = self._kept.once("reach", (score, snapshot.limbs), lambda: staff_rows(score, snapshot.limbs).reach)
        if form is ScoreForm.SCROLLING:
            across = self._kept.once("rolls", (score,), partial(rolling_spaces, score))
            return ScorePaper(ScorePlace(left, top, width, height, reach, _within(lead + across)), form, legend, lead)
        across = self._kept.once("lines", (score,), partial(line_spaces, score)) + _BEFORE_LINE + _AFTER_LINE
        place = ScorePlace(left, top, width, height, reach, _within(lead + across), ROWS)
        lines, before = self._lines_of(snapshot, place, lead)
        return ScorePaper(replace(place, rows=rows_of(lines, snapshot.comes_again, before)), form, legend, lead)

    def draw_paper(self, snapshot: Snapshot, paper: ScorePaper, size: tuple[int, int]) -> None:
        """Draw what a score lies on and what of it never moves, in a picture of `size`."""
        sheet, place = Transform(size), paper.place
        self._printer.fill((place.left, place.top, place.width, place.height), (PAPER, PAPER_LOW), sheet)
        self._printer.fill((place.left, place.top, place.width, 1.2), (PANEL_EDGE, PANEL_EDGE), sheet)
        if not (paper.form.is_staff or paper.is_free):
            self._highway.draw_paper(snapshot, place, size, paper.form)
            return
        for number in range(place.rows):
            row = place.row(number)
            draw_list = DrawList(self._atlas)
            bottom = (row.top + row.height - row.middle_line) / row.space
            draw_legend(draw_list, paper.legend, (row.top_y, bottom))
            self._printer.draw(draw_list.shapes(), Transform(size, (row.left, row.middle_line), row.space))
            left, draw_list = row.left + paper.legend.width * row.space, DrawList(self._atlas)
            note_shapes.staff_lines(draw_list, (row.left + row.width - left) / row.space)
            note_shapes.clef(draw_list, _CLEF_X)
            self._printer.draw(draw_list.shapes(), Transform(size, (left, row.middle_line), row.space))

    # --- what moves ---------------------------------------------------------------------------------------------------

    def draw(self, snapshot: Snapshot, paper: ScorePaper, size: tuple[int, int]) -> None:
        """Draw the score of `snapshot` over its paper in a picture of `size`."""
        if snapshot.strip is not None:
            self._draw_strip(snapshot.strip, snapshot.position_s, paper.place, size)
        elif not paper.form.is_staff:
            self._highway.draw(snapshot, paper.place, size, paper.form)
        elif paper.form is ScoreForm.PAGED:
            self._draw_page(snapshot, paper, size)
        else:
            self._draw_rolling(snapshot, paper, size)

    def _draw_rolling(self, snapshot: Snapshot, paper: ScorePaper, size: tuple[int, int]) -> None:
        place, space, score = paper.place, paper.place.space, snapshot.score
        first_x, right = place.left + paper.lead * space, place.left + place.width
        across = right - first_x
        ahead = (1 - BEHIND_SHARE) * across
        coming_s = self._kept.once("ahead", (score, ahead / space), partial(ahead_s, score, ahead / space))
        per_s, line_x = ahead / coming_s, right - ahead
        fade = (first_x - 1.2 * space, first_x + space, right - 3 * space, right)
        rolling = Transform(size, (line_x, place.middle_line), space, snapshot.position_s, per_s, fade)
        window_s = snapshot.position_s - across / per_s - _MARGIN_S, snapshot.position_s + coming_s + _MARGIN_S
        tick = max(int(score.tempo_map.ticks_at(snapshot.position_s)), 0)
        bars = visible_bars(score, *window_s)
        self._draw_play_line(place, line_x, size)
        self._draw_signature(snapshot, paper, place, int(score.tempo_map.bars_at(tick)), size)
        self._printer.draw(self._rolling_bars(snapshot, bars), rolling)
        self._printer.draw(self._marks(snapshot, (bars.start, bars.stop), per_s / space), rolling)

    def _draw_page(self, snapshot: Snapshot, paper: ScorePaper, size: tuple[int, int]) -> None:
        place, lead = paper.place, paper.lead
        lines, before = self._lines_of(snapshot, place, lead)
        for shown in shown_lines(lines, snapshot.position_s, snapshot.comes_again, before):
            self._draw_line(snapshot, paper, shown, size)

    def _draw_line(self, snapshot: Snapshot, paper: ScorePaper, shown: ShownLine, size: tuple[int, int]) -> None:
        place, space, line = paper.place.row(shown.row), paper.place.space, shown.line
        left = place.left + (paper.lead + _BEFORE_LINE) * space
        wide = (place.left + place.width - left - _AFTER_LINE * space) * line.share
        per_s = wide / max(line.end_s - line.start_s, 1e-3)
        if shown.is_played:
            passed_s = min(max(snapshot.position_s, line.start_s), line.end_s) - line.start_s
            self._draw_play_line(place, left + passed_s * per_s, size)
        if shown.left == 0.0:
            self._draw_signature(snapshot, paper, place, line.first, size)
        starts = (left + shown.left * wide, left + shown.left * wide + space) if shown.left else (0.0, 1.0)
        ends = (left + shown.right * wide - space, left + shown.right * wide) if shown.right < 1 else (1e6, 1e6 + 1)
        sheet = Transform(size, (left, place.middle_line), space, line.start_s, per_s, (*starts, *ends))
        self._printer.draw(self._line_shapes(snapshot, line), sheet)
        if not shown.is_again:
            self._printer.draw(self._marks(snapshot, (line.first, line.after), per_s / space), sheet)

    def _draw_play_line(self, place: ScorePlace, x: float, size: tuple[int, int]) -> None:
        plain, glow, line = Transform(size), with_opacity(BRAND, 0.07), with_opacity(BRAND, 0.95)
        for spaces, colour in ((_GLOW_WIDTH, glow), (_LINE_WIDTH, line)):
            wide = spaces * place.space
            self._printer.fill((x - wide / 2, place.top, wide, place.height), (colour, colour), plain)

    def _draw_signature(
        self, snapshot: Snapshot, paper: ScorePaper, place: ScorePlace, bar: int, size: tuple[int, int]
    ) -> None:
        draw_list, left = DrawList(self._atlas), place.left + paper.legend.width * place.space
        note_shapes.time_signature(draw_list, self._engraved(snapshot).signs.meter_of(bar), _SIGNATURE_X)
        self._printer.draw(draw_list.shapes(), Transform(size, (left, place.middle_line), place.space))

    def _draw_strip(self, strip: Strip, position_s: float, place: ScorePlace, size: tuple[int, int]) -> None:
        """What was played passes the line, which stands in the middle: nothing is known of what comes."""
        space, half_s = place.space, MOST_AHEAD_S
        per_s, line_x = place.width / (2 * half_s), place.left + place.width / 2
        plain = Transform(size, (place.left, place.middle_line), space)
        self._printer.draw(strip_paper(self._atlas, place.width / space, (place.top_y, place.height / space)), plain)
        fade = (place.left, place.left + 3 * space, place.left + place.width - 3 * space, place.left + place.width)
        rolling = Transform(size, (line_x, place.middle_line), space, position_s, per_s, fade)
        window_s = position_s - half_s - _MARGIN_S, position_s + half_s + _MARGIN_S
        self._printer.draw(strip_shapes(strip, window_s, self._atlas), rolling)

    # --- what is kept -------------------------------------------------------------------------------------------------

    def _engraved(self, snapshot: Snapshot) -> Engraver:
        engraver, limbs = self._engraver, snapshot.limbs
        if engraver is None or engraver.score is not snapshot.score or not same((self._limbs,), (limbs,)):
            engraver = Engraver(snapshot.score, self._atlas, limbs, snapshot.bar_numbers, snapshot.beat_ticks)
            if snapshot.spelling is not None:
                engraver = engraver.of_take(snapshot.spelling)
            self._engraver, self._limbs = engraver, limbs
            self._bars.clear()
            self._lines.clear()
            self._marked.clear()
        return engraver

    def _rolling_bars(self, snapshot: Snapshot, bars: range) -> NDArray[np.void]:
        engraver = self._engraved(snapshot)
        for bar in bars:
            if bar not in self._bars:
                self._bars[bar] = engraver.bar(bar)
        return np.concatenate([self._bars[bar] for bar in bars] or [np.empty(0, SHAPE_DTYPE)])

    def _line_shapes(self, snapshot: Snapshot, line: ScoreLine) -> NDArray[np.void]:
        """The bars of a line, and the bar line that closes it."""
        engraver, key = self._engraved(snapshot), (line.first, line.after)
        if key not in self._lines:
            closing = DrawList(self._atlas)
            closing.time_s = line.end_s
            engraver.signs.draw_line(closing, line.after, opens=False)
            bars = [engraver.bar(bar, opens_line=bar == line.first) for bar in range(line.first, line.after)]
            self._lines[key] = np.concatenate([*bars, closing.shapes()])
        return self._lines[key]

    def _marks(self, snapshot: Snapshot, bars: _BarsKey, spaces_per_s: float) -> NDArray[np.void]:
        """The marks of some bars, drawn anew where one of the score changed."""
        self._engraved(snapshot)
        key = snapshot.marks, snapshot.extras, spaces_per_s
        known = self._marked.get(bars)
        if known is None or known[0][0] is not key[0] or known[0][1:] != key[1:]:
            heads = self._kept.once("heads", (snapshot.score,), partial(heads_x, snapshot.score))
            known = self._marked[bars] = key, staff_marks(snapshot, bars, heads, spaces_per_s, self._atlas)
        return known[1]

    def _lines_of(self, snapshot: Snapshot, place: ScorePlace, lead: float) -> tuple[tuple[ScoreLine, ...], int]:
        """The lines of the score, and how many were shown of what was played before it."""
        across = place.width / place.space - lead - _BEFORE_LINE - _AFTER_LINE
        numbers, before = snapshot.bar_numbers, snapshot.before
        lines = self._kept.once("page", (snapshot.score, across), lambda: score_lines(snapshot.score, numbers, across))
        if before is None:
            return lines, 0
        earlier = replace(numbers, passes=None)
        return lines, self._kept.once("before", (before, across), lambda: len(score_lines(before, earlier, across)))


def _within(spaces: float) -> float:
    """As many staff spaces as a score may be wide."""
    return min(max(LEAST_SPACES, spaces), MOST_SPACES)


def lead_spaces(score: Score) -> float:
    """What the clef and the widest of the score's time signatures take on the left, in staff spaces."""
    widest = max(note_shapes.signature_width(meter) for meter in score.tempo_map.meters)
    return max(_LEAST_LEAD, _SIGNATURE_X + widest + _AFTER_SIGNATURE)
