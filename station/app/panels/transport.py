"""The strip below the picture: the ruler and the player between sessions, progress during one, where one looks from.

It takes as many lines as its controls need in the window's width, and says how high it is.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import imgui

from station.app import theme
from station.app.deck import Deck
from station.app.look import Look
from station.app.model import RoomState, Stage
from station.app.panels.look_popup import LOOK_LABEL, POPUP, LookActions, look_popup
from station.app.panels.player_controls import PlayerControls, counter
from station.app.panels.ruler import HEIGHT, Ruler
from station.app.row import Row
from station.practice.own_ear import Guess
from station.render.camera import VIEW_NAMES, View

PAUSE_LABEL, GO_ON_LABEL = "Pause##hold", "Go on##hold"
VETO_LABEL = "As it was##veto"
STOP_LABEL = "Stop##stop"
AGAIN_LABEL = "Once more##again"
BACK_LABEL = "Back to the lessons##back"

_PAUSE = "The score waits (Backspace; both crashes at once or a foot switch, as the settings say)"
_GO_ON = "A bar of count-in, then on from the bar of your last stroke (Backspace, or two kicks)"
NO_KIT = "no kit: the keys play (F1)"
_LEAST_LEFT = 360.0
"""Design pixels below which the ruler, or the two buttons beside a result, take a line of their own."""
_SMALL_FONT_SIZE = 14.0


def found(room: RoomState) -> tuple[str, ...]:
    """The kit and the sound card in words; without a kit, what plays instead."""
    return tuple(part for part in (room.kit or NO_KIT, room.sound) if part)


@dataclass(frozen=True, slots=True)
class TransportParts:
    """What the strip is made of; `actions` by name, `tools` draws the list of panels."""

    actions: dict[str, Callable[[], None]]
    viewpoints: LookActions
    tools: Callable[[], None]
    ruler: Ruler
    controls: PlayerControls


class TransportBar:
    """The strip; `height` is what it needs in pixels, as of the last frame."""

    def __init__(self, parts: TransportParts) -> None:
        self._parts = parts
        self._view_px = 0.0
        self.height = 0.0

    def gui(self, room: RoomState, deck: Deck, look: Look) -> Look:
        """Draw it; returns the look that was chosen."""
        spacing = imgui.get_style().item_spacing
        left_px = imgui.get_content_region_avail().x - self._view_px - spacing.x
        beside = left_px >= theme.points(_LEAST_LEFT)
        if not beside:
            left_px = imgui.get_content_region_avail().x
        self._left(room, deck, left_px)
        if beside:
            imgui.same_line()
            imgui.set_cursor_pos_x(imgui.get_window_width() - imgui.get_style().window_padding.x - self._view_px)
        look = self._view_part(look)
        self._below(room, deck)
        self.height = imgui.get_cursor_pos_y() - spacing.y + imgui.get_style().window_padding.y
        return look

    def _left(self, room: RoomState, deck: Deck, width: float) -> None:
        """The first line: where one is in the music, or what is to be answered or done."""
        height = theme.points(HEIGHT)
        if room.free:
            imgui.dummy(imgui.ImVec2(width, height))
        elif room.stage is Stage.IDLE:
            self._parts.ruler.gui(deck.player, deck.now_ns, width)
        elif room.stage is Stage.PLAYING:
            imgui.progress_bar(room.progress or 0.0, imgui.ImVec2(width, height), "")
            theme.tooltip("How much of the session is over")
        elif room.question:
            self._asked(room.question)
        else:
            if theme.main_button(AGAIN_LABEL, (theme.points(150), height)):
                self._parts.actions["again"]()
            theme.tooltip("The same lesson, the same tempo (Enter)")
            imgui.same_line()
            if imgui.button(BACK_LABEL, imgui.ImVec2(theme.points(190), height)):
                self._parts.actions["back"]()
            theme.tooltip("Choose another lesson (Esc)")

    def _below(self, room: RoomState, deck: Deck) -> None:
        """The second line, which wraps: the player's controls, or a session's time and how to end it."""
        row = Row()
        if room.stage is Stage.IDLE and not room.free:
            self._parts.controls.gui(deck, row)
        elif room.stage is Stage.PLAYING:
            self._session(room, row)
        if room.stage is not Stage.PLAYING:
            _told(found(room), row)

    def _session(self, room: RoomState, row: Row) -> None:
        row.place(theme.points(96))
        if imgui.button(STOP_LABEL, imgui.ImVec2(theme.points(96), theme.points(HEIGHT))):
            self._parts.actions["stop"]()
        theme.tooltip("End the session here; what was played is kept (Esc)")
        if room.clock is not None:
            row.place(theme.points(150))
            counter(room.clock.time_s, room.clock.bar, room.clock.beat)
        if room.can_pause or room.paused:
            row.place(theme.points(96))
            label = GO_ON_LABEL if room.paused else PAUSE_LABEL
            if imgui.button(label, imgui.ImVec2(theme.points(96), theme.points(HEIGHT))):
                self._parts.actions["pause"]()
            theme.tooltip(_GO_ON if room.paused else _PAUSE)
        if room.can_veto:
            row.place(theme.points(110))
            if imgui.button(VETO_LABEL, imgui.ImVec2(theme.points(110), theme.points(HEIGHT))):
                self._parts.actions["veto"]()
            theme.tooltip(f"{room.why} Press to play the last pass once more instead")

    def _view_part(self, look: Look) -> Look:
        imgui.begin_group()
        self._parts.tools()
        _, mirrored = imgui.checkbox("mirror", look.mirrored)
        theme.tooltip("Left and right swapped, to learn face to face as from a mirror (M)")
        imgui.same_line()
        if imgui.button(LOOK_LABEL, imgui.ImVec2(theme.points(64), 0)):
            imgui.open_popup(POPUP)
        theme.tooltip("A second picture, pages or a highway for the score, viewpoints of your own")
        chosen = look_popup(look, self._parts.viewpoints)
        imgui.same_line()
        imgui.set_next_item_width(theme.points(178))
        changed, index = imgui.combo("##view", int(look.view), list(VIEW_NAMES.values()))
        theme.tooltip(
            "Where you look from (F2 to F9); drag in the picture to turn, right drag to shift, wheel to come nearer"
        )
        imgui.end_group()
        self._view_px = imgui.get_item_rect_size().x
        return replace(chosen, view=View(index) if changed else look.view, mirrored=bool(mirrored))

    def _asked(self, question: str) -> None:
        """A button for each answer, and the question."""
        row = Row()
        for guess in Guess:
            row.place(theme.points(96))
            if imgui.button(guess.value, imgui.ImVec2(theme.points(96), theme.points(HEIGHT))):
                self._parts.actions[guess.value]()
            theme.tooltip(question)
        row.place(imgui.calc_text_size(question).x)
        imgui.align_text_to_frame_padding()
        imgui.text_wrapped(question)


def _told(lines: tuple[str, ...], row: Row) -> None:
    """Small lines one under the other; what is too long for the panel ends in dots, its tooltip has it whole."""
    imgui.push_font(None, _SMALL_FONT_SIZE)
    row.place(min(max(imgui.calc_text_size(line).x for line in lines), theme.points(150)))
    imgui.begin_group()
    room = imgui.get_content_region_avail().x
    imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(0, 1))
    for line in lines:
        imgui.text_disabled(elided(line, room, lambda text: imgui.calc_text_size(text).x))
    imgui.pop_style_var()
    imgui.end_group()
    imgui.pop_font()
    theme.tooltip("Found: " + ", ".join(lines))


def elided(text: str, room: float, width_of: Callable[[str], float]) -> str:
    """`text`, or as much of its beginning as leaves room for dots."""
    if width_of(text) <= room:
        return text
    kept = len(text)
    while kept and width_of(text[:kept] + "…") > room:
        kept -= 1
    return text[:kept].rstrip() + "…"
