"""The window: hello_imgui owns it and its loop, the picture is its background, panels dock round the picture.

A view and nothing else. Each frame it lets the controller take in what has happened, draws the one state that it gets
back, and hands over what the user does. It starts no thread of its own, and nothing that happens here can change a
judgement.
"""

from collections.abc import Callable
from pathlib import Path

from imgui_bundle import hello_imgui, imgui, implot

from station.app.actions.action import Notify, Show
from station.app.actions.file_actions import Import
from station.app.actions.practice_actions import Begin, Leave, Pause, StrikeKey
from station.app.actions.settings_actions import AskWhoPlays
from station.app.actions.sound_actions import BringTrack
from station.app.controller import Controller
from station.app.help_topics import topic_of
from station.app.room_state import RoomState, Stage
from station.app.settings.first_start import FirstAnswers
from station.app.window_state import State
from station.core.clock import Clock, MonotonicClock
from station.core.errors import DeviceError
from station.drills.songs.song_folder import SOUND_ENDINGS
from station.gui import theme
from station.gui.display import MonitorWatch
from station.gui.draw_flash import draw_flash
from station.gui.draw_toasts import ABOVE_RESULT, draw_toast
from station.gui.file_drop import FileDrop, file_drop
from station.gui.keyboard_kit import pressed
from station.gui.panel_layout import Pages
from station.gui.panel_size import Size, panel_factor, shares
from station.gui.panels.battle.battle_layer import BattleLayer, band_of_board
from station.gui.panels.choice_panel import band_height, choice_keys, draw_choice
from station.gui.panels.editor.editor_keys import editor_keys
from station.gui.panels.help_window import HelpWindow
from station.gui.panels.welcome_page import WelcomePage
from station.gui.player_keys import player_keys
from station.gui.viewport import Viewport
from station.gui.window_frame import Calls, WindowOptions, central_area, logical_size, runner, splits
from station.practice.exchange.parcel import Kind, kind_by_name
from station.practice.lag.first_groove import FIRST_GROOVE
from station.render.snapshot import Snapshot

_NO_WINDOW = "no window can be opened: is there a screen, and OpenGL? `station practice --headless` needs neither"
_FIRST_PICTURE = 1
"""The frame, from 0, that has the first picture: the one before it shows the panels, the one after it all lessons."""


