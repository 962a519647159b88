"""Where pieces and limbs lean and how far they spread: a row each, the mean with its interval over a bar of one SD."""

from collections.abc import Sequence

from station.render.palette import INK_SOFT
from station.render.report.page.charts.chart import (
    CUT,
    LABEL,
    LETTER,
    NUMBER,
    WIDTH,
    Axis,
    Chart,
    Spot,
    mean_mark,
    reach_ms,
    sides,
    spread_bar,
    time_axis,
    time_colour,
)
from station.render.report.page.session_page import GroupFigures
from station.render.report.page.timing_words import side, timing_words
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle

_LEFT, _RIGHT, _SAID = 108.0, 292.0, 304.0
_TOP, _ROW = 30.0, 34.0


def lean_chart(title: str, groups: Sequence[GroupFigures], on_time_ms: float, atlas: Atlas) -> Chart:
    """The rows of `groups`, those with the most notes first."""
    rows = sorted((each for each in groups if each.notes), key=lambda each: -each.notes)
    ends = [abs(row.timing.mean_ms) + (row.timing.sd_ms or 0.0) for row in rows if row.timing.mean_ms is not None]
    reach = reach_ms(ends, 40.0, 100.0)
    axis, draw_list, low = Axis(-reach, reach, _LEFT, _RIGHT), DrawList(atlas), _TOP + _ROW * len(rows)
    time_axis(draw_list, axis, _TOP - 6, low, 20.0 if reach <= 40.0 else 40.0)
    sides(draw_list, axis, 16.0)
    spots = [_row(draw_list, axis, row, _TOP + _ROW * (index + 0.5), on_time_ms) for index, row in enumerate(rows)]
    words = " ".join(f"{spot.words}." for spot in spots)
    return Chart(title, words, draw_list.shapes(), (WIDTH, low + 24.0), tuple(spots), _LEGEND)


_LEGEND = f"The dot is the mean, its whiskers the 95 % interval ({CUT}); the soft bar is one SD to either side."


def _row(draw_list: DrawList, axis: Axis, row: GroupFigures, y: float, on_time_ms: float) -> Spot:
    timing = row.timing
    draw_list.text(draw_list.fitted(row.name, NUMBER, _LEFT - 10.0), (0.0, y - 1.0), NUMBER)
    small = TypeStyle(LETTER - 2, INK_SOFT)
    draw_list.text(f"{row.matched} of {row.notes}", (0.0, y + 12.5), small)
    if timing.mean_ms is not None:
        colour = time_colour(timing.mean_ms, on_time_ms)
        if timing.sd_ms is not None:
            spread_bar(draw_list, axis, y, (timing.mean_ms - timing.sd_ms, timing.mean_ms + timing.sd_ms), colour, 8.0)
        mean_mark(draw_list, axis, y, timing.mean_ms, timing.mean_ci, colour)
        draw_list.text(side(timing.mean_ms), (_SAID, y - 1.0), NUMBER)
        if timing.sd_ms is not None:
            draw_list.text(f"SD {timing.sd_ms:.1f} ms", (_SAID, y + 13.0), TypeStyle(LETTER - 2, INK_SOFT))
    else:
        draw_list.text("nothing to measure", (_SAID, y + 4.0), LABEL)
    words = f"{row.name[:1].upper()}{row.name[1:]}, {row.matched} of {row.notes} played: {timing_words(timing)}"
    return Spot(words, 0.0, y - _ROW / 2, WIDTH, _ROW)
