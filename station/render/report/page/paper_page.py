"""A page about one session on paper: the same facts, charts and engraved bars as in a browser, on pages of A4."""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from station.render.palette import INK, INK_SOFT
from station.render.report.page.charts.chart import Chart
from station.render.report.page.engraved_bars import BarsSetter, EngravedLine
from station.render.report.page.note_signs import STATE_COLOURS, STATE_WORDS, sign_of
from station.render.report.page.paper_flow import BODY, HEADING, SOFT, TITLE, PaperFlow, scaled
from station.render.report.page.session_charts import session_charts
from station.render.report.page.session_page import GroupFigures, JudgedBars, NoteState, SessionPage
from station.render.report.page.timing_words import mean_figures, spread_figures
from station.render.text.draw_list import LINE_HEIGHT, DrawList, TypeStyle
from station.render.text.fonts import Face
from station.render.text.paper import OutlineAtlas

_SPACE = 5.0
"""Points of a staff space: a staff of 7 mm, in which parts are printed (Gould, "Behind Bars", 2011: 6.5 to 7.5 mm)."""
_BETWEEN = 18.0
_POINTS = TypeStyle(34.0, INK, Face.BOLD)
_LEGEND = (NoteState.MATCH, NoteState.EARLY, NoteState.LATE, NoteState.MISS, NoteState.WRONG_PIECE)
_FIGURE_SHARES = (0.14, 0.07, 0.07, 0.08, 0.07, 0.07, 0.27, 0.23)


def session_pdf(page: SessionPage) -> bytes:
    """The page as a PDF file."""
    flow = PaperFlow(page.title, OutlineAtlas())
    _head(flow, page)
    _score(flow, page)
    _next(flow, page)
    _exam(flow, page)
    _bars(flow, page.bars)
    _charts(flow, list(session_charts(page, flow.atlas)))
    _passes(flow, page)
    for words in page.lists:
        flow.gap()
        flow.heading(words.heading)
        for line in words.lines:
            flow.bullet(line)
    _figures(flow, page)
    flow.gap()
    for line in page.foot:
        flow.paragraph(line, SOFT)
    flow.paragraph("Made by the drum station. Negative is early, and every interval is one of 95 %.", SOFT)
    return flow.pdf(page.student)


def _head(flow: PaperFlow, page: SessionPage) -> None:
    flow.paragraph(page.title, TITLE)
    flow.paragraph(" · ".join(filter(None, (page.student, page.when))), TypeStyle(10.0, INK_SOFT))
    flow.gap(4.0)
    flow.columns(page.labels, 3)
    for remark in page.remarks:
        flow.gap(4.0)
        flow.paragraph(remark)


def _score(flow: PaperFlow, page: SessionPage) -> None:
    beside, wide = flow.left + 84.0, flow.width - 84.0
    points = "–" if page.score is None else f"{page.score:.0f}"
    counts = [f"{page.right} of {page.notes} right", f"{page.misses} missed", f"{page.wrong} on a wrong piece"]
    counts += [f"{page.extras} extra", *([page.played_again_words] if page.played_again else [])]
    counts += [*([f"{page.unknown} could not be heard"] if page.unknown else [])]
    counted = " · ".join(counts)
    height = flow.words_height(page.headline, HEADING, wide)
    whole = max(height + 2.0 + flow.words_height(counted, BODY, wide), 52.0)
    flow.gap()
    flow.room(whole)
    flow.words_at(points, (flow.left, flow.y), _POINTS, 80.0)
    flow.words_at("of 100", (flow.left, flow.y + 40.0), SOFT, 80.0)
    flow.words_at(page.headline, (beside, flow.y), HEADING, wide)
    flow.words_at(counted, (beside, flow.y + height + 2.0), BODY, wide)
    flow.gap(whole)
    if page.praise:
        flow.paragraph(page.praise)


def _next(flow: PaperFlow, page: SessionPage) -> None:
    flow.gap()
    flow.heading("What to practise next")
    for step in page.next_steps:
        flow.bullet(step.text, step.details)
    for choice in page.choices:
        flow.paragraph(f"– {choice}", SOFT, 10.0)


def _exam(flow: PaperFlow, page: SessionPage) -> None:
    if page.exam is None:
        return
    flow.gap()
    flow.heading(f"Exam: {page.exam.band}, {page.exam.total} of 100")
    rows = [("Criterion", "Points", "Measured")]
    flow.table([*rows, *((each.title, each.points, each.measured) for each in page.exam.lines)], (0.2, 0.2, 0.6), True)
    if page.exam.remark:
        flow.paragraph(page.exam.remark)


