"""Plays cues to a MIDI output: the demonstration on the student's own module, in time with the transport.

The engine's other half beside `Player`: that one sounds cues by the card's blocks, this one sends them when the engine
is advanced past their time. Cues are made into bytes only when they are due, so that a long session costs nothing at
its start. One that lies further back than `station.engine.cue_queue.LATE_NS` is left out, as a sound would be. Where
the output fails once it is left alone, and its fault is there to be reported.
"""

import heapq
from collections import deque
from collections.abc import Callable
from math import isnan
from typing import Protocol

from station.core.errors import DeviceError, StationError
from station.core.pieces import Articulation, Piece, Zone
from station.devices.midi.midi_encoder import GATE_NS, all_off, choke, note_off, note_on
from station.engine.cue_queue import Cue, CueQueue, CueRun
from station.engine.messages import Bus


class MidiSink(Protocol):
    """What MIDI is sent to."""

    def send(self, message: bytes) -> None:
        """Send one whole message now; raises `DeviceError`."""
        ...

    def close(self) -> None:
        """Give the output back; harmless when closed already."""
        ...


OpenMidiOut = Callable[[str], MidiSink]


def no_midi_out(port: str) -> MidiSink:
    """For an engine without ports; raises `DeviceError`."""
    raise DeviceError(f"{port}: there is no MIDI output here")


class MidiPlayer:
    """Sends the cues of one bus to a sink while the transport runs."""

    def __init__(self, sink: MidiSink, bus: Bus = Bus.DEMONSTRATION) -> None:
        self._sink = sink
        self._bus = bus
        self._playback = CueQueue()
        self._ends: list[tuple[int, bytes]] = []  # when notes end (session time), and how: a heap
        self._waiting: deque[list[CueRun] | None] = (
            deque()
        )  # of each start yet to take effect, None of one stopped before
        self.fault: DeviceError | None = None
        """Why nothing is sent any more; None while all is well."""

    def play(self, run: CueRun) -> None:
        """Play `run`, of this player's own, and nothing else, as soon as `started` says where its time 0 lies."""
        self._waiting.append([run])

    def add(self, run: CueRun) -> None:
        """Play `run`, of this player's own, too: with the start that is awaited, else with what plays."""
        if not self._waiting:
            self._playback.add(run)
        elif (awaited := self._waiting[-1]) is not None:
            awaited.append(run)

    def resume(self, run: CueRun, zero_ns: int, now_ns: int) -> None:
        """Play what of `run` lies ahead of `now_ns`, with time 0 at `zero_ns`, from now on."""
        self._playback.resume(run, zero_ns, now_ns)

    def started(self, zero_ns: int) -> None:
        """The transport's next start has taken effect: time 0 is `zero_ns` of session time."""
        runs = self._waiting.popleft() if self._waiting else None  # one from before this player was made is none of its
        if runs is not None:
            self._silence()
            self._playback.start(runs[0], zero_ns)
            for added in runs[1:]:
                self._playback.add(added)

    def stop(self) -> None:
        """Forget what was to be played, and end every note that sounds."""
        self._waiting = deque([None] * len(self._waiting))
        self._silence()

    def _silence(self) -> None:
        if self._playback.zero_ns is not None:
            self._send(all_off())
        self._playback.stop()
        self._ends.clear()

    def advance(self, now_ns: int) -> None:
        """Send what is due up to `now_ns`."""
        while self._ends and self._ends[0][0] <= now_ns:
            self._send(heapq.heappop(self._ends)[1])
        for cue in self._playback.pop_due(now_ns, now_ns + 1):
            if cue.bus == self._bus:
                self._play(cue)

    def close(self) -> None:
        """End what sounds and give the output back."""
        self.stop()
        self._sink.close()

    def _play(self, cue: Cue) -> None:
        piece, zone, articulation = Piece(cue.piece), Zone(cue.zone), Articulation(cue.articulation)
        openness = None if isnan(cue.openness) else cue.openness
        if cue.velocity == 0:
            messages = choke(piece, zone)
        else:
            messages = note_on(piece, zone, articulation, cue.velocity, openness)
            heapq.heappush(self._ends, (cue.at_ns + GATE_NS, note_off(piece, zone, articulation, openness)))
        for message in messages:
            self._send(message)

    def _send(self, message: bytes) -> None:
        if self.fault is None:
            try:
                self._sink.send(message)
            except DeviceError as fault:
                self.fault = fault


class MidiOut:
    """The output that the demonstration is sent to, None most of the time; `notify` hears what a user should read."""

    def __init__(self, open_output: OpenMidiOut, notify: Callable[[str], None]) -> None:
        self._open, self._notify = open_output, notify
        self._player: MidiPlayer | None = None
        self._fault: DeviceError | None = None

    def choose(self, port: str | None) -> None:
        """Send to the output whose name contains `port`, from the next start on; None to none."""
        if self._player is not None:
            self._player.close()
        self._player = self._fault = None
        if port is None:
            return
        try:
            self._player = MidiPlayer(self._open(port))
        except StationError as fault:
            self._notify(f"the demonstration is not sent: {fault}")

    def play(self, run: CueRun) -> None:
        """As `MidiPlayer.play`."""
        if self._player is not None:
            self._player.play(run)

    def add(self, run: CueRun) -> None:
        """As `MidiPlayer.add`."""
        if self._player is not None:
            self._player.add(run)

    def resume(self, run: CueRun, zero_ns: int, now_ns: int) -> None:
        """As `MidiPlayer.resume`."""
        if self._player is not None:
            self._player.resume(run, zero_ns, now_ns)

    def started(self, zero_ns: int) -> None:
        """As `MidiPlayer.started`."""
        if self._player is not None:
            self._player.started(zero_ns)

    def stop(self) -> None:
        """As `MidiPlayer.stop`."""
        if self._player is not None:
            self._player.stop()

    def advance(self, now_ns: int) -> None:
        """Send what is due; a fault is reported once."""
        if self._player is None:
            return
        self._player.advance(now_ns)
        if self._player.fault is not self._fault:
            self._fault = self._player.fault
            self._notify(f"the demonstration is no longer sent: {self._fault}")
