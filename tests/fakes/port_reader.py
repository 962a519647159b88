"""A process that reads a MIDI port through the station's transport, and can be held up as a busy machine does it.

As a program: `python -m tests.fakes.port_reader PORT`. It says `ready` once the port is open, waits for `count N`,
reads until N messages have come, and says how many did.
"""

import contextlib
import os
import signal
import sys
import time
from collections.abc import Iterator

from station.devices.midi.midi_ports import MidiDirectory
from tests.fakes.child import Child, say
from tests.fakes.jack_server import JackServer

WITHIN_S = 3.0
"""So long a message that is missing is awaited."""


class PortReader(Child):
    """The reader as the test sees it."""

    def __init__(self, server: JackServer, port: str) -> None:
        super().__init__(__name__, [port], server.env)

    @contextlib.contextmanager
    def held_up(self) -> Iterator[None]:
        """Meanwhile the reader gets no time of the processor."""
        os.kill(self.pid, signal.SIGSTOP)
        try:
            yield
        finally:
            os.kill(self.pid, signal.SIGCONT)

    def expect_messages(self, n: int) -> None:
        """Wait until n messages have been read since the port was opened; fails with how many there are."""
        self.tell(f"count {n}")
        self.expect(str(n))


def main(name: str) -> None:
    """The child's whole life."""
    directory = MidiDirectory("jack")
    port = directory.open(name)
    say("ready")
    for line in sys.stdin:
        n, read, give_up_s = int(line.split()[1]), 0, time.monotonic() + WITHIN_S
        while read < n and time.monotonic() < give_up_s:
            read += len(port.read())
            time.sleep(0.005)
        say(str(read))
    port.close()
    directory.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
