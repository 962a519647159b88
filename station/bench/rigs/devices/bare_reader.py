"""A terminal line read as plainly as Python can: the best that stamps could be on this computer, beside the engine's.

As a program: `python -m station.bench.rigs.devices.bare_reader PATH MESSAGES SIZE` waits for bytes at PATH, in real
time if it may; it says `ready`, and after so many messages of SIZE bytes the JSON list of when each was whole, in
monotonic ns.
"""

import json
import os
import sys
import tty

from station.core.clock import monotonic_ns
from station.engine.priority import be_real_time

_MOST = 4_096


def main(path: str, messages: str, size: str) -> None:
    """The program's whole life."""
    line = os.open(path, os.O_RDONLY | os.O_NOCTTY)
    tty.setraw(line)
    be_real_time()
    _say("ready")
    read_ns: list[int] = []
    while len(read_ns) < int(messages) * int(size):
        data = os.read(line, _MOST)
        read_ns += [monotonic_ns()] * len(data)
    _say(json.dumps(read_ns[int(size) - 1 :: int(size)]))


def _say(line: str) -> None:
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    main(*sys.argv[1:])
