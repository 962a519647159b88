"""The page about a week on paper: the same words and the same chart as in a browser."""

from station.render.palette import INK, INK_SOFT
from station.render.report.page.charts.week_chart import week_chart
from station.render.report.page.paper_flow import SOFT, TITLE, PaperFlow
from station.render.report.page.week_page import WeekPage
from station.render.text.draw_list import TypeStyle
from station.render.text.paper import OutlineAtlas

_LEAD = TypeStyle(14.0, INK)
_WORDS = TypeStyle(10.5, INK)
_TABLE = (0.78, 0.22)
_CHART = 0.8
"""How much of the line the chart takes (our choice)."""


def week_pdf(page: WeekPage) -> bytes:
    """The page as a PDF file."""
    flow = PaperFlow(page.title, OutlineAtlas())
    flow.paragraph(page.title, TITLE)
    flow.paragraph(page.when, TypeStyle(10.5, INK_SOFT))
    flow.gap()
    flow.paragraph(page.headline, _LEAD)
    if page.kind:
        flow.paragraph(page.kind, _WORDS)
    _chart(flow, page)
    _played(flow, page)
    for note in page.notes:
        flow.gap()
        flow.heading(f"From the teacher: {note.teacher}, {note.when}")
        for line in note.lines:
            flow.paragraph(line, _WORDS)
    if page.ahead:
        flow.gap()
        flow.heading("What comes next")
        for line in page.ahead:
            flow.bullet(line)
    if page.streak:
        flow.gap()
        flow.heading("Week by week")
        flow.paragraph(page.streak, _WORDS)
    flow.gap()
    for line in page.foot:
        flow.paragraph(line, SOFT)
    return flow.pdf(page.student)


def _chart(flow: PaperFlow, page: WeekPage) -> None:
    if page.days:
        flow.gap()
        chart = week_chart(page.days, flow.atlas)
        flow.drawing(chart.shapes, _CHART * flow.width / chart.size[0], (0.0, chart.size[1]))
        flow.paragraph("Minutes of playing on each day.", SOFT)


def _played(flow: PaperFlow, page: WeekPage) -> None:
    if not page.played:
        return
    flow.gap()
    flow.heading("What was practised")
    flow.table(page.played, _TABLE)
    flow.gap()
    flow.heading("What got better")
    for line in page.better:
        flow.bullet(line)
    flow.paragraph(page.better_words, SOFT)
