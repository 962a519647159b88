"""The notes of an exam: the whole unseen piece on one page while it is looked at and played, and the time that is left.

No line moves over it, as none does over paper.
"""

from collections.abc import Callable
from math import ceil

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.exam_actions import LeaveExam, ReadyForExam
from station.app.window_state import State
from station.gui import theme
from station.gui.flat_canvas import FlatCanvas
from station.gui.widgets.page_height import PageHeight
from station.gui.widgets.score_page import PagePlace, paint_page
from station.music.score import Score
from station.render.notation.page.editable_page import EditablePage, PageSetter
from station.scenes.piece_page import piece_setter

NOTES = "Exam notes"
READY_LABEL, LEAVE_LABEL = "I am ready##ready", "Leave##leave-exam"
_SPACES = (17.0, 15.0, 13.5, 12.0, 10.5, 9.5, 8.5, 7.5, 6.5, 5.5, 4.5)
"""Design pixels of a staff space: the largest is taken with which the whole piece is seen (our choice)."""
_MARGIN = 0.5
"""Staff spaces around the page."""
_TIME, _TIME_SHARE = 190.0, 0.28
"""Design pixels of the column that says the time, and the most of the panel that it has."""
_LEAST_HIGH = 300.0
"""Of the panel: eight bars in a small window, and all that stands below the time (our choice)."""
_TIME_SIZE, _BUTTON = 40.0, 44.0
"""Of the time, read from the stool, and of the button below it."""


class ExamNotes:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], canvas: FlatCanvas) -> None:
        self._dispatch, self._canvas = dispatch, canvas
        self._height = PageHeight(_LEAST_HIGH)
        self._set: tuple[Score, PageSetter] | None = None
        self._fitted: tuple[tuple[object, ...], EditablePage, float] | None = None

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        view, whole = state.exam, imgui.get_content_region_avail()
        if view.piece is None or view.notes is None:
            return
        self._height.fit()
        imgui.begin_child("##exam-time", imgui.ImVec2(min(theme.points(_TIME), _TIME_SHARE * whole.x), 0))
        self._time(view.left_s)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("##exam-page")
        self._page(view.notes, view.piece.lesson.beat_ticks)
        imgui.end_child()

    def _time(self, left_s: float | None) -> None:
        """How long it may still be looked at, and the ways out of it; the notes beside it stay where they are."""
        if left_s is None:
            theme.soft("One take")
            return
        whole = ceil(left_s)
        theme.heading(f"{whole // 60}:{whole % 60:02d}", _TIME_SIZE)
        theme.soft("to look, and to try what you like")
        if theme.main_button(READY_LABEL, (-1, theme.points(_BUTTON))):
            self._dispatch(ReadyForExam())
        theme.tooltip("Count in now (Enter)")
        if imgui.button(LEAVE_LABEL, imgui.ImVec2(-1, 0)):
            self._dispatch(LeaveExam())
        theme.tooltip("Play nothing (Esc); the piece counts as one that you have met")

    # --- the page ----------------------------------------------------------------------------------------------------

    def _page(self, notes: Score, beat_ticks: int) -> None:
        start, room = imgui.get_cursor_screen_pos(), imgui.get_content_region_avail()
        if self._set is None or self._set[0] is not notes:
            self._set, self._fitted = (notes, piece_setter(notes, beat_ticks)), None
        page, space = self._fitting(self._set[1], room)
        imgui.dummy(imgui.ImVec2(1, _height(page) * space - imgui.get_style().item_spacing.y))
        corner = start.x + _MARGIN * space, start.y + _MARGIN * space
        paint_page(self._canvas, page, PagePlace(corner, space))

    def _fitting(self, setter: PageSetter, room: imgui.ImVec2) -> tuple[EditablePage, float]:
        """The page at the largest size that shows the whole of it, else at the smallest, to be scrolled."""
        key = room.x, room.y, theme.points(1)
        if self._fitted is None or self._fitted[0] != key:
            self._fitted = key, *_largest(setter, room)
        return self._fitted[1:]


def _largest(setter: PageSetter, room: imgui.ImVec2) -> tuple[EditablePage, float]:
    for pixels in _SPACES:
        space = theme.points(pixels)
        page = setter.page(max(room.x / space - 2 * _MARGIN, 1.0))
        if _height(page) * space <= room.y:
            break
    return page, space


def _height(page: EditablePage) -> float:
    """In staff spaces, with what is around it."""
    return page.height + 2 * _MARGIN
