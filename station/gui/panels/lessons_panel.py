"""The lessons panel: the list on the left, what the chosen one is, and how it is to be practised.

Every control has a tooltip, and every one is reached by the keyboard (Tab, arrows, Enter).
"""

from collections.abc import Callable
from dataclasses import dataclass
from datetime import date
from itertools import groupby
from pathlib import Path

from imgui_bundle import imgui

from station.app.model import LessonCard, RoomState
from station.app.selection import MAX_LOOPS, MAX_TEMPO_BPM, MIN_TEMPO_BPM, Selection
from station.core.clock import monotonic_ns
from station.gui import theme
from station.gui.panels.course_list import course_picker, mark, mark_width
from station.gui.widgets.flow_row import FlowRow

START_LABEL = "Start##start"
ADAPT_LABEL = "the tempo follows me"
FREE_LABEL = "Just play##free"
LISTEN_LABEL, STOP_LISTENING = "Listen back##listen", "Stop listening##listen"
FILM_LABEL = "Video of it##film"
TAP_LABEL = "Tap##tap"


@dataclass(frozen=True, slots=True)
class LessonActions:
    """What the user does: `start` what is chosen, `listen` back to the last take, or end it; `film` it.

    `room` is asked.
    """

    start: Callable[[], None]
    listen: Callable[[], None]
    film: Callable[[Path], None]
    room: Callable[[], RoomState]


_HIGH_ENOUGH, _HIGH = 430, 680
"""Design pixels: in a lower panel Start comes first, so that it need not be scrolled to; in one that is not high the
heading is left out."""
_ROWS = 9
"""So many lines of the list are seen before more is said about the lesson that is chosen; our choice."""


