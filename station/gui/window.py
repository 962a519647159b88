"""The window: hello_imgui owns it and its loop, the picture is its background, panels dock round the picture.

A view and nothing else: it asks its `PracticeModel` for a snapshot a frame, draws it, and passes on what the user does.
It starts no thread of its own, and nothing that happens here can change a judgement.
"""

from imgui_bundle import hello_imgui, imgui, implot

from station.app.deeds import Deeds
from station.app.first_start import FirstAnswers, answered
from station.app.help_topics import topic_of
from station.app.model import Stage
from station.app.practice_model import PracticeModel
from station.app.selection import Selection
from station.app.view_settings import view_settings_of, with_view_settings
from station.core.clock import Clock, MonotonicClock
from station.core.errors import DeviceError
from station.core.settings import load_settings, save_settings
from station.gui import theme
from station.gui.display import MonitorWatch
from station.gui.draw_toasts import ABOVE_RESULT, Toasts
from station.gui.keyboard_kit import pressed
from station.gui.layout import Calls, WindowOptions, central_area, runner, splits
from station.gui.panel_table import Pages
from station.gui.panels.help_window import help_window
from station.gui.panels.welcome_page import WelcomePage
from station.gui.player_keys import player_keys
from station.gui.viewport import Viewport
from station.render.snapshot import Snapshot

_NO_WINDOW = "no window can be opened: is there a screen, and OpenGL? `station practice --headless` needs neither"
_FIRST_PICTURE = 1
"""The frame, from 0, that has the first picture: the one before it shows the panels, the one after it all lessons."""


