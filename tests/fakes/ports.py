"""A fake MIDI driver: ports that are plugged in and out and speak bytes, behind the seam where rtmidi sits."""

from collections import deque

from station.core.errors import DeviceError
from station.devices.mapping.presets import stable_name
from station.devices.transport import Packet


class FakePort:
    """An open connection; what `FakeDriver.play` sends to its port arrives here."""

    def __init__(self, port: str) -> None:
        self.name = stable_name(port)
        self.is_open = True
        self._arrived: deque[Packet] = deque()

    def arrive(self, packet: Packet) -> None:
        if self.is_open:
            self._arrived.append(packet)

    def read(self) -> list[Packet]:
        packets = list(self._arrived)
        self._arrived.clear()
        return packets

    def close(self) -> None:
        self.is_open = False
        self._arrived.clear()


class FakeDriver:
    """A `PortDirectory` whose ports a test plugs in, plays and pulls out."""

    def __init__(self, *ports: str) -> None:
        self.ports = list(ports)
        self.taken: set[str] = set()
        self.opened: dict[str, list[FakePort]] = {}
        self.left = False

    def names(self) -> list[str]:
        return list(self.ports)

    def open(self, port: str) -> FakePort:
        if port not in self.ports or port in self.taken:
            raise DeviceError(f"{port}: gone or taken")
        connection = FakePort(port)
        self.opened.setdefault(port, []).append(connection)
        return connection

    def close(self) -> None:
        """Nobody looks for ports here any more."""
        self.left = True

    def play(self, port: str, data: bytes, at_ns: int) -> None:
        if port in self.ports:
            for connection in self.opened.get(port, []):
                connection.arrive(Packet(data, at_ns))

    def plug(self, port: str) -> None:
        self.ports.append(port)

    def unplug(self, port: str) -> None:
        self.ports.remove(port)

    @property
    def open_connections(self) -> int:
        return sum(connection.is_open for connections in self.opened.values() for connection in connections)
