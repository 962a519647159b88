"""The lessons panel: who practises, the list of lessons, what the chosen one is, how it is played, and Start below all.

Start lies at the lower edge whatever is chosen and however large the window is. A low panel shows either the list or
the lesson, which a button turns over; in the lowest, who practises and the search are on the lesson's side too. Every
control has a tooltip, and every one is reached by the keyboard (Tab, arrows, Enter).
"""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.editor_actions import NewLesson, OpenEditor
from station.app.actions.practice_actions import Begin, Select
from station.app.room_state import LessonCard, RoomState
from station.app.selection import Selection
from station.app.window_state import State
from station.gui import theme
from station.gui.panels.lessons.course_list import course_picker
from station.gui.panels.lessons.lesson_list import LessonList, bars_of
from station.gui.panels.lessons.lesson_options import LessonOptions
from station.gui.panels.lessons.who_plays import who_button

START_LABEL, EDIT_LABEL = "Start##start", "Edit##edit-lesson"
ADD_LABEL = f"{icons.ICON_FA_PLUS}##add"
IMPORT_LABEL, NEW_LABEL = "Import…##open-import", "New lesson##new-lesson"
OPTIONS = "##options"
"""The part that has tempo, passes, level and click."""
TURN_LABEL = f"{icons.ICON_FA_SLIDERS_H}##turn"
"""The button that turns a low panel over."""
_ADD_MENU = "##add-menu"
_START = 46
"""Design pixels: struck from the drummer's seat."""
_WIDE = 280
"""Design pixels: in a narrower panel the search and the courses have a line each."""
_LEAST_LIST, _LEAST_ABOUT, _MOST_ABOUT, _OPTIONS = 136, 48, 260, 180
"""Design pixels (our choice): six lines; two lines; a long text; most options."""
_ABOUT_SHARE = 0.22
"""Of what list and text have together, the text's (our choice: at 1920 × 1080 two lines, and six lessons above)."""
_LOWEST_LIST = 64
"""Design pixels of a list, two lessons, for which who practises and the search make room in the lowest panel."""