# --- bars -------------------------------------------------------------------------------------------------------------


def _bars(flow: PaperFlow, bars: JudgedBars) -> None:
    flow.gap()
    found = BarsSetter(bars, flow.atlas).lines(flow.width / _SPACE)
    flow.heading("Note by note", below=_SPACE * (found[0].bottom - found[0].top) if found else 0.0)
    for line in found:
        shapes = np.concatenate([line.ground, *_judged(bars, line, flow.atlas)])
        flow.drawing(shapes, _SPACE, (line.top - 0.8, line.bottom + 0.8))
    flow.room(20.0)
    x = flow.left + 6.0
    for state in _LEGEND:
        draw_list = DrawList(flow.atlas)
        draw_list.sign("head_round", (0.0, 0.0), STATE_COLOURS[state])
        flow.at(np.concatenate([draw_list.shapes(), sign_of(state, flow.atlas)]), _SPACE, (x, flow.y + 8.0))
        flow.words_at(STATE_WORDS[state], (x + 12.0, flow.y + 1.5), SOFT, 100.0)
        x += 92.0
    flow.gap(18.0)
    often = (
        f"Each note as it was over {bars.passes} passes: missed where half of them missed it, else early and late by"
    )
    often = f"{often} its mean. " * (bars.passes > 1)
    flow.paragraph(f"{often}On time is within {bars.on_time_ms:g} ms.", SOFT)


def _judged(bars: JudgedBars, line: EngravedLine, atlas: OutlineAtlas) -> Iterator[NDArray[np.void]]:
    """Every head in the colour of what became of it, with its sign."""
    for note in line.notes:
        state = bars.notes[note.index].state
        head = note.head.copy()
        colour = [round(255 * value) for value in STATE_COLOURS[state]]
        head["colour"] = head["colour_2"] = colour
        yield head
        yield scaled(sign_of(state, atlas), note.scale, (note.x, note.y))


# --- charts and tables ------------------------------------------------------------------------------------------------


def _charts(flow: PaperFlow, charts: Sequence[Chart]) -> None:
    """Two beside each other, each with its title above it and its words below."""
    wide = (flow.width - _BETWEEN) / 2
    for start in range(0, len(charts), 2):
        pair = charts[start : start + 2]
        flow.gap()
        heights = [_chart_height(flow, chart, wide) for chart in pair]
        flow.room(max(heights))
        for column, chart in enumerate(pair):
            _chart(flow, chart, flow.left + column * (wide + _BETWEEN), wide)
        flow.gap(max(heights))


def _said(chart: Chart) -> str:
    return " ".join(filter(None, (chart.says, chart.legend)))


def _chart_height(flow: PaperFlow, chart: Chart, wide: float) -> float:
    title = HEADING.size * LINE_HEIGHT + 6.0
    return title + chart.size[1] * wide / chart.size[0] + 4.0 + flow.words_height(_said(chart), SOFT, wide)


def _chart(flow: PaperFlow, chart: Chart, left: float, wide: float) -> None:
    unit, y = wide / chart.size[0], flow.y
    y += flow.words_at(chart.title, (left, y), HEADING, wide) + 6.0
    flow.at(chart.shapes, unit, (left, y))
    flow.words_at(_said(chart), (left, y + chart.size[1] * unit + 4.0), SOFT, wide)


def _passes(flow: PaperFlow, page: SessionPage) -> None:
    if not page.passes:
        return
    flow.gap()
    flow.heading(page.passes_heading)
    rows = [(row.which, row.tempo, row.bars, row.right, row.why) for row in page.passes]
    flow.table(rows, (0.1, 0.12, 0.14, 0.18, 0.46))


def _figures(flow: PaperFlow, page: SessionPage) -> None:
    flow.gap()
    flow.heading("All figures")
    groups = [*page.pieces, *page.limbs, *(bar.group for bar in page.by_bar)]
    head = ("", "notes", "hit", "missed", "wrong", "extra", "mean, ms (95 %)", "SD, ms (95 %)")
    flow.table([head, *map(_figure_row, groups)], _FIGURE_SHARES, has_head=True)


def _figure_row(group: GroupFigures) -> tuple[str, ...]:
    extras = "" if group.extras is None else str(group.extras)
    counts = (str(group.notes), str(group.matched), str(group.misses), str(group.wrong), extras)
    return (group.name, *counts, mean_figures(group.timing), spread_figures(group.timing))
