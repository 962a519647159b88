"""The panel of the history: what was practised and when, each session a press from its result."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.history_actions import Asked, HistorySection, ReadAgain, ShowPages
from station.app.history.history_shown import HistoryPages, HistoryView
from station.app.room_state import Stage
from station.app.window_state import State
from station.gui import theme
from station.gui.panels.history.calendar_part import CalendarPart
from station.gui.panels.history.sessions_part import SessionsPart
from station.gui.panels.history.trends_part import TrendsPart
from station.gui.panels.history.weeks_part import weeks_part
from station.practice.history.session_list import SessionFilter

HISTORY = "History"
ABOUT = "What you practised and when, how it went over time, and every session to open again"
HELP = (
    "Calendar: the months, a day the fuller the more you played; press one for its sessions. A streak counts weeks with"
    " two days of practice and forgives days and two weeks off. Sessions: all of them, the newest first; search, and"
    " press one to open its result, its take or its battle as at its end. Trends: a lesson over time, like compared"
    " with like, with the range in which the truth lies 19 times in 20, or that it cannot be told. Weeks: lean, spread"
    " and notes hit, week by week, of each limb or piece."
)
TABS, AGAIN_LABEL = "##history-tabs", "Read again##history"
_NOTHING = "Nothing is kept yet. Whatever you play, a lesson, a take or a battle, is found here from its end on."
_WIDE = 120.0
"""Design pixels of a button."""


class HistoryPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.section = HistorySection.CALENDAR
        """The page that is to be in front."""
        self._front: HistorySection | None = None
        self.calendar = CalendarPart(self._show_day)
        self.sessions = SessionsPart(dispatch)
        self._trends = TrendsPart(dispatch)

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        view = state.history
        if view.fault:
            theme.warning(f"The history cannot be read: {view.fault}.")
            theme.soft("Practice goes on; what you play is kept in its folder and comes into the history later.")
            if imgui.button(AGAIN_LABEL, imgui.ImVec2(theme.points(_WIDE), 0)):
                self._dispatch(ReadAgain())
            theme.tooltip("Ask the database once more")
        if view.pages is None:
            if not view.fault:
                theme.soft("Reading the history …")
            return
        if not view.pages.sessions:
            theme.soft(_NOTHING)
            return
        self._tabs(state, view, view.pages)

    def _show_day(self, only: SessionFilter) -> None:
        self.sessions.only = only
        self.section = HistorySection.SESSIONS

    def _tabs(self, state: State, view: HistoryView, pages: HistoryPages) -> None:
        if theme.is_narrow():
            names = [section.value for section in HistorySection]
            imgui.set_next_item_width(-1)
            _, index = imgui.combo(TABS, names.index(self.section.value), names)
            self.section = self._front = HistorySection(names[index])
            self._page(state, view, pages)
            return
        padding = imgui.ImVec2(theme.points(6), theme.points(7))
        imgui.push_style_var(imgui.StyleVar_.frame_padding, padding)
        is_seen = imgui.begin_tab_bar(TABS, imgui.TabBarFlags_.fitting_policy_shrink)
        imgui.pop_style_var()
        if not is_seen:
            return
        opens = self.section if self.section is not self._front else None
        for section in HistorySection:
            flag = imgui.TabItemFlags_.set_selected if section is opens else 0
            imgui.push_style_var(imgui.StyleVar_.frame_padding, padding)
            is_front = imgui.begin_tab_item(section.value, None, flag)[0]
            imgui.pop_style_var()
            if is_front:
                if opens in (None, section):
                    self.section = self._front = section
                if section is self._front:
                    self._page(state, view, pages)
                imgui.end_tab_item()
        imgui.end_tab_bar()

    def _page(self, state: State, view: HistoryView, pages: HistoryPages) -> None:
        if view.asked.section is not self.section:
            self._ask(replace(view.asked, section=self.section))
        can_open = state.room.stage is not Stage.PLAYING and state.editor is None
        match self.section:
            case HistorySection.CALENDAR:
                self.calendar.gui(pages)
            case HistorySection.SESSIONS:
                self.sessions.gui(pages, view, can_open)
            case HistorySection.TRENDS:
                asked = self._trends.gui(pages, view.asked)
                self._ask_if_other(asked, view.asked)
            case HistorySection.WEEKS:
                self._ask_if_other(weeks_part(pages, view.asked), view.asked)

    def _ask_if_other(self, asked: Asked, before: Asked) -> None:
        if asked != before:
            self._ask(asked)

    def _ask(self, asked: Asked) -> None:
        self._dispatch(ShowPages(asked))
