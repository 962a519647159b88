"""The engine in a process of its own, which renders no picture: stamps and sound never wait for the window.

`station.engine.engine_main` is what runs there. It ends when it is told, or when its parent is gone, however that came
about; the parent learns of a child's end by the next call of `events` or `send`.
"""

import threading
from contextlib import suppress
from multiprocessing import get_context
from multiprocessing.connection import Connection
from types import TracebackType
from typing import Self

from station.core.errors import DeviceError
from station.core.join_timeout import ends_within
from station.core.processes import ctrl_c_ignored
from station.engine.engine_config import EngineConfig, Prepare
from station.engine.messages import Command, EngineEvent, Quit

QUIT_WITHIN_S = 3.0
"""How long the child may take to write its capture and leave before it is ended by force (our choice)."""


class EngineProcess:
    """The engine as the app sees it: commands go in, events come out; use it as a context manager.

    Without a `config` it waits as a spare, everything imported and nothing opened, until `begin`.
    """

    def __init__(self, config: EngineConfig | None = None) -> None:
        context = get_context("spawn")
        self._events, events_out = context.Pipe(duplex=False)
        commands_in, self._commands = context.Pipe(duplex=False)
        self._process = context.Process(target=_run, args=(commands_in, events_out), name="engine", daemon=True)
        with ctrl_c_ignored():
            self._process.start()
        commands_in.close()  # the child has its own; ours would hide its end from us
        events_out.close()
        self._begun = self._closed = False
        if config is not None:
            self.begin(config)

    def prepare(self, sounds: Prepare) -> None:
        """Let a spare make `sounds` ready for the time when it begins; one that has ended says so when it is needed."""
        assert not self._begun, "what plays has its sounds"
        with suppress(OSError):
            self._commands.send(sounds)

    def begin(self, config: EngineConfig) -> None:
        """Let a spare open what `config` says; one that has ended meanwhile says so at the next call."""
        assert not self._begun, "an engine begins once"
        self._begun = True
        with suppress(OSError):
            self._commands.send(config)

    @property
    def is_alive(self) -> bool:
        """Whether the child runs."""
        return self._process.is_alive()

    @property
    def pid(self) -> int | None:
        """The child's process number."""
        return self._process.pid

    @property
    def exit_code(self) -> int | None:
        """How the child ended, −n by signal n; None while it runs. Waits a little for one that is on its way out."""
        ends_within(self._process, QUIT_WITHIN_S)
        return self._process.exitcode

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
        return DeviceError(f"the sound and MIDI engine has ended (exit code {self.exit_code}); start it again")

    def close(self) -> list[EngineEvent]:
        """End the engine; it writes its capture first. Returns what it still had to say, nothing the second time."""
        if self._closed:
            return []
        self._closed = True
        if self._begun:
            with suppress(OSError):
                self._commands.send(Quit())
        else:
            self._commands.close()
        last_words: list[EngineEvent] = []
        drain = threading.Thread(target=self._drain, args=(last_words,), daemon=True)
        drain.start()  # a child that still has much to say must not wait for us while we wait for it
        if not ends_within(self._process, QUIT_WITHIN_S):
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


def _run(commands: "Connection[None, Command]", events: "Connection[list[EngineEvent], None]") -> None:
    """The child's whole life; what it needs is imported there and not in the app."""
    from station.engine.engine_main import run_engine  # noqa: PLC0415 - heavy, and never needed by the app

    run_engine(commands, events)
