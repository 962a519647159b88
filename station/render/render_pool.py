"""Pictures drawn by several processes at once, where the processor does the work of a graphics card.

A software driver seldom keeps all cores at work for one program: who draws the next picture waits for the last one.
So each of some processes draws with one thread, and all draw in turn. Planes for video come back in memory that they
share with their parent; PNG files are written by who drew them.

A process ends when it is told, or when its parent is gone, however that came about; the parent learns of a process's
end when it asks it for a picture or waits for one.
"""

import ctypes
import os
from collections import deque
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import fields, replace
from itertools import cycle
from multiprocessing import get_context
from multiprocessing.connection import Connection
from multiprocessing.reduction import ForkingPickler
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from station.core.errors import DeviceError, StationError
from station.core.processes import ctrl_c_ignored
from station.render.gpu.nv12 import Planes
from station.render.picture import Artist, Shot, renderer_name
from station.render.snapshot import Snapshot

_SOFTWARE = "llvmpipe"
"""Mesa's software driver by its name: it draws without a graphics card on Linux, and on Windows with Mesa's library."""
_WORTH = 96
"""So many pictures are worth several processes: they start half a second later and save some 5 ms a picture."""
_MOST = 4
"""So many processes draw faster at the lowest quality than x264 encodes, and each takes some 200 MB."""
_AHEAD = 3
"""So many pictures each process is asked for before the first of them is taken; our choice."""
_QUIT_WITHIN_S = 3.0
"""How long a process may take for the picture it is at before it is ended by force (our choice)."""

Place = int | Path
"""Where a picture goes: a number of the shared memory's, or a PNG file."""
Said = dict[str, Any]
"""What of a snapshot is another object than in the one before, by the field's name."""


