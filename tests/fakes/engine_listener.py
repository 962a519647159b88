"""Collects what an engine process says, for a test that waits for something."""

import time
from collections.abc import Callable

from station.core.events import Hit
from station.engine.messages import EngineEvent, Status
from station.practice.headless.live import EngineLink


class EngineListener:
    """Collects an engine's events."""

    def __init__(self, engine: EngineLink) -> None:
        self._engine = engine
        self.events: list[EngineEvent] = []

    def until(self, is_it: Callable[[EngineEvent], bool], within_s: float = 60.0) -> EngineEvent:
        """Wait for the first event, among those collected and those to come, of which `is_it` holds."""
        give_up_s = time.monotonic() + within_s
        seen = 0
        while True:
            for event in self.events[seen:]:
                if is_it(event):
                    return event
            if time.monotonic() > give_up_s:
                raise AssertionError(f"it did not happen within {within_s} s; what did: {self.events}")
            seen = len(self.events)
            self.events += self._engine.events(wait_s=0.1)

    def until_after(self, at_ns: int) -> None:
        """Wait until the engine has told all that came until `at_ns`."""
        self.until(lambda event: isinstance(event, Status) and event.at_ns > at_ns)

    def hits(self) -> list[Hit]:
        return [event for event in self.events if isinstance(event, Hit)]
