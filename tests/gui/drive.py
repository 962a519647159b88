"""What a scenario drives: a window on a screen of the test's own, with the station behind it.

imgui's test engine moves the mouse and presses the keys; nothing here reaches past the window but to look. The
scenarios lie beside this file by their topics; `scenarios.py` has the table of them and plays them.
"""

import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from imgui_bundle import hello_imgui, imgui
from numpy.typing import NDArray

from station.app.actions.practice_actions import Dismiss, EndSession
from station.app.controller import Controller
from station.app.room_state import RoomState, Stage
from station.app.settings.settings_store import SettingsStore
from station.app.window_state import State
from station.core.clock import Clock
from station.core.settings import Settings, save_settings
from station.core.units import ns_from_ms
from station.drills.library import find_lesson
from station.gui.display import Rectangle
from station.gui.glfw_screen import glfw_screen
from station.gui.panels.choice_panel import CHOICE, label_of
from station.gui.panels.lessons.lesson_list import LIST
from station.gui.panels.lessons_panel import EDIT_LABEL, OPTIONS, TURN_LABEL
from station.gui.panels.panel import PANELS_LABEL
from station.gui.panels.transport_bar import VIEW_LABEL
from station.gui.window import Window
from station.gui.window_frame import WindowOptions
from station.practice.lag.first_groove import FIRST_GROOVE, FIRST_TIME
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.snapshot import Snapshot
from station.simulation.student_spec import StudentSpec, parse_spec
from tests.gui.legible import present_faults
from tests.gui.room import DirectEngine, station
from tests.gui.screen_shot import screen_shot

STEP_NS = ns_from_ms(100)
SIZE = (760, 480)
LESSON = "rock-2"
MOST_FRAMES = 1000
MOST_CLICKS = 5
PICTURE_EVERY = 25
"""Without a graphics card the picture takes nine tenths of a frame; a test of the panels sees it now and then."""
IDLE_FRAMES_PER_S = 20.0
"""Of a window that waits: what it waits for has the processor."""
NEWCOMER = "newcomer"
"""Not a student's spec: nobody has answered the questions of the first start yet."""
OPTIONAL = imgui.test_engine.TestOpFlags_.no_error
TIMEOUT_S = 600.0  # the parent's own limit is what ends a run that hangs

Scenario = Callable[["Drive", imgui.test_engine.TestContext], None]


class TwoMonitors:
    """The screen that there is, and to the right of it a second monitor while one is plugged in."""

    NAME, AREA = 2, Rectangle(3000, 0, 1920, 1080)

    def __init__(self) -> None:
        screen = glfw_screen()
        assert screen is not None, "an X server can be asked for windows and monitors"
        self.first, self.is_plugged = screen, False

    def monitors(self) -> Sequence[int]:
        return [*self.first.monitors(), *([self.NAME] if self.is_plugged else [])]

    def area(self, monitor: int) -> Rectangle:
        return self.AREA if monitor == self.NAME else self.first.area(monitor)

    def window(self) -> Rectangle:
        return self.first.window()

    def move(self, place: Rectangle) -> None:
        self.first.move(place)


