"""Trends of a lesson: a plot and a sentence for each measure, and what they rest on."""

from collections.abc import Callable
from dataclasses import replace
from datetime import timedelta

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.history_actions import Asked
from station.app.actions.teacher_actions import TakeUp
from station.app.history.history_shown import HistoryPages
from station.gui import theme
from station.gui.widgets import plots
from station.gui.widgets.long_combo import long_combo
from station.practice.history.trends import WORDS, Measure, Trend, Verdict, trend_words
from station.render import palette

LESSON_LABEL, PRACTISE_LABEL = "##trend-lesson", "Practise it##trend"
_HIGH = 130.0
"""Design pixels of a plot."""
_ABOUT = (
    "A dot is a day, brought to the tempo that you played most; the band holds the line 19 times in 20. Only sessions"
    " on one kit, at one level and near one tempo are compared."
)
_TIPS = {
    Measure.SCORE: "Points of 100, as the reports gave them",
    Measure.SPREAD: "How far strokes scatter about your own pulse, as a standard deviation: lower is steadier",
    Measure.LEAN: "The mean of all strokes against the click: above 0 is late, below is early",
    Measure.TEMPO: "At which tempo you played it: a choice, not a mark",
}
_TICKS = 3
_MARGIN = 0.12


class TrendsPart:
    """Draws them; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, pages: HistoryPages, asked: Asked) -> Asked:
        """Draw them; returns what is asked for now."""
        if not pages.lessons:
            theme.soft("Trends are those of lessons, and no lesson has been practised yet.")
            return asked
        shown = pages.trends
        names = [each.name for each in pages.lessons]
        titles = [f"{each.title} ({each.sessions})##{each.name}" for each in pages.lessons]
        wanted = asked.lesson if asked.lesson in names else names[0]
        imgui.set_next_item_width(-1)
        at = long_combo(LESSON_LABEL, names.index(wanted), titles)
        theme.tooltip("The lesson that is looked at, the last one practised first; in brackets how often")
        if names[at] != wanted:
            return replace(asked, lesson=names[at])
        if shown is None:
            theme.soft("Reading …")
            return asked
        theme.soft(_ABOUT)
        if imgui.begin_child("##trends"):
            for trend in shown.trends:
                _trend(trend)
            if imgui.button(PRACTISE_LABEL, imgui.ImVec2(theme.points(_HIGH), 0)):
                self._dispatch(TakeUp(shown.lesson))
            theme.tooltip("Choose this lesson in the list")
        imgui.end_child()
        return asked


def _trend(trend: Trend) -> None:
    words = WORDS[trend.measure]
    near = "" if trend.near is None or trend.line is None else f", as at {trend.near:.0f} bpm"
    theme.part(f"{words.label} in {words.unit}{near}")
    is_news = trend.is_sure and trend.verdict in (Verdict.BETTER, Verdict.WORSE, Verdict.CHANGED)
    imgui.text_wrapped(trend_words(trend)) if is_news else theme.soft(trend_words(trend))
    if trend.points and implot.begin_plot(f"##{trend.measure}", imgui.ImVec2(-1, theme.points(_HIGH)), plots.SEEN):
        _plot(trend)
        implot.end_plot()
        theme.tooltip(_TIPS[trend.measure])


def _plot(trend: Trend) -> None:
    line = trend.line
    if line is None:
        day = np.array([point.day for point in trend.points])
        value = np.array([point.value for point in trend.points])
    else:
        day, value = line.days, line.values
    shown = value if trend.measure is not Measure.LEAN else np.append(value, 0.0)
    span = max(float(np.ptp(shown)), WORDS[trend.measure].small)
    first, last = float(day[0]), max(float(day[-1]), float(day[0]) + 1.0)
    edge = (last - first) * _MARGIN / 2
    plots.fixed(implot.ImAxis_.x1, first - edge, last + edge)
    plots.fixed(implot.ImAxis_.y1, float(shown.min()) - _MARGIN * span, float(shown.max()) + _MARGIN * span)
    _dates(trend, first, last)
    if trend.measure is Measure.LEAN:
        plots.across("##beat", [0.0], plots.spec(palette.INK_FAINT))
    if line is not None:
        at = np.linspace(first, last, 40)
        middle, half = line.at(at), line.half_width(at)
        implot.plot_shaded(
            "##band", at, middle - half, middle + half, plots.spec(palette.with_opacity(palette.GOOD, 0.25))
        )
        implot.plot_line("##line", at, middle, plots.spec(palette.GOOD, 2.0))
    implot.plot_scatter("##days", day, value, plots.spec(palette.BRAND, 1.0, 3.5, implot.Marker_.circle))


def _dates(trend: Trend, first: float, last: float) -> None:
    """Dates near the first day, in the middle and near the last."""
    if trend.first is None:
        return
    inset = (last - first) * _MARGIN  # so that no date is cut off
    places = np.linspace(first + inset, last - inset, _TICKS)
    dates = [trend.first + timedelta(days=round(place)) for place in places]
    implot.setup_axis_ticks(implot.ImAxis_.x1, [float(at) for at in places], [f"{at.day} {at:%b %y}" for at in dates])
