"""How long a database may keep us waiting, in seconds."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

PATIENCE_S = 10.0
"""So long a writer waits for another (our choice: a hundred times what a long session takes to be kept)."""
CONNECT_S = 3
"""So long a server may take to answer (our choice: what a user waits without asking)."""
ANSWER_S = 60.0
"""So long a server may work on one statement (our choice: a school's whole history is read in less)."""
_left_s: ContextVar[list[float] | None] = ContextVar("left_s", default=None)
"""Of whoever is in a hurry in this thread: how long they may still wait, one number; None for who is not."""


@contextmanager
def in_a_hurry(within_s: float) -> Iterator[None]:
    """Whoever asks a database in this block waits `within_s` seconds for it in all; what they do themselves is free."""
    token = _left_s.set([within_s])
    try:
        yield
    finally:
        _left_s.reset(token)


def left_of(usual_s: float) -> float:
    """How long may be waited now where `usual_s` is usual; 0 where a hurry leaves nothing."""
    left = _left_s.get()
    return usual_s if left is None else max(min(usual_s, left[0]), 0.0)


@contextmanager
def waiting() -> Iterator[None]:
    """What this block takes has been waited."""
    left, began_s = _left_s.get(), time.monotonic()
    try:
        yield
    finally:
        if left is not None:
            left[0] -= time.monotonic() - began_s
