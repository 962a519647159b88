"""The list of sessions, the newest first: searched, filtered, only its visible lines drawn; a press opens one."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.history_actions import OpenKept
from station.app.history.history_shown import HistoryPages, HistoryView
from station.gui import theme
from station.gui.panels.history.page_row import PageRow
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
)
from station.store.rows import SessionKind, SessionRow

SEARCH_LABEL, KIND_LABEL, LESSON_LABEL = "##history-search", "##history-kind", "##history-lesson"
ALL_LABEL = "All days##history"
_KINDS = (None, *SessionKind)
_TITLE_WIDE = 210.0
"""Design pixels that a title has before further columns get any."""


@dataclass(frozen=True, slots=True)
class _Column:
    """A column: its `title`, the `widest` text that it holds (empty: what the others leave), what stands in a row."""

    title: str
    widest: str
    text: Callable[[SessionRow], str]


_WHAT = _Column("What", "", played_title)
_SCORE = _Column("Score", "Score", result_words)
_MORE = (
    _Column("bpm", "000.0", lambda row: "" if row.beats_a_minute is None else f"{row.beats_a_minute:g}"),
    _Column("± ms", "± ms", lambda row: "" if row.sd_ms is None else f"{row.sd_ms:.0f}"),
    _Column("min", "min", lambda row: f"{row.played_s / 60:.0f}"),
)
"""In this order where there is room, before the score; all of it stands in a row's tooltip as well."""
_WHEN = "30 May 23:59"


class SessionsPart:
    """Keeps what the list is filtered by, `only`; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self.only = SessionFilter()
        self._page = PageRow(dispatch)
        self._listed: tuple[HistoryPages, SessionFilter, tuple[SessionRow, ...]] | None = None

    @property
    def shown(self) -> int:
        """How many sessions are listed."""
        return 0 if self._listed is None else len(self._listed[2])

    def gui(self, pages: HistoryPages, view: HistoryView, can_open: bool) -> None:
        """Draw it; while `can_open` is not, nothing is pressed."""
        self._filters(pages)
        self._page.gui(pages, view)
        rows = self._rows(pages)
        if not rows:
            theme.soft("No session is like that.")
            return
        theme.soft(f"{len(rows)} of {len(pages.sessions)} sessions; press one to open it")
        flags = imgui.TableFlags_.row_bg | imgui.TableFlags_.scroll_y
        columns = _columns(imgui.get_content_region_avail().x, max(row.id for row in rows))
        if not imgui.begin_table(f"##sessions{len(columns)}", 1 + len(columns), flags):
            return
        imgui.table_setup_scroll_freeze(0, 1)
        for title, widest in (("When", _WHEN), *((each.title, each.widest) for each in columns)):
            flag = imgui.TableColumnFlags_.width_fixed if widest else imgui.TableColumnFlags_.width_stretch
            imgui.table_setup_column(title, flag, imgui.calc_text_size(widest).x if widest else 1.0)
        imgui.table_headers_row()
        chosen = view.opened if view.opening is None else view.opening
        imgui.begin_disabled(not can_open)
        clipper = imgui.ListClipper()
        clipper.begin(len(rows))
        while clipper.step():
            for at in range(clipper.display_start, clipper.display_end):
                self._row(rows[at], pages, columns, is_marked=rows[at].id == chosen)
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

    def _row(self, row: SessionRow, pages: HistoryPages, columns: Sequence[_Column], is_marked: bool) -> None:
        imgui.table_next_row()
        imgui.table_next_column()
        flags = imgui.SelectableFlags_.span_all_columns
        when = short_when(row, pages.today or row.started.date())
        if imgui.selectable(f"{when}{session_label(row.id)}", is_marked, flags)[0]:
            self._dispatch(OpenKept(row.id))
        theme.tooltip(f"{session_words(row)}\nNumber {row.id}, as `station report {row.id}` has it")
        for column in columns:
            imgui.table_next_column()
            _text(column.text(row))


def _columns(width: float, greatest: int) -> list[_Column]:
    """The columns beside the day's that `width` pixels have room for; `greatest` is of the sessions' numbers."""
    number = _Column("No.", max("No.", "0" * len(str(greatest)), key=len), lambda row: str(row.id))
    between, bar = 2 * imgui.get_style().cell_padding.x, imgui.get_style().scrollbar_size
    taken = [imgui.calc_text_size(widest).x + between for widest in (_WHEN, _SCORE.widest, number.widest)]
    left = width - sum(taken) - between - bar - theme.points(_TITLE_WIDE)
    more: list[_Column] = []
    for column in _MORE:
        left -= imgui.calc_text_size(column.widest).x + between
        if left >= 0:
            more.append(column)
    return [_WHAT, *more, _SCORE, number]


def _text(text: str) -> None:
    """As much of a text as its column holds."""
    imgui.text(theme.one_line(text, imgui.get_content_region_avail().x))


def session_label(number: int) -> str:
    """The end of the label of the session with that id."""
    return f"##kept-{number}"
