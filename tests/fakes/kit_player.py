"""A fake electronic kit in a process of its own: plays MIDI bytes into a real port through rtmidi's JACK API.

As a program: `python -m tests.fakes.kit_player PORT STROKES TRUTH`. STROKES is a JSON list of [at_ns, hex bytes], times
from the start of playing. It says `ready` once its port is there, waits for `play START_NS` (monotonic), plays, writes
to TRUTH the list of [at_ns, hex bytes] with the monotonic time at which each was really sent, says `done`, and keeps
its port until its input ends.
"""

import json
import sys
import time
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

import rtmidi

from tests.fakes.child import Child, say
from tests.fakes.jack_server import JackServer

_FINE_S = 0.002
"""So long before its time a stroke is awaited in short steps."""


class Stroke(NamedTuple):
    """Bytes and their time: in a plan from the start of playing, in the truth on the monotonic clock."""

    at_ns: int
    data: bytes


class KitPlayer:
    """The fake kit as the test sees it."""

    def __init__(self, server: JackServer, port: str, strokes: Iterable[Stroke], folder: Path) -> None:
        plan, self._truth = folder / "strokes.json", folder / "truth.json"
        plan.write_text(_to_json(strokes))
        self._child = Child(__name__, [port, str(plan), str(self._truth)], server.env)

    def play(self, start_ns: int) -> None:
        """Begin to play with the strokes' time 0 at monotonic `start_ns`."""
        self._child.tell(f"play {start_ns}")

    def truth(self) -> list[Stroke]:
        """Wait until everything is played; what was sent, and when."""
        self._child.expect("done")
        return _from_json(self._truth.read_text())

    def unplug(self) -> None:
        """Pull the plug: the port vanishes."""
        self._child.stop()

    def __enter__(self) -> "KitPlayer":
        return self

    def __exit__(self, *_: object) -> None:
        self._child.stop()


def _to_json(strokes: Iterable[Stroke]) -> str:
    return json.dumps([[stroke.at_ns, stroke.data.hex()] for stroke in strokes])


def _from_json(text: str) -> list[Stroke]:
    return [Stroke(at_ns, bytes.fromhex(data)) for at_ns, data in json.loads(text)]


def _wait_until(at_ns: int) -> None:
    while (left_s := (at_ns - time.monotonic_ns()) / 1e9) > 0:
        time.sleep(max(0.0001, left_s - _FINE_S))


def _play(out: "rtmidi.MidiOut", strokes: list[Stroke], start_ns: int) -> list[Stroke]:
    sent = []
    for stroke in strokes:
        _wait_until(start_ns + stroke.at_ns)
        sent.append(Stroke(time.monotonic_ns(), stroke.data))
        out.send_message(stroke.data)
    return sent


def main(port: str, plan: str, truth: str) -> None:
    """The child's whole life."""
    strokes = _from_json(Path(plan).read_text())
    out = rtmidi.MidiOut(rtmidi.API_UNIX_JACK, port)
    out.open_virtual_port("out")
    say("ready")
    for line in sys.stdin:
        _, start_ns = line.split()
        Path(truth).write_text(_to_json(_play(out, strokes, int(start_ns))))
        say("done")
    out.close_port()
    out.delete()


if __name__ == "__main__":
    main(*sys.argv[1:])
