"""The window: hello_imgui owns it and its loop, the picture is its background, panels dock round the picture.

A view and nothing else: it asks its `PracticeModel` for a snapshot a frame, draws it, and passes on what the user does.
No thread is started, and nothing that happens here can change a judgement.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from imgui_bundle import hello_imgui, imgui, implot

from station.app import theme
from station.app.backdrop import Backdrop
from station.app.choice import Choice
from station.app.help_pages import topic_of
from station.app.keyboard import pressed, slot_pressed, view_pressed
from station.app.look import look_of, with_look
from station.app.model import PracticeModel, Stage
from station.app.panels.bars import heat_panel
from station.app.panels.devices import ABOUT as DEVICES_ABOUT
from station.app.panels.devices import DEVICES, DevicesPanel
from station.app.panels.devices import HELP as DEVICES_HELP
from station.app.panels.figure import ABOUT, FIGURE, HELP, FigurePanel
from station.app.panels.graph import ABOUT as GRAPH_ABOUT
from station.app.panels.graph import HELP as GRAPH_HELP
from station.app.panels.graph import GraphPanel
from station.app.panels.help import help_window
from station.app.panels.hits import ABOUT as ABOUT_HITS
from station.app.panels.hits import HITS, EarActions, HitsPanel
from station.app.panels.lessons import LessonActions, LessonsPanel
from station.app.panels.look_popup import LookActions
from station.app.panels.page import Page, Side, panels_popup
from station.app.panels.player_controls import PlayerControls
from station.app.panels.ruler import Bars, Ruler
from station.app.panels.transport import TransportBar, TransportParts
from station.app.panels.welcome import WelcomePage
from station.app.player_keys import player_keys
from station.app.welcome import Answers, answered
from station.core.clock import Clock, MonotonicClock
from station.core.errors import DeviceError, StationError
from station.core.settings import load_settings, save_settings
from station.core.units import ns_from_s
from station.practice.own_ear import Guess

TITLE = "Drum station"
_DOCK = "MainDockSpace"
_NO_WINDOW = "no window can be opened: is there a screen, and OpenGL? `station practice --headless` needs neither"
LESSONS, TRANSPORT, BARS, GRAPH, NEWS = "Lessons", "Transport", "Bars", "Graph", "##news"
_SPLITS = (
    (Side.BELOW, imgui.Dir.down, 0.28, 0.56),
    (Side.BESIDE, imgui.Dir.left, 0.26, 0.45),
    (Side.RIGHT, imgui.Dir.right, 0.42, 0.5),
    (Side.STRIP, imgui.Dir.down, 0.5, 0.5),
)
"""Where panels dock, in this order: side, way, their share of what is left, and the most of it when they are large."""
_NEWS_LOWEST = 0.3
"""Share of the picture's height above the news, where large panels leave little of it."""
_NEWS_SHOWN_S = 8.0
"""How long a fault or a notice stays on the screen (our choice: twice the time to read it)."""
_NEWS_TOP, _NEWS_BAND = 150.0, 58.0
"""Design pixels from the picture's top: where news stands over the room, and what a result leaves free for it above."""


@dataclass(frozen=True, slots=True)
class WindowOptions:
    """How the window opens: `size` in pixels, `quality` 0–2 or None to measure, whether the layout is remembered.

    `settings` is the file that keeps the look, None for this user's. `tests` registers tests with imgui's test engine
    and makes it run, without a pause between frames; `picture_every` draws the picture in every so manieth frame alone
    and leaves it dark between them, for whoever watches the panels.
    """

    size: tuple[int, int] = (1280, 720)
    quality: int | None = None
    remember_layout: bool = True
    settings: Path | None = None
    tests: Callable[[], None] | None = None
    picture_every: int = 1


