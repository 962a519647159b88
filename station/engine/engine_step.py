"""One step of the engine's life: look at the kits, feed what they sent, look after the card, move on."""

import threading
import time
from collections.abc import Callable, Sequence

from station.core.units import NS_PER_MS
from station.devices.port_watch import PortWatch
from station.engine.card import Card
from station.engine.engine import Engine
from station.engine.messages import Command, EngineEvent

SUPERVISE_EVERY_NS = 100 * NS_PER_MS
LET_IN_S = 80e-6
"""JACK hands out a period's MIDI and asks for its sound at one moment, to two threads: so long the block waits for what
the other brings (19 of 20 messages that missed it came within 88 µs), lest a stroke sound a whole block later."""
LET_IN_FROM_NS = NS_PER_MS
"""Shorter blocks have no time to spare, and the next comes soon enough (our choice)."""
LATCH_WITHIN_S = 0.0002
"""A poll takes less; whoever holds the engine longer (a port is opened) shall not hold up the sound (our choice)."""


class Runner:
    """An engine with its kits, the sensors on its sticks and its card.

    `card` is None where no sound is wanted, `pause` sleeps some seconds.
    """

    def __init__(
        self,
        engine: Engine,
        kits: Sequence[PortWatch],
        card: Card | None,
        pause: Callable[[float], None] = time.sleep,
        sticks: Sequence[PortWatch] = (),
    ) -> None:
        self.engine = engine
        self._pause = pause
        self._kits = kits
        self._sticks = sticks
        self._card = card
        self._next_supervision_ns = 0
        self._engine_lock = threading.Lock()
        if card is not None:
            card.before_block = self.latch

    @property
    def is_worn_out(self) -> bool:
        """Whether only a new process would sound again, and there is something to sound on."""
        return self._card is not None and self._card.is_worn_out

    def start(self, now_ns: int) -> None:
        """Open kits and card, the kits first: what they change in the driver then disturbs no sound."""
        self._poll_all(now_ns)
        if self._card is not None:
            self._card.start(now_ns)

    def step(self, now_ns: int) -> list[EngineEvent]:
        """Do all that is to do at `now_ns`; returns what happened."""
        with self._engine_lock:
            self._poll_all(now_ns)
            if self._card is not None and now_ns >= self._next_supervision_ns:
                self._next_supervision_ns = now_ns + SUPERVISE_EVERY_NS
                self._card.supervise(now_ns)
            return self.engine.advance(now_ns)

    def handle(self, command: Command) -> None:
        """Obey the app."""
        with self._engine_lock:
            self.engine.handle(command)

    def latch(self, block_ns: int) -> None:
        """Take in what has come by now, for the block of `block_ns` that is about to be mixed, in the card's thread.

        Where the other thread is at it the block waits for it a moment, never long.
        """
        if block_ns >= LET_IN_FROM_NS:
            self._pause(LET_IN_S)
        if self._engine_lock.acquire(timeout=LATCH_WITHIN_S):
            try:
                for kit in self._kits:
                    findings = kit.hear()
                    for packet in findings.packets:
                        self.engine.feed(findings.device, packet.data, packet.at_ns)
            finally:
                self._engine_lock.release()

    def _poll_all(self, now_ns: int) -> None:
        for kit in self._kits:
            self._poll(kit, now_ns, self.engine.device_found)
        for stick in self._sticks:
            self._poll(stick, now_ns, self.engine.sensor_found)

    def _poll(self, watch: PortWatch, now_ns: int, found: Callable[[str, int], None]) -> None:
        findings = watch.poll(now_ns)
        for packet in findings.packets:
            self.engine.feed(findings.device, packet.data, packet.at_ns)
        if findings.fault:
            self.engine.notify(findings.fault)
        if findings.lost:
            self.engine.device_lost(findings.device, now_ns)
        if findings.found:
            found(findings.device, now_ns)

    def close(self) -> None:
        """Leave card, kits and capture, in that order: nothing is played any more, and every hit is on the disk."""
        if self._card is not None:
            self._card.close()
        for watch in (*self._kits, *self._sticks):
            watch.close()
        self.engine.close()
