"""How processes of ours are started."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

_FROM_THE_TERMINAL = [getattr(signal, name) for name in ("SIGINT", "SIGHUP") if hasattr(signal, name)]


@contextmanager
def ctrl_c_ignored() -> Iterator[None]:
    """What is started meanwhile ignores Ctrl-C and a hung-up terminal, which reach all; ours is as before afterwards.

    Only the main thread may change that (Python's documentation of `signal`); another one starts the child as it is.
    """
    before = {number: signal.getsignal(number) for number in _FROM_THE_TERMINAL}
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    mine = {number: was for number, was in before.items() if was is not None}  # None: not Python's to restore
    for number in mine:
        signal.signal(number, signal.SIG_IGN)
    try:
        yield
    finally:
        for number, was in mine.items():
            signal.signal(number, was)
