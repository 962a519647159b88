"""The window: hello_imgui owns it and its loop, the picture is its background, panels dock round the picture.

A view and nothing else: it asks its `PracticeModel` for a snapshot a frame, draws it, and passes on what the user does.
It starts no thread of its own, and nothing that happens here can change a judgement.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from imgui_bundle import hello_imgui, imgui, implot

from station.app import theme
from station.app.backdrop import Backdrop
from station.app.choice import Choice
from station.app.frame import Calls, WindowOptions, central_area, runner, splits
from station.app.glfw_screen import glfw_screen
from station.app.help_pages import topic_of
from station.app.keyboard import pressed
from station.app.look import look_of, with_look
from station.app.model import PracticeModel, Stage
from station.app.monitors import MonitorWatch
from station.app.news import ABOVE_RESULT, News
from station.app.panels.bars import bars_panel
from station.app.panels.calibration import CalibrationPart
from station.app.panels.devices import ABOUT as DEVICES_ABOUT
from station.app.panels.devices import DEVICES, DevicesPanel
from station.app.panels.devices import HELP as DEVICES_HELP
from station.app.panels.ear_row import EarActions, EarRow
from station.app.panels.figure import ABOUT, FIGURE, HELP, FigurePanel
from station.app.panels.graph import ABOUT as GRAPH_ABOUT
from station.app.panels.graph import HELP as GRAPH_HELP
from station.app.panels.graph import GraphPanel
from station.app.panels.help import help_window
from station.app.panels.hits import ABOUT as ABOUT_HITS
from station.app.panels.hits import HITS, HitsPanel
from station.app.panels.lessons import LessonActions, LessonsPanel
from station.app.panels.look_popup import LookActions
from station.app.panels.page import Page, Side, panels_popup
from station.app.panels.player_controls import PlayerControls
from station.app.panels.practice import ABOUT as ABOUT_PRACTICE
from station.app.panels.practice import HELP as PRACTICE_HELP
from station.app.panels.practice import PRACTICE, PracticePanel
from station.app.panels.ruler import Bars, Ruler
from station.app.panels.take_along import ABOUT as ABOUT_TAKING
from station.app.panels.take_along import HELP as TAKE_HELP
from station.app.panels.take_along import TAKE_ALONG, TakeActions, TakeAlongPanel
from station.app.panels.transport import TransportBar, TransportParts
from station.app.panels.welcome import WelcomePage
from station.app.player_keys import player_keys
from station.app.view_keys import ViewKeys
from station.app.welcome import Answers, answered
from station.core.clock import Clock, MonotonicClock
from station.core.errors import DeviceError, StationError
from station.core.settings import load_settings, save_settings
from station.core.units import ns_from_s
from station.drills.lesson import Lesson
from station.practice.own_ear import Guess

_NO_WINDOW = "no window can be opened: is there a screen, and OpenGL? `station practice --headless` needs neither"
_FIRST_PICTURE = 2
"""The frame, from 0, that has the first picture: the first shows the panels, the second all lessons."""
LESSONS, TRANSPORT, BARS, GRAPH = "Lessons", "Transport", "Bars", "Graph"


class Window:
    """One window over one model; raises `BadInput` for a look in the settings that is none."""

    def __init__(self, model: PracticeModel, options: WindowOptions, clock: Clock | None = None) -> None:
        self._model = model
        self._options = options
        self._clock = clock or MonotonicClock()
        self.choice = Choice([model.first_card()], model.first())
        first = self.choice.wish()
        self._previewed = None if first is None else (first.lesson, first.bars)
        self._panel = LessonsPanel(
            self.choice, LessonActions(self._start, lambda: self._tried(model.listen), model.room)
        )
        settings = load_settings(options.settings)
        self.backdrop = Backdrop(options.quality, look_of(settings))
        self.welcome = None if settings.welcomed else WelcomePage(Answers.of(settings))
        self.news = News()
        self._view_keys = ViewKeys(self.backdrop, self.news.tell)
        self._kept = self.backdrop.look
        self._worn = self._kept.theme, self._kept.scale
        self._controls = PlayerControls(self._choose_bars)
        self._transport = self._strip()
        self.graph = GraphPanel(self._seek_s)
        self._show_help = False
        self._frame_ms = 0.0
        self.frames = 0
        self.picture_every = options.picture_every
        self._fault: DeviceError | None = None
        self.monitors: MonitorWatch | None = None
        calibration = CalibrationPart(model.calibration, model.measure, self._tried, self._measured)
        self._devices = DevicesPanel(model.desk, self._tried, self.news.tell, calibration)
        self.take = TakeAlongPanel(
            TakeActions(
                self._to_take,
                lambda: load_settings(options.settings),
                lambda: self.backdrop.look,
                self._tried,
                self.news.tell,
            )
        )
        self._practice = PracticePanel(model.habits, options.settings, self._tried)
        self.figure = FigurePanel(model, options.settings, self._tried, self._preview_anew)
        self._ear = EarRow(
            EarActions(
                lambda bar, whose: self._tried(lambda: model.hear_bar(bar, whose)),
                lambda: self._tried(model.listen),
                lambda: model.room().listening,
            )
        )
        self.hits = HitsPanel(self._ear)
        self._pages = self._table_of_pages()
        calls = Calls(self._opened, self._before_frame, self._background, self._over_all, self._leaving)
        self.params = runner(options, calls, self._pages, self.backdrop.look.scale)
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

    def _table_of_pages(self) -> tuple[Page, ...]:
        """Every panel; those without `shown` are tools that the user opens."""
        return (
            Page(LESSONS, Side.BESIDE, self._lessons_gui, shown=lambda stage: stage is Stage.IDLE),
            Page(BARS, Side.BESIDE, self._bars_gui, shown=lambda stage: self._shows_result()),
            Page(HITS, Side.STRIP, self._hits_gui, ABOUT_HITS),
            Page(FIGURE, Side.RIGHT, self.figure.gui, ABOUT, help=HELP),
            Page(PRACTICE, Side.RIGHT, self._practice.gui, ABOUT_PRACTICE, help=PRACTICE_HELP),
            Page(DEVICES, Side.RIGHT, self._devices_gui, DEVICES_ABOUT, help=DEVICES_HELP),
            Page(TAKE_ALONG, Side.RIGHT, self.take.gui, ABOUT_TAKING, help=TAKE_HELP),
            Page(GRAPH, Side.STRIP, self._graph_gui, GRAPH_ABOUT, help=GRAPH_HELP),
            Page(TRANSPORT, Side.BELOW, self._transport_gui, shown=lambda stage: True),
        )

    # --- frame by frame -----------------------------------------------------------------------------------------------

    def _opened(self) -> None:
        """The window is there, and nothing drawn yet."""
        screen = glfw_screen()
        self.monitors = None if screen is None else MonitorWatch(screen)

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
        if not docking.dockable_window_of_name(PRACTICE).is_visible:
            self._model.habits.learn(on=False)  # nobody sees that it listens
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
        self.take.files.cancel()
        self.backdrop.release()

    def _keep(self) -> None:
        """Write to the settings what was chosen in the window."""
        self._keep_look()
        self.figure.keep()
        self._practice.keep()

    def _keep_look(self) -> None:
        """Write the look to the settings when it has changed; never while somebody plays."""
        look = self.backdrop.look
        if look != self._kept:
            self._kept = look
            path = self._options.settings
            self._tried(lambda: save_settings(with_look(load_settings(path), look), path))

    def _background(self) -> None:
        """Draw the picture behind the panels, which are there before it: it takes a second to build."""
        if self.frames < _FIRST_PICTURE:
            self.backdrop.clear()
            if self.frames:
                self.choice.offer(self._model.lessons())
            self.frames += 1
            return
        now_ns = self._clock.now_ns()
        self._preview()
        snapshot, left, low, width, height = self._model.snapshot(now_ns), *central_area(self.params.docking_params)
        report = self._model.report() if self._shows_result() and not self._model.room().listening else None
        if report is not None:
            height -= round(theme.points(ABOVE_RESULT) * imgui.get_io().display_framebuffer_scale.y)
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

    def _shows_result(self) -> bool:
        return self._model.room().stage is Stage.RESULT and self._model.report() is not None

    def _over_all(self) -> None:
        """Keys, mouse and what floats over the picture."""
        io = imgui.get_io()
        self._frame_ms += 0.1 * (io.delta_time * 1000 - self._frame_ms)
        if self.welcome is not None:
            self._ask(self.welcome)
            return
        self.take.advance()
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
            self.news.gui(central_area(self.params.docking_params), self._shows_result())

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
        self._view_keys.take()
        if imgui.is_key_pressed(imgui.Key.escape, repeat=False):
            self._leave(room.stage)
        elif imgui.is_key_pressed(imgui.Key.backspace, repeat=False):
            self._model.pause()
        elif imgui.is_key_pressed(imgui.Key.enter, repeat=False) and self._enter_starts(room.stage):
            self._start()

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

    def _tried(self, action: Callable[[], object]) -> None:
        """Do it, or say in one line why it could not be done."""
        try:
            action()
        except StationError as fault:
            self.news.tell(str(fault))

    def _choose_bars(self, bars: Bars) -> None:
        """Repeat these bars (first, last, from 0) on the player, and practise them; None for the lesson's own."""
        self.choice.bars = None if bars is None else (bars[0] + 1, bars[1] + 1)

    # --- panels -------------------------------------------------------------------------------------------------------

    def _lessons_gui(self) -> None:
        self._panel.gui()

    def _bars_gui(self) -> None:
        report = self._model.report()
        bar = None if report is None else bars_panel(report, self._ear)
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
        viewpoints = LookActions(self._view_keys.keep, self._view_keys.go)
        return TransportBar(TransportParts(actions, viewpoints, self._tools, ruler, self._controls))

    def _devices_gui(self) -> None:
        self._devices.gui(self._model.room().stage is not Stage.PLAYING)

    def _measured(self, told: str) -> None:
        """Something that was measured is stored: judge by it."""
        self._model.trust_measured()
        self.news.tell(told)

    def _hits_gui(self) -> None:
        report = self._model.report() if self._shows_result() else None
        self.hits.gui(report)

    def _to_take(self) -> tuple[Lesson, tuple[int, int]]:
        """The chosen lesson, and the bars of it that are practised, from 0."""
        lesson, bars = self._model.deck.lesson, self.choice.bars
        return lesson, lesson.loop if bars is None else (bars[0] - 1, bars[1] - 1)

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


def run_window(model: PracticeModel, options: WindowOptions | None = None) -> None:
    """Open the window over `model` and return when it is closed; raises `DeviceError` where there is no screen."""
    Window(model, options or WindowOptions()).run()
