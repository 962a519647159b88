"""The engine in a process of its own, which renders no picture: stamps and sound never wait for the window.

The child polls the kits every half millisecond in its main thread; the sound card's driver asks for blocks in a thread
of its own; two more threads carry commands in and events out, so that neither a busy app nor a full pipe holds up a
stroke. The child ends when it is told, or when its parent is gone, however that came about; the parent learns of a
child's end by the next call of `events` or `send`.
"""

import gc
import os
import signal
import sys
import threading
import time
import traceback
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext, suppress
from dataclasses import dataclass, replace
from multiprocessing import get_context
from multiprocessing.connection import Connection
from queue import SimpleQueue
from types import TracebackType
from typing import Self

from station.core.clock import monotonic_ns
from station.core.errors import DeviceError, StationError
from station.core.settings import Settings
from station.devices.kit_file import own_kit
from station.devices.kit_ports import KitWish, parse_kits, watch_kits
from station.devices.midi_out import open_midi_output
from station.devices.watch import KitWatch
from station.engine.card import Card
from station.engine.engine import Engine
from station.engine.messages import Bus, Command, EngineEvent, Notice, Quit, Ready, SetBacking, SetLevel
from station.engine.runner import Runner
from station.sound.buses import ClickVoice
from station.sound.click import DEFAULT_TIMBRE, click_sounds
from station.sound.drum_kit import DrumKit, Frames
from station.sound.kits.load import DEFAULT_KIT, load_kit
from station.sound.mixer import Mixer
from station.sound.output import open_output
from station.sound.track import load

POLL_S = 0.0004
"""Pause between two looks at the kits; with the work itself and the system's timer slack about half a millisecond."""
SWITCH_INTERVAL_S = 0.0002
"""How soon the audio callback gets the interpreter lock; 5 ms, Python's own choice, is four blocks of sound."""
QUIT_WITHIN_S = 3.0
"""How long the child may take to write its capture and leave before it is ended by force (our choice)."""
NICENESS = -11
"""What desktop sound servers run at; granted only to those whom the system lets."""


@dataclass(frozen=True, slots=True)
class EngineConfig:
    """What the engine process opens.

    `kits` are those to listen to, none for an engine without; `midi_driver` is "auto" or one of
    `station.devices.midi_ports.compiled_drivers()`; `output`, `block_frames`, `rate_hz`, `drums`, `click`
    and `own_sound` stand as in `Settings`; without `sound` no card is opened.
    """

    kits: tuple[KitWish, ...] = (KitWish(""),)
    midi_driver: str = "auto"
    sound: bool = True
    output: str = ""
    block_frames: int = 0
    rate_hz: int = 48_000
    drums: str = DEFAULT_KIT
    click: str = DEFAULT_TIMBRE
    own_sound: bool = True

    @classmethod
    def from_settings(cls, settings: Settings) -> Self:
        """What a user has chosen; raises `BadInput` for kits that cannot be meant."""
        return cls(
            kits=parse_kits(settings.kit),
            output=settings.output,
            block_frames=settings.block_frames,
            rate_hz=settings.rate_hz,
            drums=settings.drums,
            click=settings.click,
            own_sound=settings.own_sound,
        )

    @property
    def first_commands(self) -> tuple[Command, ...]:
        """What the engine is told before anything else."""
        return () if self.own_sound else (SetLevel(Bus.STUDENT, 0.0),)


