"""The page of the first start: three questions, one button, nothing else on the screen.

The keyboard alone answers it: the name is being typed when the page opens, Enter or Tab go on, Space chooses, and Enter
on the last button begins. Escape puts the questions aside for good.
"""

from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.settings_actions import FinishFirstStart
from station.app.room_state import RoomState
from station.app.settings.first_start import LONGEST_NAME, FirstAnswers, found_lines
from station.gui import theme
from station.gui.keyboard_kit import GROOVE_KEYS
from station.motion.sticking.hand_notes import Hands

WELCOME = "Welcome"
BEGIN_LABEL, FIRST_LABEL = "Begin###begin", "Hear the first groove, then play it###begin"
BATTLE_LABEL = "I play already: battle a drummer##battle"
_WIDE = 620
"""Design pixels of the column of questions; our choice: a line that is read at a glance."""
_SOUNDS = (
    (True, "Yes, from its module or headphones", "The station stays silent when you strike: the module sounds"),
    (False, "No, or I have no kit yet", "The station sounds your strokes; without a kit the keyboard plays (F1)"),
)
_LEADS = (
    (Hands.RIGHT, "Right", "The drummer plays a right-handed kit"),
    (Hands.LEFT, "Left", "The drummer plays a left-handed kit, and every sticking changes sides"),
    (Hands.OPEN, "Open-handed", "A right-handed kit whose hi-hat the left hand plays, uncrossed"),
)


_FIRST = "The drummer plays it once, then you do, first slowly: about a minute. Esc goes to the lessons instead"


class WelcomePage:
    """The page while it is open; `answers` as they stand."""

    def __init__(self, answers: FirstAnswers) -> None:
        self.answers = answers
        self._is_new = True
        self._go_on = False
        self._high = 0.0  # pixels that the questions took in the last frame

    def gui(self, room: RoomState, plays_at_once: bool) -> FinishFirstStart | None:
        """Draw the page over the whole window; returns how it was left, None while it is open."""
        viewport = imgui.get_main_viewport()
        imgui.set_next_window_pos(viewport.pos)
        imgui.set_next_window_size(viewport.size)
        imgui.set_next_window_bg_alpha(1.0)
        flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.no_move | imgui.WindowFlags_.no_docking
        flags &= ~imgui.WindowFlags_.no_scrollbar
        imgui.begin(WELCOME, None, flags | imgui.WindowFlags_.no_saved_settings)
        if self._is_new:
            imgui.set_window_focus()
        wide = min(theme.points(_WIDE), imgui.get_content_region_avail().x)
        imgui.set_cursor_pos(
            imgui.ImVec2((viewport.size.x - wide) / 2, max((viewport.size.y - self._high) / 2, theme.points(14)))
        )
        imgui.begin_group()
        imgui.push_text_wrap_pos(imgui.get_cursor_pos_x() + wide)
        imgui.push_item_width(wide)
        done = self._questions(wide, room, plays_at_once)
        imgui.pop_item_width()
        imgui.pop_text_wrap_pos()
        imgui.end_group()
        self._high = imgui.get_item_rect_size().y
        imgui.end()
        self._is_new = False
        return FinishFirstStart(None) if imgui.is_key_pressed(imgui.Key.escape, repeat=False) else done

    def _questions(self, wide: float, room: RoomState, plays_at_once: bool) -> FinishFirstStart | None:
        theme.heading("Welcome to the drum station", 30)
        theme.soft("Three questions, then you hear a groove and play it. All of it can be changed later.")
        imgui.spacing()
        theme.heading("Who are you?", 22)
        if self._is_new:
            imgui.set_keyboard_focus_here()
        entered, name = imgui.input_text_with_hint(
            "##name", "Your name: lessons and progress are kept under it", self.answers.student,
            imgui.InputTextFlags_.enter_returns_true,
        )  # fmt: skip
        theme.tooltip(f"Up to {LONGEST_NAME} letters; blank is fine")
        self.answers = replace(self.answers, student=name)
        theme.heading("Do you hear your kit when you strike it, without the station?", 22)
        if self._go_on:  # a frame later: the field gives the keyboard back first
            imgui.set_keyboard_focus_here()
            imgui.set_nav_cursor_visible(True)
        self._go_on = entered
        for sounds, words, tip in _SOUNDS:
            if imgui.radio_button(f"{words}##sounds", self.answers.module_sounds is sounds):
                self.answers = replace(self.answers, module_sounds=sounds)
            theme.tooltip(tip)
        theme.heading("Which hand leads?", 22)
        for index, (hands, words, tip) in enumerate(_LEADS):
            if index:
                imgui.same_line(0, theme.points(24))
            if imgui.radio_button(f"{words}##leads", self.answers.hands is hands):
                self.answers = replace(self.answers, hands=hands)
            theme.tooltip(tip)
        theme.soft(next(tip for hands, _, tip in _LEADS if hands is self.answers.hands) + ".")
        imgui.spacing()
        for line in found_lines(room.kit, room.sound, GROOVE_KEYS):
            theme.soft(line)
        imgui.spacing()
        begun = theme.main_button(FIRST_LABEL if plays_at_once else BEGIN_LABEL, (wide, theme.points(52)))
        theme.tooltip(_FIRST if plays_at_once else "To the lessons: the first one is chosen, Start plays it")
        battles = imgui.button(BATTLE_LABEL, imgui.ImVec2(wide, 0))
        theme.tooltip("The drummer plays a phrase and you play it back, or you trade bars; it meets you at your level")
        return FinishFirstStart(self.answers, battles) if begun or battles else None
