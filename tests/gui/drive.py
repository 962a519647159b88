"""Runs scenarios in one window and writes what was seen to a JSON file: `drive.py SCENARIO[+SCENARIO…] SESSIONS OUT`.

A window takes seconds to open: scenarios that leave nothing behind share one.

With a fourth argument `FILE.png` the window's last frame is kept there.

A process of its own, because imgui and OpenGL keep state for as long as a process lives. imgui's test engine moves the
mouse and presses the keys; nothing here reaches past the window but to look.
"""

import json
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import moderngl
import numpy as np
from imgui_bundle import hello_imgui, imgui
from numpy.typing import NDArray

from station.app.actions.practice_actions import Dismiss, EndSession
from station.app.actions.settings_actions import SetView
from station.app.help_topics import topic_of
from station.app.room_state import RoomState, Stage
from station.app.settings.settings_store import SettingsStore
from station.app.settings.view_settings import view_settings_of
from station.app.window_state import State
from station.core.measured_latency import load_calibration
from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.core.settings import Settings, load_settings, save_settings
from station.core.units import ns_from_ms
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.stick_file import own_stick
from station.drills.library import find_lesson
from station.engine.messages import Play, SetLevel, WatchRawBytes, WatchSensors
from station.gui.display import GONE, Rectangle, home_for
from station.gui.glfw_screen import glfw_screen
from station.gui.keyboard_kit import VIEW_KEYS
from station.gui.panels.devices.calibration_part import ANYWAY_LABEL, MEASURE_LABEL
from station.gui.panels.devices.devices_panel import DEVICES
from station.gui.panels.devices.pads_part import LEARN_LABEL as LEARN_PAD_LABEL
from station.gui.panels.devices.pads_part import UNDO_LABEL
from station.gui.panels.devices.sticks_panel import (
    FOLLOW_LABEL,
    GESTURE_LABEL,
    LOOK_LABEL,
    PORTS_LABEL,
    SOUND_LABEL,
    STICKS,
)
from station.gui.panels.devices.velocity_part import LEARN_LABEL as TOUCH_LABEL
from station.gui.panels.export_panel import EXPORT, PLAYED_LABEL, SHEET_LABEL, music_label
from station.gui.panels.import_panel import IMPORT, IMPORT_LABEL, PASTE_LABEL, SOURCE_LABEL
from station.gui.panels.lessons_panel import ADAPT_LABEL, FILM_LABEL, FREE_LABEL, LEVEL_LABEL, LISTEN_LABEL
from station.gui.panels.lessons_panel import IMPORT_LABEL as OPEN_IMPORT_LABEL
from station.gui.panels.lessons_panel import LESSON_LABEL as TAKE_LESSON_LABEL
from station.gui.panels.panel import PANELS_LABEL
from station.gui.panels.phase_panel import MODEL_LABEL, MOTION_LABEL, OPEN_LABEL, PHASE, PLAY_LABEL, STOP_LABEL
from station.gui.panels.playback_row import STOP_LABEL as HITS_STOP
from station.gui.panels.playback_row import STUDENT_LABEL, TEACHER_LABEL
from station.gui.panels.player_controls import COUNT_IN_LABEL, MORE_LABEL
from station.gui.panels.practice_panel import LEARN_LABEL, PRACTICE
from station.gui.panels.transport_bar import VIEW_LABEL
from station.gui.window import Window
from station.gui.window_frame import WindowOptions
from station.music.formats.format_table import read_part
from station.music.formats.smf.midi_part import MIDI
from station.practice.session.plan import PlanOptions, plan_practice
from station.practice.session.self_estimate import SelfEstimate
from station.render.camera import VIEW_NAMES
from station.render.files.png_file import write_png
from station.render.notation.screen.score_view import ScoreForm
from station.render.snapshot import Snapshot
from station.simulation.student_spec import parse_spec
from tests.fakes.stick_physics import FINE_HZ, Sensor, Stroke, measured, strokes_by_angle
from tests.fakes.walker_files import write_walker
from tests.gui.dropped_files import drop_files
from tests.gui.editor_scenarios import EDITOR_SCENARIOS
from tests.gui.exam_scenario import exam
from tests.gui.figure import figure
from tests.gui.key_chord import chord
from tests.gui.legible import present_faults
from tests.gui.planned_day import planned_day
from tests.gui.room import KIT, station
from tests.gui.screen_shot import screen_shot
from tests.gui.song_scenario import song
from tests.gui.teacher_scenario import there_and_back

