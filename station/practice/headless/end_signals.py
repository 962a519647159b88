"""Whether somebody wants the program to end while a session is played: Ctrl-C, a hung-up terminal, a system that stops.

None of them strikes in the middle of a message or of what is being written: they are noted, and whoever plays the
session looks. However often it is asked, the session is judged and kept once.
"""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_ASKS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]


class EndAsked:
    """Nobody has asked at first; `by` is the signal that asked first."""

    def __init__(self) -> None:
        self.by: int | None = None

    def __bool__(self) -> bool:
        return self.by is not None

    @property
    def is_attended(self) -> bool:
        """Whether the student may still be there, to be asked something: they typed Ctrl-C, or nobody asked."""
        return self.by in (None, signal.SIGINT)

    def note(self, number: int, frame: FrameType | None = None) -> None:
        """Take a signal; as a handler of signals it is called between two instructions."""
        del frame
        self.by = number if self.by is None else self.by


@contextmanager
def end_asked() -> Iterator[EndAsked]:
    """What asks for the end meanwhile is noted and does nothing else; afterwards all is as before.

    Only the main thread can (Python's documentation of `signal`). What the parent wants ignored, as `nohup` does, and
    what is not Python's to restore, stays as it is; Ctrl-C asks always, for shells have it ignored in the background.
    """
    asked = EndAsked()
    if threading.current_thread() is not threading.main_thread():
        yield asked
        return
    before = {ask: signal.getsignal(ask) for ask in _ASKS}
    mine = [ask for ask, was in before.items() if was is not None and (was != signal.SIG_IGN or ask == signal.SIGINT)]
    for ask in mine:
        signal.signal(ask, asked.note)
    try:
        yield asked
    finally:
        for ask in mine:
            signal.signal(ask, before[ask])