class LessonsPanel:
    """The list, the chosen lesson's words, its tempo and passes, and the button that starts it."""

    def __init__(self, choice: Selection, actions: LessonActions) -> None:
        self._choice = choice
        self._actions = actions
        self._is_low = False
        self._below = self._about = 0.0  # pixels that the part under the list, and its words, took in the last frame

    def gui(self) -> None:
        """Draw the panel and do what the user does in it."""
        choice = self._choice
        height = imgui.get_window_height()
        self._is_low = height < theme.points(_HIGH_ENOUGH)
        if self._is_low:
            self._start_button()
        elif height >= theme.points(_HIGH):
            theme.heading("Lessons")
        imgui.set_next_item_width(-1)
        hint = theme.one_line("Search: a word of title, level or tag", imgui.calc_item_width() - theme.points(24))
        imgui.set_next_item_width(-1)
        _, choice.search = imgui.input_text_with_hint("##search", hint, choice.search)
        theme.tooltip("Shows the lessons that contain every word")
        course_picker(choice)
        room = imgui.get_content_region_avail().y
        least = _ROWS * imgui.get_text_line_height_with_spacing()
        lines = int((room - least - (self._below - self._about)) / imgui.get_text_line_height())
        imgui.begin_child("##list", imgui.ImVec2(0, max(room - (self._below or theme.points(280)), theme.points(110))))
        self._list()
        imgui.end_child()
        top, self._about = imgui.get_cursor_pos_y(), 0.0
        imgui.separator()
        if choice.free:
            self._just_play()
        elif choice.card is not None:
            self._chosen(choice.card, lines)
        self._below = imgui.get_cursor_pos_y() - top + imgui.get_style().item_spacing.y

    def _list(self) -> None:
        pressed, _ = imgui.selectable(FREE_LABEL, self._choice.free)
        if pressed:
            self._choice.free = True
        theme.tooltip("A click if you like, everything recorded, nothing judged")
        visible = self._choice.visible()
        if self._choice.course is not None:
            imgui.separator()
            for number, card in enumerate(visible, 1):
                self._row(card, f"{number}  {card.title}")
        else:
            for level, cards in groupby(visible, key=lambda card: card.level_words):
                imgui.separator_text(level)
                for card in cards:
                    self._row(card, card.title)
        if not visible:
            theme.soft("No lesson has these words.")

    def _row(self, card: LessonCard, words: str) -> None:
        chosen = not self._choice.free and self._choice.card is not None and self._choice.card.name == card.name
        progress, today = self._choice.progress.get(card.name), date.today()
        room = imgui.get_content_region_avail().x - (0.0 if progress is None else mark_width())
        pressed, _ = imgui.selectable(f"{theme.one_line(words, room)}###{card.name}", chosen)
        mark(progress, today)
        if pressed:
            self._choice.choose(card)
        far = "" if progress is None else f"\n{progress.words(today)}"
        theme.tooltip(f"{card.title}\n{card.about}\n{card.bars} bars, {card.meter}, {card.beats_a_minute:g} bpm{far}")

    def _chosen(self, card: LessonCard, lines: int) -> None:
        """The lesson, so many `lines` of what it is about, and how to practise it."""
        choice = self._choice
        theme.heading(card.title, 20)
        author = f" · {card.author}" if card.author else ""
        theme.soft(f"{card.bars} bars · {card.meter} · {card.beats_a_minute:g} bpm{author}")
        if card.about and lines > 0 and not self._is_low:  # the list's tooltip has it too
            before = imgui.get_cursor_pos_y()
            theme.soft(theme.first_lines(card.about, lines))
            theme.tooltip(card.about)
            self._about = imgui.get_cursor_pos_y() - before
        row = FlowRow()
        row.place(0)
        _, choice.adapt = imgui.checkbox(ADAPT_LABEL, choice.adapt)
        theme.tooltip(
            "Each pass begins where the last one led: faster when it is clean, slower when it is not, and says why"
        )
        row.place(imgui.get_frame_height() + imgui.calc_text_size("click").x + theme.points(8))
        _, choice.click = imgui.checkbox("click", choice.click)
        theme.tooltip("Without it you are counted in, then the score follows your own tempo and waits when you stop")
        if not choice.adapt:
            self._tempo()
        imgui.set_next_item_width(-1)
        _, choice.loops = theme.slider_int("##passes", choice.loops, 1, MAX_LOOPS, "passes %d")
        theme.tooltip("How often the loop is played")
        if not self._is_low:
            self._start_button()

    def _start_button(self) -> None:
        if theme.main_button(START_LABEL, (-1, theme.points(46))):
            self._actions.start()
        free = self._choice.free
        theme.tooltip("Record from now on (Enter)" if free else "Count-in, demonstration, then you (Enter)")

    def _just_play(self) -> None:
        choice = self._choice
        theme.heading("Just play", 20)
        theme.soft("Nothing is judged. Every stroke is recorded and kept, and you can listen back.")
        _, choice.click = imgui.checkbox("click", choice.click)
        theme.tooltip("As the settings say; without it there is silence")
        if choice.click:
            self._tempo()
        if not self._is_low:
            self._start_button()
        room = self._actions.room()
        imgui.begin_disabled(not (room.take or room.listening))
        if imgui.button(STOP_LISTENING if room.listening else LISTEN_LABEL, imgui.ImVec2(-1, theme.points(38))):
            self._actions.listen()
        imgui.end_disabled()
        theme.tooltip("The last take from its recording, through the station's own drums")
        imgui.begin_disabled(room.take is None)
        if imgui.button(FILM_LABEL, imgui.ImVec2(-1, theme.points(38))) and room.take is not None:
            self._actions.film(room.take)
        imgui.end_disabled()
        theme.tooltip("The drummer plays your last take, as MP4 beside its recording; it is filmed while you go on")

    def _tempo(self) -> None:
        choice = self._choice
        beats = 100.0 if choice.free or choice.card is None else choice.card.beats_a_minute
        low, high = min(MIN_TEMPO_BPM, int(beats)), max(MAX_TEMPO_BPM, int(beats) + 1)
        tap = theme.points(58)
        imgui.set_next_item_width(-(tap + imgui.get_style().item_spacing.x))
        beats = choice.tempo_bpm / choice.beat_quarters
        moved, beats = theme.slider_float("##tempo", beats, low, high, "tempo %.0f bpm")
        if moved:
            choice.tempo_bpm = beats * choice.beat_quarters
        theme.tooltip("How fast to practise; the lesson's own tempo is set when you choose it. Ctrl+click to type")
        imgui.same_line()
        if imgui.button(TAP_LABEL, imgui.ImVec2(tap, 0)):
            choice.tap(monotonic_ns(), (low, high))
        theme.tooltip("Click on every beat, twice or more: the tempo follows")
