"""The Enter key of the terminal, as it is pressed."""

import queue
import sys
import threading
from collections.abc import Callable

from station.core.clock import monotonic_ns

NextEnter = Callable[[float], int | None]
"""Waits up to so many seconds for the key; its session time, None where none came. Raises `EOFError` after the last."""


def enter_keys() -> NextEnter:
    """Enter as it is pressed; read in a thread, for a line cannot be awaited for a time on every system."""
    pressed: queue.SimpleQueue[int | None] = queue.SimpleQueue()

    def listen() -> None:
        for _ in sys.stdin or ():  # there may be no standard input
            pressed.put(monotonic_ns())
        pressed.put(None)

    threading.Thread(target=listen, name="enter", daemon=True).start()

    def next_enter(wait_s: float) -> int | None:
        try:
            at_ns = pressed.get(timeout=wait_s)
        except queue.Empty:
            return None
        if at_ns is None:
            raise EOFError
        return at_ns

    return next_enter