STEP_NS = ns_from_ms(100)
SIZE = (760, 480)
SIZES = {
    "planned_day": (1280, 900),
    "exam": (1280, 720),
    "player": (1280, 560),
    "phase": (1280, 720),
    "song": (1280, 800),
    "there_and_back": (1280, 900),
    "legible": (1280, 720),
    "by_mouse": (1280, 720),
    "by_kit": (1280, 720),
    "finds_draft": (1280, 720),
}
LESSON = "rock-2"
MOST_FRAMES = 1000
PICTURE_EVERY = 25
"""Without a graphics card the picture takes nine tenths of a frame; a test of the panels sees it now and then."""
NEWCOMER = "newcomer"
"""Not a student's spec: nobody has answered the questions of the first start yet."""
STUDENTS = {
    "newcomer": NEWCOMER,
    "drill": "beginner,seed=3",
    "practise": "pro,seed=4",
    "exam": "seed=1,sd_ms=4",
    "exam_in_a_small_window": "seed=1,sd_ms=4",
    "there_and_back": "intermediate,seed=2",
    "highway": "intermediate,seed=2,velocity_sd=30",
}
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
        spec = None if student in (None, NEWCOMER) else parse_spec(str(student))
        self.picture_every = picture_every
        settings = Settings(sessions=str(sessions), welcomed=student != NEWCOMER)
        self.settings = save_settings(settings, sessions / "settings.toml")
        store = SettingsStore(self.settings)
        self.station, self.engine, self.clock = station("rock-1", PlanOptions(), store, spec, STEP_NS)
        options = WindowOptions(size, quality=0, remember_layout=False, tests=self._register)
        options = replace(
            options, picture_every=picture_every, shown=self._frame_is_shown, screen=self._monitors_are_asked_for
        )
        self.window = Window(self.station, options, self.clock)
        self.monitors: TwoMonitors | None = None
        """There once the window is open."""
        self.all_seen: list[dict[str, object]] = []
        self._wants_shot = self._wants_faults = False
        self._pixels = np.empty((0, 0, 3), np.uint8)
        self.faults: list[str] = []
        """What cannot be read of the panels as they were looked at last."""
        self._scenarios: Sequence[Scenario] = ()

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

    def run(self, scenarios: "Sequence[Scenario]") -> None:
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
        deadline = time.monotonic() + TIMEOUT_S
        while len(self.state.selection.lessons) == 1:
            assert time.monotonic() < deadline, "the lessons are not read"
            ctx.yield_()

    def wait_until(self, ctx: imgui.test_engine.TestContext, holds: Callable[[State], bool]) -> None:
        """Let frames pass until what other processes do is done."""
        deadline = time.monotonic() + TIMEOUT_S
        while not holds(self.state):
            assert time.monotonic() < deadline, "nothing has come of it"
            ctx.yield_()

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

    def choose(self, ctx: imgui.test_engine.TestContext, passes: int) -> None:
        """Take `LESSON` from the list and set its passes."""
        lesson = find_lesson(LESSON)
        ctx.set_ref("//Lessons")
        ctx.item_input_value("##search", lesson.title.split(":")[0])
        ctx.item_click(f"**/###{LESSON}")
        ctx.item_input_value("##passes", passes)
        self.engine.plan = plan_practice(lesson, PlanOptions(lesson.tempo_bpm, passes))


