"""A proxy on loopback, in a thread of its own, which delays, loses and cuts real datagrams by a clock of the test's."""

import select
import socket
import threading
from collections.abc import Callable

from tests.fakes.linked_stations import Network

_LOOPBACK = "127.0.0.1"
_WAIT_S = 0.0005


class UdpProxy:
    """Whoever sends to `address` reaches `host`, and is answered from there, as `network` lets them."""

    def __init__(self, host: tuple[str, int], network: Network, now_ns: Callable[[], int]) -> None:
        self._host, self._network, self._now_ns = host, network, now_ns
        self._front, self._back = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        for side in (self._front, self._back):
            side.bind((_LOOPBACK, 0))
            side.setblocking(False)
        self.address: tuple[str, int] = self._front.getsockname()
        self._guest: tuple[str, int] | None = None
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> "UdpProxy":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._ended.set()
        self._thread.join()
        self._front.close()
        self._back.close()

    def _run(self) -> None:
        while not self._ended.is_set():
            ready, _, _ = select.select([self._front, self._back], [], [], _WAIT_S)
            for side in ready:
                data, source = side.recvfrom(65_536)
                if side is self._front:
                    self._guest = source
                    self._network.send(data, source, self._host, self._now_ns())
                elif self._guest is not None:
                    self._network.send(data, self._host, self._guest, self._now_ns())
            for data, _, target in self._network.arrived(self._now_ns()):
                (self._back if target == self._host else self._front).sendto(data, target)
