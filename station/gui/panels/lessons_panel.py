"""The lessons panel: the list on the left, what the chosen one is, and how it is to be practised.

Every control has a tooltip, and every one is reached by the keyboard (Tab, arrows, Enter).
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from datetime import date
from itertools import groupby
from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.editor_actions import DropDraft, NewLesson, OpenEditor, ResumeDraft
from station.app.actions.file_actions import FilmTake, Import
from station.app.actions.practice_actions import Begin, JudgeAt, Listen, Select, TapBeat
from station.app.editor.draft_journal import LeftDraft
from station.app.room_state import LessonCard, RoomState
from station.app.selection import MAX_LOOPS, LessonGroup, Selection
from station.app.window_state import State
from station.core.clock import monotonic_ns
from station.drills.course import Course
from station.gui import theme
from station.gui.panels.course_list import course_picker, mark, mark_width
from station.gui.widgets.flow_row import FlowRow

START_LABEL = "Start##start"
LEVEL_LABEL = "##level"
ADAPT_LABEL = "the tempo follows me"
_WITHOUT_CLICK = "Without it you are counted in, then the score follows your own tempo and waits when you stop"
_BAND_ALONE = "Without it you are counted in, then the band alone keeps the time"
FREE_LABEL = "Just play##free"
LISTEN_LABEL, STOP_LISTENING = "Listen back##listen", "Stop listening##listen"
FILM_LABEL = "Video of it##film"
LESSON_LABEL = "Lesson of it##take"
IMPORT_LABEL = "Import…##open-import"
TAP_LABEL = "Tap##tap"
EDIT_LABEL, NEW_LABEL = "Edit##edit-lesson", "New lesson##new-lesson"
RESUME_LABEL, DROP_LABEL = "Go on with it##draft", "Throw it away##draft"
UNSAVED, _DRAFT_MENU = "Draft: ", "##draft-menu"


_HIGH_ENOUGH, _HIGH = 430, 680
"""Design pixels: in a lower panel Start comes first, so that it need not be scrolled to; in one that is not high the
heading is left out."""
_PASSES = 92
"""Design pixels of the passes' slider; the level has the rest of its line."""
_ROWS = 9
"""So many lines of the list are seen before more is said about the lesson that is chosen; our choice."""


_MOST_BEFORE = 2
"""So many of the lessons that should come before are named, one where there is little room; the tooltip in the list has
all (our choice)."""


