"""The list of lessons: kinds that fold, levels that fold within them, a line or more for each lesson.

What heads the first line that is seen stays above the list while its own line is scrolled out. A title is never cut: it
goes on in the next line.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from datetime import date
from itertools import groupby
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.battle_actions import OpenBattle
from station.app.actions.editor_actions import DropDraft, ResumeDraft
from station.app.editor.draft_journal import LeftDraft
from station.app.room_state import LessonCard
from station.app.selection import LessonGroup, Selection
from station.core.counts import counted
from station.drills.course import Course
from station.gui import theme
from station.gui.panels.lessons.course_list import mark, mark_width
from station.render import palette

FREE_LABEL = "Just play##free"
BATTLE_LABEL = "Battle a drummer…##open-battle"
RESUME_LABEL, DROP_LABEL = "Go on with it##draft", "Throw it away##draft"
UNSAVED, _DRAFT_MENU = "Draft: ", "##draft-menu"
LIST = "##list"
_INWARDS, _ROOMY = 12.0, 240.0
"""Design pixels that lessons stand behind their level, where the list has this room."""
_CLOSE, _FLAT = 6.0, 4.0
"""Design pixels between lines, and above and below a heading's words (our choice: a third more lessons are seen than
with the panel's own spacing)."""
_LEAST_LINES = 4
"""In a list of fewer lines no heading stands above the lessons (our choice)."""


@dataclass(frozen=True, slots=True)
class _Heading:
    """What heads lines of the list, which begin at `top` and end at `bottom`, pixels of its whole length."""

    words: str
    top: float
    bottom: float


