"""An engine that goes on when its process does not: whoever uses it sees one engine, however many there were.

A spare process waits beside the one that works, everything imported, the sounds ready, and nothing opened. When the
working one ends unasked (killed, crashed, or worn out: its sound library went with the sound server) the spare takes
its place within tenths of a second. It is sent what still holds: levels, MIDI output, track, the capture, which it
continues, and the transport, whose zero stays where it was, for session time is the same in every process. What was
heard until then has been reported; strokes of the moment between are lost, which `Unheard` says to the ns, and the user
reads once what happened.
"""

import threading
from collections import deque
from collections.abc import Callable, Iterable
from contextlib import suppress
from types import TracebackType
from typing import Protocol, Self

import numpy as np

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError
from station.core.events import DeviceFound, DeviceLost
from station.core.pieces import Piece
from station.core.units import NS_PER_S
from station.engine.engine_config import WORN_OUT, EngineConfig, Prepare
from station.engine.engine_process import EngineProcess
from station.engine.messages import (
    AddCues,
    Bus,
    CaptureSaved,
    Command,
    EngineEvent,
    Notice,
    Play,
    Ready,
    RecordCapture,
    Resume,
    SetAirDrums,
    SetBacking,
    SetLevel,
    SetMaster,
    SetMidiOut,
    SetPiece,
    SetSounds,
    Setting,
    Started,
    Status,
    Stop,
    TrackPhase,
    Unheard,
    Watch,
    WatchRawBytes,
    WatchSensors,
)

MOST_RESTARTS = 3
RESTARTS_WITHIN_NS = 30 * NS_PER_S
"""An engine that ends a fourth time within so long ends for good: something is wrong that a new one does not mend."""

KILLED = "the sound and MIDI engine ended ({why}) and was started anew; the session goes on"
SERVER_BACK = "sound can be had again: the engine was started anew; the session goes on"


class Process(Protocol):
    """What is needed of an engine's process."""

    def prepare(self, sounds: Prepare) -> None:
        """Make `sounds` ready for the time when it begins."""
        ...

    def begin(self, config: EngineConfig) -> None:
        """Open what `config` says."""
        ...

    def send(self, command: Command) -> None:
        """Hand over a command; raises `DeviceError` if the process has ended."""
        ...

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What happened since the last call; raises `DeviceError` if the process has ended."""
        ...

    @property
    def exit_code(self) -> int | None:
        """How the process ended."""
        ...

    def close(self) -> list[EngineEvent]:
        """End the process; returns its last words."""
        ...


class EngineSupervisor:
    """The engine as the app uses it; use it as a context manager."""

    def __init__(
        self,
        config: EngineConfig,
        start: Callable[[], Process] = EngineProcess,
        now_ns: Callable[[], int] = monotonic_ns,
    ) -> None:
        self._config = config
        self._start = start
        self._now_ns = now_ns
        self._holds = _Standing()
        self._restarts_ns: deque[int] = deque(maxlen=MOST_RESTARTS)
        self._said: list[EngineEvent] = []
        self._kits_before: set[str] = set()
        self._kits: set[str] = set()
        self._lived_ns: deque[int] = deque([now_ns()], maxlen=2)
        """When the engine was asked the last times and had not ended; at the last time it may have, and not said so."""
        self._deaf_since_ns: int | None = None
        self._ending: list[threading.Thread] = []
        self._process = start()
        self._process.begin(config)
        self._spare: Process | None = None

    def send(self, command: Command) -> None:
        """Hand `command` to the engine; raises `DeviceError` if it has ended for good."""
        self._holds.sent(command, self._now_ns())
        try:
            self._process.send(command)
        except DeviceError as fault:
            self._hear_out()
            self._restart(fault)  # what holds includes the command
            if self._holds.misses(command):
                self._process.send(command)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What happened since the last call; waits up to `wait_s` for something to happen.

        Raises `DeviceError` if the engine has ended for good and all that was said before was returned.
        """
        asked_ns = self._now_ns()
        try:
            heard = self._process.events(0.0 if self._said else wait_s)
            self._lived_ns.append(asked_ns)
        except DeviceError as fault:
            self._restart(fault)
            heard = []
        said, self._said = self._said, []
        return said + [event for event in heard if self._handle(event)] + self._drained()

    def _handle(self, event: EngineEvent) -> bool:
        """Keep in mind what happened; whether it is news."""
        self._holds.heard(event)
        match event:
            case Ready(_, rate_hz) if self._spare is None:  # not sooner: it would compete with the one that is awaited
                if not self._kits_before:
                    self._hears_again(self._now_ns())
                self._spare = self._start()
                if rate_hz is not None:
                    self._spare.prepare(Prepare(self._config.drums, self._config.click, rate_hz))
            case DeviceFound(at_ns, device):
                self._kits.add(device)
                if device in self._kits_before:
                    self._kits_before.discard(device)
                    if not self._kits_before:
                        self._hears_again(at_ns)
                    return False
            case DeviceLost(_, device):
                self._kits.discard(device)
            case Status(at_ns) if self._kits_before:  # a second has passed: what has not come back is gone
                self._said += [DeviceLost(at_ns, device) for device in sorted(self._kits_before)]
                self._kits_before.clear()
                self._hears_again(at_ns)
            case _:
                pass
        return True

    def _hears_again(self, at_ns: int) -> None:
        """All kits that can be heard are heard again."""
        if self._deaf_since_ns is not None:
            self._said.append(Unheard(self._deaf_since_ns, at_ns))
            self._deaf_since_ns = None

    def _hear_out(self) -> None:
        """Keep what a process that has ended said before."""
        with suppress(DeviceError):
            for event in self._process.events():
                if self._handle(event):
                    self._said.append(event)

    def _drained(self) -> list[EngineEvent]:
        said, self._said = self._said, []
        return said

    def _restart(self, fault: DeviceError) -> None:
        """Let the spare take the place of a process that has ended; raises `fault` where that happens too often."""
        now_ns = self._now_ns()
        is_worn_out = self._process.exit_code == WORN_OUT  # it is as the world wants it, however often a server ends
        often = len(self._restarts_ns) == MOST_RESTARTS and now_ns - self._restarts_ns[0] < RESTARTS_WITHIN_NS
        if often and not is_worn_out:
            raise fault
        if not is_worn_out:
            self._restarts_ns.append(now_ns)
        if self._deaf_since_ns is None:
            self._deaf_since_ns = self._lived_ns[0]
        ended, self._process = self._process, self._spare or self._start()
        self._spare = None
        self._process.begin(self._config)
        for command in self._holds.commands(now_ns):
            with suppress(DeviceError):  # one that has ended as well is found out by the next call
                self._process.send(command)
        self._kits_before |= self._kits
        self._kits.clear()
        self._said.append(Notice(_why(ended.exit_code)))
        self._ending.append(threading.Thread(target=ended.close, daemon=True))
        self._ending[-1].start()

    def close(self) -> list[EngineEvent]:
        """End the engine; it writes its capture first. Returns what it still had to say."""
        if self._spare is not None:
            self._spare.close()
        last_words = self._said + self._process.close()
        self._said = []
        for ending in self._ending:
            ending.join()
        return last_words

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


