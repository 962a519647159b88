"""Which charts a page about a session has: those that have something to show."""

from collections.abc import Iterator

from station.render.report.page.charts.asynchrony_histogram import asynchrony_histogram
from station.render.report.page.charts.bar_chart import bar_chart
from station.render.report.page.charts.chart import Chart
from station.render.report.page.charts.lean_chart import lean_chart
from station.render.report.page.charts.loudness_chart import loudness_chart
from station.render.report.page.charts.tempo_chart import tempo_chart
from station.render.report.page.session_page import SessionPage
from station.render.text.atlas import Atlas


def session_charts(page: SessionPage, atlas: Atlas) -> Iterator[Chart]:
    """The charts in the order in which they are read."""
    on_time_ms = page.timing.on_time_ms
    if len(page.timing.asynchrony_ms):
        yield asynchrony_histogram(page.timing, atlas)
        yield lean_chart("Piece by piece", page.pieces, on_time_ms, atlas)
        if page.limbs:
            yield lean_chart("Limb by limb", page.limbs, on_time_ms, atlas)
    if page.hands:
        yield lean_chart("Hands beside their common motion", page.hands, on_time_ms, atlas)
    if page.by_bar:
        yield bar_chart(page.by_bar, on_time_ms, atlas)
    if len(page.tempo.at_s):
        yield tempo_chart(page.tempo, atlas)
    if page.loudness:
        yield loudness_chart(page.loudness, atlas)
