"""Today: the plan of the day as a list with its reasons, Start for the next block, and the lesson book below it."""

from collections.abc import Callable
from datetime import date

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.today_actions import LeaveOutBlock, LookAtDay, PlanDay, Reflect, StartBlock
from station.app.room_state import Stage
from station.app.today_page import CalendarDay, TodayView, calendar_weeks
from station.app.window_state import State
from station.drills.daily.day_facts import LEAST_MINUTES, MINUTES, MOST_MINUTES
from station.gui import theme
from station.practice.book.book_day import LONGEST_LINE
from station.practice.book.book_words import MOST_RETURNING, day_in_words, how_words, returns_words, session_words
from station.practice.book.day_progress import Block, BlockState
from station.practice.book.lesson_book import DayPage
from station.render import palette

TODAY = "Today"
ABOUT = "The plan of the day, block by block, and the lesson book"
HELP = (
    "The plan is made from what you have practised: reviews that are due, what is not stable yet, something new where"
    " nothing is under way, and playing at the end. Start begins the next block with its bars, tempo and click. What a"
    " day leaves undone is simply there again the next day. Below is the book: press a day to read it."
)
START_LABEL, LEAVE_OUT_LABEL = "Start##start-block", "Leave out##leave-out"
_MARKS = {BlockState.OPEN: "", BlockState.DONE: " · done", BlockState.LEFT_OUT: " · left out"}
_CELL, _BUTTON = 40.0, 42.0
"""Design pixels of a day in the calendar, and of the button's height."""
_BETWEEN = 3.0
"""Pixels between two days."""
_FULL_DAY = 20.0
"""Minutes at which a day of the calendar is quite filled: the usual plan's."""


class TodayPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._minutes = MINUTES
        self._line, self._line_of = "", ""

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        view = state.today
        if view.today is None:
            theme.soft("Reading the lesson book …")
            return
        self._plan(view.today, can_start=state.room.stage is not Stage.PLAYING)
        theme.part("The lesson book")
        self._calendar(view)
        if view.looked_at is not None and view.looked_at.kept.day != view.today.kept.day:
            _day(view.looked_at)
        else:
            self._about_today(view.today)
        _returning(view)

    # --- the plan ----------------------------------------------------------------------------------------------------

    def _plan(self, today: DayPage, can_start: bool) -> None:
        progress = today.progress
        theme.heading(day_in_words(today.kept.day), 20)
        theme.soft(f"{progress.done} of {len(progress.blocks)} blocks, {progress.minutes:.0f} minutes played")
        following = progress.next
        if following is None:
            imgui.text_wrapped("That was today's plan. Whatever you play now is a gift.")
        for block in progress.blocks:
            self._block(block, following, can_start)
        self._length(today)

    def _block(self, block: Block, following: Block | None, can_start: bool) -> None:
        """A block: the next one with its reason and buttons, the others in two lines."""
        item, is_next = block.item, block == following
        imgui.push_id(block.place)
        imgui.separator()
        label = f"{item.kind.label} · {item.minutes} min{_MARKS[block.state]}"
        theme.warning(label) if is_next else theme.soft(label)
        imgui.text_wrapped(item.title)
        if is_next:
            imgui.text_wrapped(how_words(item))
            theme.soft(item.why)
            self._buttons(block, can_start)
        elif block.state is BlockState.OPEN:
            theme.soft(how_words(item))
            theme.tooltip(f"{item.tempo_why}\n{item.why}")
        imgui.pop_id()

    def _buttons(self, block: Block, can_start: bool) -> None:
        room, style = imgui.get_content_region_avail().x, imgui.get_style()
        beside = imgui.calc_text_size(LEAVE_OUT_LABEL, True).x + 2 * style.frame_padding.x
        has_room = room - beside - style.item_spacing.x >= beside
        width = room - beside - style.item_spacing.x if has_room else room
        if theme.main_button(START_LABEL, (width, theme.points(_BUTTON)), enabled=can_start):
            self._dispatch(StartBlock(block.place))
        theme.tooltip(block.item.tempo_why)
        if has_room:
            imgui.same_line()
        if imgui.button(LEAVE_OUT_LABEL, imgui.ImVec2(-1, theme.points(_BUTTON))):
            self._dispatch(LeaveOutBlock(block.place))
        theme.tooltip("Not today: it will be there again another day")

    def _length(self, today: DayPage) -> None:
        """How long the day is to be; another plan where it changes."""
        imgui.separator()
        imgui.set_next_item_width(-1)
        kept = today.kept.minutes or MINUTES
        label = f"##minutes-{today.kept.day}"
        _, minutes = theme.slider_int(label, self._minutes or kept, LEAST_MINUTES, MOST_MINUTES, "%d minutes")
        theme.tooltip("How long you have today; let go, and the plan is made anew")
        self._minutes = minutes if imgui.is_item_active() else kept
        if imgui.is_item_deactivated_after_edit() and minutes != kept:
            self._dispatch(PlanDay(minutes))

    # --- the book ----------------------------------------------------------------------------------------------------

    def _calendar(self, view: TodayView) -> None:
        """Four weeks, a cell a day, the fuller the more was played; a press shows the day."""
        size = min(theme.points(_CELL), (imgui.get_content_region_avail().x - 6 * _BETWEEN) / 7)
        imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(0, 0))
        for week in calendar_weeks(view.calendar):
            for column, day in enumerate(week):
                if column:
                    imgui.same_line(0, _BETWEEN)
                if day is None:
                    imgui.dummy(imgui.ImVec2(size, size))
                else:
                    self._cell(day, size, view)
        imgui.pop_style_var()

    def _cell(self, day: CalendarDay, size: float, view: TodayView) -> None:
        assert view.today is not None, "it is drawn"
        today = view.today.kept.day
        shown = today if view.looked_at is None else view.looked_at.kept.day
        share = min(day.minutes / _FULL_DAY, 1.0)
        top = imgui.get_cursor_screen_pos()
        if imgui.button(f"{day.day.day}##{day.day}", imgui.ImVec2(size, size)):
            self._dispatch(LookAtDay(None if day.day == today else day.day))
        words = ", with words" if day.has_words else ""
        theme.tooltip(f"{day_in_words(day.day)}: {day.minutes:.0f} minutes{words}")
        _fill(top, size, share, is_shown=day.day == shown)

    def _about_today(self, page: DayPage) -> None:
        """The line about today, and what was played."""
        for one in page.sessions:
            imgui.text_wrapped(session_words(one))
        if self._line_of != page.kept.line:
            self._line = self._line_of = page.kept.line
        if page.sessions or page.kept.line:
            imgui.set_next_item_width(-1)
            hint = "One line about today, if you like"
            _, self._line = imgui.input_text_with_hint("##line", hint, self._line)
            theme.tooltip("What went well, what was hard: the book keeps it, and your teacher may read it")
            if imgui.is_item_deactivated_after_edit() and self._line != page.kept.line:
                self._line_of = self._line = self._line[:LONGEST_LINE]
                self._dispatch(Reflect(self._line))
        _notes(page)


