"""Who hosts a battle on this network: a question to all, sent only while somebody looks, and a list of who answers.

A host answers only while it hosts (`link_handshake.Door`). Whatever answers may be lying: names are those that
`link_messages` lets through, the list is bounded, and nothing is opened by an answer.
"""

from dataclasses import dataclass
from secrets import token_bytes

from station.core.units import NS_PER_S, ms_from_ns
from station.practice.battle.link.link_datagram import HALF_BYTES, HEAD_BYTES, Drop, Kind, body, headed, kind_of
from station.practice.battle.link.link_handshake import ASK_BYTES, Address, RandomBytes
from station.practice.battle.link.link_messages import decoded_card

DEFAULT_PORT = 34_117
"""Where a host listens unless told otherwise (our choice, in the range that is registered but unused there)."""
EVERYBODY = "255.255.255.255"
ASK_EVERY_NS = NS_PER_S
FORGETS_NS = 4 * ASK_EVERY_NS
"""A host that has not answered for so long is not shown any more (our choice: four questions may be lost)."""
_MOST_FOUND = 64
"""Of hosts in a list (our choice: two classes)."""
_MOST_QUESTIONS = 8
"""Whose answers are still awaited: what takes longer than so many seconds is of no use for a battle."""


@dataclass(frozen=True, slots=True)
class FoundStation:
    """A host that answered: what it calls itself, what it would play, how far it is."""

    address: Address
    station: str
    about: str
    is_busy: bool
    ping_ms: float


class Lookout:
    """Asks `targets` who hosts: by broadcast, and whatever addresses are given."""

    def __init__(self, targets: tuple[Address, ...], random_bytes: RandomBytes = token_bytes) -> None:
        self._targets = targets
        self._random_bytes = random_bytes
        self._asked: dict[bytes, int] = {}
        self._asked_ns: int | None = None
        self._found: dict[Address, FoundStation] = {}
        self._heard_ns: dict[Address, int] = {}

    @property
    def found(self) -> tuple[FoundStation, ...]:
        """Who has answered, the nearest first."""
        return tuple(sorted(self._found.values(), key=lambda each: (each.ping_ms, each.address)))

    def forget(self, now_ns: int) -> None:
        """Leave out whoever has not answered for `FORGETS_NS`, for who looks all the while."""
        for address, heard_ns in list(self._heard_ns.items()):
            if now_ns - heard_ns > FORGETS_NS:
                del self._found[address], self._heard_ns[address]

    def due(self, now_ns: int) -> list[tuple[bytes, Address]]:
        """The questions that are to be sent now."""
        if self._asked_ns is not None and now_ns - self._asked_ns < ASK_EVERY_NS:
            return []
        self._asked_ns, question = now_ns, self._random_bytes(HALF_BYTES)
        self._asked[question] = now_ns
        if len(self._asked) > _MOST_QUESTIONS:
            del self._asked[next(iter(self._asked))]
        data = headed(Kind.ASK, question).ljust(ASK_BYTES, b"\0")
        return [(data, target) for target in self._targets]

    def handle(self, data: bytes, source: Address, now_ns: int) -> Drop | None:
        """Take an answer; why it was thrown away, if it was."""
        kind = kind_of(data)
        if kind is not Kind.HERE:
            return kind if isinstance(kind, Drop) else Drop.KIND
        parts = body(data, (HALF_BYTES,))
        if isinstance(parts, Drop):
            return parts
        asked_ns = self._asked.get(parts[0])
        if asked_ns is None:
            return Drop.SESSION  # answers a question that nobody asked
        card = decoded_card(data[HEAD_BYTES + HALF_BYTES :])
        if card is None:
            return Drop.MALFORMED
        if source not in self._found and len(self._found) >= _MOST_FOUND:
            return Drop.FLOOD
        before, self._heard_ns[source] = self._found.get(source), now_ns
        ping_ms = ms_from_ns(now_ns - asked_ns)
        least_ms = ping_ms if before is None else min(ping_ms, before.ping_ms)
        self._found[source] = FoundStation(source, card.station, card.about, card.is_busy, least_ms)
        return None