class Window:
    """One window over one controller."""

    def __init__(self, controller: Controller, options: WindowOptions, clock: Clock | None = None) -> None:
        self._controller = controller
        self._options = options
        self._clock = clock or MonotonicClock()
        self._shown = Show(picture=False)
        controller.dispatch(self._shown)
        self.state: State = controller.view()
        """What this frame shows."""
        self.viewport = Viewport(options.quality, self.state.view_settings)
        self.pages = Pages(controller.dispatch, self.viewport)
        self.battle = BattleLayer(controller.dispatch)
        settings = self.state.settings
        self.welcome = None if settings.welcomed else WelcomePage(FirstAnswers.of(settings))
        look, size = self.state.view_settings, (float(options.size[0]), float(options.size[1]))
        self._worn = look.theme, panel_factor(size, look.scale)
        self._docked_for = self._sized_for = size, self._worn[1]
        self._show_help, self._help_window = False, HelpWindow()
        self._frame_ms = 0.0
        self._drawn: Snapshot | None = None
        self.frames = 0
        self.picture_every = options.picture_every
        self._fault: DeviceError | None = None
        self.monitors: MonitorWatch | None = None
        self._drop: FileDrop | None = None
        self._to_open = [options.opens] if options.opens else []
        calls = Calls(self._opened, self._before_frame, self._background, self._over_all, self._swapped, self._leaving)
        windows = [page.window(lambda: self.state) for page in self.pages.table]
        self.params = runner(options, calls, windows, shares(*self._docked_for))
        self.pages.docking = self.params.docking_params
        theme.choose(*self._worn)

    def run(self) -> None:
        """Show the window until it is closed; raises `DeviceError` where no window can be had, or OpenGL ends."""
        implot.create_context()
        try:
            hello_imgui.run(self.params)
        except RuntimeError as fault:
            if self.frames:
                raise
            raise DeviceError(_NO_WINDOW) from fault
        finally:
            implot.destroy_context()
        if self.frames == 0:
            raise DeviceError(_NO_WINDOW)
        if self._fault is not None:
            raise self._fault

    # --- frame by frame -----------------------------------------------------------------------------------------------

    def _opened(self) -> None:
        """The window is there, and nothing drawn yet."""
        screen = self._options.screen()
        self.monitors = None if screen is None else MonitorWatch(screen)
        self._drop = file_drop()

    def _before_frame(self) -> None:
        """Take in what has happened: the state that this frame shows."""
        self._show()
        self._bring_in()
        self._controller.update(self._clock.now_ns())
        self.state = self._controller.view()
        snapshot = self.state.snapshot
        self.viewport.follow(self.state.view_settings, None if snapshot is None else snapshot.view)
        self.viewport.may_rebuild = self.state.room.stage is not Stage.PLAYING
        self._wear()
        self.pages.show(self.state, self.welcome is None)
        self.params.fps_idling.enable_idling = not self.state.is_lively
        io = imgui.get_io()
        nav = imgui.ConfigFlags_.nav_enable_keyboard
        takes_keys = self.state.room.stage is Stage.PLAYING or self.pages.editor.is_writing
        io.config_flags = io.config_flags & ~nav if takes_keys else io.config_flags | nav

    def _bring_in(self) -> None:
        """Import what the window was opened with, what was dropped on it, and what the system's dialog has brought."""
        self.pages.poll()
        self._to_open += [] if self._drop is None else self._drop.paths()
        if self.welcome is not None:  # nobody knows yet whose it is
            return
        dropped, self._to_open = self._to_open, []
        for path in dropped:
            if self._is_track(path):
                self._controller.dispatch(BringTrack(path))
            else:
                self._controller.dispatch(Import(path))
        for path in dropped:
            self._page_of(path)()

    def _is_track(self, path: str) -> bool:
        """A sound becomes the track where it is dropped on the page of sounds, a song's sound anywhere else."""
        return Path(path).suffix.lower() in SOUND_ENDINGS and self.pages.sound.is_seen

    def _page_of(self, path: str) -> Callable[[], None]:
        """What shows the page where a file that was dropped is found again."""
        if self._is_track(path):
            return self.pages.open_track
        if Path(path).suffix.lower() in SOUND_ENDINGS:
            return self.pages.open_song
        match kind_by_name(path):
            case None:
                return self.pages.open_import
            case Kind.RETURN:
                return self.pages.open_teacher
            case Kind.ASSIGNMENT | Kind.NOTE:
                return self.pages.open_assigned

    def _show(self) -> None:
        """Say what the window shows: first the panels alone, for the picture takes half a second to build."""
        shown = Show(picture=self.frames >= _FIRST_PICTURE, catalog=self.frames > _FIRST_PICTURE)
        shown = self.pages.seen(shown)
        if shown != self._shown:
            self._shown = shown
            self._controller.dispatch(shown)

    def _wear(self) -> None:
        """Show the panels in the colours and the size that were chosen, and that the window's own size asks for."""
        view_settings, size = self.state.view_settings, logical_size()
        factor = self._worn[1] if size is None else panel_factor(size, view_settings.scale)
        if (view_settings.theme, factor) != self._worn:
            self._worn = view_settings.theme, factor
            theme.choose(*self._worn)
            theme.apply()
        if size is not None:
            self._dock_for(size, factor)

    def _dock_for(self, size: Size, factor: float) -> None:
        """Dock anew what another size gives another place, once the window is no longer dragged larger or smaller."""
        before, self._sized_for = self._sized_for, (size, factor)
        if before == self._sized_for and shares(size, factor) != shares(*self._docked_for):
            self._docked_for = size, factor
            self.params.docking_params.docking_splits = splits(shares(size, factor))
            self.params.docking_params.layout_reset = True
            theme.docked_anew()

    def _leaving(self) -> None:
        if self._drop is not None:
            self._drop.close()
        self.viewport.release()

    def _background(self) -> None:
        """Draw the picture behind the panels."""
        self._drawn = self.state.snapshot
        try:
            self._draw(self.state)
        except DeviceError as fault:
            self._fault, self.params.app_shall_exit = fault, True
        self.frames += 1

    def _draw(self, state: State) -> None:
        """Draw a result or the room, and in this what was struck while all that moves was drawn, the longest part."""
        left, low, width, height = central_area(self.params.docking_params)
        whole = left, low, width, height
        band = band_height(state.choice, whole) or band_of_board(state.battle, whole)
        low, height = low + band, height - band
        if state.battle.covers_picture or state.snapshot is None or self.frames % self.picture_every:
            self.viewport.clear()
        elif state.report is not None and state.shows_result and not state.room.listening:
            height -= round(theme.points(ABOVE_RESULT) * imgui.get_io().display_framebuffer_scale.y)
            self.viewport.draw_report(state.report, (left, low, width, height))
        else:
            has_page = state.editor is not None or state.exam.shows_notes
            finish = self.viewport.begin(state.snapshot, (left, low, width, height), with_score=not has_page)
            if self._controller.update(self._clock.now_ns()):
                self.state = self._controller.view()
            self._drawn = self.state.snapshot or state.snapshot
            finish(self._drawn)

    def _swapped(self) -> None:
        """The frame is on the screen."""
        if self._options.shown is not None and not self._options.shown(self._drawn):
            self.params.app_shall_exit = True

    def _over_all(self) -> None:
        """Keys, mouse and what floats over the picture."""
        io = imgui.get_io()
        self._frame_ms += 0.1 * (io.delta_time * 1000 - self._frame_ms)
        if self.welcome is not None:
            self._ask(self.welcome)
            return
        moved = "" if self.monitors is None else self.monitors.check(self._clock.now_ns())
        if moved:
            self._controller.dispatch(Notify(moved))
        self._keys()
        free = central_area(self.params.docking_params)
        self.battle.gui(self.state.battle, free, band_height(self.state.choice, free))
        if self.state.choice is not None:
            draw_choice(self.state.choice, central_area(self.params.docking_params), self._controller.dispatch)
        if not io.want_capture_mouse:
            self.viewport.steer(io)
        self.pages.who.gui(self.state.students)
        draw_flash(self.state.flash, central_area(self.params.docking_params))
        if self._show_help:
            self._help()
        else:
            draw_toast(self.state.toast, central_area(self.params.docking_params), self.viewport.free_line())

    def _ask(self, page: WelcomePage) -> None:
        """The questions of the first start, until they are answered or put aside."""
        plays_at_once = self.state.selection.card is not None and self.state.selection.card.name == FIRST_GROOVE
        finished = page.gui(self.state.room, plays_at_once)
        if finished is not None:
            self._controller.dispatch(finished)
            self.welcome = None

    def _keys(self) -> None:
        room, dispatch = self.state.room, self._controller.dispatch
        if imgui.is_key_pressed(imgui.Key.f1, repeat=False):
            self._show_help = not self._show_help
        if imgui.is_key_pressed(imgui.Key.escape, repeat=False) and self._close_what_is_open():
            return
        if self.state.editor is not None:
            self._editor_keys()
            return
        if room.stage is Stage.PLAYING or not imgui.get_io().nav_visible:
            for hit in pressed(self._clock.now_ns()):
                dispatch(StrikeKey(hit))
        if imgui.get_io().want_text_input:
            return
        if self.state.choice is not None and choice_keys(self.state.choice, dispatch):
            return
        if room.stage is Stage.IDLE and not room.free:
            self.pages.controls.key_wind = player_keys(self.state.player, dispatch)
        self.pages.view_keys.handle(self.state.view_settings)
        if imgui.is_key_pressed(imgui.Key.escape, repeat=False):
            dispatch(Leave())
        elif imgui.is_key_pressed(imgui.Key.backspace, repeat=False):
            dispatch(Pause())
        elif imgui.is_key_pressed(imgui.Key.enter, repeat=False) and self._enter_starts(room):
            dispatch(Begin())

    def _close_what_is_open(self) -> bool:
        """Escape closes what lies over the page, a list before the help; whether anything did."""
        if imgui.is_popup_open("", imgui.PopupFlags_.any_popup):
            imgui.internal.close_popup_to_level(0, restore_focus_to_window_under_popup=True)
            return True
        if self.state.students.asks:
            self._controller.dispatch(AskWhoPlays(on=False))
            return True
        is_closed, self._show_help = self._show_help, False
        return is_closed

    def _editor_keys(self) -> None:
        """What keys mean while a lesson is written: neither the kit nor the player has any."""
        if not imgui.get_io().want_text_input:
            editor_keys(self._controller.dispatch, self.pages.editor.is_writing)
            self.pages.view_keys.turn(self.state.view_settings)

    @staticmethod
    def _enter_starts(room: RoomState) -> bool:
        """Enter belongs to the control that has the keyboard's focus, if there is one."""
        return room.stage is Stage.IDLE and (room.exam or not imgui.is_any_item_focused())

    def _help(self) -> None:
        is_open = [page for page in self.pages.tools if self.pages.is_open(page.name)]
        topic = topic_of(self.state.room, self.state.selection.free, self.state.editor is not None)
        self._show_help = self._help_window.gui(topic, is_open, self._frame_ms)


def run_window(controller: Controller, options: WindowOptions | None = None) -> None:
    """Open the window over `controller` and return when it is closed; raises `DeviceError` where there is no screen."""
    Window(controller, options or WindowOptions()).run()
