"""PortAudio's life: loaded when sound is first wanted, started for each use, ended with the last.

PortAudio looks for devices only when it starts. So it runs no longer than somebody needs it, and what was plugged in,
or started, since then is found the next time. A sound server that dies takes its stream with it: PortAudio then waits
for it ten minutes when the stream is closed (JACK), and aborts the process when it is ended itself. Such a PortAudio is
abandoned as it is, and the process has no further sound.
"""

import atexit
from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock
from types import ModuleType

from station.core.errors import DeviceError

NO_PORTAUDIO = (
    "no sound: the PortAudio library is missing; on Debian and Ubuntu `apt install libportaudio2`, "
    "elsewhere `pip install --force-reinstall sounddevice`"
)
SERVER_GONE = "no sound: the sound server has ended; start it, then start the station again"


class SoundServerGone(DeviceError):
    """The process that raises it will never sound again; a new one will, as soon as there is a server."""


class PortAudio:
    """Counts who uses the library; one for the whole process, as the library is."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._users = 0
        self._abandoned = False

    def acquire(self) -> ModuleType:
        """The running library (the module sounddevice), until `release`.

        Raises `DeviceError`, and of these `SoundServerGone` where only a new process helps.
        """
        with self._lock:
            if self._abandoned:
                raise SoundServerGone(SERVER_GONE)
            sd = _sounddevice()
            if not sd._initialized:
                try:
                    sd._initialize()
                except sd.PortAudioError as fault:
                    raise DeviceError(f"the sound system does not start: {fault}") from fault
            self._users += 1
            return sd

    def release(self) -> None:
        """Undo one `acquire`; the last one ends the library."""
        with self._lock:
            self._users -= 1
            if self._users or self._abandoned:
                return
            sd = _sounddevice()
            while sd._initialized:  # importing it has started it once more
                sd._terminate()

    def abandon(self) -> None:
        """Never touch the library again, not even at the end of the process."""
        with self._lock:
            self._abandoned = True
            atexit.unregister(_sounddevice()._exit_handler)

    @contextmanager
    def running(self) -> Iterator[ModuleType]:
        """The running library for the length of a block; raises `DeviceError`."""
        sd = self.acquire()
        try:
            yield sd
        finally:
            self.release()


PORTAUDIO = PortAudio()


def _sounddevice() -> ModuleType:
    try:
        import sounddevice  # noqa: PLC0415 - loads PortAudio, which may be missing
    except OSError as fault:
        raise DeviceError(NO_PORTAUDIO) from fault
    module: ModuleType = sounddevice
    return module
