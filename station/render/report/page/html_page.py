"""A page about one session as HTML that stands alone: no server, no download, nothing from a network.

Names, titles and notes are hostile text: the templates escape whatever is not our own drawing.
"""

from dataclasses import dataclass
from functools import cache
from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup, escape

from station.render.files.svg_file import SvgPaths, figures, style_of
from station.render.palette import Theme
from station.render.report.page.bars_markup import bar_lines, legend, sign_definitions
from station.render.report.page.charts.chart import Chart
from station.render.report.page.session_charts import session_charts
from station.render.report.page.session_page import SessionPage
from station.render.report.page.timing_words import mean_figures, spread_figures
from station.render.text.paper import OutlineAtlas

TEMPLATES = Path(__file__).with_name("templates")
POLICY = (
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
    "media-src data: blob:; connect-src data: blob:; base-uri 'none'; form-action 'none'"
)
"""Content Security Policy Level 3: what is within the page, and nothing else."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """A chart as the templates take it."""

    title: str
    says: str
    legend: str
    picture: Markup


@cache
def templates() -> Environment:
    """The templates of all pages; what they are not given is a fault of ours."""
    found = Environment(loader=FileSystemLoader(TEMPLATES), autoescape=True, undefined=StrictUndefined)
    found.trim_blocks = found.lstrip_blocks = True
    found.globals |= {
        "policy": POLICY,
        "day": Markup(style_of(Theme.DAY)),
        "night": Markup(style_of(Theme.NIGHT)),
        "mean_figures": mean_figures,
        "spread_figures": spread_figures,
    }
    return found


def session_html(page: SessionPage, take: str = "") -> str:
    """The page; `take` is the markup of what is to be seen and heard of the session, empty where there is none."""
    paths = SvgPaths(OutlineAtlas())
    lines = [Markup(line) for line in bar_lines(page.bars, paths)]
    charts = [drawn(chart, paths) for chart in session_charts(page, paths.atlas)]
    samples = [(Markup(sample), words) for sample, words in legend(page.bars, paths)]
    outlines = Markup(sign_definitions(paths) + paths.definitions())
    return (
        templates()
        .get_template("session.html")
        .render(
            page=page,
            lines=lines,
            charts=charts,
            samples=samples,
            outlines=outlines,
            take=Markup(take),
        )
    )


def drawn(chart: Chart, paths: SvgPaths) -> Drawn:
    """A chart as an inline picture whose places tell what they show."""
    width, height = map(figures, chart.size)
    spots = "".join(
        f'<rect class="spot" x="{figures(spot.left)}" y="{figures(spot.top)}" width="{figures(spot.width)}"'
        f' height="{figures(spot.height)}"><title>{escape(spot.words)}</title></rect>'
        for spot in chart.spots
    )
    label = escape(f"{chart.title}. {chart.words}")
    svg = (
        f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{label}">{paths.areas(chart.shapes)}{spots}</svg>'
    )
    return Drawn(chart.title, chart.says, chart.legend, Markup(svg))
