"""The opened session over the list: its page for a browser is written and opened here. It is always as high."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.history_actions import OpenPage, WritePage
from station.app.history.history_shown import HistoryPages, HistoryView
from station.gui import theme
from station.practice.history.session_list import played_title, when_words
from station.store.rows import SessionKind, SessionRow

WRITE_ID, OPEN_LABEL = "###history-write-page", "Open it##history-page"
_WRITE, _WRITING = "Write its page", "writing …"
_WHAT = "bars, strokes and advice, and the whole take to see and hear, for any browser"


class PageRow:
    """Draws it; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, pages: HistoryPages, view: HistoryView) -> None:
        """Draw what is said of the opened session, and two buttons."""
        row = next((row for row in pages.sessions if row.id == view.opened), None)
        said = page_line(view, row)
        imgui.text_disabled(theme.one_line(said, imgui.get_content_region_avail().x))
        theme.tooltip(said)
        files = view.page_files
        half = imgui.ImVec2((imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2, 0)
        imgui.begin_disabled(not has_page(view, row) or files.writing is not None)
        pressed = imgui.button(f"{_WRITE if files.writing is None else _WRITING}{WRITE_ID}", half)
        imgui.end_disabled()
        theme.tooltip(_WHAT[0].upper() + _WHAT[1:])
        if pressed and row is not None:
            self._dispatch(WritePage(row.id, row.name))
        imgui.same_line()
        imgui.begin_disabled(row is None or row.id not in files.written or files.writing == row.id or files.opens)
        if imgui.button(OPEN_LABEL, half) and row is not None:
            self._dispatch(OpenPage(row.id))
        imgui.end_disabled()
        theme.tooltip("Show the page that was written in your browser")


def has_page(view: HistoryView, row: SessionRow | None) -> bool:
    """Whether a page can be written of the opened session: of a lesson, once it is judged."""
    return row is not None and row.kind is SessionKind.LESSON and view.opening is None


def page_line(view: HistoryView, row: SessionRow | None) -> str:
    """What is said of the opened session, None where none is, and of its page."""
    files = view.page_files
    if view.opening is not None:
        return "Judging the session again from its capture …"
    if row is None:
        return "No session is opened yet."
    name = f"{played_title(row)}, {when_words(row)}"
    if row.kind is not SessionKind.LESSON:
        return f"{name}: only lessons have a page"
    if files.writing == row.id:
        return f"{name}: its page is being written; you may go on"
    if files.writing is not None:
        return f"{name}: another session's page is being written"
    path = files.written.get(row.id)
    return f"Opened: {name}" if path is None else f"Its page: {path}"
