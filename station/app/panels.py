"""The panels of the window: lessons on the left, the transport below the picture, the keys' help.

Every control has a tooltip, and every one is reached by the keyboard (Tab, arrows, Enter).
"""

from collections.abc import Callable
from dataclasses import replace
from itertools import groupby, zip_longest

from imgui_bundle import imgui

from station.app import theme
from station.app.choice import MAX_LOOPS, MAX_TEMPO_BPM, MIN_TEMPO_BPM, Choice
from station.app.keyboard import COMMANDS, KEYS
from station.app.look import Look
from station.app.look_panel import LOOK_LABEL, POPUP, LookActions, look_popup
from station.app.model import LessonCard, RoomState, Stage
from station.core.clock import monotonic_ns
from station.practice.own_ear import Guess
from station.render.camera import VIEW_NAMES, View

START_LABEL = "Start##start"
ADAPT_LABEL = "the tempo follows me"
TAP_LABEL = "Tap the tempo##tap"
VETO_LABEL = "As it was##veto"
STOP_LABEL = "Stop##stop"
AGAIN_LABEL = "Once more##again"
BACK_LABEL = "Back to the lessons##back"


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


_RIGHT_PART = 430
"""Design pixels that the viewpoint's controls take."""


def found(room: RoomState) -> str:
    """The kit and the sound card in words; without a kit, what plays instead."""
    return " · ".join(part for part in (room.kit or "no kit: the computer's keys play (F1)", room.sound) if part)


def transport_bar(
    room: RoomState, look: Look, actions: "dict[str, Callable[[], None]]", viewpoints: LookActions
) -> Look:
    """Stop or go on, progress, the viewpoint; returns the look that was chosen."""
    height = theme.points(38)
    if room.stage is Stage.PLAYING:
        if imgui.button(STOP_LABEL, imgui.ImVec2(theme.points(96), height)):
            actions["stop"]()
        theme.tooltip("End the session here; what was played is kept (Esc)")
        if room.can_veto:
            imgui.same_line()
            if imgui.button(VETO_LABEL, imgui.ImVec2(theme.points(110), height)):
                actions["veto"]()
            theme.tooltip(f"{room.why} Press to play the last pass once more instead")
    elif room.question:
        _asked(room.question, actions)
    elif room.stage is Stage.RESULT:
        if theme.main_button(AGAIN_LABEL, (theme.points(150), height)):
            actions["again"]()
        theme.tooltip("The same lesson, the same tempo (Enter)")
        imgui.same_line()
        if imgui.button(BACK_LABEL, imgui.ImVec2(theme.points(190), height)):
            actions["back"]()
        theme.tooltip("Choose another lesson (Esc)")
    if room.stage is not Stage.IDLE:
        imgui.same_line()
    if room.progress is not None:
        room_left = imgui.get_content_region_avail().x - theme.points(_RIGHT_PART)
        imgui.progress_bar(room.progress, imgui.ImVec2(max(room_left, 1.0), height), "")
        theme.tooltip("How much of the session is over")
        imgui.same_line()
    elif room.stage is Stage.IDLE:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(found(room))
        theme.tooltip("The kit and the sound card that were found")
        imgui.same_line()
    imgui.set_cursor_pos_x(imgui.get_window_width() - theme.points(_RIGHT_PART))
    return _view_part(look, viewpoints)


def _view_part(look: Look, actions: LookActions) -> Look:
    _, mirrored = imgui.checkbox("mirror", look.mirrored)
    theme.tooltip("Left and right swapped, to learn face to face as from a mirror (M)")
    imgui.same_line()
    if imgui.button(LOOK_LABEL, imgui.ImVec2(theme.points(70), 0)):
        imgui.open_popup(POPUP)
    theme.tooltip("A second picture, pages or a highway for the score, viewpoints of your own")
    chosen = look_popup(look, actions)
    imgui.same_line()
    imgui.set_next_item_width(-1)
    changed, index = imgui.combo("##view", int(look.view), list(VIEW_NAMES.values()))
    theme.tooltip(
        "Where you look from (F2 to F9); drag in the picture to turn, right drag to shift, wheel to come nearer"
    )
    return replace(chosen, view=View(index) if changed else look.view, mirrored=bool(mirrored))


def _asked(question: str, actions: "dict[str, Callable[[], None]]") -> None:
    """A button for each answer, and the question."""
    for guess in Guess:
        if imgui.button(guess.value, imgui.ImVec2(theme.points(96), theme.points(38))):
            actions[guess.value]()
        theme.tooltip(question)
        imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(question)


def keys_help(frame_ms: float) -> None:
    """What the keys play, and how exactly."""
    theme.heading("Keys", 22)
    theme.soft(
        f"Without a kit, play on these keys. They are looked at once a frame, now every {frame_ms:.0f} ms,"
        " so their timing is that coarse: a kit is measured far better."
    )
    strokes = [(stroke.cap, stroke.words) for stroke in KEYS.values()]
    if imgui.begin_table("##keys", 4, imgui.TableFlags_.sizing_fixed_fit):
        for played, done in zip_longest(strokes, COMMANDS, fillvalue=("", "")):
            imgui.table_next_row()
            for cap, words in (played, done):
                imgui.table_next_column()
                imgui.text(cap)
                imgui.table_next_column()
                imgui.text_disabled(words)
        imgui.end_table()