class Window:
    """One window over one model; raises `BadInput` for a look in the settings that is none."""

    def __init__(self, model: PracticeModel, options: WindowOptions, clock: Clock | None = None) -> None:
        self._model = model
        self._options = options
        self._clock = clock or MonotonicClock()
        self.choice = Choice(model.lessons(), model.first())
        first = self.choice.wish()
        self._previewed = None if first is None else (first.lesson, first.bars)
        self._panel = LessonsPanel(
            self.choice, LessonActions(self._start, lambda: self._tried(model.listen), model.room)
        )
        settings = load_settings(options.settings)
        self.backdrop = Backdrop(options.quality, look_of(settings))
        self.welcome = None if settings.welcomed else WelcomePage(Answers.of(settings))
        self._kept = self.backdrop.look
        self._worn = self._kept.theme, self._kept.scale
        self._controls = PlayerControls(self._choose_bars)
        self._transport = self._strip()
        self.graph = GraphPanel(self._seek_s)
        self.news, self._news_left_s = "", 0.0
        self._told: tuple[str, ...] = ()
        self._show_help = False
        self._frame_ms = 0.0
        self.frames = 0
        self.picture_every = options.picture_every
        self._fault: DeviceError | None = None
        self._devices = DevicesPanel(model.desk, self._tried, self._tell)
        self.figure = FigurePanel(model, options.settings, self._tried, self._preview_anew)
        self.hits = HitsPanel(
            EarActions(
                lambda bar, whose: self._tried(lambda: model.hear_bar(bar, whose)),
                lambda: self._tried(model.listen),
                lambda: model.room().listening,
            )
        )
        self._pages = self._table_of_pages()
        self.params = self._runner()
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

    # --- how hello_imgui is told ----------------------------------------------------------------------------------

    def _runner(self) -> hello_imgui.RunnerParams:
        params = hello_imgui.RunnerParams()
        params.app_window_params.window_title = TITLE
        params.app_window_params.window_geometry.size = self._options.size
        params.app_window_params.restore_previous_geometry = self._options.remember_layout
        imgui_window = params.imgui_window_params
        imgui_window.default_imgui_window_type = hello_imgui.DefaultImGuiWindowType.provide_full_screen_dock_space
        imgui_window.enable_viewports = False
        imgui_window.show_menu_bar = imgui_window.show_status_bar = False
        params.ini_disable = not self._options.remember_layout
        params.ini_folder_type = hello_imgui.IniFolderType.app_user_config_folder
        params.fps_idling.fps_idle = 20.0
        self._use_opengl_3_3(params)
        callbacks = params.callbacks
        callbacks.load_additional_fonts = theme.load_fonts
        callbacks.setup_imgui_style = theme.apply
        callbacks.custom_background = self._background
        callbacks.pre_new_frame = self._before_frame
        callbacks.show_gui = self._over_all
        callbacks.before_exit = self._leaving
        self._dock(params)
        if self._options.tests is not None:
            params.use_imgui_test_engine = True
            params.fps_idling.fps_idle = 0.0
            callbacks.register_tests = self._options.tests
        return params

    @staticmethod
    def _use_opengl_3_3(params: hello_imgui.RunnerParams) -> None:
        gl = hello_imgui.OpenGlOptions()
        gl.glsl_version, gl.major_version, gl.minor_version = "330", 3, 3
        gl.use_core_profile = gl.use_forward_compat = True
        gl.anti_aliasing_samples = 0  # the picture smooths itself, off screen
        params.renderer_backend_options.open_gl_options = gl

    def _dock(self, params: hello_imgui.RunnerParams) -> None:
        docking = params.docking_params
        docking.layout_condition = hello_imgui.DockingLayoutCondition.application_start
        docking.docking_splits = self._splits()
        docking.dockable_windows = [page.window() for page in self._pages]

    def _splits(self) -> list[hello_imgui.DockingSplit]:
        """Where panels dock; the larger they are, the more of the window they take."""
        scale = self.backdrop.look.scale
        splits = [
            hello_imgui.DockingSplit(_DOCK, str(side), way, min(share * scale, most))
            for side, way, share, most in _SPLITS
        ]
        for split in splits[:2]:
            split.node_flags = imgui.DockNodeFlags_.auto_hide_tab_bar
        return splits

    def _table_of_pages(self) -> tuple[Page, ...]:
        """Every panel; those without `shown` are tools that the user opens."""
        return (
            Page(LESSONS, Side.BESIDE, self._lessons_gui, shown=lambda stage: stage is Stage.IDLE),
            Page(BARS, Side.BESIDE, self._bars_gui, shown=self._has_bars),
            Page(HITS, Side.STRIP, self._hits_gui, ABOUT_HITS),
            Page(FIGURE, Side.RIGHT, self.figure.gui, ABOUT, help=HELP),
            Page(DEVICES, Side.RIGHT, self._devices.gui, DEVICES_ABOUT, help=DEVICES_HELP),
            Page(GRAPH, Side.STRIP, self._graph_gui, GRAPH_ABOUT, help=GRAPH_HELP),
            Page(TRANSPORT, Side.BELOW, self._transport_gui, shown=lambda stage: True),
        )

    def _has_bars(self, stage: Stage) -> bool:
        return stage is Stage.RESULT and self._model.report() is not None

    # --- frame by frame -----------------------------------------------------------------------------------------------

    def _before_frame(self) -> None:
        stage = self._model.room().stage
        docking = self.params.docking_params
        self._wear()
        for page in self._pages:
            if page.shown is not None:
                docking.dockable_window_of_name(page.name).is_visible = self.welcome is None and page.shown(stage)
        runs = self._model.room().listening or self._model.deck.player.rate_percent != 0
        self.params.fps_idling.enable_idling = stage is not Stage.PLAYING and not runs
        self._model.desk.listen(docking.dockable_window_of_name(DEVICES).is_visible)
        io = imgui.get_io()
        nav = imgui.ConfigFlags_.nav_enable_keyboard
        io.config_flags = io.config_flags & ~nav if stage is Stage.PLAYING else io.config_flags | nav

        if stage is not Stage.PLAYING:
            self._keep_look()
            self.figure.keep()

    def _wear(self) -> None:
        """Show the panels in the colours and the size that were chosen; larger ones dock anew."""
        look = self.backdrop.look
        if (look.theme, look.scale) != self._worn:
            if look.scale != self._worn[1]:
                self.params.docking_params.docking_splits = self._splits()
                self.params.docking_params.layout_reset = True
            self._worn = look.theme, look.scale
            theme.choose(*self._worn)
            theme.apply()

    def _leaving(self) -> None:
        self._keep_look()
        self.figure.keep()
        self.backdrop.release()

    def _keep_look(self) -> None:
        """Write the look to the settings when it has changed; never while somebody plays."""
        look = self.backdrop.look
        if look != self._kept:
            self._kept = look
            path = self._options.settings
            self._tried(lambda: save_settings(with_look(load_settings(path), look), path))

    def _background(self) -> None:
        """Draw the picture behind the panels."""
        now_ns = self._clock.now_ns()
        self._preview()
        snapshot, left, low, width, height = self._model.snapshot(now_ns), *self._central_area()
        report = self._model.report() if self._model.room().stage is Stage.RESULT else None
        if report is not None:
            height -= round(theme.points(_NEWS_BAND) * imgui.get_io().display_framebuffer_scale.y)
        if self._model.wants_start():
            self._start()
        if self.frames % self.picture_every:
            self.backdrop.clear()
        else:
            try:
                self.backdrop.draw(snapshot, report, (left, low, width, height))
            except DeviceError as fault:
                self._fault, self.params.app_shall_exit = fault, True
        self.frames += 1

    def _preview(self) -> None:
        """Show the lesson that was chosen in the list."""
        wish = self.choice.wish()
        shown = None if wish is None else (wish.lesson, wish.bars)
        if shown == self._previewed or self._model.room().stage is not Stage.IDLE or not (wish or self.choice.free):
            return
        if wish is not None and self._previewed is not None and wish.lesson == self._previewed[0]:
            self._model.deck.repeat(wish.bars)
            if self._model.deck.player.playing:  # the rest can wait: nothing of it is seen
                return
        self._previewed = shown
        self._tried(lambda: self._model.preview(wish))

    def _preview_anew(self) -> None:
        """Show the chosen lesson as it is to be played now, or when the result is left; raises `StationError`."""
        wish = self.choice.wish()
        if self._model.room().stage is not Stage.IDLE:
            self._previewed = None
        elif wish is not None:
            self._model.preview(wish)

    def _central_area(self) -> tuple[int, int, int, int]:
        """The free middle of the window in pixels from the lower left corner."""
        io = imgui.get_io()
        sx, sy = io.display_framebuffer_scale
        width, height = io.display_size
        dock = self.params.docking_params.dock_space_id_from_name(_DOCK)
        node = imgui.internal.dock_builder_get_central_node(dock) if dock is not None else None
        if node is None:
            return (0, 0, round(width * sx), round(height * sy))
        low = height - node.pos.y - node.size.y
        return (round(node.pos.x * sx), round(low * sy), round(node.size.x * sx), round(node.size.y * sy))

    def _over_all(self) -> None:
        """Keys, mouse and what floats over the picture."""
        io = imgui.get_io()
        self._frame_ms += 0.1 * (io.delta_time * 1000 - self._frame_ms)
        self._news_left_s -= io.delta_time
        if self.welcome is not None:
            self._ask(self.welcome)
            return
        notices = self._model.room().notices
        if notices != self._told:
            self._told = notices
            if notices:
                self._tell(notices[-1])
        self._keys()
        if not io.want_capture_mouse:
            self.backdrop.steer(io)
        if self._show_help:
            self._help()
        elif self._news_left_s > 0:
            self._news_line()

    def _ask(self, page: WelcomePage) -> None:
        """The questions of the first start, until they are answered or put aside."""
        begun = page.gui()
        if begun is None:
            return
        path, answers = self._options.settings, page.answers if begun else None
        self._tried(lambda: save_settings(answered(load_settings(path), answers), path))
        if answers is not None:
            self._tried(lambda: self._model.meet(answers))
            self._tried(self._preview_anew)
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
            player_keys(self._model.deck, self._controls, self._choose_bars)
        self._view_keys()
        if imgui.is_key_pressed(imgui.Key.escape, repeat=False):
            self._leave(room.stage)
        elif imgui.is_key_pressed(imgui.Key.backspace, repeat=False):
            self._model.pause()
        elif imgui.is_key_pressed(imgui.Key.enter, repeat=False) and self._enter_starts(room.stage):
            self._start()

    def _view_keys(self) -> None:
        """The keys that change where the user looks from."""
        io, backdrop = imgui.get_io(), self.backdrop
        slot, view = slot_pressed(), view_pressed()
        if slot is not None and io.key_ctrl and not io.key_shift:
            self._keep_viewpoint(slot)
        elif io.key_ctrl and imgui.is_key_pressed(imgui.Key.equal):
            backdrop.look_from(backdrop.look.scaled(1))
        elif io.key_ctrl and imgui.is_key_pressed(imgui.Key.minus):
            backdrop.look_from(backdrop.look.scaled(-1))
        elif io.key_ctrl or io.key_shift or io.key_alt or io.key_super:
            return
        elif slot is not None:
            self._go_to_viewpoint(slot)
        elif view is not None:
            backdrop.back_to(view)
        elif imgui.is_key_pressed(imgui.Key.m, repeat=False):
            backdrop.look_from(replace(backdrop.look, mirrored=not backdrop.look.mirrored))
        elif imgui.is_key_pressed(imgui.Key.p, repeat=False):
            backdrop.look_from(backdrop.look.next_inset())
        elif imgui.is_key_pressed(imgui.Key.n, repeat=False):
            backdrop.look_from(backdrop.look.next_score())
        elif imgui.is_key_pressed(imgui.Key.e, repeat=False):
            backdrop.look_from(replace(backdrop.look, double=not backdrop.look.double))

    def _keep_viewpoint(self, slot: int) -> None:
        self.backdrop.keep(slot)
        self._tell(f"viewpoint {slot + 1} is kept: {slot + 1} comes back to it")

    def _go_to_viewpoint(self, slot: int) -> None:
        if not self.backdrop.go(slot):
            self._tell(f"no viewpoint {slot + 1} is kept yet: Ctrl+{slot + 1} keeps where you look from")

    @staticmethod
    def _enter_starts(stage: Stage) -> bool:
        """Enter belongs to the control that has the keyboard's focus, if there is one."""
        return stage is Stage.RESULT or (stage is Stage.IDLE and not imgui.is_any_item_focused())

    def _leave(self, stage: Stage) -> None:
        if stage is Stage.PLAYING:
            self._tried(self._model.stop)
        elif stage is Stage.RESULT:
            self._model.dismiss()
        else:
            self._model.deck.halt()

    def _start(self) -> None:
        wish, free = self.choice.wish(), self.choice.free_wish()
        if wish is not None:
            self._tried(lambda: self._model.start(wish))
        elif free is not None:
            self._tried(lambda: self._model.just_play(free))

    def _drill(self, bar: int) -> None:
        """Practise one bar (from 1) of the lesson alone."""
        wish = self.choice.wish()
        if wish is not None:
            self._tried(lambda: self._model.start(replace(wish, bars=(bar, bar), adapt=False)))

    def _tell(self, text: str) -> None:
        self.news, self._news_left_s = text, _NEWS_SHOWN_S

    def _tried(self, action: Callable[[], object]) -> None:
        """Do it, or say in one line why it could not be done."""
        try:
            action()
        except StationError as fault:
            self._tell(str(fault))

    def _choose_bars(self, bars: Bars) -> None:
        """Repeat these bars (first, last, from 0) on the player, and practise them; None for the lesson's own."""
        self.choice.bars = None if bars is None else (bars[0] + 1, bars[1] + 1)

    # --- panels -------------------------------------------------------------------------------------------------------

    def _lessons_gui(self) -> None:
        self._panel.gui()

    def _bars_gui(self) -> None:
        report = self._model.report()
        bar = None if report is None else heat_panel(report.heat)
        if bar is not None:
            self._drill(bar)

    def _strip(self) -> TransportBar:
        deck = self._model.deck
        ruler = Ruler(
            seek=lambda at_ns: deck.do(lambda player, now_ns: player.sought(now_ns, at_ns)),
            choose=self._choose_bars,
            flag=lambda slot: deck.do(lambda player, now_ns: player.at_flag(now_ns, slot)),
        )
        actions: dict[str, Callable[[], None]] = {
            "stop": lambda: self._tried(self._model.stop),
            "again": self._start,
            "pause": self._model.pause,
            "veto": lambda: self._tried(self._model.veto),
            "back": self._model.dismiss,
            **{guess.value: partial(self._model.answer, guess) for guess in Guess},
        }
        viewpoints = LookActions(self._keep_viewpoint, self._go_to_viewpoint)
        return TransportBar(TransportParts(actions, viewpoints, self._tools, ruler, self._controls))

    def _hits_gui(self) -> None:
        report = self._model.report() if self._model.room().stage is Stage.RESULT else None
        self.hits.gui(None if report is None else report.hits)

    def _seek_s(self, to_s: float) -> None:
        self._model.deck.do(lambda player, now_ns: player.sought(now_ns, ns_from_s(to_s)))

    def _graph_gui(self) -> None:
        self.graph.gui(self._model.graphed(), can_seek=self._model.room().stage is Stage.IDLE)

    def _transport_gui(self) -> None:
        look = self._transport.gui(self._model.room(), self._model.deck, self.backdrop.look)
        self.backdrop.look_from(look)
        theme.fit_height(self._transport.height)

    def _tools(self) -> None:
        tools = [page for page in self._pages if page.shown is None]
        panels_popup(tools, self.params.docking_params)

    def _help(self) -> None:
        docking = self.params.docking_params
        tools = [page for page in self._pages if page.shown is None]
        is_open = [page for page in tools if docking.dockable_window_of_name(page.name).is_visible]
        topic = topic_of(self._model.room(), self.choice.free)
        self._show_help = help_window(topic, is_open, self._frame_ms)

    def _news_line(self) -> None:
        """One or two lines at the picture's top; above a result, never over it."""
        io = imgui.get_io()
        left, low, width, height = self._central_area()
        scale_x, scale_y = io.display_framebuffer_scale
        top = io.display_size.y - (low + height) / scale_y
        is_result = self._model.room().stage is Stage.RESULT and self._model.report() is not None
        middle, wide = (left + width / 2) / scale_x, width / scale_x - theme.points(40)
        below = theme.points(4.0) if is_result else min(theme.points(_NEWS_TOP), _NEWS_LOWEST * height / scale_y)
        at = imgui.ImVec2(middle, top + below)
        imgui.set_next_window_pos(at, imgui.Cond_.always, imgui.ImVec2(0.5, 0))
        flags = imgui.WindowFlags_.no_decoration | imgui.WindowFlags_.always_auto_resize | imgui.WindowFlags_.no_inputs
        flags |= imgui.WindowFlags_.no_focus_on_appearing | imgui.WindowFlags_.no_docking
        imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(theme.points(14), theme.points(6)))
        imgui.begin(NEWS, None, flags)
        imgui.push_text_wrap_pos(min(wide, imgui.calc_text_size(self.news).x + theme.points(16)))
        imgui.text(self.news)
        imgui.pop_text_wrap_pos()
        imgui.end()
        imgui.pop_style_var()


def run_window(model: PracticeModel, options: WindowOptions | None = None) -> None:
    """Open the window over `model` and return when it is closed; raises `DeviceError` where there is no screen."""
    Window(model, options or WindowOptions()).run()
