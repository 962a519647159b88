"""A kit that plays by itself, in a process of its own, and knows when it played: for measuring what the engine hears.

As a program: `python -m station.bench.rigs.devices.playing_kit serial PATH BAUD` speaks on a pty at PATH, `… jack NAME`
on a port of the JACK server. It says `ready`, then obeys lines on its standard input:

    play START_NS STEP_NS COUNT    strokes from monotonic START_NS on; says the JSON list of when each was sent
    flood START_NS STEP_NS COUNT   the same with messages of all kinds, of which every fourth is a stroke

The end of its input is the plug that is pulled.
A stroke on a serial line is sent when its last byte would have come. A real kit waits for no processor, so this one
asks for the first place in the queue. Times are monotonic ns.
"""

import json
import os
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path
from typing import Protocol, Self

import mido

from station.bench.rigs.devices.serial_kit import SerialKit
from station.core.clock import monotonic_ns

_NOTES = (36, 38, 48, 45)
_SPIN_NS = 400_000
"""So long before its time a message is awaited without sleeping: longer than the system's timer is late."""


class _Cable(Protocol):
    def unplug(self) -> None: ...
    def send(self, message: bytes) -> int:
        """Send, and say when."""
        ...


class _Serial:
    def __init__(self, path: str, baud: str) -> None:
        self._kit, self._baud = SerialKit(Path(path)), int(baud)
        self.unplug = self._kit.unplug

    def send(self, message: bytes) -> int:
        return self._kit.play_at_wire_speed(message, self._baud)[-1]


class _Jack:
    def __init__(self, name: str) -> None:
        backend = mido.Backend("mido.backends.rtmidi/UNIX_JACK")
        self._port = backend.open_output(name, virtual=True, client_name=name)

    def unplug(self) -> None:
        self._port.close()

    def send(self, message: bytes) -> int:
        sent_ns = monotonic_ns()
        self._port.send(mido.Message.from_bytes(message))
        return sent_ns


def velocity_of(index: int) -> int:
    """The velocity of the message of this number, by which it is known again."""
    return 1 + index % 127


def flood_message(index: int) -> bytes:
    """The message of this number in a flood: a stroke, its note off, the pedal and the clock in turn."""
    stroke = bytes((0x99, 38, velocity_of(index)))
    return (stroke, bytes((0x89, 38, 0)), bytes((0xB9, 4, index % 128)), b"\xf8")[index % 4]


def _stroke(index: int) -> bytes:
    return bytes((0x99, _NOTES[index % len(_NOTES)], velocity_of(index)))


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


def _hurry() -> None:
    with suppress(OSError, AttributeError):
        os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(1))


def _wait_until(at_ns: int) -> None:
    left_ns = at_ns - monotonic_ns()
    if left_ns > _SPIN_NS:
        time.sleep((left_ns - _SPIN_NS) / 1e9)
    while monotonic_ns() < at_ns:
        pass


def main(kind: str, *words: str) -> None:
    """The program's whole life."""
    _hurry()
    cable: _Cable = _Serial(*words) if kind == "serial" else _Jack(*words)
    _say("ready")
    for line in sys.stdin:
        verb, *numbers = line.split()
        start_ns, step_ns, count = map(int, numbers)
        sent = []
        for index in range(count):
            _wait_until(start_ns + index * step_ns)
            sent.append(cable.send(flood_message(index) if verb == "flood" else _stroke(index)))
        _say(json.dumps(sent))
    cable.unplug()


class PlayingKit:
    """The program as a benchmark sees it; use it as a context manager."""

    def __init__(self, *words: str) -> None:
        self._words = words
        self._process: subprocess.Popen[str] | None = None
        self.plug()

    def plug(self) -> int:
        """Have the kit come; returns when it had, in monotonic ns."""
        self._process = subprocess.Popen(
            [sys.executable, "-m", __name__, *self._words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            bufsize=1,
        )
        self.hear()
        return monotonic_ns()

    def unplug(self) -> int:
        """Have the kit go, if it is there; returns when it had, in monotonic ns."""
        if self._process is not None:
            self._process.communicate()
            self._process = None
        return monotonic_ns()

    def command(self, line: str) -> None:
        """Have it do what `line` says."""
        assert self._process is not None, "a kit that is unplugged does nothing"
        assert self._process.stdin is not None
        self._process.stdin.write(line + "\n")

    def hear(self) -> str:
        """The next thing that it says; raises `RuntimeError` where it has ended."""
        assert self._process is not None, "a kit that is unplugged says nothing"
        assert self._process.stdout is not None
        said = self._process.stdout.readline()
        if not said:
            raise RuntimeError(f"the playing kit has ended (exit status {self._process.wait()})")
        return said.strip()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.unplug()


if __name__ == "__main__":
    main(*sys.argv[1:])