class Window:
    """One window over one model; raises `BadInput` for a look in the settings that is none."""

    def __init__(self, model: PracticeModel, options: WindowOptions, clock: Clock | None = None) -> None:
        self._model = model
        self._options = options
        self._clock = clock or MonotonicClock()
        settings = load_settings(options.settings)
        self.news = Toasts()
        self.choice = Selection([model.shelf.first_card()], model.first())
        self._deeds = Deeds(model, self.choice, self.news.tell)
        self.backdrop = Viewport(options.quality, view_settings_of(settings), self._news)
        self.pages = Pages(self._deeds, self.backdrop, options.settings)
        self.welcome = None if settings.welcomed else WelcomePage(FirstAnswers.of(settings))
        self._kept = self.backdrop.look
        self._worn = self._kept.theme, self._kept.scale
        self._show_help = False
        self._frame_ms = 0.0
        self._drawn: Snapshot | None = None
        self.frames = 0
        self.picture_every = options.picture_every
        self._fault: DeviceError | None = None
        self.monitors: MonitorWatch | None = None
        calls = Calls(self._opened, self._before_frame, self._background, self._over_all, self._swapped, self._leaving)
        self.params = runner(options, calls, self.pages.table, self.backdrop.look.scale)
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

    def _before_frame(self) -> None:
        stage = self._model.room().stage
        self._wear()
        self.pages.show(None if self.welcome is not None else stage)
        self.params.fps_idling.enable_idling = not self._model.is_lively(self._clock.now_ns())
        io = imgui.get_io()
        nav = imgui.ConfigFlags_.nav_enable_keyboard
        io.config_flags = io.config_flags & ~nav if stage is Stage.PLAYING else io.config_flags | nav
        if stage is not Stage.PLAYING:
            self._keep()

    def _wear(self) -> None:
        """Show the panels in the colours and the size that were chosen; larger ones dock anew."""
        look = self.backdrop.look
        if (look.theme, look.scale) != self._worn:
            if look.scale != self._worn[1]:
                self.params.docking_params.docking_splits = splits(look.scale)
                self.params.docking_params.layout_reset = True
            self._worn = look.theme, look.scale
            theme.choose(*self._worn)
            theme.apply()

    def _leaving(self) -> None:
        self._keep()
        self.pages.take.files.cancel()
        self.backdrop.release()

    def _keep(self) -> None:
        """Write to the settings what was chosen in the window."""
        self._keep_look()
        self.pages.keep()

    def _keep_look(self) -> None:
        """Write the look to the settings when it has changed; never while somebody plays."""
        look = self.backdrop.look
        if look != self._kept:
            self._kept = look
            path = self._options.settings
            self._deeds.tried(lambda: save_settings(with_view_settings(load_settings(path), look), path))

    def _background(self) -> None:
        """Draw the picture behind the panels, which are there before it: it takes half a second to build."""
        if self.frames < _FIRST_PICTURE:
            self.backdrop.clear()
            self.frames += 1
            return
        if self.frames > _FIRST_PICTURE:
            self._offer()
        now_ns = self._clock.now_ns()
        self._deeds.preview()
        self._drawn = snapshot = self._model.snapshot(now_ns)
        left, low, width, height = central_area(self.params.docking_params)
        report = self._model.report() if self._deeds.shows_result and not self._model.room().listening else None
        if report is not None:
            height -= round(theme.points(ABOVE_RESULT) * imgui.get_io().display_framebuffer_scale.y)
        if self._model.wants_start():
            self._deeds.start()
        if self.frames % self.picture_every:
            self.backdrop.clear()
        else:
            try:
                self.backdrop.draw(snapshot, report, (left, low, width, height))
            except DeviceError as fault:
                self._fault, self.params.app_shall_exit = fault, True
        self.frames += 1

    def _news(self) -> Snapshot | None:
        """What was struck while the frame was drawn."""
        news = self._model.news(self._clock.now_ns())
        self._drawn = news or self._drawn
        return news

    def _swapped(self) -> None:
        """The frame is on the screen."""
        if self._options.shown is not None and not self._options.shown(self._drawn):
            self.params.app_shall_exit = True

    def _offer(self) -> None:
        """What can be chosen, and how far the student is: read from files once, after the first picture."""
        if self.frames == _FIRST_PICTURE + 1:
            course = load_settings(self._options.settings).course
            self.choice.offer(self._model.shelf.cards(), self._model.shelf.courses(), course)
        self.choice.progress = self._model.shelf.progress()

    def _over_all(self) -> None:
        """Keys, mouse and what floats over the picture."""
        io = imgui.get_io()
        self._frame_ms += 0.1 * (io.delta_time * 1000 - self._frame_ms)
        if self.welcome is not None:
            self._ask(self.welcome)
            return
        self.pages.take.advance()
        self.news.follow(self._model.room().notices, io.delta_time)
        moved = "" if self.monitors is None else self.monitors.check(self._clock.now_ns())
        if moved:
            self.news.tell(moved)
        self._keys()
        if not io.want_capture_mouse:
            self.backdrop.steer(io)
        if self._show_help:
            self._help()
        else:
            self.news.gui(central_area(self.params.docking_params), self._deeds.shows_result)

    def _ask(self, page: WelcomePage) -> None:
        """The questions of the first start, until they are answered or put aside."""
        begun = page.gui()
        if begun is None:
            return
        path, answers = self._options.settings, page.answers if begun else None
        self._deeds.tried(lambda: save_settings(answered(load_settings(path), answers), path))
        if answers is not None:
            self._deeds.tried(lambda: self._model.meet(answers))
            self._deeds.tried(self._deeds.preview_anew)
        self.welcome = None

    def _keys(self) -> None:
        room = self._model.room()
        if imgui.is_key_pressed(imgui.Key.f1, repeat=False):
            self._show_help = not self._show_help
        if room.stage is Stage.PLAYING or not imgui.get_io().nav_visible:
            for hit in pressed(self._clock.now_ns()):
                self._model.key(hit)
        if imgui.get_io().want_text_input:
            return
        if room.stage is Stage.IDLE and not room.free:
            player_keys(self._model.deck, self.pages.controls, self._deeds.choose_bars)
        self.pages.view_keys.take()
        if imgui.is_key_pressed(imgui.Key.escape, repeat=False):
            self._deeds.leave()
        elif imgui.is_key_pressed(imgui.Key.backspace, repeat=False):
            self._model.pause()
        elif imgui.is_key_pressed(imgui.Key.enter, repeat=False) and self._enter_starts(room.stage):
            self._deeds.start()

    @staticmethod
    def _enter_starts(stage: Stage) -> bool:
        """Enter belongs to the control that has the keyboard's focus, if there is one."""
        return stage is Stage.RESULT or (stage is Stage.IDLE and not imgui.is_any_item_focused())

    def _help(self) -> None:
        is_open = [page for page in self.pages.tools if self.pages.is_open(page.name)]
        topic = topic_of(self._model.room(), self.choice.free)
        self._show_help = help_window(topic, is_open, self._frame_ms)


def run_window(model: PracticeModel, options: WindowOptions | None = None) -> None:
    """Open the window over `model` and return when it is closed; raises `DeviceError` where there is no screen."""
    Window(model, options or WindowOptions()).run()
