"""The window on the real station: an engine in a process of its own, a fake kit on a serial line."""

import sys
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from time import monotonic
from types import SimpleNamespace
from typing import cast

from imgui_bundle import imgui
from jpeg_file import write_jpeg
from pty_student import PtyStudent

from station.app.actions.settings_actions import SetView
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.sessions.launch import Launch
from station.app.settings.settings_store import SettingsStore
from station.app.window_state import State
from station.core.clock import Clock, MonotonicClock
from station.core.measured_latency import load_calibration
from station.engine.engine_config import EngineConfig
from station.engine.supervisor import EngineSupervisor
from station.practice.lag.first_groove import first_groove
from station.practice.session.device_latency import latency_of
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import PlanOptions
from station.render.snapshot import Snapshot
from station.simulation.student_spec import StudentSpec
from tests.gui.drive import NEWCOMER, Drive
from tests.gui.room import DirectEngine

_PATIENCE_S = 75.0
"""The longest that anything is waited for: the first groove takes a minute."""
Context = imgui.test_engine.TestContext


class RealRoom(Drive):
    """What the walk works with: `student` sits at the kit, and looks at the screen whenever a frame is on it."""

    def __init__(self, sessions: Path, student: PtyStudent, size: tuple[int, int], scale: float) -> None:
        self._engines = ExitStack()
        self.student = student
        super().__init__(sessions, NEWCOMER, picture_every=1, size=size)
        self.station.dispatch(SetView(replace(self.state.view_settings, scale=scale)))

    def made(
        self, lesson: str, options: PlanOptions, store: SettingsStore, student: StudentSpec | None
    ) -> tuple[Controller, DirectEngine, Clock]:
        """The station as `station` opens it; nothing of its engine is played."""
        del lesson, options, student
        store = SettingsStore(self.settings, {"kit": self.student.device})
        wake = lambda: self._engines.enter_context(EngineSupervisor(EngineConfig.from_settings(store.now)))  # noqa: E731
        launch = Launch(first_groove(store.now, hands_of(store.now)), False, latency_of(store.now, load_calibration()))
        nobody = cast("DirectEngine", SimpleNamespace(sent=[]))
        return Controller(ChildPrograms(wake), store, launch), nobody, MonotonicClock()

    def close(self) -> None:
        """End the station and its engine."""
        self.station.close()
        self._engines.close()

    def wait_until(self, ctx: Context, holds: Callable[[State], bool]) -> None:
        """Let frames pass until it holds; what takes a minute does not come."""
        until = monotonic() + _PATIENCE_S
        while not holds(self.state):
            assert monotonic() < until, "it does not come"
            ctx.yield_()

    def keep(self, ctx: Context, path: Path) -> None:
        """A picture of the screen; what imgui has cut off, or written over itself, is told."""
        if not imgui.is_any_item_hovered() or "sound" not in path.name:  # a preview stays
            ctx.mouse_move_to_pos(imgui.ImVec2(imgui.get_io().display_size.x - 3.0, 3.0))
        write_jpeg(self.shot(ctx), path.with_suffix(".jpg"))
        for fault in self.faults:
            sys.stderr.write(f"{path.name}: {fault}\n")

    def _frame_is_shown(self, snapshot: Snapshot | None) -> bool:
        self.student.watch(self.station.parts.sessions.practice.session.session)
        return super()._frame_is_shown(snapshot)
