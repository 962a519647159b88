"""Keeps the engine sounding: opens the sound card, and when it goes runs silent until it is back.

A card that is missing from the start is reported once, and opened when there is one while no transport runs; one that
stops in mid-session (unplugged, its server ended, no block asked for in a while) is tried anew every few seconds, and
the session goes on meanwhile.
Where a sound server took this process's sound library with it, as JACK does, only a new process sounds again: as soon
as there is an output once more, the card says that this one is worn out. Where the user left the choice to the system,
the sound moves with the system's default, while no transport runs.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial

from station.core.errors import DeviceError
from station.core.units import NS_PER_S
from station.engine.engine import Engine, OutputState
from station.engine.hotplug import Hotplug
from station.engine.messages import Sounding
from station.sound.drum_kit import Frames
from station.sound.mixer import Mixer
from station.sound.output.portaudio import SoundServerGone
from station.sound.output.sound_output import Output

STALLED_NS = 2 * NS_PER_S
"""A card that asks for nothing so long has stopped (our choice: every driver's blocks are well under a second)."""
RETRY_NS = 3 * NS_PER_S
SERVER_LOOK_NS = NS_PER_S // 2
"""How long after a look for a server the next one begins: with the look, and a new engine, it is heard again within two
seconds (our choice)."""
LOOK_EVERY_NS = 10 * NS_PER_S
"""How often it is looked what there is to sound on while nothing plays (our choice: a look costs a quarter of a second
of another process)."""
_JACK = "JACK"
"""The host whose default stays what it is, and whose graph a look would disturb."""

OpenOutput = Callable[[], Output]
BuildMixer = Callable[[int], Mixer]


class Card:
    """The engine's sound card. `build_mixer` makes a mixer for a sample rate, `hotplug` finds what there is to open."""

    def __init__(
        self, engine: Engine, open_output: OpenOutput, build_mixer: BuildMixer, hotplug: Hotplug | None = None
    ) -> None:
        self.is_worn_out = False
        """Whether sound can be had again, but only by a new process."""
        self.before_block: Callable[[int], None] = _nothing
        """What to do at the last moment before a block of so many nanoseconds is mixed, in the card's thread."""
        self._engine = engine
        self._open_output = open_output
        self._build_mixer = build_mixer
        self._hotplug = hotplug
        self._server_is_gone = False
        self._next_look_ns = 0
        self._mixers: dict[int, Mixer] = {}
        self._output: Output | None = None
        self._is_on_jack = False
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
        """Open the card; where that fails the user is notified, and the engine runs silent."""
        try:
            self._open(now_ns)
        except DeviceError as fault:
            self._next_look_ns = now_ns + LOOK_EVERY_NS
            self._engine.notify(f"running silent, on the computer's own clock: {fault}")

    def supervise(self, now_ns: int) -> None:
        """Look after the stream; to be called now and then."""
        if self._output is not None:
            self._watch(self._output, now_ns)
            self._follow_default(now_ns)
        elif self._server_is_gone:
            self._await_server(now_ns)
        elif self._retry_ns is None:
            self._await_first(now_ns)
        elif now_ns >= self._retry_ns:
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

    def server_lives(self) -> bool | None:
        """Whether the JACK server that the sound was opened on still plays it; None where it is on none."""
        if not self._is_on_jack:
            return None
        return self._output is not None and self._output.fault is None

    def forget_others(self) -> None:
        """Forget the mixers of other rates, and without a card all: their sounds are not those that are wanted."""
        rate_hz = self.rate_hz
        self._mixers = {rate: mixer for rate, mixer in self._mixers.items() if rate == rate_hz}

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
        mixer.silence()  # what rang when the last card went is long over
        self._engine.attach(mixer)
        try:
            output.start(partial(self._render, output.rate_hz))
        except DeviceError:
            output.close()
            self._engine.attach(None)
            raise
        self._output, self._alive_ns, self._retry_ns = output, now_ns, None
        self._blocks_seen = -1  # it may stall from the next look on: making the mixer can have taken seconds
        self._is_on_jack = _JACK in output.host
        self._engine.output = OutputState(output.name, self._underflows, output.latency_ms)

    def _reopen(self, now_ns: int) -> None:
        self._retry_ns = now_ns + RETRY_NS
        try:
            self._open(now_ns)
        except SoundServerGone:
            self._server_is_gone = True
            return
        except DeviceError:  # told when it went; the next try will come
            return
        self._engine.notify(f"sound is back on {self.name}")
        self._engine.report(Sounding(self.name, self.rate_hz))

    def _await_first(self, now_ns: int) -> None:
        """Sound as soon as there is something to sound on, where there was nothing from the start."""
        hotplug = self._hotplug
        if hotplug is None or self._engine.is_playing:
            return
        if hotplug.found() is None:
            self._look(hotplug, now_ns)
            return
        try:
            self._open(now_ns)
        except DeviceError:  # it is there and cannot be had; the next look will come
            return
        self._engine.notify(f"sound goes to {self.name}")
        self._engine.report(Sounding(self.name, self.rate_hz))

    def _look(self, hotplug: Hotplug, now_ns: int) -> None:
        if now_ns >= self._next_look_ns:
            self._next_look_ns = now_ns + LOOK_EVERY_NS
            hotplug.begin()

    def _await_server(self, now_ns: int) -> None:
        if self._hotplug is None:
            return
        self.is_worn_out = self.is_worn_out or self._hotplug.found() is not None
        if not self.is_worn_out and self._retry_ns is not None and now_ns >= self._retry_ns:
            self._retry_ns = now_ns + SERVER_LOOK_NS
            self._hotplug.begin()

    def _follow_default(self, now_ns: int) -> None:
        output, hotplug = self._output, self._hotplug
        if output is None or hotplug is None or not hotplug.follows_default or _JACK in output.host:
            return
        if self._engine.is_playing:
            return
        found = hotplug.found()
        if found is not None and found.is_default and found.name != output.name:
            self._move(now_ns)
        else:
            self._look(hotplug, now_ns)

    def _move(self, now_ns: int) -> None:
        """Leave the card for the one that is the system's default by now."""
        self.close()
        try:
            self._open(now_ns)
        except DeviceError as fault:
            self._retry_ns = now_ns + RETRY_NS
            self._engine.notify(f"{fault}; the session goes on, silent, and looks for it again")
        else:
            self._engine.notify(f"the system's default has changed: sound goes to {self.name}")
        self._engine.report(Sounding(self.name, self.rate_hz))

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
        self._server_is_gone = self._is_on_jack and self._hotplug is not None
        self.close()
        self._retry_ns = now_ns + (SERVER_LOOK_NS if self._server_is_gone else RETRY_NS)
        self._engine.notify(f"{fault}; the session goes on, silent, and looks for it again")
        self._engine.report(Sounding(None))

    def _render(self, rate_hz: int, frames: int, dac_ns: int) -> Frames:
        self._blocks += 1
        self.before_block(frames * NS_PER_S // rate_hz)
        return self._engine.render(frames, dac_ns)


def _nothing(_: int) -> None:
    pass
