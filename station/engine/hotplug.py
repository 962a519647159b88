"""Looks out for sound outputs while the engine plays: in a process of its own, awaited in a thread of its own.

It is asked while there is no sound that it could disturb, or while the transport stands.
"""

import threading
from collections.abc import Callable
from contextlib import suppress

from station.core.errors import DeviceError
from station.sound.output.card_stream import SoundDevice
from station.sound.output.list_outputs import outputs_now
from station.sound.output.sound_output import choose_output

ListDevices = Callable[[], list[SoundDevice]]


class Hotplug:
    """Finds what the user's choice `wanted` (part of a name, empty for the system's default) means at present."""

    def __init__(self, wanted: str, list_devices: ListDevices = outputs_now) -> None:
        self._wanted = wanted
        self._list_devices = list_devices
        self._looking: threading.Thread | None = None
        self._found: SoundDevice | None = None

    @property
    def follows_default(self) -> bool:
        """Whether the user left the choice to the system."""
        return not self._wanted

    def begin(self) -> None:
        """Look, unless a look is on its way."""
        if self._looking is None:
            self._looking = threading.Thread(target=self._run, name="look for sound outputs", daemon=True)
            self._looking.start()

    def found(self) -> SoundDevice | None:
        """The output that would be opened now; None while a look is on its way, or where there is none."""
        if self._looking is None or self._looking.is_alive():
            return None
        self._looking = None
        return self._found

    def _run(self) -> None:
        self._found = None
        with suppress(DeviceError):  # there is none; whoever wants sound asks again
            self._found = choose_output(self._list_devices(), self._wanted)