def _view(names: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    """What cannot be written again."""
    return MappingProxyType(names)


ForkingPickler.register(MappingProxyType, lambda view: (_view, (dict(view),)))  # kits hold such views


@contextmanager
def artist(shot: Shot, pictures: int) -> "Iterator[Artist | RenderPool]":
    """Who draws so many `pictures` soonest on this computer; raises `DeviceError` without OpenGL."""
    crew = _crew(pictures)
    who = RenderPool(shot, crew) if crew > 1 else Artist(shot)
    try:
        yield who
    finally:
        who.close()


def _crew(pictures: int) -> int:
    """How many processes should draw."""
    if pictures < _WORTH or _SOFTWARE not in renderer_name():
        return 1
    return min(_cores(), _MOST)


def _cores() -> int:
    """How many cores this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


class RenderPool:
    """`crew` processes that draw the pictures of a shot in turn; after what it raises only `close` is left to do."""

    def __init__(self, shot: Shot, crew: int) -> None:
        self._slots = crew * _AHEAD
        memory = _memory(self._slots, shot)
        self._planes = _planes(memory, shot)
        self._workers: list[_Worker] = []
        try:
            for _ in range(crew):
                self._workers.append(_Worker(memory, shot, _cores() // crew))
        except BaseException:
            self.close()
            raise

    def film(self, snapshots: Iterable[Snapshot]) -> Iterator[Planes]:
        """The pictures of consecutive `snapshots` as planes for video, in order; raises `DeviceError`."""
        places: Iterable[Place] = cycle(range(self._slots))
        for place in self._drawn(zip(snapshots, places, strict=False)):
            assert isinstance(place, int)
            yield self._planes[place].copy()

    def pngs(self, snapshots: Iterable[Snapshot], paths: Iterable[Path]) -> Iterator[Path]:
        """Write the picture of each snapshot to its path, and tell them in order; raises `DeviceError`."""
        for place in self._drawn(zip(snapshots, paths, strict=True)):
            assert isinstance(place, Path)
            yield place

    def _drawn(self, wanted: Iterable[tuple[Snapshot, Place]]) -> Iterator[Place]:
        """Where each picture went that is there, in order."""
        asked: deque[tuple[_Worker, Place]] = deque()

        def first() -> Place:
            drawer, place = asked.popleft()
            drawer.wait()
            return place

        for drawer, (snapshot, place) in zip(cycle(self._workers), wanted, strict=False):
            if len(asked) == self._slots:
                yield first()
            drawer.ask(snapshot, place)
            asked.append((drawer, place))
        while asked:
            yield first()

    def close(self) -> None:
        """End the processes; none is left when this returns."""
        for drawer in self._workers:
            drawer.dismiss()
        for drawer in self._workers:
            drawer.close()


class _Worker:
    """One process as its parent sees it."""

    def __init__(self, memory: "ctypes.Array[ctypes.c_uint8]", shot: Shot, threads: int) -> None:
        context = get_context("spawn")
        self._line, its = context.Pipe()
        self._before: Snapshot | None = None
        self._process = context.Process(target=_draw, args=(its, memory, shot, threads), name="drawer", daemon=True)
        try:
            with ctrl_c_ignored():
                self._process.start()
        except OSError as fault:
            raise DeviceError(f"no process can be started that draws: {fault.strerror or fault}") from fault
        finally:
            its.close()  # the process has its own; ours would hide its end from us

    def ask(self, snapshot: Snapshot, place: Place) -> None:
        """Let it draw a picture; raises `DeviceError` if it has ended."""
        try:
            self._line.send((_news(self._before, snapshot), place))
        except OSError:
            raise self._ended() from None
        self._before = snapshot

    def wait(self) -> None:
        """Wait for the first of those pictures that was not waited for; raises what its drawing raised."""
        try:
            fault = self._line.recv()
        except (EOFError, OSError):
            raise self._ended() from None
        if fault is not None:
            raise fault

    def _ended(self) -> DeviceError:
        self._process.join(_QUIT_WITHIN_S)
        return DeviceError(f"a process that draws pictures has ended (exit code {self._process.exitcode}): try again")

    def dismiss(self) -> None:
        """Tell it that no more is wanted."""
        self._line.close()

    def close(self) -> None:
        """Wait for its end."""
        self._process.join(_QUIT_WITHIN_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        self._process.close()


def _memory(pictures: int, shot: Shot) -> "ctypes.Array[ctypes.c_uint8]":
    """Memory for so many pictures that processes share."""
    width, height = shot.size
    try:
        return get_context("spawn").RawArray(ctypes.c_uint8, pictures * width * (height * 3 // 2))
    except OSError as fault:
        raise DeviceError(f"there is no room for pictures: {fault.strerror or fault}") from fault


def _planes(memory: "ctypes.Array[ctypes.c_uint8]", shot: Shot) -> Planes:
    """The shared memory as pictures, shape (n, height · 3/2, width)."""
    width, height = shot.size
    return np.frombuffer(memoryview(memory).cast("B"), np.uint8).reshape(-1, height * 3 // 2, width)


def _news(before: Snapshot | None, snapshot: Snapshot) -> Said:
    """What `snapshot` says that the one before did not."""
    names = [field.name for field in fields(Snapshot)]
    said = {name: getattr(snapshot, name) for name in names}
    return {name: it for name, it in said.items() if before is None or it is not getattr(before, name)}


# --- in the process ---------------------------------------------------------------------------------------------------


def _draw(
    line: "Connection[StationError | None, tuple[Said, Place]]",
    memory: "ctypes.Array[ctypes.c_uint8]",
    shot: Shot,
    threads: int,
) -> None:
    """Draw what is asked for until nobody asks any more."""
    os.environ["LP_NUM_THREADS"] = str(threads if threads > 1 else 0)  # Mesa's documentation, "Environment variables"
    renderer = _ShotRenderer(memory, shot)
    with suppress(EOFError, ConnectionError):
        while True:
            said, place = line.recv()
            line.send(renderer.draw(said, place))


class _ShotRenderer:
    """Keeps what consecutive pictures share."""

    def __init__(self, memory: "ctypes.Array[ctypes.c_uint8]", shot: Shot) -> None:
        self._shot = shot
        self._planes = _planes(memory, shot)
        self._artist: Artist | None = None
        self._snapshot: Snapshot | None = None

    def draw(self, said: Said, place: Place) -> StationError | None:
        """Draw one; returns what went wrong."""
        self._snapshot = Snapshot(**said) if self._snapshot is None else replace(self._snapshot, **said)
        try:
            self._artist = self._artist or Artist(self._shot)
            if isinstance(place, int):
                self._artist.planes(self._snapshot, self._planes[place])
            else:
                self._artist.png(self._snapshot, place)
        except StationError as fault:
            return fault
        return None
