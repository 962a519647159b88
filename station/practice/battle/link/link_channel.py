"""Messages that arrive once, whole and in order, over datagrams that need not: pure, without socket or clock.

Each message is cut into fragments with consecutive numbers. Every datagram acknowledges: all fragments before
`expected`, and by a bit each of the next `WINDOW` that are here already (as TCP's selective acknowledgement, RFC 2018).
What is not acknowledged is sent again after a time estimated from the round trips (RFC 6298), twice as long each time.
An end with nothing to say beats its heart. A line that is silent for `CUT_NS` is cut; when it is heard again all goes
on where it was, from whatever address it now comes. Memory is bounded on both sides, whoever is at the other end.
"""

from collections import deque
from dataclasses import dataclass

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.link.link_datagram import (
    FRAGMENT_BYTES,
    MOST_COUNT,
    MOST_SEQUENCE,
    Carry,
    Drop,
    SessionKey,
    opened,
    packed,
)

WINDOW = 64
"""Fragments on their way at once: as many as a datagram's bits acknowledge; 70 kB, an hour of strokes."""
HEARTBEAT_NS = NS_PER_S // 2
CUT_NS = 2_500 * NS_PER_MS
"""Five heartbeats: at a loss of one in twenty all of them are lost once in three million (our choice)."""
FIRST_RESEND_NS, LEAST_RESEND_NS, MOST_RESEND_NS = NS_PER_S, 100 * NS_PER_MS, 2 * NS_PER_S
"""Before a round trip is known (RFC 6298, 2.1); on a quick network; and while the line is cut (our choices)."""
_GRAIN_NS = 10 * NS_PER_MS
"""How finely whoever drives a channel looks at it (G of RFC 6298)."""
MOST_MESSAGE_BYTES = 1 << 18
"""Our choice: a turn of sixteen bars of sixteen strokes a beat is a tenth of it."""
MOST_HELD_BYTES = 1 << 20
"""Of messages that wait to be sent, and of those that wait to be taken (our choice: four of the longest)."""
_OBJECT_BYTES = 64
"""What a fragment takes beside its bytes (our choice: CPython's `bytes` and a pointer, generously)."""
REPLAY_WINDOW = 1024
"""Datagrams that may overtake one another (our choice; RFC 6479 proposes as many)."""


@dataclass(slots=True)
class _Flying:
    """A fragment on its way: when it was sent last, and how often."""

    data: bytes
    is_last: bool
    sent_ns: int = 0
    times: int = 0


class ReplayGuard:
    """Says of each number once that it is new; one `REPLAY_WINDOW` behind the highest is old (as RFC 6479)."""

    def __init__(self) -> None:
        self._next = 0
        self._seen = 0  # bit i: number `_next - 1 - i` was here

    def is_new(self, number: int) -> bool:
        """Whether it was never here; remembers it."""
        ahead = number - self._next + 1
        if ahead > 0:
            kept = self._seen << ahead if ahead < REPLAY_WINDOW else 0
            self._seen, self._next = (kept | 1) & ((1 << REPLAY_WINDOW) - 1), number + 1
            return True
        if -ahead >= REPLAY_WINDOW or self._seen >> -ahead & 1:
            return False
        self._seen |= 1 << -ahead
        return True

    def is_newest(self, number: int) -> bool:
        """Whether none higher was here."""
        return number + 1 == self._next


class RoundTrips:
    """The smoothed round trip, and how long to wait for an acknowledgement (RFC 6298, 2)."""

    def __init__(self) -> None:
        self.smoothed_ns: float | None = None
        self._spread_ns = 0.0

    def measured(self, trip_ns: int) -> None:
        """One fragment that was sent but once was acknowledged after so long."""
        if self.smoothed_ns is None:
            self.smoothed_ns, self._spread_ns = float(trip_ns), trip_ns / 2
            return
        self._spread_ns += (abs(self.smoothed_ns - trip_ns) - self._spread_ns) / 4
        self.smoothed_ns += (trip_ns - self.smoothed_ns) / 8

    def resend_after_ns(self, times: int) -> float:
        """How long after it was sent for the `times`-th time a fragment is sent again."""
        if self.smoothed_ns is None:
            first = float(FIRST_RESEND_NS)
        else:
            first = max(self.smoothed_ns + max(4 * self._spread_ns, _GRAIN_NS), LEAST_RESEND_NS)
        return float(min(first * 2 ** min(times - 1, 8), MOST_RESEND_NS))