class Drive:
    """What a scenario works with: the test context, the window, what is behind it, and `seen` for the parent."""

    def __init__(
        self, sessions: Path, student: str | None, picture_every: int = PICTURE_EVERY, size: tuple[int, int] = SIZE
    ) -> None:
        is_new = student is not None and student.startswith(NEWCOMER)
        said = (student or "").removeprefix(NEWCOMER).removeprefix(",")
        spec = parse_spec(said) if said else None
        self.picture_every = picture_every
        settings = Settings(sessions=str(sessions), welcomed=not is_new)
        self.settings = save_settings(settings, sessions / "settings.toml")
        store = SettingsStore(self.settings)
        first = (FIRST_GROOVE, FIRST_TIME) if is_new else ("rock-1", PlanOptions())
        self.station, self.engine, self.clock = self.made(*first, store, spec)
        options = WindowOptions(size, quality=0, remember_layout=False, tests=self._register)
        options = replace(
            options, picture_every=picture_every, shown=self._frame_is_shown, screen=self._monitors_are_asked_for
        )
        self.window = Window(self.station, options, self.clock)
        self.window.params.callbacks.before_imgui_render = self._panels_are_drawn_now_and_then
        self.monitors: TwoMonitors | None = None
        """There once the window is open."""
        self.all_seen: list[dict[str, object]] = []
        self._wants_shot = self._wants_faults = False
        self._pixels = np.empty((0, 0, 3), np.uint8)
        self.faults: list[str] = []
        """What cannot be read of the panels as they were looked at last."""
        self._scenarios: Sequence[Scenario] = ()

    def made(
        self, lesson: str, options: PlanOptions, store: SettingsStore, student: StudentSpec | None
    ) -> tuple[Controller, DirectEngine, Clock]:
        """The station that opens on `lesson`, its engine and its clock: here a played one."""
        return station(lesson, options, store, student, STEP_NS)

    @property
    def seen(self) -> dict[str, object]:
        """What the scenario that runs has seen."""
        return self.all_seen[-1]

    @property
    def state(self) -> State:
        """What the window shows, or will in the next frame."""
        return self.station.view()

    @property
    def room(self) -> RoomState:
        """What goes on."""
        return self.state.room

    @property
    def picture(self) -> Snapshot:
        """What is seen behind the panels."""
        assert self.state.snapshot is not None
        return self.state.snapshot

    def run(self, scenarios: Sequence[Scenario]) -> None:
        """Open the window and play them in turn, each from the lessons page with no popup open."""
        self._scenarios = scenarios
        self.window.run()

    def shot(self, ctx: imgui.test_engine.TestContext) -> NDArray[np.uint8]:
        """What the window shows on the screen, picture and panels: (height, width, 3)."""
        every, self.window.picture_every = self.window.picture_every, 1
        ctx.yield_(3)
        self._wants_shot = True
        ctx.yield_(2)
        assert not self._wants_shot
        self.window.picture_every = every
        return self._pixels

    def unread(self, ctx: imgui.test_engine.TestContext) -> list[str]:
        """What cannot be read of the panels as they stand now (`legible`).

        Two frames are looked at: what grows, as where something has just been read, can be scrolled to a frame later.
        """
        first, second = self._faults(ctx), self._faults(ctx)
        return [line for line in first if line in second]

    def _faults(self, ctx: imgui.test_engine.TestContext) -> list[str]:
        self._wants_faults = True
        ctx.yield_(2)
        assert not self._wants_faults
        return self.faults

    def _monitors_are_asked_for(self) -> TwoMonitors:
        self.monitors = TwoMonitors()
        return self.monitors

    def _panels_are_drawn_now_and_then(self) -> None:
        """With the picture: a viewport of no pixels is laid out, and draws nothing."""
        if self.window.frames % self.window.picture_every:
            imgui.get_main_viewport().framebuffer_scale = imgui.ImVec2(1e-6, 1e-6)

    def _frame_is_shown(self, snapshot: Snapshot | None) -> bool:
        """Whether the window shall stay."""
        del snapshot
        if self._wants_shot:
            assert self.monitors is not None
            self._pixels = screen_shot(self.monitors.window())
        if self._wants_shot or self._wants_faults:
            self.faults = present_faults()
        self._wants_shot = self._wants_faults = False
        return True

    def _register(self) -> None:
        engine = hello_imgui.get_imgui_test_engine()
        test = imgui.test_engine.register_test(engine, "window", "scenario")
        test.test_func = self._test
        io = imgui.test_engine.get_io(engine)
        io.config_run_speed = imgui.test_engine.TestRunSpeed.fast
        io.config_log_to_tty = True
        io.config_watchdog_warning = io.config_watchdog_kill_test = io.config_watchdog_kill_app = TIMEOUT_S
        imgui.test_engine.queue_test(engine, test)

    def _test(self, ctx: imgui.test_engine.TestContext) -> None:
        for scenario in self._scenarios:
            self.all_seen.append({})
            try:
                ctx.popup_close_all()
                self.station.dispatch(EndSession())
                self.station.dispatch(Dismiss())
                ctx.yield_(2)
                self._wait_for_lessons(ctx)
                scenario(self, ctx)
            except Exception:
                self.seen["traceback"] = traceback.format_exc()
                break
            self.seen["commands"] = [type(command).__name__ for command in self.engine.sent]
        hello_imgui.get_runner_params().app_shall_exit = True

    def wait_for(self, ctx: imgui.test_engine.TestContext, stage: Stage) -> int:
        """Let frames pass until the room is at `stage`; returns how many went by."""
        for frame in range(MOST_FRAMES):
            if self.room.stage is stage:
                return frame
            ctx.yield_()
        raise AssertionError(f"{stage!r} did not come in {MOST_FRAMES} frames")

    def _wait_for_lessons(self, ctx: imgui.test_engine.TestContext) -> None:
        """Let frames pass until the list is read, which may take seconds where nothing is cached."""
        self.wait_until(ctx, lambda state: len(state.selection.lessons) > 1)

    def wait_until(self, ctx: imgui.test_engine.TestContext, holds: Callable[[State], bool]) -> None:
        """Let frames pass until what other processes do is done, as few a second as of a user's window that idles."""
        idling, deadline = self.window.params.fps_idling, time.monotonic() + TIMEOUT_S
        idling.fps_idle, idling.time_active_after_last_event = IDLE_FRAMES_PER_S, 0.0
        try:
            while not holds(self.state):
                assert time.monotonic() < deadline, "nothing has come of it"
                ctx.yield_()
        finally:
            idling.fps_idle = 0.0

    def imported(self, ctx: imgui.test_engine.TestContext, title: str) -> list[object]:
        """Wait for an import: what is chosen, what is on the player, and how long the longest frame took meanwhile."""
        longest, before = 0.0, time.monotonic()
        deadline = before + TIMEOUT_S
        while self.state.player.lesson.title != title:
            ctx.yield_()
            now = time.monotonic()
            assert now < deadline, f"{title} is not imported: {self.state.imports}"
            longest, before = max(longest, now - before), now
        assert self.state.selection.card is not None
        return [self.state.selection.card.title, self.state.selection.card.kind, longest]

    def answer(self, ctx: imgui.test_engine.TestContext) -> None:
        """Answer "on" with the mouse where the question before a result is open."""
        ctx.yield_(2)
        if self.room.question:
            ctx.item_click(f"//{CHOICE}/{label_of(1)}")
        ctx.yield_(2)

    def choose(self, ctx: imgui.test_engine.TestContext, passes: int) -> None:
        """Take `LESSON` from the list and set its passes."""
        lesson = find_lesson(LESSON)
        to_list(ctx)
        ctx.item_input_value("##search", lesson.title.split(":")[0])
        ctx.item_click(f"**/###{LESSON}")
        to_options(ctx)
        ctx.item_input_value("##passes", passes)
        ctx.set_ref("//Lessons")
        self.engine.plan = plan_practice(lesson, PlanOptions(lesson.tempo_bpm, passes))


