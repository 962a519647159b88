"""The window as `station` opens it, closed after some frames: a process of its own, so that all of it is measured."""

import sys
import time

from station.app.commands.window import open_window
from station.core.clock import monotonic_ns
from station.core.settings import load_settings
from station.drills.library import FIRST_LESSON, find_lesson
from station.practice.plan import Wishes, plan_practice


def open_until(frame: int) -> None:
    """Open it, close it after so many frames; print when the last was shown and the processor's seconds until then."""
    seen: list[tuple[int, float]] = []

    def shown() -> bool:
        seen.append((monotonic_ns(), time.process_time()))
        return len(seen) < frame

    open_window(load_settings(), plan_practice(find_lesson(FIRST_LESSON), Wishes()), adapt=True, shown=shown)
    at_ns, worked_s = seen[frame - 1]
    sys.stdout.write(f"{at_ns} {worked_s}\n")
