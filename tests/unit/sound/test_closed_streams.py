"""Closed streams are freed at once: the engine runs without the garbage collector, so what is not stays for good.

The library is a fake in the place of `sounddevice`; like the real one, each of its streams and the callback that it
makes for the driver hold each other.
"""

import gc
import sys
import weakref
from collections.abc import Callable, Iterator
from threading import Event, Thread
from types import ModuleType, SimpleNamespace
from typing import Any

import numpy as np
import pytest

from station.core.errors import DeviceError
from station.sound.drum_kit import Frames
from station.sound.output import card_stream, sound_output
from station.sound.output.card_input import open_input
from station.sound.output.card_output import CardOutput
from station.sound.output.portaudio import PortAudio, SoundServerGone
from station.sound.output.sound_output import open_output

BLOCK_FRAMES = 64
STREAMS: "weakref.WeakSet[Stream]" = weakref.WeakSet()


class PortAudioError(Exception):
    pass


class CallbackAbort(Exception):
    pass


class Stream:
    """Asks for blocks in a thread of its own until it is stopped, or the callback fails."""

    latency, time = 0.01, 0.0

    def __init__(self, channels: int, callback: Callable[..., None], **_: object) -> None:
        def ask() -> None:
            times = SimpleNamespace(currentTime=0.0, outputBufferDacTime=0.0, inputBufferAdcTime=0.0)
            status = SimpleNamespace(output_underflow=False, input_overflow=False)
            callback(np.zeros((BLOCK_FRAMES, self.channels), np.float32), BLOCK_FRAMES, times, status)

        self.channels = channels
        self._callback = ask
        self._stopped = Event()
        self._driver: Thread | None = None
        STREAMS.add(self)

    @property
    def active(self) -> bool:
        return self._driver is not None and self._driver.is_alive()

    def start(self) -> None:
        self._driver = Thread(target=drive, args=(self._callback, self._stopped))
        self._driver.start()

    def stop(self) -> None:
        self._stopped.set()
        if self._driver is not None:
            self._driver.join()

    close = stop


def drive(ask: Callable[[], None], stopped: Event) -> None:
    try:
        while not stopped.is_set():
            ask()
    except CallbackAbort:
        pass


@pytest.fixture(autouse=True)
def _sounddevice(monkeypatch: pytest.MonkeyPatch) -> None:
    library: Any = ModuleType("sounddevice")
    library._initialized = 1
    library._terminate = lambda: setattr(library, "_initialized", 0)
    library.PortAudioError, library.CallbackAbort = PortAudioError, CallbackAbort
    library.check_output_settings = library.check_input_settings = lambda **_: None
    library.query_hostapis = lambda: [{"name": "ALSA"}]
    library.query_devices = lambda: [
        {
            "index": 0,
            "name": "a card",
            "hostapi": 0,
            "max_input_channels": 2,
            "max_output_channels": 2,
            "default_samplerate": 48_000.0,
        }
    ]
    library.default = SimpleNamespace(device=(0, 0))
    library.OutputStream = library.InputStream = Stream
    monkeypatch.setitem(sys.modules, "sounddevice", library)


@pytest.fixture(autouse=True)
def _no_collector() -> Iterator[None]:
    gc.collect()
    gc.disable()
    yield
    gc.enable()


def silence(frames: int, _dac_ns: int) -> Frames:
    return np.zeros((frames, 2), np.float32)


def broken(_frames: int, _dac_ns: int) -> Frames:
    raise ValueError("no sound")


def played(render: Callable[[int, int], Frames]) -> CardOutput:
    output = open_output()
    output.start(render)
    return output


def test_a_closed_output_is_freed() -> None:
    output = played(silence)
    freed = weakref.ref(output)
    output.close()
    output.close()
    assert output.fault is None
    del output
    assert freed() is None
    assert not STREAMS


def test_a_closed_input_is_freed() -> None:
    recorder = open_input()
    recorder.start()
    freed = weakref.ref(recorder)
    recorder.close()
    del recorder
    assert freed() is None
    assert not STREAMS


def test_an_output_that_failed_and_was_told_of_is_freed() -> None:
    output = played(broken)
    freed = weakref.ref(output)
    while output.fault is None:
        pass
    try:
        output.pause()
    except DeviceError as fault:
        assert "ValueError('no sound')" in str(fault)  # noqa: PT017 - pytest.raises would hold on to it
    output.close()
    del output
    assert freed() is None
    assert not STREAMS


def test_a_stream_whose_jack_server_has_ended_is_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """To close it would end the process: PortAudio asserts that JACK takes its ports back."""
    library = sys.modules["sounddevice"]
    library.query_hostapis = lambda: [{"name": "JACK Audio Connection Kit"}]  # type: ignore[attr-defined]
    port_audio = PortAudio()
    for module in (card_stream, sound_output):
        monkeypatch.setattr(module, "PORTAUDIO", port_audio)
    library._exit_handler = lambda: None  # type: ignore[attr-defined]
    output = played(silence)
    (stream,) = STREAMS
    stream._stopped.set()  # the server is gone: nobody asks any more
    while output.fault is None:
        pass
    monkeypatch.setattr(stream, "close", lambda: pytest.fail("it was closed"))
    monkeypatch.setattr(stream, "stop", lambda: pytest.fail("it was stopped"))
    output.close()
    with pytest.raises(SoundServerGone):
        port_audio.acquire()
