"""A fake kit in a process of its own, so that no picture delays a stroke: `pty_kit.py PATH`.

Lines of its input are strokes to come, `AT_NS HEX` (monotonic time, bytes), or `rest`: none of those that were still to
come. The serial line lies at PATH until its input ends; it says `ready` once it does.
"""

import heapq
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT))

from station.bench.rigs.devices.serial_kit import SerialKit  # noqa: E402
from station.core.units import NS_PER_S  # noqa: E402

_FINE_S = 0.002


class PtyKit:
    """Plays what is due on `kit`."""

    def __init__(self, kit: SerialKit) -> None:
        self._kit = kit
        self._due: list[tuple[int, int, bytes]] = []
        self._count = 0
        self._change = threading.Condition()

    def tell(self, line: str) -> None:
        """Take a line of the input."""
        words = line.split()
        with self._change:
            if words == ["rest"]:
                self._due.clear()
            else:
                self._count += 1
                heapq.heappush(self._due, (int(words[0]), self._count, bytes.fromhex(words[1])))
            self._change.notify()

    def play(self) -> None:
        """Play for ever, each stroke at its time."""
        while True:
            with self._change:
                while not self._due or self._wait_s() > _FINE_S:
                    self._change.wait(self._wait_s() - _FINE_S if self._due else None)
                at_ns, _, data = heapq.heappop(self._due)
            while time.monotonic_ns() < at_ns:
                time.sleep(0.0002)
            self._kit.play(data)

    def _wait_s(self) -> float:
        return (self._due[0][0] - time.monotonic_ns()) / NS_PER_S


def main(path: str) -> None:
    """Play until the input ends."""
    with SerialKit(Path(path)) as kit:
        player = PtyKit(kit)
        threading.Thread(target=player.play, daemon=True).start()
        sys.stdout.write("ready\n")
        sys.stdout.flush()
        for line in sys.stdin:
            player.tell(line)


if __name__ == "__main__":
    main(*sys.argv[1:])