class EngineProcess:
    """The engine as the app sees it: commands go in, events come out; use it as a context manager."""

    def __init__(self, config: EngineConfig | None = None) -> None:
        context = get_context("spawn")
        self._events, events_out = context.Pipe(duplex=False)
        commands_in, self._commands = context.Pipe(duplex=False)
        self._process = context.Process(
            target=run_engine, args=(config or EngineConfig(), commands_in, events_out), name="engine", daemon=True
        )
        with _ctrl_c_ignored():
            self._process.start()
        commands_in.close()  # the child has its own; ours would hide its end from us
        events_out.close()
        self._closed = False

    @property
    def is_alive(self) -> bool:
        """Whether the child runs."""
        return self._process.is_alive()

    @property
    def pid(self) -> int | None:
        """The child's process number."""
        return self._process.pid

    def send(self, command: Command) -> None:
        """Hand `command` to the engine; raises `DeviceError` if the engine has ended."""
        try:
            self._commands.send(command)
        except OSError:
            raise self._ended() from None

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What happened since the last call; waits up to `wait_s` for something to happen.

        Raises `DeviceError` if the engine has ended and all that it said before was returned.
        """
        events: list[EngineEvent] = []
        try:
            while self._events.poll(0.0 if events else wait_s):
                events += self._events.recv()
        except (EOFError, OSError):
            if not events:
                raise self._ended() from None
        return events

    def _ended(self) -> DeviceError:
        self._process.join(QUIT_WITHIN_S)
        return DeviceError(f"the sound and MIDI engine has ended (exit code {self._process.exitcode}); start it again")

    def close(self) -> list[EngineEvent]:
        """End the engine; it writes its capture first. Returns what it still had to say, nothing the second time."""
        if self._closed:
            return []
        self._closed = True
        with suppress(OSError):
            self._commands.send(Quit())
        last_words: list[EngineEvent] = []
        drain = threading.Thread(target=self._drain, args=(last_words,), daemon=True)
        drain.start()  # a child that still has much to say must not wait for us while we wait for it
        self._process.join(QUIT_WITHIN_S)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        drain.join()
        self._commands.close()
        self._events.close()
        self._process.close()
        return last_words

    def _drain(self, last_words: list[EngineEvent]) -> None:
        with suppress(EOFError, OSError):
            while True:
                last_words += self._events.recv()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, fault: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()


@contextmanager
def _ctrl_c_ignored() -> Iterator[None]:
    """What is started meanwhile ignores Ctrl-C from its first instruction on; ours is as before afterwards.

    Only the main thread may change that (Python's documentation of `signal`); another one starts the child as it is.
    """
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or before is None:  # None: not Python's to restore
        yield
        return
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


# --- in the child ----------------------------------------------------------------------------------------------------


def run_engine(
    config: EngineConfig, commands: "Connection[None, Command]", events: "Connection[list[EngineEvent], None]"
) -> None:
    """The child's whole life."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C reaches both; the parent asks the child to quit
    if hasattr(os, "nice"):
        with suppress(OSError):
            os.nice(NICENESS)
    outbox = _Outbox(events)
    inbox = _Inbox(commands)
    try:
        _live(config, inbox, outbox)
    except Exception as fault:
        traceback.print_exc()
        outbox.put([Notice(f"the sound and MIDI engine failed: {fault!r}")])
        raise SystemExit(1) from fault
    finally:
        outbox.close()


def _live(config: EngineConfig, inbox: "_Inbox", outbox: "_Outbox") -> None:
    engine = Engine(open_midi_out=lambda port: open_midi_output(config.midi_driver, port, undisturbed), own_kit=own_kit)
    card = _card(engine, config) if config.sound else None
    undisturbed = card.paused if card is not None else nullcontext
    runner = Runner(engine, _kits(engine, config, card), card)
    for command in config.first_commands:
        engine.handle(command)
    try:
        runner.start(monotonic_ns())
        sys.setswitchinterval(SWITCH_INTERVAL_S)  # not before: making the drum kit takes long turns
        gc.collect()
        gc.freeze()
        gc.disable()  # a collection in the audio thread is a late block; what runs from here on makes no cycles
        outbox.put([Ready(card.name, card.rate_hz) if card is not None else Ready(None)])
        while not (engine.quitting or inbox.is_closed):
            commands = inbox.take()
            happened = runner.step(monotonic_ns())  # after taking them: what was played before a command counts before
            if happened:
                outbox.put(happened)
            for command in commands:
                engine.handle(command)
            time.sleep(POLL_S)
    finally:
        runner.close()
        outbox.put(engine.advance(monotonic_ns()))


def _kits(engine: Engine, config: EngineConfig, card: Card | None) -> tuple[KitWatch, ...]:
    undisturbed = card.paused if card is not None else nullcontext
    watches = watch_kits(config.kits, config.midi_driver, monotonic_ns, undisturbed)
    if watches.fault is not None:
        engine.notify(f"no MIDI kit can be heard: {watches.fault}")
    return watches.kits


def _card(engine: Engine, config: EngineConfig) -> Card:
    return Card(
        engine,
        lambda: open_output(config.output, config.block_frames, config.rate_hz),
        lambda rate_hz: Mixer(_drums(engine, config.drums, rate_hz), _clicks(engine, config.click, rate_hz)),
    )


def _drums(engine: Engine, name: str, rate_hz: int) -> DrumKit:
    """The kit called `name`; where it cannot be had the user is told, and the default one plays."""
    try:
        return load_kit(name, rate_hz)
    except StationError as fault:
        engine.notify(f"{fault}; the {DEFAULT_KIT} kit plays instead")
        return load_kit(DEFAULT_KIT, rate_hz)


def _clicks(engine: Engine, timbre: str, rate_hz: int) -> dict[ClickVoice, Frames]:
    """The clicks of `timbre`, likewise."""
    try:
        return click_sounds(rate_hz, timbre)
    except StationError as fault:
        engine.notify(f"{fault}; the click called {DEFAULT_TIMBRE} plays instead")
        return click_sounds(rate_hz)


class _Outbox:
    """Carries events to the parent in a thread of its own, for a pipe can be full."""

    def __init__(self, events: "Connection[list[EngineEvent], None]") -> None:
        self._events = events
        self._queue: SimpleQueue[list[EngineEvent] | None] = SimpleQueue()
        self._thread = threading.Thread(target=self._run, name="events", daemon=True)
        self._thread.start()

    def put(self, events: list[EngineEvent]) -> None:
        """Send `events` soon."""
        self._queue.put(events)

    def close(self) -> None:
        """Wait until everything is sent, or the parent is gone."""
        self._queue.put(None)
        self._thread.join(QUIT_WITHIN_S / 2)

    def _run(self) -> None:
        with suppress(OSError):
            while (events := self._queue.get()) is not None:
                self._events.send(events)


class _Inbox:
    """Receives commands in a thread of its own; closed once the parent is gone."""

    def __init__(self, commands: "Connection[None, Command]") -> None:
        self._commands = commands
        self._received: deque[Command] = deque()
        self.is_closed = False
        threading.Thread(target=self._run, name="commands", daemon=True).start()

    def take(self) -> list[Command]:
        """The commands since the last call."""
        commands = []
        while self._received:
            commands.append(self._received.popleft())
        return commands

    def _run(self) -> None:
        try:
            while True:
                self._received.append(_loaded(self._commands.recv()))
        except (EOFError, OSError):
            self.is_closed = True


def _loaded(command: Command) -> Command:
    """The command, with a track's file read here, where nobody waits; a fault is left for the engine to find."""
    if isinstance(command, SetBacking) and command.track is not None:
        with suppress(DeviceError):
            return replace(command, loaded=load(command.track))
    return command
