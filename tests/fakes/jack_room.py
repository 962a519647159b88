"""The room between a loudspeaker, a kit and a microphone, as a JACK client in a process of its own.

As a program: `python -m tests.fakes.jack_room MODE DELAY_FRAMES`. It plugs itself into PortAudio's ports whenever they
appear, says `ready`, and ends with its input. MODE is

* `cable`: what is played comes back DELAY_FRAMES later;
* `pads`: after `go` pads are struck, each heard at once and told by MIDI DELAY_FRAMES later;
* `drummer`: for each click that is played a stroke is told by MIDI DELAY_FRAMES after the click began.

Everything is done in JACK's own callback, to the frame.
"""

import random
import sys
import threading
import time
from collections import deque
from contextlib import suppress

import numpy as np

from tests.fakes.child import Child, say
from tests.fakes.jack_server import JackServer

KIT = "TD-17 room"
STATION = "PortAudio"
STROKES = 16
SNARE, RIDE = 38, 51
"""A TD-17's notes; the pads are struck in turn."""
_LOUD = 0.05
_QUIET_S = 0.2
_LEAD_S = 1.0


class JackRoom:
    """The room as a test sees it."""

    def __init__(self, server: JackServer, mode: str, delay_frames: int) -> None:
        self._child = Child(__name__, [mode, str(delay_frames)], server.env)

    def go(self) -> None:
        """Strike the pads."""
        self._child.tell("go")

    def __enter__(self) -> "JackRoom":
        return self

    def __exit__(self, *_: object) -> None:
        self._child.stop()


class _Room:
    """The client; one of the three `_cable`, `_pads`, `_drummer` is its callback."""

    def __init__(self, mode: str, delay_frames: int) -> None:
        import jack  # needs JACK's library, which a machine may lack

        self.client = jack.Client(KIT, no_start_server=True)
        self._heard = self.client.inports.register("heard")
        self._sound = self.client.outports.register("sound")
        self._midi = self.client.midi_outports.register("out")
        self._delay = delay_frames
        self._line = np.zeros(delay_frames, np.float32)
        self._strokes: deque[tuple[int, int]] = deque()
        self._told: deque[tuple[int, int]] = deque()
        self._quiet_until = 0
        self._burst = _burst(self.client.samplerate)
        self.client.set_process_callback({"cable": self._cable, "pads": self._pads, "drummer": self._drummer}[mode])
        self.client.activate()

    def strike(self) -> None:
        """Plan the strokes from now on, at uneven times."""
        rate_hz, rng = self.client.samplerate, random.Random(7)
        at = self.client.frame_time + round(_LEAD_S * rate_hz)
        for number in range(STROKES):
            self._strokes.append((at, SNARE if number % 2 else RIDE))
            at += round(rng.uniform(0.2, 0.45) * rate_hz)

    def plug(self) -> None:
        """Connect whatever of the station's ports is not yet connected."""
        for port in self.client.get_ports(f"{STATION}:out", is_audio=True, is_output=True):
            if port.name.endswith("_0") and self._heard not in self.client.get_all_connections(port):
                self._joined(port, self._heard)
        for port in self.client.get_ports(f"{STATION}:in", is_audio=True, is_input=True):
            if port.name.endswith("_0") and self._sound not in self.client.get_all_connections(port):
                self._joined(self._sound, port)

    def _joined(self, source: object, target: object) -> None:
        import jack

        try:
            self.client.connect(source, target)
        except jack.JackError:  # it has gone again, or is joined already
            return

    def _cable(self, frames: int) -> None:
        line = np.concatenate([self._line, self._heard.get_array()])
        self._sound.get_array()[:] = line[:frames]
        self._line = line[frames:]

    def _pads(self, frames: int) -> None:
        begin = self.client.last_frame_time
        out = self._sound.get_array()
        out[:] = 0.0
        for at, note in list(self._strokes):
            first = at - begin
            if first >= frames:
                break
            part = self._burst[max(-first, 0) : max(frames - first, 0)]
            out[max(first, 0) : max(first, 0) + len(part)] += part
            if first >= 0:
                self._told.append((at + self._delay, note))
            if first + len(self._burst) < frames:
                self._strokes.popleft()
        self._tell(begin, frames)

    def _drummer(self, frames: int) -> None:
        begin = self.client.last_frame_time
        loud = np.flatnonzero(np.abs(self._heard.get_array()) > _LOUD)
        if len(loud) and begin + loud[0] >= self._quiet_until:
            at = begin + int(loud[0])
            self._quiet_until = at + round(_QUIET_S * self.client.samplerate)
            self._told.append((at + self._delay, SNARE))
        self._tell(begin, frames)

    def _tell(self, begin: int, frames: int) -> None:
        self._midi.clear_buffer()
        while self._told and self._told[0][0] < begin + frames:
            at, note = self._told.popleft()
            self._midi.write_midi_event(max(at - begin, 0), (0x99, note, 100))


def _burst(rate_hz: int) -> "np.ndarray[tuple[int], np.dtype[np.float32]]":
    at_s = np.arange(round(0.1 * rate_hz)) / rate_hz
    noise = np.random.default_rng(1).standard_normal(len(at_s))
    return (0.4 * noise * np.exp(-at_s / 0.01)).astype(np.float32)


def _plug_on(room: _Room, ended: threading.Event) -> None:
    import jack

    while not ended.is_set():
        with suppress(jack.JackError):  # a port has gone since it was listed
            room.plug()
        time.sleep(0.02)


def main(mode: str, delay_frames: str) -> None:
    """The child's whole life."""
    room, ended = _Room(mode, int(delay_frames)), threading.Event()
    plugging = threading.Thread(target=_plug_on, args=(room, ended), daemon=True)
    plugging.start()
    say("ready")
    for line in sys.stdin:
        if line.strip() == "go":
            room.strike()
    ended.set()
    plugging.join()
    room.client.deactivate()
    room.client.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
