"""MIDI ports that we play to: the score and the demonstration on the student's own module, or any synthesiser.

Opening and closing are kept from a sound callback as those of inputs are (`station.devices.midi.midi_clients`); sending
is not, for it neither waits nor changes a driver's graph.
"""

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext

import rtmidi

from station.core.errors import BadInput, DeviceError
from station.devices.midi.midi_clients import APIS, CLIENT_NAME, compiled_drivers, quiet_drivers, why_not

Undisturbed = Callable[[], AbstractContextManager[None]]


class MidiOutPort:
    """One open MIDI output."""

    def __init__(self, name: str, connection: rtmidi.MidiOut, undisturbed: Undisturbed) -> None:
        self.name = name
        self._connection: rtmidi.MidiOut | None = connection
        self._undisturbed = undisturbed

    def send(self, message: bytes) -> None:
        """Send one whole MIDI message now; raises `DeviceError` where the port has gone or was closed."""
        if self._connection is None:
            raise DeviceError(f"{self.name}: this MIDI output is closed")
        try:
            self._connection.send_message(message)
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            raise DeviceError(f"{self.name}: MIDI cannot be sent: {fault}") from fault

    def close(self) -> None:
        """End the connection; harmless when closed already."""
        if self._connection is not None:
            with self._undisturbed():
                self._connection.close_port()
                self._connection.delete()
            self._connection = None


def open_midi_output(driver: str, part: str, undisturbed: Undisturbed = nullcontext) -> MidiOutPort:
    """Open the output whose name contains `part`, letter case aside; an exact name comes first.

    Raises `BadInput` for a driver that there is not, `DeviceError` that names the outputs there are.
    """
    faults: list[DeviceError] = []
    for one in _drivers(driver):
        try:
            return _open(one, part, undisturbed if one == "jack" else nullcontext)
        except DeviceError as fault:
            faults.append(fault)
    for found in faults:
        if isinstance(found, NotThere):  # a driver that works knows better
            raise found
    raise DeviceError(". ".join(["MIDI cannot be sent", *map(str, faults)]))


class NotThere(DeviceError):
    """The driver works, and has no output of that name."""


def _drivers(driver: str) -> tuple[str, ...]:
    compiled = compiled_drivers()
    if driver not in ("auto", *compiled):
        raise BadInput(driver, "", f"no such MIDI driver here; there are auto, {', '.join(compiled)}")
    return compiled if driver == "auto" else (driver,)


def _open(driver: str, part: str, undisturbed: Undisturbed) -> MidiOutPort:
    with undisturbed():
        connection = _new_output(driver)
        try:
            ports = connection.get_ports()
            port = _choose(ports, part)
            connection.open_port(ports.index(port), "out")
        except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError) as fault:
            connection.delete()
            raise DeviceError(f"{part}: this MIDI output cannot be opened: {fault}") from fault
        except DeviceError:
            connection.delete()
            raise
    return MidiOutPort(port, connection, undisturbed)


def _choose(ports: list[str], part: str) -> str:
    foreign = [port for port in ports if CLIENT_NAME not in port]
    exact = [port for port in foreign if port.casefold() == part.casefold()]
    near = [port for port in foreign if part.casefold() in port.casefold()]
    if not (exact or near):
        names = ", ".join(repr(port) for port in foreign) or "none"
        raise NotThere(f"no MIDI output is called {part!r}; there are {names}")
    return (exact or near)[0]


def _new_output(driver: str) -> rtmidi.MidiOut:
    try:
        with quiet_drivers():
            return rtmidi.MidiOut(APIS[driver], f"{CLIENT_NAME} out")
    except (rtmidi.RtMidiError, OSError, RuntimeError, ValueError, SystemError) as fault:
        raise DeviceError(why_not(driver, fault)) from fault
