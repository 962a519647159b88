"""How processes of ours are started."""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from multiprocessing import resource_tracker

_FROM_THE_TERMINAL = [getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)]


@contextmanager
def ctrl_c_ignored() -> Iterator[None]:
    """What is started meanwhile ignores Ctrl-C and a hung-up terminal, which reach all; we hear them, soon after.

    They are held back rather than ignored: a child has its mask from the thread that starts it, and what reaches us
    meanwhile waits. Where there are no masks (Windows) a child sees to it by itself.
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    resource_tracker.ensure_running()  # before Python 3.13 its start, at the first child's, holds nothing back any more
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _FROM_THE_TERMINAL)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def silence_libraries() -> None:
    """Let nothing but Python's own words come to standard error from now on.

    The C libraries of JACK, ALSA and PortAudio print what a user can do nothing about, at any time and from threads of
    their own; what matters of it we say ourselves.
    """
    if sys.stderr is None:
        return
    with suppress(OSError, ValueError):  # there is none, or it is closed
        sys.stderr.flush()
        ours = os.dup(2)
        with open(os.devnull, "wb") as nowhere:  # noqa: PTH123 - the name of no file
            os.dup2(nowhere.fileno(), 2)
        sys.stderr = open(ours, "w", buffering=1, encoding="utf-8", errors="backslashreplace")  # noqa: PTH123, SIM115