def practise(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A whole session, from the list to the results and back."""
    drive.choose(ctx, passes=1)
    drive.seen["suggested"] = str(drive.state.selection.level)
    ctx.combo_click(f"{LEVEL_LABEL}/judged as advanced")
    ctx.yield_(2)
    ctx.item_click("Start##start")
    drive.seen["started"] = drive.room.stage.name
    drive.seen["frames"] = drive.wait_for(ctx, Stage.RESULT)
    drive.seen["asked"] = drive.room.question
    drive.seen["told before"] = drive.state.report is not None
    ctx.yield_(3)
    ctx.set_ref("//Transport")
    ctx.item_click("on")
    ctx.yield_(2)
    report = drive.state.report
    assert report is not None
    drive.seen["points"] = report.facts.words.points
    drive.seen["notes"] = len(report.facts.label)
    drive.seen["level"], drive.seen["told"] = report.document["level"], report.facts.words.subtitle
    drive.seen["title"] = report.facts.words.title
    ctx.item_click("Back to the lessons##back")
    ctx.yield_(2)
    drive.seen["after"] = drive.room.stage.name


def keys(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Strokes on the computer's keyboard, and Escape."""
    drive.choose(ctx, passes=2)
    ctx.item_click("Start##start")
    ctx.yield_(5)
    for key in (imgui.Key.f, imgui.Key.space, imgui.Key.d, imgui.Key.a):
        ctx.key_press(key)
        ctx.yield_(2)
    drive.seen["pieces"] = [hit.piece.name for hit in drive.engine.keys]
    drive.seen["rising"] = sorted({hit.at_ns for hit in drive.engine.keys}) == [hit.at_ns for hit in drive.engine.keys]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(3)
    drive.seen["after"] = drive.room.stage.name


def just_play(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A free take on the keys, and the take heard again."""
    ctx.set_ref("//Lessons")
    ctx.item_click(f"**/{FREE_LABEL}")
    ctx.item_click("Start##start")
    ctx.yield_(8)
    for key in (imgui.Key.f, imgui.Key.space, imgui.Key.d):
        ctx.key_press(key)
        ctx.yield_(3)
    drive.seen["stage"] = drive.room.stage.name
    strip = drive.picture.strip
    assert strip is not None
    drive.seen["pieces"] = [hit.piece.name for hit in strip.played]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(3)
    drive.seen["after"] = drive.room.stage.name
    ctx.item_click(LISTEN_LABEL)
    ctx.yield_(2)
    drive.seen["listening"] = drive.room.listening
    for _ in range(MOST_FRAMES):
        if drive.picture.strikes or not drive.room.listening:
            break
        ctx.yield_()
    drive.seen["lit"] = [strike.piece.name for strike in drive.picture.strikes]
    for _ in range(MOST_FRAMES):
        if not drive.room.listening:
            break
        ctx.yield_()
    drive.seen["ended"] = not drive.room.listening
    films = drive.station.export
    ctx.item_click(FILM_LABEL)
    drive.seen["filming"] = films.process is not None
    if films.process is not None:
        films.process.wait(TIMEOUT_S)
    ctx.yield_(3)
    capture = drive.room.take
    drive.seen["filmed"] = capture is not None and capture.with_suffix(".mp4").read_text() == str(capture)
    open_panel(ctx, EXPORT)
    ctx.item_click(f"//{EXPORT}/{PLAYED_LABEL}")
    drive.wait_until(ctx, lambda state: not state.export.is_writing)
    written = drive.state.export.written
    assert written is not None
    drive.seen["midi"] = [note.piece.name for note in read_part(written.path).score]
    open_panel(ctx, EXPORT)
    ctx.set_ref("//Lessons")
    ctx.item_click(f"**/{TAKE_LESSON_LABEL}")
    drive.seen["lesson"] = drive.imported(ctx, "Just play")


def search(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Letters typed into the search field play nothing, and narrow the list."""
    ctx.set_ref("//Lessons")
    ctx.item_click("##search")
    ctx.key_chars("paradiddle")
    ctx.yield_(2)
    drive.seen["keys"] = len(drive.engine.keys)
    drive.seen["shown"] = [card.title for card in drive.state.selection.visible()]
    for course in ("###course-funk", "###course-"):
        ctx.item_click("##course")
        ctx.item_click(f"//$FOCUSED/{course}")
        ctx.yield_(2)
        kept = load_settings(drive.settings).course
        drive.seen[kept or "none"] = [card.name for card in drive.state.selection.visible()]
        drive.seen[f"chosen in {kept or 'none'}"] = drive.state.selection.card and drive.state.selection.card.name


def look(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Every viewpoint can be chosen, two from the list and the others by their keys, and the mouse turns it."""
    ctx.set_ref("//Transport")
    keys = {view: key for key, view in VIEW_KEYS.items()}
    for view in NamedView:
        if view in (NamedView.TOP, NamedView.FEET):
            ctx.combo_click(f"##view/{VIEW_NAMES[view]}")
        else:
            ctx.key_press(keys[view])
        ctx.yield_(2)
        drive.seen[view.name] = drive.window.viewport.view_settings.view.name
    mirrored = drive.window.viewport.camera.mirrored
    ctx.item_click("mirror")
    ctx.yield_(2)
    drive.seen["mirrored"] = drive.window.viewport.camera.mirrored is not mirrored
    before = drive.window.viewport.camera.azimuth_rad
    turn(ctx)
    drive.seen["turned"] = drive.window.viewport.camera.azimuth_rad - before
    pixels, start = drive.shot(ctx), ctx.item_info("//Lessons/Start##start").rect_full
    drive.seen["button"] = pixels[round(start.get_center().y), round(start.min.x) + 12].tolist()
    drive.seen["picture"] = float(pixels[100:200, 400:].std())
    drive.seen["cannot be read"] = drive.faults


def turn(ctx: imgui.test_engine.TestContext) -> None:
    """Drag in the picture."""
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    ctx.mouse_drag_with_delta(imgui.ImVec2(60, 0))


def viewpoints(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Views, mirror, second picture and own viewpoints by keys and in the popup; all is kept in the settings."""
    viewport = drive.window.viewport
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    for key, name in ((imgui.Key.f2, "FRONT"), (imgui.Key.f8, "LEFT_HAND"), (imgui.Key.f9, "RIGHT_HAND")):
        ctx.key_press(key)
        ctx.yield_(2)
        drive.seen[name] = viewport.view_settings.view.name
    ctx.key_press(imgui.Key.m)
    ctx.key_press(imgui.Key.p)
    turn(ctx)
    turned = viewport.camera
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_ctrl))
    ctx.yield_(2)
    drive.seen["told"] = drive.state.toast
    ctx.key_press(imgui.Key.f5)
    ctx.yield_(2)
    drive.seen["left"] = viewport.camera != turned
    ctx.set_ref("//Transport")
    ctx.item_click("Look##look")
    ctx.yield_(2)
    ctx.item_click("//$FOCUSED/3##go3")
    ctx.yield_(2)
    drive.seen["back"] = viewport.camera == turned
    ctx.item_click("//$FOCUSED/8##keep8")
    ctx.item_click("//$FOCUSED/Feet##Second picture")
    double = [viewport.view_settings.double.name]
    ctx.item_click("//$FOCUSED/Over##Your double")
    ctx.yield_(2)
    double += [viewport.view_settings.double.name, view_settings_of(load_settings(drive.settings)).double.name]
    drive.seen["slots"] = [
        slot for slot, camera in enumerate(viewport.view_settings.viewpoints, 1) if camera is not None
    ]
    kept = view_settings_of(load_settings(drive.settings))
    drive.seen["kept"] = [kept.view.name, kept.mirrored, kept.inset is NamedView.FEET]
    there = kept.viewpoints[2]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    ctx.key_press(imgui.Key.e)
    ctx.yield_(2)
    drive.seen["double"] = [*double, viewport.view_settings.double.name]
    drive.seen["kept_there"] = there is not None and abs(there.azimuth_rad - turned.azimuth_rad) < 1e-5


def score(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The score's three forms by key and in the popup."""
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    forms = []
    for _ in range(3):
        ctx.key_press(imgui.Key.n)
        ctx.yield_(2)
        forms.append(drive.window.viewport.view_settings.score.name)
    drive.seen["by_key"] = forms
    ctx.set_ref("//Transport")
    ctx.item_click("Look##look")
    ctx.yield_(2)
    ctx.item_click("//$FOCUSED/Pages##Score")
    ctx.yield_(2)
    drive.seen["chosen"] = drive.window.viewport.view_settings.score.name
    drive.seen["kept"] = load_settings(drive.settings).score


def devices(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The devices page: live lines, a threshold and a rule set by looking, kept and taken by the engine."""
    open_panel(ctx, DEVICES)
    desk = drive.station.mapping
    for text in ("99 26 50", "99 24 64", "99 26 0a", "99 2e 40"):
        drive.engine.play_bytes(text)
        ctx.yield_(2)
    drive.seen["pads"] = [piece.name for piece in desk.pads]
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_input_value("**/##threshold-snare", 30)
    ctx.yield_(2)
    drive.engine.play_bytes("99 26 0a")
    ctx.yield_(3)
    drive.seen["raw"] = desk.seen.lines[-1].raw
    drive.seen["held back"] = [stroke.why is not None for stroke in desk.seen.strokes[Piece.SNARE]]
    ctx.item_click("Save##save-kit")
    ctx.yield_(2)
    kept = own_kit(KIT)
    drive.seen["kept"] = None if kept is None else kept.pad(Piece.SNARE).threshold
    drive.seen["taken"] = [type(command).__name__ for command in drive.engine.sent]
    drive.seen["told"] = drive.state.toast
    pads_are_learnt(drive, ctx)
    open_panel(ctx, DEVICES)  # and close it again
    ctx.yield_(2)
    drive.seen["still listens"] = [command.on for command in drive.engine.sent if isinstance(command, WatchRawBytes)]


def pads_are_learnt(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """An unknown note gets a name, a pad is learnt with one hit and undone, Esc gives up, ten strokes make a curve."""
    desk = drive.station.mapping
    drive.engine.play_bytes("99 0e 40")
    ctx.yield_(2)
    drive.seen["unknown"] = desk.unknown
    ctx.item_click("What is it?##10-14")
    ctx.item_click("//$FOCUSED/##pads/rim##tom_1\\/rim")
    ctx.yield_(2)
    drive.seen["named"] = desk.learnt
    ctx.item_click(LEARN_PAD_LABEL)
    ctx.item_click("//$FOCUSED/##pads/bell##ride\\/bell")
    ctx.yield_(2)
    drive.seen["asks"] = desk.asks
    drive.engine.play_bytes("99 24 60")
    ctx.yield_(6)
    drive.seen["learnt"] = [desk.learnt, drive.room.stage.name]
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click(UNDO_LABEL)
    ctx.yield_(2)
    drive.seen["undone"] = desk.kit.strike(10, 0x24).piece.name
    ctx.item_click("**/snare##pad-snare")
    ctx.yield_(2)
    ctx.item_click(TOUCH_LABEL)
    ctx.yield_(2)
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    drive.seen["given up"] = desk.learns
    ctx.item_click(TOUCH_LABEL)
    for velocity in (0x10, 0x12, 0x11, 0x13, 0x14, 0x50, 0x52, 0x51, 0x53, 0x54):
        drive.engine.play_bytes(f"99 26 {velocity:02x}")
        ctx.yield_(2)
    ctx.yield_(3)
    kept = own_kit(KIT)
    drive.seen["touch"] = None if kept is None else [kept.pad(Piece.SNARE).curve.table[v] for v in (0x12, 0x52)]


def sticks(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The sticks page: a sensor is seen, its hand chosen and kept, the gesture begun and given up, the air switched."""
    device = "x-IMU3 1"
    open_panel(ctx, STICKS)
    drive.engine.plug_stick(device)
    angle, _, _ = strokes_by_angle([Stroke(0.5)] * 2, rest_s=1.0)
    drive.engine.move_stick(device, measured(angle, Sensor(200)))
    ctx.yield_(3)
    (stick,) = drive.state.sticks.sticks
    drive.seen["facts"], drive.seen["drawn"] = stick.facts, stick.turn is not None
    ctx.set_ref(f"//{STICKS}")
    ctx.item_click(f"left##{device}")
    ctx.yield_(2)
    drive.seen["hand"] = own_stick(device).limb.name
    drive.seen["shown"] = drive.state.sticks.sticks[0].limb.name
    ctx.yield_(25)  # it falls silent, and says so
    drive.seen["silent"] = drive.state.sticks.sticks[0].troubles
    ctx.item_click(GESTURE_LABEL)
    ctx.yield_(3)
    drive.seen["asks"] = drive.state.sticks.lesson and drive.state.sticks.lesson.asks
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    drive.seen["given up"] = drive.state.sticks.lesson is None
    ctx.item_click(f"**/{FOLLOW_LABEL}")
    ctx.yield_(2)
    drive.seen["follows"] = load_settings(drive.settings).follow_phase
    ctx.item_click(f"**/{SOUND_LABEL}")
    ctx.yield_(2)
    drive.seen["sounds"] = load_settings(drive.settings).sound_phase
    ctx.item_input_value(f"**/{PORTS_LABEL}", "serial:/dev/ttyUSB0@fast")
    ctx.item_click(f"**/{LOOK_LABEL}")
    ctx.yield_(2)
    drive.seen["refused"] = drive.state.toast
    open_panel(ctx, STICKS)  # and close it again
    ctx.yield_(2)
    drive.seen["watched"] = [command.on for command in drive.engine.sent if isinstance(command, WatchSensors)]


def habits(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The practice panel: a tick, a gesture taken away, another learnt from the kit; the settings keep them."""
    open_panel(ctx, PRACTICE)
    ctx.set_ref(f"//{PRACTICE}")
    ctx.item_uncheck("two kicks start")
    ctx.item_click("×##no-cc=64")
    ctx.item_click(LEARN_LABEL)
    drive.engine.play_bytes("99 31 50 99 33 50")
    ctx.yield_(4)
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.kicks_start, kept.pause]
    drive.engine.play_bytes("99 24 50")
    ctx.yield_(5)
    drive.engine.play_bytes("99 24 50")
    ctx.yield_(2)
    drive.seen["stage"] = drive.room.stage.name
    ctx.item_click(LEARN_LABEL)
    ctx.yield_(2)
    drive.seen["learns"] = drive.state.learns_pause
    open_panel(ctx, PRACTICE)  # and close it again
    ctx.yield_(2)
    drive.seen["learns unseen"] = drive.state.learns_pause
    open_panel(ctx, EXPORT)
    ctx.set_ref(f"//{EXPORT}")
    ctx.item_click(music_label(MIDI))
    drive.wait_until(ctx, lambda state: state.export.written is not None)
    drive.seen["taken"] = drive.state.toast
    ctx.item_click(SHEET_LABEL)
    drive.wait_until(ctx, lambda state: not state.export.is_writing)
    drive.seen["printed"] = drive.state.toast
    open_panel(ctx, EXPORT)


def imports(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Music comes in by a typed path, by what is dropped, as GLFW hands it over, and by what was copied."""
    folder = Path.cwd()
    tab = "Title: {}\nTempo: 90\nHH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\n"
    for name in ("typed", "dropped", "copied"):
        (folder / f"{name}.tab").write_text(tab.format(name.title()))
    ctx.set_ref("//Lessons")
    ctx.item_click(OPEN_IMPORT_LABEL)
    ctx.yield_(3)
    ctx.set_ref(f"//{IMPORT}")
    ctx.item_input_value(SOURCE_LABEL, str(folder / "typed.tab"))
    ctx.item_click(IMPORT_LABEL)
    drive.seen["typed"] = drive.imported(ctx, "Typed")
    drop_files([folder / "dropped.tab", folder / "none.mid"])
    drive.seen["dropped"] = drive.imported(ctx, "Dropped")
    drive.wait_until(ctx, lambda state: bool(state.imports.fault))
    drive.seen["fault"] = drive.state.imports.fault
    imgui.set_clipboard_text((folder / "copied.tab").as_uri())
    ctx.item_click(f"//{IMPORT}/{PASTE_LABEL}")
    drive.seen["copied"] = drive.imported(ctx, "Copied")
    open_panel(ctx, IMPORT)  # and close it again


def calibration(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Latency is measured on the devices page; what is found is kept only when it is asked for, doubts are said."""
    open_panel(ctx, DEVICES)
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click("Strike##by")
    ctx.item_click(MEASURE_LABEL)
    drive.seen["rests"] = [drive.state.calibration.runs, drive.room.kit]
    for _ in range(MOST_FRAMES):
        if not drive.state.calibration.runs:
            break
        ctx.yield_()
    ctx.yield_(6)
    drive.seen["found"] = [drive.state.calibration.runs, drive.room.kit, drive.state.calibration.trusted]
    drive.seen["kept unasked"] = bool(load_calibration().kits)
    ctx.item_click(ANYWAY_LABEL)
    ctx.yield_(3)
    kept = load_calibration().kits[KIT].kit
    drive.seen["kept"] = [kept.latency_ms, kept.by, kept.doubts]
    drive.seen["told"] = drive.state.toast
    open_panel(ctx, DEVICES)  # and close it again


def press_view(ctx: imgui.test_engine.TestContext, label: str) -> None:
    """Press a button of the strip's right end, which large panels have behind another."""
    ctx.set_ref("//Transport")
    if ctx.item_exists(VIEW_LABEL):
        ctx.item_click(VIEW_LABEL)
        ctx.yield_(2)
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


def newcomer(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The questions of the first start, answered by the keyboard alone; then a session is one Enter away."""
    drive.seen["asked"] = drive.window.welcome is not None
    ctx.yield_(2)
    ctx.key_chars(" Ann  Lee ")
    for key in (imgui.Key.enter, imgui.Key.space, imgui.Key.down_arrow, imgui.Key.down_arrow, imgui.Key.right_arrow):
        ctx.key_press(key)
        ctx.yield_(2)
    ctx.key_press(imgui.Key.space)
    ctx.yield_(2)
    answers = drive.window.welcome.answers if drive.window.welcome is not None else None
    drive.seen["answers"] = str(answers)
    ctx.key_press(imgui.Key.down_arrow)
    ctx.key_press(imgui.Key.enter)
    ctx.yield_(3)
    drive.seen["gone"] = drive.window.welcome is None
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.student, kept.own_sound, kept.hands, kept.welcomed]
    drive.seen["levels"] = [[c.bus.name, c.level] for c in drive.engine.sent if isinstance(c, SetLevel)]
    drive.seen["keys"] = len(drive.engine.keys)
    drive.seen["left-handed"] = drive.picture.kit.left_handed
    drive.seen["helped"] = helped(drive, ctx)
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    ctx.yield_(2)
    drive.seen["stage"] = drive.room.stage.name
    drive.seen["helped playing"] = helped(drive, ctx)


def helped(drive: Drive, ctx: imgui.test_engine.TestContext) -> str:
    """Which page F1 explains; it is closed again."""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(3)
    shown = ctx.window_info("//Help").window
    topic = topic_of(drive.room, drive.state.selection.free).value if shown is not None else ""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(2)
    return topic


def worn(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The panels' colours in the popup and their size by keys; both are kept."""
    ctx.set_ref("//Transport")
    ctx.item_click("Look##look")
    ctx.yield_(2)
    ctx.item_click("//$FOCUSED/Day##Colours")
    ctx.yield_(2)
    paper = imgui.get_style().color_(imgui.Col_.window_bg)
    drive.seen["light"] = min(paper.x, paper.y, paper.z) > 0.8
    ctx.popup_close_all()
    ctx.key_press(chord(imgui.Key.equal, imgui.Key.mod_ctrl))
    ctx.key_press(chord(imgui.Key.equal, imgui.Key.mod_ctrl))
    ctx.yield_(3)
    behind_buttons(drive, ctx)
    ctx.key_press(chord(imgui.Key.minus, imgui.Key.mod_ctrl))
    ctx.yield_(3)
    drive.seen["letters"] = imgui.get_style().font_scale_main
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.theme, kept.panel_scale]
    drive.seen["panels"] = round(_width_of(ctx, "//Lessons") / imgui.get_io().display_size.x, 2)


def behind_buttons(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Panels so large that the strip has no room for all: views and the player's rest are reached by two buttons."""
    strip = ctx.window_info("//Transport").window
    assert strip is not None
    drive.seen["strip"] = strip.size.y / imgui.get_style().font_scale_main
    ctx.set_ref("//Transport")
    ctx.item_click(VIEW_LABEL)
    ctx.yield_(2)
    ctx.item_click("//$FOCUSED/mirror")
    ctx.yield_(2)
    drive.seen["mirrored"] = drive.window.viewport.view_settings.mirrored
    ctx.popup_close_all()
    ctx.item_click(MORE_LABEL)
    ctx.yield_(2)
    ctx.item_input_value("//$FOCUSED/##speed", 70)
    ctx.yield_(2)
    drive.seen["speed"] = drive.state.player.player.speed_percent
    ctx.popup_close_all()


def _width_of(ctx: imgui.test_engine.TestContext, panel: str) -> float:
    window = ctx.window_info(panel).window
    assert window is not None, panel
    return float(window.size.x)


def highway(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The highway while a virtual student plays: the last frame is looked at."""
    drive.choose(ctx, passes=4)
    ctx.key_press(imgui.Key.escape)
    drive.station.dispatch(SetView(replace(drive.state.view_settings, score=ScoreForm.HIGHWAY)))
    ctx.item_click("Start##start")
    for _ in range(MOST_FRAMES):
        ctx.yield_()
        if drive.picture.hud.judged > 15:
            break
    drive.seen["stage"] = drive.room.stage.name


def drill(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A bar of the result's heat map is clicked, and practised alone."""
    drive.choose(ctx, passes=1)
    ctx.item_uncheck(ADAPT_LABEL)
    ctx.item_click("Start##start")
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(2)
    for guess in SelfEstimate:
        if drive.room.question:
            ctx.item_click(f"//Transport/{guess.value}")
            ctx.yield_(2)
    report = drive.state.report
    assert report is not None
    drive.seen["cells"] = {f"{bar} {limb.name}": cell.notes for (bar, limb), cell in report.heat.cells.items()}
    ctx.yield_(3)
    by_ear(drive, ctx)
    ctx.set_ref("//Bars")
    ctx.item_click("**/2##bar2")
    ctx.yield_(3)
    drive.seen["stage"] = drive.room.stage.name
    kept = drive.station.close()
    assert kept is None, kept
    drilled = drive.state.report
    drive.seen["subtitle"] = None if drilled is None else drilled.facts.words.subtitle


def by_ear(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The panel of every hit: its dots answer the mouse, and a bar of the teacher's and one's own is heard."""
    ctx.item_click("//Transport/Panels##panels")
    ctx.item_click("//$FOCUSED/Every hit")
    ctx.popup_close_all()
    ctx.yield_(3)
    ctx.set_ref("//Every hit")
    for label in (TEACHER_LABEL, STUDENT_LABEL):
        ctx.item_click(label)
        ctx.yield_(2)
        drive.seen[f"heard {label.split('#')[0]}"] = drive.room.listening
        double = drive.picture.double
        drive.seen[f"seen {label.split('#')[0]}"] = double is not None and double.is_compared
        ctx.item_click(HITS_STOP)
        ctx.yield_(2)
    drive.seen["quiet"] = not drive.room.listening
    panel, report = drive.window.pages.hits, drive.state.report
    assert report is not None
    x, y = panel.at[0].tolist()
    ctx.mouse_move_to_pos(imgui.ImVec2(x, y))
    ctx.yield_(2)
    drive.seen["pointed"] = panel.pointed
    x, y = min(panel.at[report.hits.dots["bar"] == 2].tolist(), key=lambda at: at[1])  # the lowest are scrolled away
    ctx.mouse_move_to_pos(imgui.ImVec2(x, y))
    ctx.yield_(2)
    ctx.mouse_click(0)
    ctx.yield_(2)
    drive.seen["clicked"] = panel.playback.bar


def closes(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The window is closed in mid-session."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    ctx.yield_(100)
    drive.seen["at_the_end"] = drive.room.stage.name


def unplugged(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A second monitor is unplugged in mid-session, and the window is on it."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    assert drive.monitors is not None, "the window is open"
    screen = drive.monitors.first
    drive.monitors.is_plugged = True
    screen.move(Rectangle(3100, 100, *SIZE))
    ctx.yield_(12)
    drive.seen["outside"] = home_for(screen.window(), [screen.area(name) for name in screen.monitors()]) is not None
    drive.seen["told before"] = drive.state.toast == GONE
    drive.monitors.is_plugged = False
    ctx.yield_(3)
    seen = [screen.window().shared(screen.area(name)) for name in screen.monitors()]
    drive.seen["shown"] = max(seen) / (SIZE[0] * SIZE[1])
    drive.seen["told"] = drive.state.toast
    drive.seen["stage"] = drive.room.stage.name


def lost(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The driver loses the window's context in mid-session."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    ctx.yield_(30)
    moderngl.Context.error = "GL_UNKNOWN_ERROR"  # what the library says of a context that its driver has lost
    ctx.yield_(MOST_FRAMES)


def player(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The demonstration is watched, stepped through, reversed, slowed down and looped; Start practises the loop."""
    deck, engine, seen = drive.station.sessions.player, drive.engine, drive.seen

    def at_ms() -> int:
        return round(deck.player.position_ns(deck.now_ns) / 1e6)

    ctx.set_ref("//Transport")
    ctx.item_click("###play")
    ctx.yield_(6)
    seen["plays"], seen["moves"] = deck.player.playing, at_ms() > 300
    ctx.key_press(imgui.Key.w)
    ctx.yield_(2)
    seen["stands"] = not deck.player.playing
    stepped = []
    for button in ("###start", "###step", "###step", "###back", "###end"):
        ctx.item_click(button)
        ctx.yield_(1)
        stepped.append(at_ms())
    seen["stepped"] = stepped
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_ctrl, imgui.Key.mod_shift))
    ctx.item_click("###reverse")
    ctx.key_press(imgui.Key.w)
    ctx.yield_(4)
    seen["back"] = at_ms() < stepped[-1]
    ctx.key_press(imgui.Key.r)
    ctx.key_press(imgui.Key.w)
    ctx.item_input_value("##speed", 50)
    ctx.yield_(1)
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_shift))
    ctx.yield_(1)
    seen["flag"], seen["speed"] = at_ms(), deck.player.speed_percent
    low, high = ctx.item_info("##ruler").rect_full.min, ctx.item_info("##ruler").rect_full.max
    y, width = (low.y + high.y) / 2, high.x - low.x
    ctx.mouse_move_to_pos(imgui.ImVec2(low.x + 0.6 * width, y))
    ctx.mouse_drag_with_delta(imgui.ImVec2(0.3 * width, 0))
    ctx.yield_(3)
    seen["loop"] = deck.player.loop
    request = drive.state.selection.request()
    seen["bars"] = None if request is None else request.bars
    ctx.mouse_move_to_pos(imgui.ImVec2(low.x + 0.75 * width, y))
    ctx.mouse_click(0)
    ctx.yield_(2)
    seen["sought"] = at_ms()
    plays = [command for command in engine.sent if isinstance(command, Play)]
    seen["cues"] = len(plays[0].cues)
    ctx.item_click(COUNT_IN_LABEL)
    ctx.key_press(imgui.Key.w)
    ctx.mouse_move_to_pos(imgui.ImVec2(900, 30))
    ctx.yield_(4)
    seen["counts"] = [deck.counts_in, deck.snapshot().hud.phase]
    ctx.key_press(imgui.Key.q)
    ctx.yield_(4)
    seen["counts no more"] = deck.counts_in


def graph(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The graph is opened, follows the play line, is zoomed by wheel, its line dragged; a result shows there."""
    panel, deck, seen = drive.window.pages.graph, drive.station.sessions.player, drive.seen
    ctx.set_ref("//Transport")
    ctx.item_click("Panels##panels")
    ctx.item_click("//$FOCUSED/Graph")
    ctx.popup_close_all()
    ctx.yield_(3)
    ctx.item_click("###start")
    low, high = panel.span_s
    ctx.item_click("###step")
    ctx.yield_(2)
    seen["beat"] = deck.player.at_ns % 1_500_000_000
    seen["middle"] = sum(panel.span_s) / 2 - deck.player.at_ns / 1e9
    place = imgui.internal.find_window_by_name("Graph").inner_rect
    middle = (place.min.x + place.max.x) / 2
    ctx.mouse_move_to_pos(imgui.ImVec2(middle, (place.min.y + place.max.y) / 2))
    ctx.mouse_wheel_y(3.0)
    ctx.yield_(2)
    seen["zoomed"] = (panel.span_s[1] - panel.span_s[0]) / (high - low)
    before = deck.player.at_ns
    ctx.mouse_move_to_pos(imgui.ImVec2(panel.line_x, (place.min.y + place.max.y) / 2))
    ctx.mouse_drag_with_delta(imgui.ImVec2(60, 0))
    ctx.yield_(2)
    width = ctx.item_info("//Graph/##angles").rect_full.get_width()
    seen["dragged"] = (deck.player.at_ns - before) / 1e9 / (panel.span_s[1] - panel.span_s[0]) * width
    drive.choose(ctx, passes=1)
    ctx.item_click("Start##start")
    ctx.yield_(4)
    seen["during"] = drive.room.stage.name
    drive.station.dispatch(EndSession())
    ctx.yield_(4)
    curves = drive.state.curves
    seen["result"] = curves is not None and curves.played is not None


def phase(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A motion is opened in the phase panel, heard, and its line dragged."""
    motion = write_walker(Path())  # a short name, for the fields show no more
    drive.window.params.docking_params.dockable_window_of_name(PHASE).is_visible = True
    ctx.yield_(3)
    ctx.set_ref(f"//{PHASE}")
    for label in (MOTION_LABEL, MODEL_LABEL):
        ctx.item_input_value(label, str(motion))
    ctx.item_click(OPEN_LABEL)
    for _ in range(MOST_FRAMES):
        if drive.state.phase.scene is not None:
            break
        ctx.yield_()
    drive.seen["opened"] = drive.state.phase.motion
    ctx.yield_(2)
    ctx.item_click(PLAY_LABEL)
    ctx.yield_(20)
    drive.seen["plays"], drive.seen["at_s"] = drive.state.phase.plays, drive.state.phase.at_s
    drive.seen["unread"] = drive.unread(ctx)
    ctx.item_click(STOP_LABEL)
    ctx.yield_(2)
    drive.seen["stopped"] = not drive.state.phase.plays


def legible(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Every tool is opened, at both ends of the usual sizes, and what cannot be read in it is told."""
    docking = drive.window.params.docking_params
    drive.engine.plug_stick("x-IMU3 1")
    drive.engine.move_stick("x-IMU3 1", measured(np.full(FINE_HZ, 0.2), Sensor(100)))
    for scale in (1.0, 2.0):
        drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=scale)))
        for page in drive.window.pages.tools:
            tool = docking.dockable_window_of_name(page.name)
            tool.is_visible = True
            ctx.yield_(5)
            drive.seen[f"{page.name} at {scale:g}"] = drive.unread(ctx)
            tool.is_visible = False


def fault(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A session that cannot begin is said in one line, and nothing else happens."""
    drive.engine.refuses = "the engine has ended"
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    ctx.yield_(2)
    drive.seen["news"] = drive.state.toast
    drive.seen["after"] = drive.room.stage.name
    drive.engine.refuses = ""


SCENARIOS = {
    "practise": practise,
    "keys": keys,
    "just_play": just_play,
    "search": search,
    "look": look,
    "viewpoints": viewpoints,
    "score": score,
    "worn": worn,
    "newcomer": newcomer,
    "devices": devices,
    "calibration": calibration,
    "highway": highway,
    "lost": lost,
    "drill": drill,
    "closes": closes,
    "unplugged": unplugged,
    "sticks": sticks,
    "habits": habits,
    "imports": imports,
    "player": player,
    "graph": graph,
    "fault": fault,
    "legible": legible,
    "phase": phase,
    "figure": figure,
    **EDITOR_SCENARIOS,
    "song": song,
    "planned_day": planned_day,
    "exam": exam,
    "exam_in_a_small_window": exam,
    "there_and_back": there_and_back,
}


def main(names: str, sessions: str, out: str, picture: str | None = None) -> None:
    scenarios = names.split("+")
    every, size = PICTURE_EVERY if picture is None else 1, SIZES.get(scenarios[0], SIZE)
    drive = Drive(Path(sessions), STUDENTS.get(scenarios[0]), every, size)
    try:
        drive.run([SCENARIOS[name] for name in scenarios])
    finally:
        kept = drive.station.close()
    if picture is not None:
        write_png(np.ascontiguousarray(hello_imgui.final_app_window_screenshot()), Path(picture))
    assert kept is None, kept
    Path(out).write_text(json.dumps(dict(zip(scenarios, drive.all_seen, strict=False))))


if __name__ == "__main__":
    main(*sys.argv[1:])
