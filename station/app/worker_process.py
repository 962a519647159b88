"""One piece of work in a process of its own, so that no frame waits for it, and that can be ended wherever it is.

Files are read and written so: what a stranger's file does to the reader happens there, and not to the window.
"""

import copyreg
import multiprocessing as mp
import os
from collections.abc import Callable, Mapping
from contextlib import suppress
from multiprocessing.connection import Connection
from types import MappingProxyType
from typing import Any, Generic, Protocol, TypeVar

from station.core.errors import DeviceError, StationError

Result_co = TypeVar("Result_co", covariant=True)
Result = TypeVar("Result")
_NICE = 3
"""How nice work is to a drummer who plays meanwhile (our choice: the window and the sound come first, and whoever waits
for a file gets it before a film gets on)."""
_ENDED = "the program that did the work has ended without a result: is there enough memory?"


class Work(Protocol[Result_co]):
    """Work that goes on."""

    def result(self) -> Result_co | None:
        """What came of it, None while it goes on; raises the `StationError` that it ended with."""
        ...

    def end(self) -> None:
        """End it, wherever it is."""
        ...


class StartWork(Protocol):
    """Begins `do`, a function of a module, with what it needs; raises `DeviceError`."""

    def __call__(self, do: Callable[..., Result], *words: object) -> Work[Result]:
        """The work that goes on; `do` returns no None."""
        ...


class WorkerProcess(Generic[Result]):
    """The work of `do` in a new process; raises `DeviceError` where the system has none to give."""

    def __init__(self, do: Callable[..., Result], *words: object) -> None:
        context = mp.get_context("spawn")
        self._from, to = context.Pipe(duplex=False)
        self._process = context.Process(target=_work, args=(to, do, words), daemon=True)
        try:
            self._process.start()
        except OSError as fault:
            raise DeviceError(f"no process can be started: {fault.strerror or fault}") from fault
        finally:
            to.close()

    def result(self) -> Result | None:
        """What came through the pipe."""
        if not self._from.poll():
            return None
        try:
            found: Result | StationError = self._from.recv()
        except (EOFError, OSError):
            raise DeviceError(_ENDED) from None
        if isinstance(found, StationError):
            raise found
        return found

    def end(self) -> None:
        """Kill it if it still runs."""
        self._process.kill()
        self._process.join()
        self._from.close()


def _work(to: Connection, do: Callable[..., object], words: tuple[object, ...]) -> None:
    """What the process does."""
    with suppress(OSError, AttributeError):  # there is no such thing on every system
        os.nice(_NICE)
    try:
        to.send(do(*words))
    except StationError as fault:
        to.send(fault)


def _read_only(values: dict[Any, Any]) -> Mapping[Any, Any]:
    return MappingProxyType(values)


def _reduced(view: MappingProxyType[Any, Any]) -> tuple[Any, ...]:
    return _read_only, (dict(view),)


copyreg.pickle(MappingProxyType, _reduced)  # a kit's tables are read-only: so they come out of the process as well