class LessonsPanel:
    """The list, the chosen lesson's words, its tempo and passes, and the button that starts it."""

    def __init__(self, dispatch: Callable[[Action], None], open_import: Callable[[], None]) -> None:
        self._dispatch, self._open_import = dispatch, open_import
        self._is_low = False
        self._chosen_last, self._is_chosen_anew = "", False
        self._below = self._about = 0.0  # pixels that the part under the list, and its words, took in the last frame

    def gui(self, state: State) -> None:
        """Draw the panel and do what the user does in it."""
        selection = state.selection
        height = imgui.get_window_height()
        self._is_low = height < theme.points(_HIGH_ENOUGH)
        if self._is_low:
            self._start_button(selection)
        elif height >= theme.points(_HIGH):
            theme.heading("Lessons")
        selection = replace(selection, search=self._search(selection.search))
        selection = course_picker(selection)
        chosen = "" if selection.card is None else selection.card.name
        self._is_chosen_anew, self._chosen_last = chosen != self._chosen_last, chosen
        room = imgui.get_content_region_avail().y
        least = _ROWS * imgui.get_text_line_height_with_spacing()
        lines = int((room - least - (self._below - self._about)) / imgui.get_text_line_height())
        imgui.begin_child("##list", imgui.ImVec2(0, max(room - (self._below or theme.points(280)), theme.points(110))))
        self._drafts(state.drafts)
        selection = self._list(selection)
        imgui.end_child()
        top, self._about = imgui.get_cursor_pos_y(), 0.0
        imgui.separator()
        before = state.selection
        if selection.free:
            selection = self._just_play(selection, state.room)
        elif selection.card is not None:
            selection = self._chosen(selection, selection.card, lines)
        self._below = imgui.get_cursor_pos_y() - top + imgui.get_style().item_spacing.y
        if selection != before:
            self._dispatch(Select(selection))

    def _search(self, words: str) -> str:
        """The words that are searched for, and beside them what brings more lessons."""
        spacing = imgui.get_style().item_spacing.x
        beside = imgui.calc_text_size(IMPORT_LABEL, True).x + 2 * imgui.get_style().frame_padding.x + spacing
        imgui.set_next_item_width(-beside)
        hint = theme.one_line("Search: a word of title, level or tag", imgui.calc_item_width() - theme.points(24))
        imgui.set_next_item_width(-beside)
        _, words = imgui.input_text_with_hint("##search", hint, words)
        theme.tooltip("Shows the lessons that contain every word")
        imgui.same_line()
        if imgui.button(IMPORT_LABEL):
            self._open_import()
        theme.tooltip("Make a lesson of a music file, a song's folder, a GrooveScribe link or a take; or drop it here")
        return str(words)

    def _drafts(self, drafts: Sequence[LeftDraft]) -> None:
        """The lessons that were edited and not saved."""
        for left in drafts:
            imgui.push_id(left.path.name)
            self._draft(left)
            imgui.pop_id()

    def _draft(self, left: LeftDraft) -> None:
        name = Path(left.draft.lesson).stem or "a new lesson"
        changes = f"{left.draft.changes} change{'' if left.draft.changes == 1 else 's'}"
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

    def _list(self, selection: Selection) -> Selection:
        if imgui.selectable(NEW_LABEL, False)[0]:
            self._dispatch(NewLesson())
        theme.tooltip("Write one: with the mouse, the keyboard or your kit")
        pressed, _ = imgui.selectable(FREE_LABEL, selection.free)
        theme.tooltip("A click if you like, everything recorded, nothing judged")
        groups, picked = selection.groups(), None
        for number, group in enumerate(groups):
            if selection.course is not None:
                before = sum(len(earlier.cards) for earlier in groups[:number])
                picked = self._part(selection, selection.course, group, before) or picked
            elif selection.search:
                imgui.separator_text(group.title)
                picked = self._rows(selection, group.cards) or picked
            elif self._kind(selection, group):
                picked = self._levels(selection, group) or picked
        if not groups:
            theme.soft("No lesson has these words.")
        if picked is not None:
            return selection.choose(picked)
        return replace(selection, free=True) if pressed else selection

    def _part(self, selection: Selection, course: Course, group: LessonGroup, before: int) -> LessonCard | None:
        """A part of a course, its lessons numbered from those `before` it on; returns the one that was pressed."""
        if group.title:
            done = selection.finished(course, [card.name for card in group.cards])
            imgui.separator_text(f"{group.title} · {done} of {len(group.cards)}")
        else:
            imgui.separator()
        rows = [self._row(selection, card, f"{k}  {card.title}") for k, card in enumerate(group.cards, before + 1)]
        return next((card for card in rows if card is not None), None)

    def _kind(self, selection: Selection, group: LessonGroup) -> bool:
        """The heading of a kind, which opens and closes; returns whether it is open."""
        has_chosen = selection.card is not None and any(card.name == selection.card.name for card in group.cards)
        if has_chosen:
            imgui.set_next_item_open(True, imgui.Cond_.always if self._is_chosen_anew else imgui.Cond_.once)
        counted = f"{selection.mastered(group.cards)} of {len(group.cards)}"
        is_open = imgui.collapsing_header(f"{group.title} · {counted}###kind-{group.title}")
        theme.tooltip(f"{counted} lessons of this kind are mastered")
        return is_open

    def _levels(self, selection: Selection, group: LessonGroup) -> LessonCard | None:
        """A kind's lessons, level by level; returns the one that was pressed."""
        picked = None
        for level, cards in groupby(group.cards, key=lambda card: card.level_words):
            imgui.separator_text(level)
            picked = self._rows(selection, cards) or picked
        return picked

    def _rows(self, selection: Selection, cards: Iterable[LessonCard]) -> LessonCard | None:
        """A line for each of some lessons; returns the one that was pressed."""
        rows = [self._row(selection, card, card.title) for card in cards]
        return next((card for card in rows if card is not None), None)

    def _row(self, selection: Selection, card: LessonCard, words: str) -> LessonCard | None:
        """One line of the list; returns its lesson where it was pressed."""
        chosen = not selection.free and selection.card is not None and selection.card.name == card.name
        progress, today = selection.progress.get(card.name), date.today()
        room = imgui.get_content_region_avail().x - (0.0 if progress is None else mark_width())
        pressed, _ = imgui.selectable(f"{theme.one_line(words, room)}###{card.name}", chosen)
        if chosen and self._is_chosen_anew and not imgui.is_item_visible():
            imgui.set_scroll_here_y()
        mark(progress, today)
        facts = f"{_bars(card)}, {card.meter}, {card.beats_a_minute:g} bpm"
        far = [] if progress is None else [progress.words(today)]
        theme.tooltip("\n".join([card.title, card.about, facts, *selection.first_words(card), *far]))
        return card if pressed else None

    def _chosen(self, selection: Selection, card: LessonCard, lines: int) -> Selection:
        """The lesson, so many `lines` of what it is about, and how to practise it; returns how it is chosen to be."""
        theme.heading(card.title, 20)
        author = f" · {card.author}" if card.author else ""
        theme.soft(f"{_bars(card)} · {card.meter} · {card.beats_a_minute:g} bpm{author}")
        for line in selection.first_words(card)[: _MOST_BEFORE if lines > 0 else 1]:
            theme.soft(line)
            theme.tooltip("What should come before; nothing is forbidden")
        if card.about and lines > 0 and not self._is_low:  # the list's tooltip has it too
            before = imgui.get_cursor_pos_y()
            theme.soft(theme.first_lines(card.about, lines))
            theme.tooltip(card.about)
            self._about = imgui.get_cursor_pos_y() - before
        row = FlowRow()
        row.place(0)
        if not card.is_song:
            selection = replace(selection, adapt=imgui.checkbox(ADAPT_LABEL, selection.adapt)[1])
            theme.tooltip(
                "Each pass begins where the last one led: faster when it is clean, slower when it is not, and says why"
            )
            row.place(imgui.get_frame_height() + imgui.calc_text_size("click").x + theme.points(8))
        selection = replace(selection, click=imgui.checkbox("click", selection.click)[1])
        theme.tooltip(_BAND_ALONE if card.is_song else _WITHOUT_CLICK)
        if card.is_song or not selection.adapt:
            selection = self._tempo(selection)
        imgui.set_next_item_width(theme.points(_PASSES))
        selection = replace(
            selection, loops=theme.slider_int("##passes", selection.loops, 1, MAX_LOOPS, "passes %d")[1]
        )
        theme.tooltip("How often the loop is played")
        imgui.same_line()
        self._level(selection, card)
        if not self._is_low:
            self._start_button(selection)
        return selection

    def _level(self, selection: Selection, card: LessonCard) -> None:
        """How strictly the lesson is judged."""
        levels, level = card.levels.choices, selection.level
        assert level is not None, "a lesson is chosen"
        imgui.set_next_item_width(-1)
        changed, index = imgui.combo(LEVEL_LABEL, levels.index(level), [f"judged as {each}" for each in levels])
        if changed:
            self._dispatch(JudgeAt(card.name, levels[index]))
        within_ms = level.windows.edges_ms[0]
        theme.tooltip(
            f"On time is within {within_ms:g} ms, and a pass is clean at this level's mark; the score stays the same."
            " When you hold the lesson at it, the next one holds from the next time on"
        )

    def _start_button(self, selection: Selection) -> None:
        card = None if selection.free else selection.card
        style, high = imgui.get_style(), theme.points(46)
        edit = imgui.calc_text_size(EDIT_LABEL, True).x + 2 * style.frame_padding.x
        if theme.main_button(START_LABEL, (-1 if card is None else -(edit + style.item_spacing.x), high)):
            self._dispatch(Select(selection))  # what was typed last is part of what begins
            self._dispatch(Begin())
        theme.tooltip("Record from now on (Enter)" if selection.free else "Count-in, demonstration, then you (Enter)")
        if card is None:
            return
        imgui.same_line()
        if imgui.button(EDIT_LABEL, imgui.ImVec2(edit, high)):
            self._dispatch(OpenEditor(card.name))
        own = "Change this lesson of your own" if not card.kind else "Change a copy of it; the lesson itself stays"
        theme.tooltip(f"{own}: grid, notation, words")

    def _just_play(self, selection: Selection, room: RoomState) -> Selection:
        theme.heading("Just play", 20)
        theme.soft("Nothing is judged. Every stroke is recorded and kept, and you can listen back.")
        selection = replace(selection, click=imgui.checkbox("click", selection.click)[1])
        theme.tooltip("As the settings say; without it there is silence")
        if selection.click:
            selection = self._tempo(selection)
        if not self._is_low:
            self._start_button(selection)
        imgui.begin_disabled(not (room.take or room.listening))
        if imgui.button(STOP_LISTENING if room.listening else LISTEN_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._dispatch(Listen())
        imgui.end_disabled()
        theme.tooltip("The last take from its recording, through the station's own drums")
        imgui.begin_disabled(room.take is None)
        half = (imgui.get_content_region_avail().x - imgui.get_style().item_spacing.x) / 2
        if imgui.button(FILM_LABEL, imgui.ImVec2(half, theme.points(38))) and room.take is not None:
            self._dispatch(FilmTake(room.take))
        theme.tooltip("The drummer plays your last take, as MP4 beside its recording; it is filmed while you go on")
        imgui.same_line()
        if imgui.button(LESSON_LABEL, imgui.ImVec2(half, theme.points(38))) and room.take is not None:
            self._dispatch(Import(str(room.take)))
        theme.tooltip("Your last take on the grid, as a lesson of your own; Export has it as MIDI, stroke by stroke")
        imgui.end_disabled()
        return selection

    def _tempo(self, selection: Selection) -> Selection:
        tap = theme.points(58)
        imgui.set_next_item_width(-(tap + imgui.get_style().item_spacing.x))
        moved, beats = theme.slider_float("##tempo", selection.beats_a_minute, *selection.tempo_range, "tempo %.0f bpm")
        if moved:
            selection = replace(selection, tempo_bpm=beats * selection.beat_quarters)
        theme.tooltip("How fast to practise; the lesson's own tempo is set when you choose it. Ctrl+click to type")
        imgui.same_line()
        if imgui.button(TAP_LABEL, imgui.ImVec2(tap, 0)):
            self._dispatch(TapBeat(monotonic_ns()))
        theme.tooltip("Click on every beat, twice or more: the tempo follows")
        return selection


def _bars(card: LessonCard) -> str:
    return f"{card.bars} bar{'' if card.bars == 1 else 's'}"
