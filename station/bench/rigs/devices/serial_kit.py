"""A home-built module on a serial line, played by a pty: plugged in and out at one path, it speaks bytes.

The path is a link to the pty, as /dev/serial/by-id links to /dev/ttyUSB0, so that it stays over plug cycles. A pty
passes bytes on at once, whatever its rate; `play_at_wire_speed` waits for each as a UART would.
"""

import fcntl
import os
import pty
import struct
from pathlib import Path

from station.core.clock import monotonic_ns

_TCGETS2 = 0x802C542A  # asm-generic/ioctls.h: read struct termios2, whose last two words are the speeds
_TERMIOS2 = struct.Struct("=4I B 19s 2I")


class SerialKit:
    """The module and its cable; use it as a context manager."""

    def __init__(self, path: Path, plugged: bool = True) -> None:
        self.path = path
        self._master = -1
        if plugged:
            self.plug()

    @property
    def device(self) -> str:
        """What names it on the command line, such as `serial:/dev/ttyUSB0`."""
        return f"serial:{self.path}"

    def plug(self) -> None:
        """Put the cable in: the path appears."""
        self._master, slave = pty.openpty()
        name = os.ttyname(slave)
        os.close(slave)
        self.path.symlink_to(name)

    def unplug(self) -> None:
        """Pull the cable: the path vanishes, and who has it open is hung up on."""
        if self._master >= 0:
            self.path.unlink()
            os.close(self._master)
            self._master = -1

    def play(self, data: bytes) -> None:
        """Send all of `data` at once."""
        os.write(self._master, data)

    def play_at_wire_speed(self, data: bytes, baud: int) -> list[int]:
        """Send each byte when it would have come over a wire; the monotonic times at which they were sent."""
        sent_ns = []
        due_ns = monotonic_ns()
        for index in range(len(data)):
            due_ns += 10_000_000_000 // baud
            while monotonic_ns() < due_ns:
                pass
            sent_ns.append(monotonic_ns())
            os.write(self._master, data[index : index + 1])
        return sent_ns

    def heard(self, count: int) -> bytes:
        """The next `count` bytes that the station has written; waits for them."""
        found = b""
        while len(found) < count:
            found += os.read(self._master, count - len(found))
        return found

    def rate(self) -> tuple[int, int]:
        """The input and output rates that the station has set, as the kernel keeps them."""
        settings = bytearray(_TERMIOS2.size)
        fcntl.ioctl(self._master, _TCGETS2, settings)
        *_, input_baud, output_baud = _TERMIOS2.unpack(settings)
        return input_baud, output_baud

    def __enter__(self) -> "SerialKit":
        return self

    def __exit__(self, *_: object) -> None:
        self.unplug()
