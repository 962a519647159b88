"""The console: a command's result on standard output, words for people and questions on standard error, progress.

A result that cannot be written is a fault of the command. Words for people are lost where nobody can read them.
"""

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import monotonic
from typing import TextIO

from station.core.errors import DeviceError

_MOST_WARNINGS = 5
"""So many warnings are shown one by one (our choice)."""
_WIDTH = 30
_EVERY_S = 0.2
"""So often is a line of progress written anew (our choice: calm to look at)."""
_SURE_AFTER_S = 1.0
"""Before that the first, slow steps would foretell too much (our choice)."""


# --- the result -------------------------------------------------------------------------------------------------------


@contextmanager
def written_output() -> Iterator[None]:
    """At its end everything is written to standard output; raises as `write` does."""
    try:
        yield
    finally:
        if sys.stdout is not None:
            with _refusals():
                sys.stdout.flush()


def write(text: str, *, end: str = "\n", flush: bool = False) -> None:
    """Write a part of the command's result.

    Raises `DeviceError` where standard output is closed or takes no more, `BrokenPipeError` where its reader has gone.
    """
    if sys.stdout is None:
        raise DeviceError("standard output is closed")
    with _refusals():
        sys.stdout.write(f"{text}{end}")
        if flush:
            sys.stdout.flush()


def print_json(document: object) -> None:
    """Write one JSON document; NaN never appears, for no data is null. Raises as `write` does."""
    write(json.dumps(document, ensure_ascii=False, allow_nan=False, indent=2), flush=True)


@contextmanager
def _refusals() -> Iterator[None]:
    """What standard output refuses, in a user's words; what waits to be written there is given up."""
    try:
        yield
    except OSError as fault:
        _give_up(sys.stdout)
        if isinstance(fault, BrokenPipeError):
            raise
        raise DeviceError(f"standard output: {fault.strerror or fault}") from fault


def _give_up(stream: TextIO) -> None:
    """What waits to be written goes nowhere, so that Python's exit does not complain of it too."""
    with suppress(OSError):  # what stands in for a standard stream may have no file of its own
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


# --- words for people -------------------------------------------------------------------------------------------------


def say(text: str, *, end: str = "\n") -> None:
    """Tell the user something that is not the command's result."""
    if sys.stderr is None:
        return
    try:
        sys.stderr.write(f"{text}{end}")
        sys.stderr.flush()
    except OSError:
        _give_up(sys.stderr)


def say_infeasible(warnings: tuple[str, ...]) -> None:
    """Say what the score asks that no human can play; beyond `_MOST_WARNINGS` as a number."""
    for warning in warnings[:_MOST_WARNINGS]:
        say(f"not playable: {warning}")
    if len(warnings) > _MOST_WARNINGS:
        say(f"not playable: {len(warnings) - _MOST_WARNINGS} more such bars")


def is_attended() -> bool:
    """Whether somebody is there who can read a question and answer it."""
    return all(stream is not None and stream.isatty() for stream in (sys.stdin, sys.stderr))


def ask(question: str) -> str:
    """The line that is typed as the answer; empty without one."""
    say(question, end="")
    return sys.stdin.readline().strip()


# --- progress ---------------------------------------------------------------------------------------------------------


class Progress:
    """Shows how many of `total` things are done, on standard error if that is a terminal, else not at all."""

    def __init__(self, total: int, things: str = "pictures") -> None:
        self._total, self._things = total, things
        self._is_seen = sys.stderr is not None and sys.stderr.isatty()
        self._began_s = self._next_s = monotonic()

    def show(self, done: int) -> None:
        """So many are done."""
        now_s = monotonic()
        if self._is_seen and (now_s >= self._next_s or done == self._total):
            self._next_s = now_s + _EVERY_S
            say(f"\r{progress_line(done, self._total, now_s - self._began_s, self._things)}\x1b[K", end="")

    def close(self) -> None:
        """Leave the line as it is, and go on below it."""
        if self._is_seen:
            say("")


def progress_line(done: int, total: int, passed_s: float, things: str = "pictures") -> str:
    """Such as `████████░░░░  45 %  270 of 600 pictures, 92 a second, 4 s left`."""
    filled = _WIDTH * done // total
    line = f"{'█' * filled}{'░' * (_WIDTH - filled)} {100 * done // total:3d} %  {done} of {total} {things}"
    if not done or passed_s < _SURE_AFTER_S:
        return line
    left_s = passed_s * (total - done) / done
    return f"{line}, {done / passed_s:.3g} a second, {_duration(left_s)} left"


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    return f"{minutes} min {rest:02d} s" if minutes else f"{rest} s"