def to_options(ctx: imgui.test_engine.TestContext) -> None:
    """Refer to the options of the chosen lesson from now on, which a low panel shows in place of the list."""
    ctx.set_ref("//Lessons")
    if ctx.item_exists(TURN_LABEL) and ctx.window_info(f"//Lessons/{OPTIONS}", OPTIONAL).window is None:
        ctx.item_click(TURN_LABEL)
        ctx.yield_(2)
    shown = ctx.window_info(f"//Lessons/{OPTIONS}").window
    assert shown is not None, "the options are shown"
    ctx.set_ref(shown)


def to_edit(ctx: imgui.test_engine.TestContext) -> None:
    """Refer to where the editor is opened, which is among the options of a low panel."""
    ctx.set_ref("//Lessons")
    if not ctx.item_exists(EDIT_LABEL):
        to_options(ctx)


def to_list(ctx: imgui.test_engine.TestContext) -> None:
    """Show the list again, which a low panel may have turned over."""
    ctx.set_ref("//Lessons")
    if ctx.window_info(f"//Lessons/{LIST}", OPTIONAL).window is None:
        ctx.item_click(TURN_LABEL)
        ctx.yield_(2)


def open_popup(ctx: imgui.test_engine.TestContext, label: str) -> None:
    """Click until a popup is open: what is still being read may move the item away from under the mouse."""
    for _ in range(MOST_CLICKS):
        ctx.item_click(label)
        ctx.yield_(2)
        if imgui.is_popup_open("", imgui.PopupFlags_.any_popup):
            return
    raise AssertionError(f"{label} opens nothing")


def press_view(ctx: imgui.test_engine.TestContext, label: str) -> None:
    """Press a button of the strip's right end, which large panels have behind another."""
    ctx.set_ref("//Transport")
    if ctx.item_exists(VIEW_LABEL):
        open_popup(ctx, VIEW_LABEL)
        ctx.item_click(f"//$FOCUSED/{label}")
    else:
        ctx.item_click(f"**/{label}")
    ctx.yield_(2)


def open_panel(ctx: imgui.test_engine.TestContext, name: str) -> None:
    """Tick a tool in the list of panels."""
    press_view(ctx, PANELS_LABEL)
    ctx.item_click(f"//$FOCUSED/{name}")
    ctx.popup_close_all()
    ctx.yield_(2)
