"""The window as `station` opens it, watched from outside: a process of its own, so that all of it is measured."""

import json
import sys
import time
from math import ceil

from station.app.settings_store import SettingsStore
from station.cli.window import open_window
from station.core.clock import monotonic_ns
from station.core.units import NS_PER_S
from station.drills.library import FIRST_LESSON, find_lesson
from station.practice.session.plan import PlanOptions, plan_practice
from station.render.snapshot import Snapshot

PASS_S = 6.0
"""The first lesson's two bars at its own tempo."""


def open_until(frame: int) -> None:
    """Open it, close it after so many frames; print when the last was shown and the processor's seconds until then."""
    seen: list[tuple[int, float]] = []

    def shown(_: Snapshot | None) -> bool:
        seen.append((monotonic_ns(), time.process_time()))
        return len(seen) < frame

    open_window(SettingsStore(), plan_practice(find_lesson(FIRST_LESSON), PlanOptions()), adapt=True, shown=shown)
    at_ns, worked_s = seen[frame - 1]
    sys.stdout.write(f"{at_ns} {worked_s}\n")


def open_for(seconds: float) -> None:
    """Open it on a long session, which the kit's own two kicks begin, and close it after so many seconds.

    Prints "open" when the first frame is there; at the end a JSON object: when frames were `shown_ns`, the processor's
    seconds until then (`worked_s`), and `lit`, pairs of when a frame first showed a stroke and of its velocity.
    """
    shown_ns: list[int] = []
    worked_s: list[float] = []
    lit: list[tuple[int, int]] = []
    before: set[int] = set()

    def shown(snapshot: Snapshot | None) -> bool:
        now_ns = monotonic_ns()
        if not shown_ns:
            _say("open")
        shown_ns.append(now_ns)
        worked_s.append(time.process_time())
        struck = set() if snapshot is None else {strike.velocity for strike in snapshot.strikes if strike.student}
        lit.extend((now_ns, velocity) for velocity in struck - before)
        before.clear()
        before.update(struck)
        return now_ns - shown_ns[0] < seconds * NS_PER_S

    plan = plan_practice(find_lesson(FIRST_LESSON), PlanOptions(loops=ceil(seconds / PASS_S), demonstrations=0))
    open_window(SettingsStore(), plan, adapt=False, shown=shown)
    _say(json.dumps({"shown_ns": shown_ns, "worked_s": worked_s, "lit": lit}))


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()
