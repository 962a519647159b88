"""`station` without a command: opens the practice room."""

from contextlib import ExitStack
from dataclasses import dataclass
from typing import TYPE_CHECKING

from station.app.equipment.diagnostics import has_screen
from station.app.settings.settings_store import SettingsStore
from station.cli.options.option_fields import Command, group, optional_argument
from station.cli.options.watch_options import WatchOptions
from station.core.errors import DeviceError
from station.core.measured_latency import load_calibration
from station.practice.lag.first_groove import first_groove
from station.practice.session.leading_hand import hands_of
from station.practice.session.plan import Plan, PlanOptions, plan_practice

if TYPE_CHECKING:
    from station.app.opening import Watch
    from station.practice.session.backing_track import BackingRequest


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenOptions:
    """What is opened in the window."""

    file: str | None = optional_argument("FILE", "a lesson, music, a take, an assignment, a return or a note to open")
    watch: WatchOptions = group(WatchOptions)


def run(options: OpenOptions) -> int:
    """Open the window on the first lesson, a newcomer's on the first groove, or on the file that is named."""
    from station.drills.library import FIRST_LESSON, find_lesson

    store = SettingsStore()
    if not store.now.welcomed:
        first = first_groove(store.now, hands_of(store.now))
        return open_window(store, first, adapt=False, watch=options.watch.watch(), file=options.file or "")
    first = plan_practice(find_lesson(FIRST_LESSON), PlanOptions(hands=hands_of(store.now), stands=store.now.stands))
    return open_window(store, first, adapt=True, watch=options.watch.watch(), file=options.file or "")


def open_window(
    store: SettingsStore,
    first: Plan,
    adapt: bool,
    backing: "BackingRequest | None" = None,
    watch: "Watch | None" = None,
    file: str = "",
) -> int:
    """Show the practice room, by the settings of `store`, until it is closed, or the system wants it to end.

    What was played until then is kept.

    `adapt` whether the tempo follows the student, until another choice is made in the window; `backing` a track to
    play along to in every session whose tempo stays; `file`, if there is one, is taken in as if it were dropped; a
    `watch` sees each frame, and says when the window closes.
    """
    if not has_screen():
        raise DeviceError("no screen: `station practice --headless` practises in the terminal")
    from station.app.child_programs import ChildPrograms
    from station.app.controller import Controller
    from station.app.sessions.launch import Launch
    from station.engine.engine_config import EngineConfig
    from station.engine.supervisor import EngineSupervisor
    from station.gui.window import run_window
    from station.gui.window_frame import WindowOptions
    from station.practice.headless.end_signals import end_asked
    from station.practice.session.device_latency import latency_of

    launch = Launch(first, adapt, latency_of(store.now, load_calibration()), backing)
    with ExitStack() as engines, end_asked() as asked:
        wake = lambda: engines.enter_context(EngineSupervisor(EngineConfig.from_settings(store.now)))  # noqa: E731
        controller = Controller(ChildPrograms(wake), store, launch)
        try:
            goes_on = lambda drawn: not asked and (watch is None or watch.shown(drawn))  # noqa: E731
            run_window(controller, WindowOptions(shown=goes_on, opens=file))
        finally:
            fault = controller.close()
        if fault is not None:
            raise fault
    if watch is not None:
        watch.close()
    return 0


COMMAND = Command(OpenOptions, run)
