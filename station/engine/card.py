"""Keeps the engine sounding: opens the sound card, and when it goes runs silent until it is back.

A card that is missing from the start is told of once and not asked for again; one that stops in mid-session (unplugged,
its server ended, no block asked for in a while) is tried anew every few seconds, and the session goes on meanwhile.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.engine.engine import Engine, OutputState
from station.sound.drum_kit import Frames
from station.sound.mixer import Mixer
from station.sound.output import Output

STALLED_NS = 2 * NS_PER_S
"""A card that asks for nothing so long has stopped (our choice: every driver's blocks are well under a second)."""
RETRY_NS = 3 * NS_PER_S

OpenOutput = Callable[[], Output]
BuildMixer = Callable[[int], Mixer]


class Card:
    """The engine's sound card. `build_mixer` makes a mixer for a sample rate."""

    def __init__(self, engine: Engine, open_output: OpenOutput, build_mixer: BuildMixer) -> None:
        self._engine = engine
        self._open_output = open_output
        self._build_mixer = build_mixer
        self._mixers: dict[int, Mixer] = {}
        self._output: Output | None = None
        self._underflows = 0
        self._blocks = 0
        self._blocks_seen = 0
        self._alive_ns = 0
        self._retry_ns: int | None = None

    @property
    def name(self) -> str | None:
        """The card that sounds, None while there is none."""
        return self._output.name if self._output is not None else None

    @property
    def rate_hz(self) -> int | None:
        """The rate of the card that sounds, None while there is none."""
        return self._output.rate_hz if self._output is not None else None

    def start(self, now_ns: int) -> None:
        """Open the card; where that fails the user is told, and the engine runs silent."""
        try:
            self._open(now_ns)
        except DeviceError as fault:
            self._engine.notify(f"running silent, on the computer's own clock: {fault}")

    def supervise(self, now_ns: int) -> None:
        """Look after the stream; to be called now and then."""
        if self._output is not None:
            self._watch(self._output, now_ns)
        elif self._retry_ns is not None and now_ns >= self._retry_ns:
            self._reopen(now_ns)

    @contextmanager
    def paused(self) -> Iterator[None]:
        """Keep the sound still for a moment, and with it every callback that could wait for the interpreter lock."""
        output = self._output
        if output is None:
            yield
            return
        try:
            output.pause()
        except DeviceError as fault:
            self._lose(fault, self._alive_ns)
        try:
            yield
        finally:
            if self._output is output:
                self._resume(output)

    def close(self) -> None:
        """Give the card back; the engine runs silent from now on."""
        if self._output is not None:
            self._output.close()
            self._underflows += self._output.underflows
            self._output = None
        self._engine.attach(None)
        self._engine.output = OutputState(underflows=self._underflows)

    def _open(self, now_ns: int) -> None:
        output = self._open_output()
        mixer = self._mixers.get(output.rate_hz)
        if mixer is None:
            mixer = self._mixers[output.rate_hz] = self._build_mixer(output.rate_hz)
        self._engine.attach(mixer)
        try:
            output.start(self._render)
        except DeviceError:
            output.close()
            self._engine.attach(None)
            raise
        self._output, self._alive_ns, self._retry_ns = output, now_ns, None
        self._engine.output = OutputState(output.name, self._underflows, output.latency_ms)

    def _reopen(self, now_ns: int) -> None:
        self._retry_ns = now_ns + RETRY_NS
        try:
            self._open(now_ns)
        except DeviceError:  # told when it went; the next try will come
            return
        self._engine.notify(f"sound is back on {self.name}")

    def _watch(self, output: Output, now_ns: int) -> None:
        if self._blocks != self._blocks_seen:
            self._blocks_seen, self._alive_ns = self._blocks, now_ns
        fault = output.fault
        if fault is None and now_ns - self._alive_ns > STALLED_NS:
            fault = DeviceError(f"sound output {output.name!r} asks for no more sound")
        if fault is None:
            underflows = self._underflows + output.underflows
            self._engine.output = OutputState(output.name, underflows, output.latency_ms, output.load)
            return
        self._lose(fault, now_ns)

    def _resume(self, output: Output) -> None:
        try:
            output.resume()
        except DeviceError as fault:
            self._lose(fault, self._alive_ns)

    def _lose(self, fault: DeviceError, now_ns: int) -> None:
        self.close()
        self._retry_ns = now_ns + RETRY_NS
        self._engine.notify(f"{fault}; the session goes on, silent, and looks for it again")

    def _render(self, frames: int, dac_ns: int) -> Frames:
        self._blocks += 1
        return self._engine.render(frames, dac_ns)
