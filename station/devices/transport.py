"""What every way in has in common: whole or partial messages as bytes, each with the session time at which it came.

A transport never waits: `read` gives what has come since the last call, and an empty list where nothing has. It stamps
with the driver's own time where there is one, else by the moment at which the bytes were read.
"""

from typing import NamedTuple, Protocol


class Packet(NamedTuple):
    """Bytes as they came, and the session time (monotonic ns) at which they did."""

    data: bytes
    at_ns: int


class Transport(Protocol):
    """An open connection to one device."""

    @property
    def name(self) -> str:
        """The device's name, the same after it is unplugged and plugged in again."""
        ...

    def read(self) -> list[Packet]:
        """What has come since the last call, in order, with times that never go back.

        Raises `DeviceError` where the device has gone and its driver says so.
        """
        ...

    def close(self) -> None:
        """End the connection; closing twice is harmless, and a closed transport reads as empty."""
        ...


class PortDirectory(Protocol):
    """The ports that one kind of driver offers at present."""

    def names(self) -> list[str]:
        """The ports that could be opened now, as the driver calls them."""
        ...

    def open(self, port: str) -> Transport:
        """Open one of `names()`; raises `DeviceError` where it has gone or is taken."""
        ...
