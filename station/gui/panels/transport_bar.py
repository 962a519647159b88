"""The strip below the picture: the ruler and the player between sessions, progress during one, where one looks from.

The picture has most of the window: the strip takes two lines, and one while somebody plays. What has no room in them,
in a narrow window or with large panels, is behind a button. It says how high it is.
"""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.practice_actions import Dismiss, EndSession, Pause, Veto
from station.app.actions.settings_actions import SetView
from station.app.room_state import RoomState, Stage
from station.app.sessions.demo_picture import PlayerView
from station.app.settings.view_settings import ViewSettings
from station.app.window_state import State
from station.core.named_view import NamedView
from station.core.short_names import short_paths
from station.gui import theme
from station.gui.panels.panel import PANELS_WIDTH
from station.gui.panels.player_controls import PlayerControls, counter
from station.gui.panels.ruler import Ruler
from station.gui.panels.view_popup import LOOK_LABEL, POPUP, ViewActions, view_settings_popup
from station.gui.widgets.flow_row import LINE_HEIGHT, FlowRow
from station.render.camera import VIEW_NAMES

PAUSE_LABEL, GO_ON_LABEL = "Pause##hold", "Go on##hold"
VETO_LABEL = "As it was##veto"
STOP_LABEL = "Stop##stop"
BACK_LABEL = "Back to the lessons##back"

_PAUSE = "The score waits (Backspace; both crashes at once or a foot switch, as the Practice panel says)"
_GO_ON = "A bar of count-in, then on from the bar of your last stroke (Backspace, or two kicks)"
NO_KIT = "no kit: the keys play (F1)"
VIEW_LABEL = "View##views"
_VIEW_POPUP = "##view-popup"
_MIRROR = "mirror"
_LEAST_LEFT = 260.0
"""Design pixels below which panels and views leave their place to the ruler, and are behind a button."""
_MIN_LINE_WIDTH, _LEAST_PROGRESS = 108.0, 60.0
"""Design pixels: narrower words and a shorter bar say nothing (our choice)."""
_BUTTON, _VIEW = 64.0, 178.0
"""Design pixels: buttons of one word, the list of views."""


def found(room: RoomState) -> tuple[str, ...]:
    """The kit and the sound card in words; without a kit, what plays instead."""
    return tuple(part for part in (room.kit or NO_KIT, room.sound) if part)