def _why(exit_code: int | None) -> str:
    if exit_code == WORN_OUT:
        return SERVER_BACK
    return KILLED.format(why=f"by signal {-exit_code}" if exit_code is not None and exit_code < 0 else exit_code)


class _Standing:
    """What an engine has been sent that still holds."""

    def __init__(self) -> None:
        self._play: Play | None = None
        self._sent_ns = 0
        self._zero_ns: int | None = None
        self._levels: dict[Bus, SetLevel] = {}
        self._pieces: dict[Piece, SetPiece] = {}
        self._others: dict[type[Command], Command] = {}  # of these the last one holds
        self._unanswered = False

    def sent(self, command: Command, now_ns: int) -> None:
        """`command` was sent at `now_ns`."""
        match command:
            case Play():
                self._play, self._sent_ns, self._zero_ns = command, now_ns, None
            case Resume(cues, zero_ns):
                self._play, self._sent_ns, self._zero_ns = Play(cues, 0), now_ns, zero_ns
            case AddCues(cues):
                if self._play is not None:  # what goes on sounds all of it
                    self._play = Play(np.concatenate([self._play.cues, cues]), self._play.start_in_ns)
            case Stop():
                self._play = None
            case SetLevel():
                self._levels[command.bus] = command
            case SetPiece():
                self._pieces[command.piece] = command
            case (
                SetMaster()
                | SetSounds()
                | SetBacking()
                | SetMidiOut()
                | SetAirDrums()
                | TrackPhase()
                | WatchRawBytes()
                | WatchSensors()
            ):
                self._others[type(command)] = command
            case RecordCapture():
                self._others[RecordCapture] = command
                self._unanswered = True
            case _:
                pass

    def misses(self, command: Command) -> bool:
        """Whether `commands` leaves `command` out."""
        return not isinstance(command, Play | AddCues | Stop | Setting | Watch | RecordCapture)

    def heard(self, event: EngineEvent) -> None:
        """The engine said `event`."""
        match event:
            case Started(zero_ns):
                self._zero_ns = zero_ns
            case CaptureSaved():
                self._unanswered = False
            case _:
                pass

    def commands(self, now_ns: int) -> Iterable[Command]:
        """What a new engine is sent at `now_ns`, in order."""
        yield from self._levels.values()
        yield from self._pieces.values()
        for kind in (SetMaster, SetSounds, SetBacking, SetMidiOut, SetAirDrums, WatchRawBytes, WatchSensors):
            if kind in self._others:
                yield self._others[kind]
        record = self._others.get(RecordCapture)
        if isinstance(record, RecordCapture) and (record.path is not None or self._unanswered):
            yield record
        if TrackPhase in self._others:  # its note belongs into the capture
            yield self._others[TrackPhase]
        if self._play is None:
            return
        if self._zero_ns is not None:
            yield Resume(self._play.cues, self._zero_ns)
        else:
            yield Play(self._play.cues, max(0, self._sent_ns + self._play.start_in_ns - now_ns))