def _day(page: DayPage) -> None:
    """An earlier day."""
    theme.heading(day_in_words(page.kept.day), 18)
    progress = page.progress
    if progress.blocks:
        theme.soft(f"Planned {page.kept.minutes} minutes; {progress.done} of {len(progress.blocks)} blocks played")
    for one in page.sessions:
        imgui.text_wrapped(session_words(one))
    if not page.sessions:
        theme.soft("Nothing was played.")
    if page.kept.line:
        imgui.text_wrapped(f"“{page.kept.line}”")
    _notes(page)


def _notes(page: DayPage) -> None:
    for note in page.notes:
        theme.soft(note.author or "Your teacher")
        imgui.text_wrapped("\n".join(note.lines))


def _returning(view: TodayView) -> None:
    assert view.today is not None, "it is drawn"
    today: date = view.today.kept.day
    if not view.returning:
        return
    theme.part("What returns")
    for one in view.returning[:MOST_RETURNING]:
        imgui.text_wrapped(f"{one.title}: {returns_words(one, today)}")
    if len(view.returning) > MOST_RETURNING:
        theme.soft(f"and {len(view.returning) - MOST_RETURNING} more, later")


def _fill(top: imgui.ImVec2, size: float, share: float, is_shown: bool) -> None:
    """The bar at the foot of a day that says how much was played, and the frame of the day that is shown."""
    draw, foot = imgui.get_window_draw_list(), theme.points(5)
    right, below = top.x + size, top.y + size
    if share > 0:
        draw.add_rect_filled(
            imgui.ImVec2(top.x, below - foot), imgui.ImVec2(top.x + size * share, below), theme.packed(palette.BRAND)
        )
    if is_shown:
        draw.add_rect(top, imgui.ImVec2(right, below), theme.packed(palette.BRAND), 0.0, theme.points(2))