class LessonsPanel:
    """The panel; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None], open_import: Callable[[], None]) -> None:
        self._dispatch, self._open_import = dispatch, open_import
        self._list, self._options = LessonList(dispatch), LessonOptions(dispatch)
        self._is_turned = False
        self._high = 0.0  # pixels that the options took in the last frame
        self._described = ""

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        start = imgui.get_window_height() - imgui.get_style().window_padding.y - theme.points(_START)
        room = start - imgui.get_cursor_pos_y() - imgui.get_style().item_spacing.y
        lines = 2 if _is_wide() else 3
        is_lowest = room - lines * imgui.get_frame_height_with_spacing() < theme.points(_LOWEST_LIST)
        selection = state.selection if is_lowest else self._upper_lines(state)
        middle = start - imgui.get_cursor_pos_y() - imgui.get_style().item_spacing.y
        if is_lowest and middle < theme.points(_LOWEST_LIST):  # then the panel scrolls
            start, middle = start + theme.points(_LOWEST_LIST) - middle, theme.points(_LOWEST_LIST)
        is_low = middle < theme.points(_LEAST_LIST + _LEAST_ABOUT + _OPTIONS)
        if is_low:
            selection = self._one_of_two(selection, state, middle, is_lowest)
        else:
            self._is_turned = False
            selection = self._both(selection, state, middle)
        imgui.set_cursor_pos_y(start)
        self._last_line(selection, is_low)
        if selection != state.selection:
            self._dispatch(Select(selection))

    # --- who and what ------------------------------------------------------------------------------------------------

    def _upper_lines(self, state: State) -> Selection:
        """Who plays, and which lessons are listed."""
        self._who_and_more(state)
        return self._head(state.selection)

    def _who_and_more(self, state: State) -> None:
        """Who plays, and what brings more lessons."""
        beside = imgui.get_frame_height() + imgui.get_style().item_spacing.x
        who_button(state.students, imgui.get_content_region_avail().x - beside, self._dispatch)
        imgui.same_line()
        self._add()

    def _head(self, selection: Selection) -> Selection:
        """Which lessons are listed."""
        width, is_wide = imgui.get_content_region_avail().x, _is_wide()
        each = (width - imgui.get_style().item_spacing.x) / 2 if is_wide else width
        selection = course_picker(selection, each)
        if is_wide:
            imgui.same_line()
        return replace(selection, search=self._search(selection.search, each))

    @staticmethod
    def _search(words: str, width: float) -> str:
        """The words that are searched for."""
        hint = theme.one_line("Search", width - 2 * imgui.get_style().frame_padding.x)
        imgui.set_next_item_width(width)
        _, words = imgui.input_text_with_hint("##search", hint, words)
        theme.tooltip("Shows the lessons that contain every word in title, level, author or tags")
        return str(words)

    def _add(self) -> None:
        """What brings more lessons."""
        if theme.icon_button(ADD_LABEL, (imgui.get_frame_height(), 0)):
            imgui.open_popup(_ADD_MENU)
        theme.tooltip("More lessons: write one, or make one of a music file, a song or a take")
        if not imgui.begin_popup(_ADD_MENU):
            return
        if imgui.selectable(NEW_LABEL, False)[0]:
            self._dispatch(NewLesson())
        theme.tooltip("Write one: with the mouse, the keyboard or your kit")
        if imgui.selectable(IMPORT_LABEL, False)[0]:
            self._open_import()
        theme.tooltip("Make a lesson of a music file, a song's folder, a GrooveScribe link or a take; or drop it here")
        imgui.end_popup()

    # --- the list and the lesson -------------------------------------------------------------------------------------

    def _both(self, selection: Selection, state: State, middle: float) -> Selection:
        """The list, and the lesson below it, each with a share that no lesson's text changes."""
        spacing = imgui.get_style().item_spacing.y
        room = middle - (self._high or theme.points(_OPTIONS)) - 3 * spacing
        about = min(max(room * _ABOUT_SHARE, theme.points(_LEAST_ABOUT)), theme.points(_MOST_ABOUT))
        line = imgui.get_text_line_height()
        about = max(round((about - spacing) / line), 2) * line + spacing  # no line is cut
        selection = self._list.gui(selection, state.drafts, imgui.ImVec2(0, room - about))
        imgui.separator()
        imgui.begin_child("##about", imgui.ImVec2(0, about))
        self._about(selection, is_named=False)
        imgui.end_child()
        flags = imgui.ChildFlags_.auto_resize_y
        imgui.begin_child(OPTIONS, imgui.ImVec2(0, 0), flags)
        imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(imgui.get_style().item_spacing.x, spacing / 2))
        selection = self._played(selection, state.room)
        imgui.pop_style_var()
        imgui.end_child()
        self._high = imgui.get_item_rect_size().y
        return selection

    def _one_of_two(self, selection: Selection, state: State, middle: float, is_lowest: bool) -> Selection:
        """The list, or the lesson in its place, in the lowest panel below what else stands above both."""
        size = imgui.ImVec2(0, middle)
        if not self._is_turned:
            return self._list.gui(selection, state.drafts, size)
        imgui.begin_child(OPTIONS, size)
        if is_lowest:
            selection = self._upper_lines(state)
        selection = self._played(selection, state.room)
        self._edit(selection, imgui.ImVec2(-1, 0))
        imgui.separator()
        self._about(selection)
        imgui.end_child()
        return selection

    def _about(self, selection: Selection, is_named: bool = True) -> None:
        """All that is said about what is chosen, its name where no list is seen; it scrolls where it is long."""
        card = None if selection.free else selection.card
        name = "" if card is None else card.name
        if name != self._described:
            self._described = name
            imgui.set_scroll_y(0.0)
        if card is None:
            if is_named:
                theme.heading("Just play", 20)
            theme.soft("Nothing is judged. Every stroke is recorded and kept, and you can listen back.")
            return
        if is_named:
            theme.heading(card.title, 20)
        author = f" · {card.author}" if card.author else ""
        theme.soft(f"{bars_of(card)} · {card.meter} · {card.beats_a_minute:g} bpm{author}")
        for line in selection.first_words(card):
            theme.soft(line)
            theme.tooltip("What should come before; nothing is forbidden")
        if card.about:
            theme.soft(card.about)

    def _played(self, selection: Selection, room: RoomState) -> Selection:
        if selection.free:
            return self._options.just_play(selection, room)
        return selection if selection.card is None else self._options.lesson(selection, selection.card)

    def _last_line(self, selection: Selection, is_low: bool) -> None:
        """Start, and beside it what is as wide in every panel: the editor, or in a low one the lesson's other page."""
        style, high = imgui.get_style(), theme.points(_START)
        beside = imgui.ImVec2(imgui.calc_text_size(EDIT_LABEL, True).x + 2 * style.frame_padding.x, high)
        if theme.main_button(START_LABEL, (-(beside.x + style.item_spacing.x), high)):
            self._dispatch(Select(selection))  # what was typed last is part of what begins
            self._dispatch(Begin())
        theme.tooltip("Record from now on (Enter)" if selection.free else "Count-in, demonstration, then you (Enter)")
        imgui.same_line()
        if is_low:
            self._turn(selection, beside)
        else:
            self._edit(selection, beside)

    def _turn(self, selection: Selection, size: imgui.ImVec2) -> None:
        if theme.icon_button(TURN_LABEL, (size.x, size.y), self._is_turned):
            self._is_turned = not self._is_turned
        other = "Back to the list" if self._is_turned else f"What it is, and how to play it: {_in_short(selection)}"
        theme.tooltip(other)

    def _edit(self, selection: Selection, size: imgui.ImVec2) -> None:
        card = None if selection.free else selection.card
        imgui.begin_disabled(card is None)
        if imgui.button(EDIT_LABEL, size) and card is not None:
            self._dispatch(OpenEditor(card.name))
        imgui.end_disabled()
        theme.tooltip(_edit_words(card))


def _is_wide() -> bool:
    """Whether courses and search have room beside each other."""
    return bool(imgui.get_content_region_avail().x >= theme.points(_WIDE))


def _in_short(selection: Selection) -> str:
    """How what is chosen is to be played, in a few words."""
    if selection.free or selection.card is None:
        return "Just play"
    tempo = "the tempo follows you" if selection.adapt and selection.click else f"{selection.beats_a_minute:.0f} bpm"
    return f"{tempo}, passes {selection.loops}"


def _edit_words(card: LessonCard | None) -> str:
    if card is None:
        return "Choose a lesson to change it"
    own = "Change this lesson of your own" if not card.kind else "Change a copy of it; the lesson itself stays"
    return f"{own}: grid, notation, words"