class TransportBar:
    """The strip; `height` is what it needs in pixels, as of the last frame.

    `viewpoints` goes to and keeps one, `tools` draws the list of panels; all else goes to `dispatch`.
    """

    def __init__(self, dispatch: Callable[[Action], None], viewpoints: ViewActions, tools: Callable[[], None]) -> None:
        self._dispatch, self._viewpoints, self._tools = dispatch, viewpoints, tools
        self._ruler = Ruler(dispatch)
        self.controls = PlayerControls(dispatch)
        self.height = 0.0
        self._second = LINE_HEIGHT  # design pixels of the player's line when it was drawn last

    def gui(self, state: State) -> None:
        """Draw it and do what the user does in it."""
        room, player = state.room, state.player
        spacing, whole = imgui.get_style().item_spacing, imgui.get_content_region_avail().x
        is_short = whole - _views_width() - spacing.x < theme.points(_LEAST_LEFT)
        view_px = theme.points(_BUTTON) if is_short else _views_width()
        top = imgui.get_cursor_pos_y()
        imgui.begin_group()
        imgui.dummy(imgui.ImVec2(0, theme.points(LINE_HEIGHT)))
        imgui.same_line(0, 0)
        self._first_line(room, player, FlowRow(whole - view_px - spacing.x, LINE_HEIGHT))
        imgui.end_group()
        below = imgui.get_cursor_pos_y()
        imgui.set_cursor_pos((imgui.get_window_width() - imgui.get_style().window_padding.x - view_px, top))
        view_settings = self._views_popup(state.view_settings) if is_short else self._views(state.view_settings)
        if view_settings != state.view_settings:
            self._dispatch(SetView(view_settings))
        if self._has_second_line(room):
            imgui.set_cursor_pos_y(below)
            self._second_line(room, player)
            if room.stage is Stage.IDLE:
                self._second = (imgui.get_cursor_pos_y() - below) / theme.points(1.0)
            below = imgui.get_cursor_pos_y()
        elif room.stage is Stage.IDLE:  # what stands above the strip stays where it is
            below += theme.points(self._second)
        self.height = below - spacing.y + imgui.get_style().window_padding.y

    @staticmethod
    def _has_second_line(room: RoomState) -> bool:
        return room.stage is Stage.IDLE and not room.free

    def _second_line(self, room: RoomState, player: PlayerView) -> None:
        """The player's controls."""
        row = FlowRow(height=LINE_HEIGHT)
        self.controls.gui(player, row)
        _lines(found(room), row)

    def _first_line(self, room: RoomState, player: PlayerView, row: FlowRow) -> None:
        """Where one is in the music, or what is to be answered or done."""
        if room.stage is Stage.PLAYING:
            self._session(room, row)
        elif room.stage is Stage.RESULT:
            self._result(room, row)
        elif room.free:
            _lines(found(room), row)
        else:
            self._ruler.gui(player.player, player.now_ns, row.left_px)

    def _result(self, room: RoomState, row: FlowRow) -> None:
        """The way back from a result; what comes next stands large below it."""
        if row.button(BACK_LABEL, 190):
            self._dispatch(Dismiss())
        theme.tooltip("Choose another lesson (Esc; while a question is open Esc puts that aside first)")
        _lines((f"played by {room.student}",) if room.student else found(room), row)

    def _session(self, room: RoomState, row: FlowRow) -> None:
        """How to end the session, its time, how far it is."""
        if row.button(STOP_LABEL, 96):
            self._dispatch(EndSession())
        theme.tooltip("End the session here; what was played is kept (Esc)")
        if room.can_pause or room.paused:
            if row.button(GO_ON_LABEL if room.paused else PAUSE_LABEL, 96):
                self._dispatch(Pause())
            theme.tooltip(_GO_ON if room.paused else _PAUSE)
        if room.can_veto:
            if row.button(VETO_LABEL, 110):
                self._dispatch(Veto())
            theme.tooltip(f"{room.why} Press to play the last pass once more instead")
        if room.clock is not None:
            row.place(theme.points(150))
            counter(room.clock.time_s, room.clock.bar, room.clock.beat)
        if row.fits(theme.points(_LEAST_PROGRESS) + imgui.calc_text_size(room.judged).x):
            row.place(0)
            imgui.text_disabled(room.judged)
            theme.tooltip(f"You are judged as {room.judged}: what is nearer to its time is on time")
        if row.fits(theme.points(_LEAST_PROGRESS)):
            row.place(0)
            imgui.progress_bar(room.progress or 0.0, imgui.ImVec2(row.left_px, theme.points(LINE_HEIGHT)), "")
            theme.tooltip("How much of the session is over")

    def _views_popup(self, view_settings: ViewSettings) -> ViewSettings:
        """A button for what has no room beside a ruler."""
        if imgui.button(VIEW_LABEL, imgui.ImVec2(theme.points(_BUTTON), theme.points(LINE_HEIGHT))):
            imgui.open_popup(_VIEW_POPUP)
        theme.tooltip("Panels, and how the picture is seen")
        if imgui.begin_popup(_VIEW_POPUP):
            view_settings = self._views(view_settings)
            imgui.end_popup()
        return view_settings

    def _views(self, view_settings: ViewSettings) -> ViewSettings:
        imgui.begin_group()
        self._tools()
        _, mirrored = imgui.checkbox(_MIRROR, view_settings.mirrored)
        theme.tooltip("Left and right swapped, to learn face to face as from a mirror (M)")
        imgui.same_line()
        if imgui.button(LOOK_LABEL, imgui.ImVec2(theme.points(_BUTTON), 0)):
            imgui.open_popup(POPUP)
        theme.tooltip("A second picture, pages or a highway for the score, viewpoints of your own")
        chosen = view_settings_popup(view_settings, self._viewpoints)
        imgui.same_line()
        imgui.set_next_item_width(theme.points(_VIEW))
        changed, index = imgui.combo("##view", int(view_settings.view), list(VIEW_NAMES.values()))
        theme.tooltip(
            "Where you look from (F2 to F9); drag in the picture to turn, right drag to shift, wheel to come nearer"
        )
        imgui.end_group()
        return replace(chosen, view=NamedView(index) if changed else view_settings.view, mirrored=bool(mirrored))


def _views_width() -> float:
    """What panels, mirror, look and view take side by side, in pixels."""
    style = imgui.get_style()
    mirror = imgui.get_frame_height() + style.item_inner_spacing.x + imgui.calc_text_size(_MIRROR).x
    return float(theme.points(PANELS_WIDTH + _BUTTON + _VIEW) + mirror + 3 * style.item_spacing.x)


def _lines(lines: tuple[str, ...], row: FlowRow) -> None:
    """Lines one under the other where the row has room; what is too long ends in dots, its tooltip has it whole."""
    width = min(max(imgui.calc_text_size(line).x for line in lines), theme.points(_MIN_LINE_WIDTH))
    if not row.fits(width):
        return
    row.place(width)
    room = row.left_px
    imgui.begin_group()
    imgui.push_style_var(imgui.StyleVar_.item_spacing, imgui.ImVec2(0, 1))
    for line in lines:
        imgui.text_disabled(elided(short_paths(line), room, lambda text: imgui.calc_text_size(text).x))
    imgui.pop_style_var()
    imgui.end_group()
    theme.tooltip("Found: " + ", ".join(lines))


def elided(text: str, room: float, width_of: Callable[[str], float]) -> str:
    """`text`, or as much of its beginning as leaves room for dots."""
    if width_of(text) <= room:
        return text
    kept = len(text)
    while kept and width_of(text[:kept] + "…") > room:
        kept -= 1
    return text[:kept].rstrip() + "…"
