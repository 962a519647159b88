"""The page about a week as HTML that stands alone, without any script."""

from markupsafe import Markup

from station.render.files.svg_file import SvgPaths
from station.render.report.page.charts.week_chart import week_chart
from station.render.report.page.html_page import drawn, templates
from station.render.report.page.week_page import WeekPage
from station.render.text.paper import OutlineAtlas

POLICY = "default-src 'none'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'"
"""Content Security Policy Level 3: the page's own style, and nothing else."""


def week_html(page: WeekPage) -> str:
    """The page; whatever people wrote is escaped."""
    paths = SvgPaths(OutlineAtlas())
    chart = drawn(week_chart(page.days, paths.atlas), paths) if page.days else None
    outlines = Markup(paths.definitions())
    return templates().get_template("week.html").render(page=page, chart=chart, outlines=outlines, policy=POLICY)