class LinkChannel:
    """One end of an open session: hand it what comes, send what is `due`, take the messages.

    `fault` says why nothing more is taken from the other end, None while all is well.
    """

    def __init__(self, key: SessionKey, now_ns: int) -> None:
        self.key = key
        self.heard_ns = now_ns
        """When the last sign of the other end came."""
        self.fault: str | None = None
        self.trips = RoundTrips()
        self._waiting = deque[_Flying]()
        self._waiting_bytes = 0
        self._flying: dict[int, _Flying] = {}
        self._next_sequence = self._count = 0
        self._guard = ReplayGuard()
        self._expected = 0
        self._ahead: dict[int, tuple[bytes, bool]] = {}
        self._parts: list[bytes] = []
        self._parts_bytes = 0
        self._messages = deque[bytes]()
        self._messages_bytes = 0
        self._owes_sign = True
        self._sent_ns = now_ns

    # --- sending -----------------------------------------------------------------------------------------------------

    def send(self, message: bytes) -> None:
        """Have `message` arrive; raises `DeviceError` where the other end has taken nothing for far too long."""
        assert len(message) <= MOST_MESSAGE_BYTES, "no message of ours is so long"
        if self._waiting_bytes + len(message) > MOST_HELD_BYTES:
            raise DeviceError("the other station takes nothing any more: too much waits to be sent")
        cuts = range(0, max(len(message), 1), FRAGMENT_BYTES)
        self._waiting.extend(_Flying(message[at : at + FRAGMENT_BYTES], at == cuts[-1]) for at in cuts)
        self._waiting_bytes += len(message)

    @property
    def is_delivered(self) -> bool:
        """Whether the other end has all that was sent."""
        return not self._waiting and not self._flying

    def due(self, now_ns: int) -> list[bytes]:
        """The datagrams that are to be sent now."""
        self._fill_window()
        late = [(n, f) for n, f in self._flying.items() if self._is_due(f, now_ns)]
        sent = [self._fragment(number, flying, now_ns) for number, flying in late]
        if not sent and (self._owes_sign or now_ns - self._sent_ns >= HEARTBEAT_NS):
            sent.append(self._carry())
        if sent:
            self._owes_sign, self._sent_ns = False, now_ns
        return sent

    def _fill_window(self) -> None:
        oldest = min(self._flying, default=self._next_sequence)
        while self._waiting and self._next_sequence < min(oldest + WINDOW, MOST_SEQUENCE):
            flying = self._waiting.popleft()
            self._waiting_bytes -= len(flying.data)
            self._flying[self._next_sequence] = flying
            self._next_sequence += 1

    def _is_due(self, flying: _Flying, now_ns: int) -> bool:
        return not flying.times or now_ns - flying.sent_ns >= self.trips.resend_after_ns(flying.times)

    def _fragment(self, number: int, flying: _Flying, now_ns: int) -> bytes:
        flying.sent_ns, flying.times = now_ns, flying.times + 1
        return self._carry(number, flying)

    def _carry(self, number: int = 0, flying: _Flying | None = None) -> bytes:
        beyond = sum(1 << (ahead - self._expected - 1) for ahead in self._ahead)
        carry = Carry(self._count, self._expected, beyond)
        if flying is not None:
            carry = Carry(self._count, self._expected, beyond, number, flying.is_last, flying.data)
        self._count += 1
        return packed(carry, self.key)

    # --- receiving ---------------------------------------------------------------------------------------------------

    def handle(self, data: bytes, now_ns: int) -> Carry | Drop:
        """Take a datagram whose kind is `CARRY`; what it carried, or why it was thrown away."""
        carry = opened(data, self.key)
        if isinstance(carry, Drop):
            return carry
        if carry.count == MOST_COUNT or carry.expected > self._next_sequence:
            return Drop.RANGE  # acknowledges what was never sent
        if not self._guard.is_new(carry.count):
            return Drop.REPLAY
        if self.is_cut(now_ns):
            self._send_all_again()
        self.heard_ns = now_ns
        self._acknowledged(carry, now_ns)
        return self._take_fragment(carry) or carry

    def is_newest(self, carry: Carry) -> bool:
        """Whether nothing that was sent later has come: only then does its address count."""
        return self._guard.is_newest(carry.count)

    def is_cut(self, now_ns: int) -> bool:
        """Whether the other end has been silent for too long."""
        return now_ns - self.heard_ns > CUT_NS

    def messages(self) -> list[bytes]:
        """The messages that have come whole since the last call, in the order in which they were sent."""
        taken = list(self._messages)
        self._messages.clear()
        self._messages_bytes = 0
        return taken

    def _send_all_again(self) -> None:
        for flying in self._flying.values():
            flying.sent_ns, flying.times = self.heard_ns, min(flying.times, 1)

    def _acknowledged(self, carry: Carry, now_ns: int) -> None:
        bits = carry.beyond
        for number in list(self._flying):
            ahead = number - carry.expected - 1
            if number >= carry.expected and not (ahead >= 0 and bits >> ahead & 1):
                continue
            flying = self._flying.pop(number)
            if flying.times == 1:  # of one sent twice nobody knows which was acknowledged (Karn)
                self.trips.measured(now_ns - flying.sent_ns)

    def _take_fragment(self, carry: Carry) -> Drop | None:
        if carry.fragment is None:
            return None
        self._owes_sign = True
        if carry.sequence < self._expected or carry.sequence in self._ahead:
            return None  # sent twice; the acknowledgement of the first was lost
        if carry.sequence > self._expected + WINDOW:
            return Drop.RANGE
        if self.fault is not None or self._messages_bytes + self._parts_bytes > MOST_HELD_BYTES:
            return Drop.FLOOD
        self._ahead[carry.sequence] = (carry.fragment, carry.is_last)
        while self._expected in self._ahead:
            self._append(*self._ahead.pop(self._expected))
            self._expected += 1
        return None

    def _append(self, fragment: bytes, is_last: bool) -> None:
        self._parts.append(fragment)
        self._parts_bytes += len(fragment) + _OBJECT_BYTES  # an empty one takes room too
        if self._parts_bytes > MOST_MESSAGE_BYTES + _OBJECT_BYTES * len(self._parts):
            self.fault = f"the other station sends a message of more than {MOST_MESSAGE_BYTES} bytes"
            self._parts, self._parts_bytes = [], 0
        elif is_last:
            self._messages.append(b"".join(self._parts))
            self._messages_bytes += self._parts_bytes
            self._parts, self._parts_bytes = [], 0
