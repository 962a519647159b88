"""`station` without a command: opens the practice room."""

import argparse
from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING

from station.app.diagnostics import has_screen
from station.app.settings_store import SettingsStore
from station.core.errors import DeviceError
from station.core.measured_latency import load_calibration
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.render.snapshot import Snapshot

if TYPE_CHECKING:
    from station.practice.session.backing_track import BackingRequest


def add_options(_: argparse.ArgumentParser) -> None:
    """Nothing but --help: what a window needs is chosen in it."""


def run(_: argparse.Namespace) -> int:
    """Open the window on the first lesson."""
    from station.drills.library import FIRST_LESSON, find_lesson

    store = SettingsStore()
    first = plan_practice(find_lesson(FIRST_LESSON), PlanOptions(hands=hands_of(store.now)))
    return open_window(store, first, adapt=True)


def open_window(
    store: SettingsStore,
    first: Plan,
    adapt: bool,
    backing: "BackingRequest | None" = None,
    shown: Callable[[Snapshot | None], bool] | None = None,
) -> int:
    """Show the practice room, by the settings of `store`, until it is closed; what was played until then is kept.

    `adapt` whether the tempo follows the student, until another choice is made in the window; `backing` a track to
    play along to in every session whose tempo stays; `shown` is called after each frame, with what
    it shows behind the panels, and says whether to go on.
    """
    if not has_screen():
        raise DeviceError("no screen: `station practice --headless` practises in the terminal")
    from station.app.controller import Controller
    from station.app.session_control import Launch
    from station.engine.engine_config import EngineConfig
    from station.engine.supervisor import EngineSupervisor
    from station.gui.layout import WindowOptions
    from station.gui.window import run_window
    from station.practice.session.device_latency import latency_of

    launch = Launch(first, adapt, latency_of(store.now, load_calibration()), backing)
    with ExitStack() as engines:
        wake = lambda: engines.enter_context(EngineSupervisor(EngineConfig.from_settings(store.now)))  # noqa: E731
        controller = Controller(wake, store, launch)
        try:
            run_window(controller, WindowOptions(shown=shown))
        finally:
            fault = controller.close()
        if fault is not None:
            raise fault
    return 0
