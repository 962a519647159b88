"""The lessons panel: the list on the left, what the chosen one is, and how it is to be practised.

Every control has a tooltip, and every one is reached by the keyboard (Tab, arrows, Enter).
"""

from collections.abc import Callable
from itertools import groupby

from imgui_bundle import imgui

from station.app import theme
from station.app.choice import MAX_LOOPS, MAX_TEMPO_BPM, MIN_TEMPO_BPM, Choice
from station.app.model import LessonCard
from station.core.clock import monotonic_ns

START_LABEL = "Start##start"
ADAPT_LABEL = "the tempo follows me"
TAP_LABEL = "Tap the tempo##tap"


class LessonsPanel:
    """The list, the chosen lesson's words, its tempo and passes, and the button that starts it."""

    def __init__(self, choice: Choice, start: Callable[[], None]) -> None:
        self._choice = choice
        self._start = start
        self._below = 0.0  # pixels that the part under the list took in the last frame

    def gui(self) -> None:
        """Draw the panel and do what the user does in it."""
        choice = self._choice
        theme.heading("Lessons")
        imgui.set_next_item_width(-1)
        _, choice.search = imgui.input_text_with_hint(
            "##search", "Search: a word of title, level or tag", choice.search
        )
        theme.tooltip("Shows the lessons that contain every word")
        room = imgui.get_content_region_avail().y - (self._below or theme.points(280))
        imgui.begin_child("##list", imgui.ImVec2(0, max(room, theme.points(110))))
        self._list()
        imgui.end_child()
        top = imgui.get_cursor_pos_y()
        imgui.separator()
        if choice.card is not None:
            self._chosen(choice.card)
        self._below = imgui.get_cursor_pos_y() - top + imgui.get_style().item_spacing.y

    def _list(self) -> None:
        visible = self._choice.visible()
        for level, cards in groupby(visible, key=lambda card: card.level_words):
            imgui.separator_text(level)
            for card in cards:
                self._row(card)
        if not visible:
            theme.soft("No lesson has these words.")

    def _row(self, card: LessonCard) -> None:
        chosen = self._choice.card is not None and self._choice.card.name == card.name
        pressed, _ = imgui.selectable(f"{card.title}##{card.name}", chosen)
        if pressed:
            self._choice.choose(card)
        theme.tooltip(f"{card.about}\n{card.bars} bars, {card.meter}, {card.beats_a_minute:g} bpm")

    def _chosen(self, card: LessonCard) -> None:
        choice = self._choice
        theme.heading(card.title, 20)
        author = f" · {card.author}" if card.author else ""
        theme.soft(f"{card.bars} bars · {card.meter} · {card.beats_a_minute:g} bpm{author}")
        if card.about:
            theme.soft(card.about)
        _, choice.adapt = imgui.checkbox(ADAPT_LABEL, choice.adapt)
        theme.tooltip(
            "Each pass begins where the last one led: faster when it is clean, slower when it is not, and says why"
        )
        if not choice.adapt:
            self._tempo(card)
        imgui.set_next_item_width(-theme.points(84))
        _, choice.loops = imgui.slider_int("passes", choice.loops, 1, MAX_LOOPS)
        theme.tooltip("How often the loop is played")
        _, choice.click = imgui.checkbox("click", choice.click)
        theme.tooltip("Without it you are counted in, then the score follows your own tempo and waits when you stop")
        if theme.main_button(START_LABEL, (-1, theme.points(46))):
            self._start()
        theme.tooltip("Count-in, demonstration, then you (Enter)")

    def _tempo(self, card: LessonCard) -> None:
        choice = self._choice
        low = min(MIN_TEMPO_BPM, int(card.beats_a_minute))
        high = max(MAX_TEMPO_BPM, int(card.beats_a_minute) + 1)
        imgui.set_next_item_width(-theme.points(84))
        beats = choice.tempo_bpm / card.beat_quarters
        moved, beats = imgui.slider_float("tempo", beats, low, high, "%.0f bpm")
        if moved:
            choice.tempo_bpm = beats * card.beat_quarters
        theme.tooltip("How fast to practise; the lesson's own tempo is set when you choose it. Ctrl+click to type")
        if imgui.button(TAP_LABEL):
            choice.tap(monotonic_ns(), (low, high))
        theme.tooltip("Click on every beat, twice or more: the tempo follows")
