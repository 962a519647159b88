"""Trends of a lesson: a plot and a sentence for each measure, and what they rest on."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from datetime import timedelta

import numpy as np
from imgui_bundle import imgui, implot

from station.app.actions.action import Action
from station.app.actions.history_actions import Asked
from station.app.actions.teacher_actions import TakeUp
from station.app.history.history_shown import HistoryPages
from station.app.history.trend_shown import axis_of, dot_words, dots_of, told
from station.gui import theme
from station.gui.widgets import plots
from station.gui.widgets.long_combo import long_combo
from station.practice.progress.trends import WORDS, Measure, Trend, Verdict
from station.render import palette
from station.store.rows import SessionRow

LESSON_LABEL, PRACTISE_LABEL = "##trend-lesson", "Practise it##trend"
_HIGH = 130.0
"""Design pixels of a plot."""
_ABOUT = (
    "A dot is a day, brought to the tempo that you played most; the two lines are the means of the first days and"
    " of the last. Only the same bars of the lesson on one kit, at one level and near one tempo are compared."
)
_TIPS = {
    Measure.SCORE: "Points of 100, as the reports gave them",
    Measure.SPREAD: "How far strokes scatter about your own pulse, as a standard deviation: lower is steadier",
    Measure.LEAN: "The mean of all strokes against the click: above 0 is late, below is early",
    Measure.TEMPO: "At which tempo you played it: a choice, not a mark",
}
_NEAR = 8.0
"""A dot is pointed at from so many design pixels."""
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
            rows = {row.id: row for row in pages.sessions}
            for trend in shown.trends:
                _trend(trend, rows)
            if imgui.button(PRACTISE_LABEL, imgui.ImVec2(theme.points(_HIGH), 0)):
                self._dispatch(TakeUp(shown.lesson))
            theme.tooltip("Choose this lesson in the list")
        imgui.end_child()
        return asked


def _trend(trend: Trend, rows: Mapping[int, SessionRow]) -> None:
    words = WORDS[trend.measure]
    near = "" if trend.near is None or trend.compared is None else f", as at {trend.near:.0f} bpm"
    theme.part(f"{words.label} in {words.unit}{near}")
    is_news = trend.is_sure and trend.verdict in (Verdict.BETTER, Verdict.WORSE, Verdict.CHANGED)
    imgui.text_wrapped(told(trend)) if is_news else theme.soft(told(trend))
    if trend.points and implot.begin_plot(f"##{trend.measure}", imgui.ImVec2(-1, theme.points(_HIGH)), plots.SEEN):
        pointed = _plot(trend)
        implot.end_plot()
        theme.tooltip(_TIPS[trend.measure] if pointed is None else dot_words(trend, pointed, rows))


def _plot(trend: Trend) -> int | None:
    """Draw it; returns the dot that is pointed at, None for none."""
    compared = trend.compared
    day, value = dots_of(trend)
    low, high = axis_of(trend.measure, value)
    span = high - low
    first, last = float(day[0]), max(float(day[-1]), float(day[0]) + 1.0)
    edge = (last - first) * _MARGIN / 2
    plots.fixed(implot.ImAxis_.x1, first - edge, last + edge)
    plots.fixed(implot.ImAxis_.y1, low - _MARGIN * span, high + _MARGIN * span)
    _dates(trend, first, last)
    if trend.measure is Measure.LEAN:
        plots.across("##beat", [0.0], plots.spec(palette.INK_FAINT))
    if compared is not None:
        _mean("early", compared.early_days, compared.early, compared.mean_half)
        _mean("late", compared.late_days, compared.late, compared.mean_half)
    implot.plot_scatter("##days", day, value, plots.spec(palette.BRAND, 1.0, 3.5, implot.Marker_.circle))
    return _pointed_at(day, value)


def _pointed_at(day: plots.Array, value: plots.Array) -> int | None:
    mouse, near = imgui.get_mouse_pos(), theme.points(_NEAR)
    places = [implot.plot_to_pixels(float(x), float(y)) for x, y in zip(day, value, strict=True)]
    off = [((place.x - mouse.x) ** 2 + (place.y - mouse.y) ** 2) ** 0.5 for place in places]
    nearest = min(range(len(off)), key=off.__getitem__)
    return nearest if off[nearest] <= near else None


def _mean(name: str, days: tuple[float, float], mean: float, half: float) -> None:
    """The mean of the first days, or of the last, within its 95 % interval."""
    at, middle = np.array(days), np.full(2, mean)
    faint = plots.spec(palette.with_opacity(palette.GOOD, 0.25))
    implot.plot_shaded(f"##{name}-band", at, middle - half, middle + half, faint)
    implot.plot_line(f"##{name}", at, middle, plots.spec(palette.GOOD, 2.0))


def _dates(trend: Trend, first: float, last: float) -> None:
    """Dates near the first day, in the middle and near the last."""
    if trend.first is None:
        return
    inset = (last - first) * _MARGIN  # so that no date is cut off
    places = np.linspace(first + inset, last - inset, _TICKS)
    dates = [trend.first + timedelta(days=round(place)) for place in places]
    implot.setup_axis_ticks(implot.ImAxis_.x1, [float(at) for at in places], [f"{at.day} {at:%b %y}" for at in dates])