class LessonList:
    """The list; what becomes of drafts, and a battle, go to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch
        self._chosen_last, self._is_chosen_anew = ("", 0, 0.0), False
        self._headings: list[_Heading] = []  # of the last frame

    def gui(self, selection: Selection, drafts: Sequence[LeftDraft], size: imgui.ImVec2) -> Selection:
        """Draw it as large as `size`; returns what is chosen."""
        chosen = "" if selection.card is None else selection.card.name, len(selection.lessons), size.y
        self._is_chosen_anew, self._chosen_last = chosen != self._chosen_last, chosen
        imgui.begin_child(LIST, size)
        spacing = imgui.get_style().item_spacing
        padding = imgui.get_style().frame_padding
        imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(spacing.x, theme.points(_CLOSE)))
        imgui.push_style_var(imgui.StyleVar_.frame_padding, imgui.ImVec2(padding.x, theme.points(_FLAT)))
        high = self._head_that_is_scrolled_out()
        low, room = imgui.get_window_pos(), imgui.get_window_size()
        imgui.push_clip_rect(imgui.ImVec2(low.x, low.y + high), imgui.ImVec2(low.x + room.x, low.y + room.y), True)
        self._headings = []
        self._drafts(drafts)
        selection = self._lines(selection)
        imgui.pop_clip_rect()
        imgui.pop_style_var(2)
        imgui.end_child()
        return selection

    def _head_that_is_scrolled_out(self) -> float:
        """Above the lines, what heads the first that is seen, where it is not seen itself; returns how high that is."""
        scrolled, high = imgui.get_scroll_y(), imgui.get_frame_height_with_spacing()
        if imgui.get_window_height() < _LEAST_LINES * high:
            return 0.0
        heads = [each for each in self._headings if each.top < scrolled and each.bottom > scrolled + high]
        if not heads:
            return 0.0
        top = imgui.get_cursor_pos()
        imgui.set_cursor_pos_y(scrolled)
        if _headed(heads[-1].words, "", "above"):
            imgui.set_scroll_y(heads[0].top)
        theme.tooltip("Back to where they begin")
        imgui.set_cursor_pos(top)
        return high

    # --- drafts ------------------------------------------------------------------------------------------------------

    def _drafts(self, drafts: Sequence[LeftDraft]) -> None:
        """The lessons that were edited and not saved."""
        for left in drafts:
            imgui.push_id(left.path.name)
            self._draft(left)
            imgui.pop_id()

    def _draft(self, left: LeftDraft) -> None:
        name = Path(left.draft.lesson).stem or "a new lesson"
        changes = counted(left.draft.changes, "change")
        words = theme.one_line(f"{UNSAVED}{name}", imgui.get_content_region_avail().x)
        if imgui.selectable(words, False)[0]:
            imgui.open_popup(_DRAFT_MENU)
        theme.tooltip(f"{name}: {changes} that were not saved")
        if imgui.begin_popup(_DRAFT_MENU):
            imgui.text_disabled(f"{name}: {changes} not saved")
            if imgui.selectable(RESUME_LABEL, False)[0]:
                self._dispatch(ResumeDraft(left.path))
            if imgui.selectable(DROP_LABEL, False)[0]:
                self._dispatch(DropDraft(left.path))
            imgui.end_popup()

    # --- lessons -----------------------------------------------------------------------------------------------------

    def _lines(self, selection: Selection) -> Selection:
        pressed, _ = imgui.selectable(FREE_LABEL, selection.free)
        theme.tooltip("A click if you like, everything recorded, nothing judged")
        if imgui.selectable(BATTLE_LABEL, False)[0]:
            self._dispatch(OpenBattle())
        theme.tooltip("The drummer plays a phrase and you play it back, or you trade bars; or battle a friend")
        groups, picked = selection.groups(), None
        for number, group in enumerate(groups):
            if selection.course is not None:
                before = sum(len(earlier.cards) for earlier in groups[:number])
                picked = self._part(selection, selection.course, group, before) or picked
            elif selection.search:
                theme.part(f"{group.title} · {len(group.cards)} found")
                picked = self._rows(selection, group.cards) or picked
            else:
                picked = self._kind(selection, group) or picked
        if not groups:
            theme.soft("No lesson has these words.")
        if picked is not None:
            return selection.choose(picked)
        return replace(selection, free=True) if pressed else selection

    def _part(self, selection: Selection, course: Course, group: LessonGroup, before: int) -> LessonCard | None:
        """A part of a course, its lessons numbered from those `before` it on; returns the one that was pressed."""
        top = imgui.get_cursor_pos_y()
        if group.title:
            done = selection.finished(course, [card.name for card in group.cards])
            theme.part(f"{group.title} · {done} of {len(group.cards)}")
        else:
            imgui.separator()
        rows = [self._row(selection, card, f"{k}  {card.title}") for k, card in enumerate(group.cards, before + 1)]
        if group.title:
            self._heads(group.title, top)
        return next((card for card in rows if card is not None), None)

    def _kind(self, selection: Selection, group: LessonGroup) -> LessonCard | None:
        """A kind and, where it is open, its lessons level by level; returns the one that was pressed."""
        self._opens_for_chosen(selection, group.cards)
        top, picked = imgui.get_cursor_pos_y(), None
        counted_so = f"{selection.mastered(group.cards)} of {len(group.cards)}"
        is_open = _headed(group.title, counted_so, f"kind-{group.title}")
        theme.tooltip(f"{group.title}: {counted_so} mastered")
        if not is_open:
            return None
        for level, cards in groupby(group.cards, key=lambda card: card.level_words):
            picked = self._level(selection, group.title, level, tuple(cards)) or picked
        self._headings.insert(0, _Heading(group.title, top, imgui.get_cursor_pos_y()))
        return picked

    def _level(self, selection: Selection, kind: str, level: str, cards: Sequence[LessonCard]) -> LessonCard | None:
        """The lessons of a kind that are as hard as one another; returns the one that was pressed."""
        self._opens_for_chosen(selection, cards)
        top, counted_so = imgui.get_cursor_pos_y(), f"{selection.mastered(cards)} of {len(cards)}"
        flags = imgui.TreeNodeFlags_.default_open | imgui.TreeNodeFlags_.span_avail_width
        flags |= imgui.TreeNodeFlags_.no_tree_push_on_open
        right = _right_end(imgui.get_cursor_screen_pos().y, imgui.get_text_line_height())
        imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*theme.themed(palette.INK_SOFT)))
        is_open = imgui.tree_node_ex(f"{level}###level-{kind}-{level}", flags)
        imgui.pop_style_color()
        theme.tooltip(f"{kind}, {level}: {counted_so} mastered")
        right.words(counted_so, level)
        if not is_open:
            return None
        inwards = theme.points(_INWARDS) if imgui.get_content_region_avail().x > theme.points(_ROOMY) else 0.0
        imgui.set_cursor_pos_x(imgui.get_cursor_pos_x() + inwards)
        imgui.begin_group()
        picked = self._rows(selection, cards)
        imgui.end_group()
        self._heads(f"{kind} › {level}", top)
        return picked

    def _opens_for_chosen(self, selection: Selection, cards: Sequence[LessonCard]) -> None:
        """What is drawn next is open where the lesson that has just been chosen is among its own."""
        if selection.card is not None and any(card.name == selection.card.name for card in cards):
            imgui.set_next_item_open(True, imgui.Cond_.always if self._is_chosen_anew else imgui.Cond_.once)

    def _heads(self, words: str, top: float) -> None:
        self._headings.append(_Heading(words, top, imgui.get_cursor_pos_y()))

    def _rows(self, selection: Selection, cards: Iterable[LessonCard]) -> LessonCard | None:
        """A line for each of some lessons; returns the one that was pressed."""
        rows = [self._row(selection, card, card.title) for card in cards]
        return next((card for card in rows if card is not None), None)

    def _row(self, selection: Selection, card: LessonCard, words: str) -> LessonCard | None:
        """One lesson of the list, its title in as many lines as it needs; returns it where it was pressed."""
        chosen = not selection.free and selection.card is not None and selection.card.name == card.name
        progress, today = selection.progress.get(card.name), date.today()
        room = imgui.get_content_region_avail().x - (0.0 if progress is None else mark_width())
        high, at = imgui.calc_text_size(words, False, room).y, imgui.get_cursor_screen_pos()
        pressed, _ = imgui.selectable(f"###{card.name}", chosen, 0, imgui.ImVec2(0, high))
        if not imgui.is_item_visible():
            if chosen and self._is_chosen_anew:
                imgui.set_scroll_here_y()
            return card if pressed else None
        brush, ink = imgui.get_window_draw_list(), imgui.get_color_u32(imgui.Col_.text)
        brush.add_text(imgui.get_font(), imgui.get_font_size(), at, ink, words, room)
        mark(progress, today)
        if imgui.is_item_hovered():
            facts = f"{bars_of(card)}, {card.meter}, {card.beats_a_minute:g} bpm"
            far = [] if progress is None else [progress.words(today)]
            theme.tooltip("\n".join([card.title, card.about, facts, *selection.first_words(card), *far]))
        return card if pressed else None


def bars_of(card: LessonCard) -> str:
    """How long its loop is, in words."""
    return counted(card.bars, "bar")


@dataclass(frozen=True, slots=True)
class _RightEnd:
    """The right end of a line that is about to be drawn, in the screen's pixels."""

    left: float
    right: float
    middle: float

    def words(self, words: str, before: str) -> None:
        """What is counted of the line `before`, in short where it has no more room, or not at all."""
        arrow = imgui.get_tree_node_to_label_spacing()
        room = self.right - self.left - arrow - imgui.calc_text_size(before).x - imgui.get_style().item_spacing.x
        for each in (words, words.replace(" of ", "/")):
            size = imgui.calc_text_size(each)
            if each and size.x <= room:
                ink = theme.packed(palette.INK_SOFT)
                at = imgui.ImVec2(self.right - size.x, self.middle - size.y / 2)
                imgui.get_window_draw_list().add_text(at, ink, each)
                return


def _right_end(top: float, high: float) -> _RightEnd:
    left, room = imgui.get_cursor_screen_pos().x, imgui.get_content_region_avail().x
    return _RightEnd(left, left + room - imgui.get_style().frame_padding.x / 2, top + high / 2)


def _headed(words: str, counted_so: str, name: str) -> bool:
    """A heading that opens what is below it, what is counted at its right end; returns whether it is open."""
    right = _right_end(imgui.get_cursor_screen_pos().y, imgui.get_frame_height())
    if not counted_so:  # it opens nothing
        words = theme.one_line(words, imgui.get_content_region_avail().x - 2 * imgui.get_style().frame_padding.x)
        imgui.push_style_var(imgui.StyleVar_.button_text_align, imgui.ImVec2(0.0, 0.5))
        pressed = imgui.button(f"{words}###{name}", imgui.ImVec2(-1, 0))
        imgui.pop_style_var()
        return bool(pressed)
    is_open = imgui.collapsing_header(f"{words}###{name}")
    right.words(counted_so, words)
    return bool(is_open)
