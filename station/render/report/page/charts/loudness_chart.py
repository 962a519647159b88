"""How loud what was written was played: a row for each piece and mark, from a ghost to an accent."""

from collections.abc import Sequence

import numpy as np

from station.render.palette import BRAND, GOOD, INK, INK_FAINT, INK_SOFT, with_opacity
from station.render.report.page.charts.chart import HAIR, LETTER, NUMBER, WIDTH, Axis, Chart, Spot
from station.render.report.page.session_page import LoudnessRow
from station.render.text.atlas import Atlas
from station.render.text.draw_list import DrawList, TypeStyle

_LEFT, _RIGHT, _SAID = 128.0, 318.0, 328.0
_TOP, _ROW = 12.0, 30.0


def loudness_chart(rows: Sequence[LoudnessRow], atlas: Atlas) -> Chart:
    """The chart of `rows`, at least one."""
    axis, draw_list = Axis(0.0, 127.0, _LEFT, _RIGHT), DrawList(atlas)
    low = _TOP + _ROW * len(rows)
    for value in (0, 32, 64, 96, 127):
        x = axis.x(value)
        draw_list.box((x - HAIR / 2, _TOP), (HAIR, low - _TOP), with_opacity(INK_FAINT, 0.5))
        draw_list.text(str(value), (x, low + LETTER + 2), TypeStyle(LETTER - 1, INK_SOFT, align=0.5))
    draw_list.text("soft", (_LEFT - 8, low + LETTER + 2), TypeStyle(LETTER - 1, INK_SOFT, align=1.0))
    draw_list.text("loud", (_RIGHT + 16, low + LETTER + 2), TypeStyle(LETTER - 1, INK_SOFT))
    spots = [_row(draw_list, axis, row, _TOP + _ROW * (index + 0.5)) for index, row in enumerate(rows)]
    words = " ".join(f"{spot.words}." for spot in spots)
    legend = (
        "MIDI velocity. The line is what is written, the dot the middle of what was played; half of the strokes lie"
    )
    return Chart(
        "How loud",
        words,
        draw_list.shapes(),
        (WIDTH, low + 24.0),
        tuple(spots),
        f"{legend} in the dark bar, eight of ten in the light one.",
    )


def _row(draw_list: DrawList, axis: Axis, row: LoudnessRow, y: float) -> Spot:
    name = f"{row.piece}, {row.kind}"
    draw_list.text(draw_list.fitted(name, NUMBER, _LEFT - 10.0), (0.0, y + 4.5), NUMBER)
    far_low, low, middle, high, far_high = np.percentile(row.played, [10, 25, 50, 75, 90]).tolist()
    for (left, right), half, opacity in (((far_low, far_high), 4.0, 0.3), ((low, high), 7.0, 0.55)):
        x = axis.x(left)
        draw_list.box((x, y - half), (max(axis.x(right) - x, 1.0), 2 * half), with_opacity(GOOD, opacity))
    draw_list.box((axis.x(row.written) - 1.2, y - 11.0), (2.4, 22.0), BRAND)
    draw_list.ellipse((axis.x(middle), y), (3.6, 3.6), INK)
    draw_list.text(f"{middle:.0f}, asked {row.written:.0f}", (_SAID, y + 4.5), TypeStyle(LETTER - 1, INK))
    count = len(row.played)
    words = f"{name[:1].upper()}{name[1:]}: {count} {'stroke' if count == 1 else 'strokes'},"
    return Spot(f"{words} {middle:.0f} in the middle for {row.written:.0f} written", 0.0, y - _ROW / 2, WIDTH, _ROW)
