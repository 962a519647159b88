"""The page on which a battle is chosen: the drummers, what the chosen one is like, a line for everything else.

All of it is chosen with pads below the page too (`app.battle.battle_choice`); here by the mouse and the keyboard.
"""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.battle_actions import CallOff, ChooseBattle, CloseBattle
from station.app.battle.battle_shown import BattleShown
from station.app.battle.friend_shown import FriendShown
from station.app.settings.chosen_battle import MOST_NAME, ChosenBattle, People
from station.app.settings.setup_lines import (
    MODE_ABOUT,
    MODE_LINE,
    MODE_WORDS,
    OPPONENT_LINE,
    WAY_LINE,
    WHO_LINE,
    SetupLine,
    lines_of,
)
from station.gui import theme
from station.gui.panels.battle.friend_lines import way_to_friend
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.opponents.opponent import OPPONENTS, Opponent

CLOSE_LABEL = "Back to the lessons##close-battle"
CALL_OFF_LABEL = "Call it off##call-off"
FRIEND_LABEL = "##battle-friend"
_TWO_COLUMNS = 620.0
"""Design pixels in which drummers and settings stand beside each other (our choice)."""
_TITLE_SHARE = 0.36
"""The share of a line that its title has."""


class BattleSetupPage:
    """The page; what the user does goes to `dispatch`."""

    def __init__(self, dispatch: Callable[[Action], None]) -> None:
        self._dispatch = dispatch

    def gui(self, shown: BattleShown) -> None:
        """Draw the page and do what the user does in it."""
        setup = shown.setup
        if shown.friend.waits:
            self._waiting(shown.friend)
            return
        chosen = self._head(setup)
        if shown.fault:
            theme.warning(shown.fault)
        if shown.friend.told:
            theme.warning(shown.friend.told)
        if setup.is_guest:
            chosen = self._settings(chosen, shown.friend)
        elif imgui.get_content_region_avail().x < theme.points(_TWO_COLUMNS):
            chosen = self._settings(chosen, shown.friend)
            chosen = self._drummers(chosen)
        else:
            chosen = self._beside(chosen, shown.friend)
        if chosen != setup:
            self._dispatch(ChooseBattle(chosen))

    def _head(self, setup: ChosenBattle) -> ChosenBattle:
        """What is battled."""
        right = _right_end()
        theme.heading("Battle", 24)
        back = imgui.calc_text_size(CLOSE_LABEL, True).x + 2 * imgui.get_style().frame_padding.x
        imgui.same_line(right - back)
        if imgui.button(CLOSE_LABEL):
            self._dispatch(CloseBattle())
        theme.tooltip("No battle (Esc)")
        if setup.is_guest:
            theme.soft("Your friend hosts, and chooses what is played.")
            return setup
        for place, mode in enumerate(BattleMode):
            if place:
                imgui.same_line(0, theme.points(24))
            if theme.radio_button(f"{MODE_WORDS[mode]}##mode", setup.mode is mode):
                setup = replace(setup, mode=mode)
            theme.tooltip(MODE_ABOUT[mode])
        theme.soft(MODE_ABOUT[setup.mode])
        return setup

    def _beside(self, setup: ChosenBattle, friend: FriendShown) -> ChosenBattle:
        """Drummers on the left, settings on the right."""
        room, gap = imgui.get_content_region_avail(), imgui.get_style().item_spacing.x
        imgui.begin_child("##drummers", imgui.ImVec2((room.x - gap) / 2, 0))
        setup = self._drummers(setup)
        imgui.end_child()
        imgui.same_line()
        imgui.begin_child("##settings")
        setup = self._settings(setup, friend)
        imgui.end_child()
        return setup

    # --- the drummers ------------------------------------------------------------------------------------------------

    def _drummers(self, setup: ChosenBattle) -> ChosenBattle:
        theme.part("The drummer" if not setup.people.needs_friend else "Phrases by")
        for opponent in OPPONENTS.values():
            if _drummer(opponent, opponent.name == setup.opponent):
                setup = setup.against(opponent.name)
        return setup

    # --- everything else ---------------------------------------------------------------------------------------------

    def _settings(self, setup: ChosenBattle, friend: FriendShown) -> ChosenBattle:
        theme.part("How")
        for line in lines_of(setup):
            if line in (MODE_LINE, OPPONENT_LINE):
                continue
            setup = _line(line, setup)
            if line is WHO_LINE:
                setup = self._who(setup)
            elif line is WAY_LINE:
                setup = way_to_friend(setup, friend)
        return setup

    def _waiting(self, friend: FriendShown) -> None:
        """Who is waited for, how they come here, and the way back."""
        theme.heading(friend.waits[0], 34)
        for line in friend.waits[1:]:
            theme.heading(line, 24)
        if friend.told:
            theme.soft(friend.told)
        if imgui.button(CALL_OFF_LABEL):
            self._dispatch(CallOff())
        theme.tooltip("Back to what is chosen (Esc)")

    @staticmethod
    def _who(setup: ChosenBattle) -> ChosenBattle:
        """What is to be known of the other person."""
        if setup.people in (People.HOT_SEAT, People.TWO_KITS):
            imgui.set_next_item_width(-1)
            _, friend = imgui.input_text_with_hint(FRIEND_LABEL, "Who plays against you", setup.friend)
            theme.tooltip("The name on the board; blank is fine")
            return replace(setup, friend=friend[:MOST_NAME])
        return setup


def _drummer(opponent: Opponent, is_chosen: bool) -> bool:
    """A drummer, with their words where they are chosen; returns whether they were pressed."""
    pressed = theme.radio_button(f"{opponent.title}##{opponent.name}", is_chosen)
    theme.tooltip(opponent.about)
    if not is_chosen:
        return pressed
    imgui.indent(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x)
    theme.soft(opponent.about)
    imgui.unindent(imgui.get_frame_height() + imgui.get_style().item_inner_spacing.x)
    return pressed


def _right_end() -> float:
    """Where a line ends that begins here, in the window's own pixels."""
    return float(imgui.get_cursor_pos_x() + imgui.get_content_region_avail().x)


def _line(line: SetupLine, setup: ChosenBattle) -> ChosenBattle:
    """A setting: its title, its value between two buttons that turn it."""
    imgui.push_id(line.title)
    room = _right_end()
    imgui.align_text_to_frame_padding()
    imgui.text_disabled(line.title)
    theme.tooltip(line.about)
    high, gap = imgui.get_frame_height(), imgui.get_style().item_spacing.x
    imgui.same_line(_TITLE_SHARE * room)
    if imgui.arrow_button("##back", imgui.Dir.left):
        setup = line.turned(setup, -1)
    theme.tooltip(f"{line.about}: the one before")
    imgui.same_line()
    words = room - imgui.get_cursor_pos_x() - high - gap
    if imgui.button(f"{theme.one_line(line.words(setup), words - theme.points(8))}###value", imgui.ImVec2(words, 0)):
        setup = line.turned(setup, 1)
    theme.tooltip(f"{line.about}. {line.words(setup)}")
    imgui.same_line()
    if imgui.arrow_button("##on", imgui.Dir.right):
        setup = line.turned(setup, 1)
    theme.tooltip(f"{line.about}: the next one")
    imgui.pop_id()
    return setup
