"""The calendar: the streak and this week in words, then month by month, the newest first, a cell a day."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.history.history_shown import HistoryPages
from station.core.counts import counted, whole_minutes
from station.gui import theme
from station.practice.book.book_words import day_in_words
from station.practice.history.session_list import SessionFilter
from station.practice.progress.calendar_days import Month, PractisedDay
from station.practice.progress.streaks import RULE, streak_words, this_week_words
from station.render import palette

FULL_DAY = 20.0
"""Minutes at which a day is quite filled: the usual plan's (TEACHING: sessions of 15 to 25 minutes)."""
_CELL, _LEAST_CELL = 46.0, 20.0
"""Design pixels of a day."""
_BETWEEN = 3.0
_FAINTEST, _FULLEST = 0.15, 0.75
"""Opacity of a day's shade, of the shortest practice and of a full day."""
_DAYS = ("Mo", "Tu", "We", "Th", "Fr", "Sa", "Su")
_TITLES = 6
"""So many titles are named of a day (our choice)."""


class CalendarPart:
    """Draws the calendar; a day that is pressed goes to `show` as a filter of the list of sessions."""

    def __init__(self, show: Callable[[SessionFilter], None]) -> None:
        self._show = show

    def gui(self, pages: HistoryPages) -> None:
        """Draw it."""
        streak = pages.streak
        theme.heading(streak_words(streak), 20)
        theme.tooltip(RULE)
        imgui.text_wrapped(f"{this_week_words(streak)}. {_minutes(pages.week_s)} played.")
        theme.soft(f"A day is quite filled at {FULL_DAY:.0f} minutes; press it for its sessions.")
        if imgui.begin_child("##months"):
            for month in pages.months:
                self._month(month, pages)
        imgui.end_child()

    def _month(self, month: Month, pages: HistoryPages) -> None:
        days = "1 day" if month.days == 1 else f"{month.days} days"
        theme.part(f"{month.first:%B %Y}: {_minutes(month.played_s)}, {days}")
        room = imgui.get_content_region_avail().x
        size = max(min(theme.points(_CELL), (room - 6 * _BETWEEN) / 7), theme.points(_LEAST_CELL))
        left = imgui.get_cursor_pos_x()
        for column, name in enumerate(_DAYS):
            if column:
                imgui.same_line(left + column * (size + _BETWEEN))
            imgui.text_disabled(name)
        imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(0, 0))
        imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(_BETWEEN, _BETWEEN))
        for week in month.weeks:
            for column, day in enumerate(week):
                if column:
                    imgui.same_line(0, _BETWEEN)
                if day is None:
                    imgui.dummy(imgui.ImVec2(size, size))
                else:
                    self._day(day, size, is_today=day.day == pages.today)
        imgui.pop_style_var(2)

    def _day(self, day: PractisedDay, size: float, is_today: bool) -> None:
        share = min(day.minutes / FULL_DAY, 1.0)
        shade = palette.with_opacity(theme.themed(palette.BRAND), _FAINTEST + (_FULLEST - _FAINTEST) * share)
        top = imgui.get_cursor_screen_pos()
        if day.sessions:
            imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*shade))
        pressed = imgui.button(f"{day.day.day}##{day.day}", imgui.ImVec2(size, size))
        if day.sessions:
            imgui.pop_style_color()
        theme.tooltip(day_words(day))
        if is_today:
            low, high = imgui.ImVec2(top.x, top.y), imgui.ImVec2(top.x + size, top.y + size)
            imgui.get_window_draw_list().add_rect(low, high, theme.packed(palette.INK), 0.0, theme.points(1.5))
        if pressed:
            self._show(SessionFilter(day=day.day))


def day_words(day: PractisedDay) -> str:
    """A day in lines: how long, in how many sessions, what."""
    if not day.sessions:
        return f"{day_in_words(day.day)}: a day off"
    sessions = "1 session" if day.sessions == 1 else f"{day.sessions} sessions"
    more = [f"and {len(day.titles) - _TITLES} more"] if len(day.titles) > _TITLES else []
    return "\n".join([f"{day_in_words(day.day)}: {_minutes(day.played_s)} in {sessions}", *day.titles[:_TITLES], *more])


def _minutes(seconds: float) -> str:
    return counted(whole_minutes(seconds), "minute")
