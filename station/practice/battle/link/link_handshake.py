"""How two stations come to share a key: the joiner asks, the host welcomes, the joiner knocks; then it is open.

Each end brings a random half. The host keeps nothing of a joiner until the knock proves that the welcome reached the
address that it names (as the cookie of DTLS, RFC 9147, 5.1): who forges addresses can fill no memory and have no third
party flooded, for an answer is never longer than the question. Both halves travel openly: the key keeps out whoever is
not on the way between the two, and nobody who listens there.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import IntEnum
from hashlib import blake2b
from hmac import compare_digest
from secrets import token_bytes

from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.link.link_datagram import (
    HALF_BYTES,
    MAC_BYTES,
    Drop,
    Kind,
    SessionKey,
    body,
    headed,
    is_signed,
    kind_of,
    signature,
)

Address = tuple[str, int]
"""Host and port of IPv4."""
RandomBytes = Callable[[int], bytes]
JOIN_BYTES, ASK_BYTES = 64, 512
"""Questions are padded to these lengths, so that no answer is longer."""
AGAIN_NS = 300 * NS_PER_MS
"""Between two questions (our choice: more than the round trip of any home)."""
GIVE_UP_NS = 8 * NS_PER_S
"""A host that has not opened until then is not there (our choice: 26 questions)."""
ANSWERS_A_SECOND = 50
"""Of a host, to whomever (our choice: a class of 30 that asks twice a second)."""


class Refusal(IntEnum):
    """Why a host does not open; the numbers are on the wire in every version."""

    BUSY = 1
    VERSION = 2


@dataclass(frozen=True, slots=True)
class Answer:
    """What becomes of a datagram: what to answer, if anything, and the key where it opened a session."""

    reply: bytes | None = None
    key: SessionKey | None = None


def session_key(joiner_half: bytes, host_half: bytes, is_host: bool) -> SessionKey:
    """The key that both halves make."""
    both = joiner_half + host_half
    session = blake2b(both, digest_size=8, person=b"dsb session").digest()
    return SessionKey(session, blake2b(both, digest_size=32, person=b"dsb secret").digest(), is_host)


@dataclass
class Door:
    """The host's side: answers who asks for hosts with `card`, and lets the first one in who knocks.

    `is_busy` while somebody is in; the door then refuses everybody else by name.
    """

    card: Callable[[bool], bytes]
    random_bytes: RandomBytes = token_bytes
    is_busy: bool = field(default=False, init=False)

    def __post_init__(self) -> None:
        self._secret = self.random_bytes(32)
        self._inside: bytes | None = None  # the joiner's half of whoever is in
        self._budget, self._budget_ns = float(ANSWERS_A_SECOND), 0

    def release(self) -> None:
        """Whoever was in has left: the next one may come. Nothing that was said before opens it again."""
        self.is_busy, self._inside, self._secret = False, None, self.random_bytes(32)

    def handle(self, data: bytes, source: Address, now_ns: int) -> Answer | Drop:
        """Take a datagram of no open session."""
        kind = kind_of(data)
        if kind not in (Kind.ASK, Kind.JOIN, Kind.KNOCK, Drop.VERSION):
            return kind if isinstance(kind, Drop) else Drop.KIND
        if len(data) < (ASK_BYTES if kind is Kind.ASK else JOIN_BYTES):
            return Drop.LENGTH
        if not self._may_answer(now_ns):
            return Drop.FLOOD
        if kind is Kind.ASK:
            return self._shown(data)
        if kind is Kind.JOIN:
            return self._welcomed(data, source)
        return self._knocked(data, source) if kind is Kind.KNOCK else _refused_half(data, Refusal.VERSION)

    def _may_answer(self, now_ns: int) -> bool:
        gained = (now_ns - self._budget_ns) / NS_PER_S * ANSWERS_A_SECOND
        self._budget, self._budget_ns = min(self._budget + gained, ANSWERS_A_SECOND), now_ns
        if self._budget < 1:
            return False
        self._budget -= 1
        return True

    def _shown(self, data: bytes) -> Answer | Drop:
        parts = body(data, (HALF_BYTES,))
        return parts if isinstance(parts, Drop) else Answer(headed(Kind.HERE, *parts, self.card(self.is_busy)))

    def _half_for(self, joiner_half: bytes, source: Address) -> bytes:
        whom = joiner_half + f"{source[0]} {source[1]}".encode()
        return blake2b(whom, digest_size=HALF_BYTES, key=self._secret).digest()

    def _welcomed(self, data: bytes, source: Address) -> Answer | Drop:
        parts = body(data, (HALF_BYTES,))
        if isinstance(parts, Drop):
            return parts
        if self.is_busy:
            return Drop.KIND if parts[0] == self._inside else _refused_half(data, Refusal.BUSY)
        return Answer(headed(Kind.WELCOME, parts[0], self._half_for(parts[0], source)))

    def _knocked(self, data: bytes, source: Address) -> Answer | Drop:
        parts = body(data, (HALF_BYTES, HALF_BYTES, MAC_BYTES))
        if isinstance(parts, Drop):
            return parts
        joiner_half, host_half, said = parts
        if self.is_busy:
            return Drop.KIND if joiner_half == self._inside else _refused_half(data, Refusal.BUSY)
        key = session_key(joiner_half, host_half, is_host=True)
        if not compare_digest(host_half, self._half_for(joiner_half, source)):
            return Drop.SESSION
        if not is_signed(key.secret, said, joiner_half, host_half):
            return Drop.MAC
        self.is_busy, self._inside = True, joiner_half
        return Answer(key=key)


def _refused_half(data: bytes, why: Refusal) -> Answer | Drop:
    parts = body(data, (HALF_BYTES,))
    return parts if isinstance(parts, Drop) else Answer(headed(Kind.REFUSED, *parts, bytes([why])))


class Knock:
    """The joiner's side: asks until the host at `host` welcomes it, then knocks until it is `let_in`.

    `refusal` says why it is not.
    """

    def __init__(self, host: Address, now_ns: int, random_bytes: RandomBytes = token_bytes) -> None:
        self.host = host
        self.refusal: Refusal | None = None
        self.let_in = False
        self._began_ns = now_ns
        self._asked_ns = now_ns - AGAIN_NS
        self._half = random_bytes(HALF_BYTES)
        self._host_half: bytes | None = None

    def is_hopeless(self, now_ns: int) -> bool:
        """Whether the host is not there, or does not open."""
        return self.refusal is not None or (not self.let_in and now_ns - self._began_ns > GIVE_UP_NS)

    def due(self, now_ns: int) -> list[bytes]:
        """What is to be sent to the host now."""
        if self.let_in or self.is_hopeless(now_ns) or now_ns - self._asked_ns < AGAIN_NS:
            return []
        self._asked_ns = now_ns
        if self._host_half is None:
            return [headed(Kind.JOIN, self._half).ljust(JOIN_BYTES, b"\0")]
        secret = session_key(self._half, self._host_half, is_host=False).secret
        said = signature(secret, self._half, self._host_half)
        return [headed(Kind.KNOCK, self._half, self._host_half, said).ljust(JOIN_BYTES, b"\0")]

    def handle(self, data: bytes, source: Address, now_ns: int) -> Answer | Drop:
        """Take a datagram of no open session."""
        kind = kind_of(data)
        if kind is Drop.VERSION and source == self.host and body(data, (HALF_BYTES,)) == (self._half,):
            self.refusal = Refusal.VERSION  # its refusal, of whatever version
        if kind not in (Kind.WELCOME, Kind.REFUSED) or self.let_in:
            return kind if isinstance(kind, Drop) else Drop.KIND
        parts = body(data, (HALF_BYTES, HALF_BYTES if kind is Kind.WELCOME else 1))
        if isinstance(parts, Drop):
            return parts
        if source != self.host or not compare_digest(parts[0], self._half):
            return Drop.SESSION
        if kind is Kind.WELCOME:
            return self._welcomed(parts[1], now_ns)
        self.refusal = Refusal(parts[1][0]) if parts[1][0] in set(Refusal) else Refusal.BUSY
        return Answer()

    def _welcomed(self, host_half: bytes, now_ns: int) -> Answer | Drop:
        if self._host_half is not None:
            return Drop.REPLAY
        self._host_half, self._asked_ns = host_half, now_ns - AGAIN_NS
        return Answer(key=session_key(self._half, host_half, is_host=False))
