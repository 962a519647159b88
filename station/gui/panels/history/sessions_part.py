"""The list of sessions, the newest first: searched, filtered, only its visible lines drawn; a press opens one."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.file_actions import ExportReport
from station.app.actions.history_actions import OpenKept
from station.app.history.history_shown import HistoryPages, HistoryView
from station.gui import theme
from station.gui.widgets.long_combo import long_combo
from station.practice.book.book_words import day_in_words
from station.practice.history.session_list import (
    KINDS,
    SessionFilter,
    listed,
    played_title,
    result_words,
    session_words,
    short_when,
    when_words,
)
from station.store.rows import SessionKind, SessionRow

SEARCH_LABEL, KIND_LABEL, LESSON_LABEL = "##history-search", "##history-kind", "##history-lesson"
ALL_LABEL, REPORT_LABEL = "All days##history", "Write the page of the opened session##history"
_KINDS = (None, *SessionKind)


class SessionsPart:
    """Keeps what the list is filtered by, `only`; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.only = SessionFilter()
        self._listed: tuple[HistoryPages, SessionFilter, tuple[SessionRow, ...]] | None = None

    @property
    def shown(self) -> int:
        """How many sessions are listed."""
        return 0 if self._listed is None else len(self._listed[2])

    def gui(self, pages: HistoryPages, view: HistoryView, can_open: bool) -> None:
        """Draw it; while `can_open` is not, nothing is pressed."""
        self._filters(pages)
        opened = next((row for row in pages.sessions if row.id == view.opened), None)
        if opened is not None and opened.kind is SessionKind.LESSON:
            self._report(opened)
        rows = self._rows(pages)
        if not rows:
            theme.soft("No session is like that.")
            return
        theme.soft(f"{len(rows)} of {len(pages.sessions)} sessions; press one to open it")
        flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.scroll_y
        if not imgui.begin_table("##sessions", 4, flags):
            return
        imgui.table_setup_scroll_freeze(0, 1)
        for title, widest in (("When", "30 May 23:59"), ("What", ""), ("min", "min"), ("Score", "Score 0")):
            flag = imgui.TableColumnFlags_.width_fixed if widest else imgui.TableColumnFlags_.width_stretch
            imgui.table_setup_column(title, flag, imgui.calc_text_size(widest).x if widest else 1.0)
        imgui.table_headers_row()
        imgui.begin_disabled(not can_open)
        clipper = imgui.ListClipper()
        clipper.begin(len(rows))
        while clipper.step():
            for at in range(clipper.display_start, clipper.display_end):
                self._row(rows[at], pages, is_marked=rows[at].id in (view.opening, view.opened))
        clipper.end()
        imgui.end_disabled()
        imgui.end_table()

    def _rows(self, pages: HistoryPages) -> tuple[SessionRow, ...]:
        """What is listed; sought again where something is new."""
        if self._listed is None or self._listed[0] is not pages or self._listed[1] != self.only:
            self._listed = pages, self.only, listed(pages.sessions, self.only)
        return self._listed[2]

    def _filters(self, pages: HistoryPages) -> None:
        if self.only.day is not None:
            imgui.align_text_to_frame_padding()
            imgui.text(day_in_words(self.only.day))
            imgui.same_line()
            if imgui.button(ALL_LABEL):
                self.only = replace(self.only, day=None)
            theme.tooltip("List the sessions of all days again")
        imgui.set_next_item_width(-1)
        _, search = imgui.input_text_with_hint(SEARCH_LABEL, "Search title, device, exam, day …", self.only.search)
        is_narrow = theme.is_narrow()
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        imgui.set_next_item_width(-1 if is_narrow else half)
        kinds = ["all kinds", *(KINDS[kind] for kind in SessionKind)]
        kind = long_combo(KIND_LABEL, _KINDS.index(self.only.kind), kinds)
        theme.tooltip("Lessons, takes of what was just played, battles")
        if not is_narrow:
            imgui.same_line()
        imgui.set_next_item_width(-1)
        names = ["", *(each.name for each in pages.lessons)]
        titles = ["all lessons", *(f"{each.title} ({each.sessions})##{each.name}" for each in pages.lessons)]
        at = names.index(self.only.lesson) if self.only.lesson in names else 0
        lesson = long_combo(LESSON_LABEL, at, titles)
        theme.tooltip("Sessions of one lesson alone")
        self.only = replace(self.only, search=search, kind=_KINDS[kind], lesson=names[lesson])

    def _report(self, row: SessionRow) -> None:
        """The page about the session that was opened last."""
        if imgui.button(REPORT_LABEL, imgui.ImVec2(-1, 0)):
            self._dispatch(ExportReport(row.id, row.name))
        what = "bars, strokes and advice, and the take to see and hear, for any browser"
        theme.tooltip(f"{played_title(row)}, {when_words(row)}: {what}")

    def _row(self, row: SessionRow, pages: HistoryPages, is_marked: bool) -> None:
        imgui.table_next_row()
        imgui.table_next_column()
        flags = imgui.SelectableFlags_.span_all_columns
        when = short_when(row, pages.today or row.started.date())
        if imgui.selectable(f"{when}{session_label(row.id)}", is_marked, flags)[0]:
            self._dispatch(OpenKept(row.id))
        theme.tooltip(session_words(row))
        imgui.table_next_column()
        _text(played_title(row))
        imgui.table_next_column()
        imgui.text(f"{row.played_s / 60:.0f}")
        imgui.table_next_column()
        _text(result_words(row))


def _text(text: str) -> None:
    """As much of a text as its column holds."""
    imgui.text(theme.one_line(text, imgui.get_content_region_avail().x))


def session_label(number: int) -> str:
    """The end of the label of the session with that id."""
    return f"##kept-{number}"
