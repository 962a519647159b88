"""A fake drum module at the byte level: what it sends for what a drummer does, with the faults of real ones.

Built from what the modules' MIDI implementations and their users describe: pedal and position controllers come before
the note, aftertouch says grabs, retriggers and crosstalk come beside it, stomps fire hi-hat notes.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

Sent = tuple[float, bytes]
"""Milliseconds and a message."""


@dataclass
class FakeModule:
    """`notes` number by what is struck ("snare rim"); openness by `pedal` values (wide open, shut) of `controller`.

    `crosstalk` says by what is struck which number answers, its share of the velocity and how many ms later; `doubles`
    which sounds trigger twice, how many ms apart.
    """

    notes: dict[str, int]
    controller: int | None = 4
    pedal: tuple[int, int] = (0, 127)
    places: tuple[int, ...] = ()
    crosstalk: dict[str, list[tuple[int, float, float]]] = field(default_factory=dict)
    doubles: dict[str, float] = field(default_factory=dict)
    position: dict[str, int] = field(default_factory=dict)
    grab: Callable[[int, float], list[Sent]] = lambda note, ms: [(ms, bytes((0xA9, note, 127)))]
    stomp_fires: tuple[int, ...] = ()
    least: int = 4

    def strike(self, what: str, velocity: int, ms: float, openness: float | None = None) -> list[Sent]:
        """One stroke."""
        note, sent = self.notes.get(what), list[Sent]()
        if openness is not None:
            sent += self.at(openness, ms - 1)
        if note is None:
            return sent
        if what in self.position:
            sent.append((ms - 0.5, bytes((0xB9, self.position[what], 64))))
        heard = max(velocity, self.least)
        for number, share, later_ms in [(note, 1.0, 0.0), *self.crosstalk.get(what, [])]:
            if heard * share >= 1:
                sent += self._note(number, int(heard * share), ms + later_ms)
        if what in self.doubles:
            sent += self._note(note, heard // 2, ms + self.doubles[what])
        return sorted(sent)

    def at(self, openness: float, ms: float) -> list[Sent]:
        """The pedal says where it is."""
        if self.controller is None:
            return []
        value = round(self.pedal[1] + openness * (self.pedal[0] - self.pedal[1]))
        if self.places:
            value = min(self.places, key=lambda place: abs(place - value))
        return [(ms, bytes((0xB9, self.controller, value)))]

    def way(self, ms: float, begin: float, end: float, took_ms: float, steps: int = 20) -> Iterator[Sent]:
        """The pedal moves; what it has said it does not say again."""
        said = None
        for step in range(steps + 1):
            for at_ms, message in self.at(begin + (end - begin) * step / steps, ms + took_ms * step / steps):
                if message != said:
                    yield at_ms, message
                said = message

    def stomp(self, velocity: int, ms: float, splash: bool = False) -> list[Sent]:
        """The foot comes down, and at once up again for a splash."""
        sent = list(self.way(ms - 60, 1.0, 0.0, 60))
        note = self.notes.get("splash" if splash and "splash" in self.notes else "stomp")
        if note is not None:
            sent += self._note(note, velocity, ms)
            for fired in self.stomp_fires:
                sent += self._note(fired, velocity * 2 // 3, ms + 4)
        if splash:
            sent += self.way(ms + 30, 0.0, 1.0, 60)
        return sorted(sent)

    def grabbed(self, what: str, ms: float) -> list[Sent]:
        """A stroke, and after 300 ms a hand on the cymbal."""
        note = self.notes.get(what)
        return [] if note is None else self.strike(what, 100, ms) + self.grab(note, ms + 300)

    @staticmethod
    def _note(number: int, velocity: int, ms: float) -> list[Sent]:
        return [(ms, bytes((0x99, number, velocity))), (ms + 1, bytes((0x89, number, 64)))]
