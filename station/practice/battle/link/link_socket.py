"""The port of a line: datagrams in and out of one UDP socket of IPv4, never waiting.

A port is opened only here, and only by who hosts, joins or looks for hosts.
"""

import socket
from collections.abc import Iterable
from types import TracebackType

from station.core.errors import BadInput, DeviceError
from station.practice.battle.link.link_datagram import MOST_BYTES
from station.practice.battle.link.link_discovery import DEFAULT_PORT
from station.practice.battle.link.link_handshake import Address

MOST_AT_ONCE = 256
"""Datagrams read in one go: a flood costs a step a few milliseconds, and the rest is the system's to drop."""
_LEAST_PORT, MOST_PORT = 1, 65_535


def address_of(written: str, port: int = DEFAULT_PORT, is_numeric: bool = False) -> Address:
    """The address that a user typed, `192.168.1.20`, `station.local` or either with `:port`; raises `BadInput`.

    A name may take seconds to be found; where nobody may wait the address `is_numeric`, and a name is none.
    """
    host, colon, digits = written.strip().partition(":")
    typed = digits if colon else str(port)
    is_number = typed.isascii() and typed.isdigit() and len(typed) <= len(str(MOST_PORT))
    if not (is_number and _LEAST_PORT <= int(typed) <= MOST_PORT):
        raise BadInput("address", written, f"expected a port from {_LEAST_PORT} to {MOST_PORT} after the colon")
    flags = socket.AI_NUMERICHOST if is_numeric else 0
    try:
        found = socket.getaddrinfo(host, int(typed), socket.AF_INET, socket.SOCK_DGRAM, flags=flags)
    except (OSError, UnicodeError):
        raise BadInput("address", written, "no such address; expected one such as 192.168.1.20") from None
    name, number = found[0][4][:2]
    return str(name), int(number)


def own_address() -> str | None:
    """The address under which others of this network reach this computer; None where it is in no network.

    No datagram is sent: the system says only which way it would go to an address that nobody has (RFC 5737).
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked:
        try:
            asked.connect(("192.0.2.1", DEFAULT_PORT))
        except OSError:
            return None
        return str(asked.getsockname()[0])


class LinkSocket:
    """A socket bound to `host` and `port`, 0 for any; raises `DeviceError` where it cannot be had.

    Raises `BadInput` for what is no address.
    """

    def __init__(self, host: str = "", port: int = 0, may_broadcast: bool = False) -> None:
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        try:
            self._socket.setblocking(False)
            if may_broadcast:
                self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
            self._socket.bind((host, port))
        except OSError as fault:
            self._socket.close()
            raise DeviceError(f"port {port} of UDP cannot be opened: {fault.strerror}; choose another port") from None
        except (OverflowError, TypeError):  # no port, or a host that no name's encoding takes
            self._socket.close()
            raise BadInput("address", f"{host}:{port}", f"expected an address, and a port up to {MOST_PORT}") from None

    @property
    def address(self) -> Address:
        """Where it is bound."""
        host, port = self._socket.getsockname()[:2]
        return str(host), int(port)

    def fileno(self) -> int:
        """The system's number, for who waits with `select`."""
        return self._socket.fileno()

    def received(self) -> list[tuple[bytes, Address]]:
        """What has come since the last call, at most `MOST_AT_ONCE`; one too long for a datagram of ours stays so."""
        found: list[tuple[bytes, Address]] = []
        for _ in range(MOST_AT_ONCE):
            try:
                data, source = self._socket.recvfrom(MOST_BYTES + 1)
            except BlockingIOError:
                break
            except OSError:  # Windows: a datagram too long, or an earlier one of ours that nobody took
                continue
            found.append((data, (str(source[0]), int(source[1]))))
        return found

    def send(self, datagrams: Iterable[tuple[bytes, Address]]) -> None:
        """Send them; what the network refuses is lost like any other datagram, and sent again by the channel."""
        for data, target in datagrams:
            try:
                self._socket.sendto(data, target)
            except OSError:
                continue

    def close(self) -> None:
        """Give the port back."""
        self._socket.close()

    def __enter__(self) -> "LinkSocket":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.close()
