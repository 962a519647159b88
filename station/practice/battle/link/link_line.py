"""The line between two stations: a handshake, then a channel with typed messages; what is neither is counted.

Pure: whoever drives it hands over datagrams with their addresses and the time, and sends what is `due`. The other end's
address is where its newest signed datagram came from, so that a line survives a new address or port.
"""

from collections import Counter, deque
from collections.abc import Iterator

from station.core.errors import BadInput
from station.practice.battle.link.link_channel import LinkChannel
from station.practice.battle.link.link_datagram import Drop, Kind, kind_of
from station.practice.battle.link.link_handshake import Address, Door, Knock
from station.practice.battle.link.link_messages import Message, decoded, encoded

WHO = "the other station"


class LinkLine:
    """One end; `opening` is the host's door or the joiner's knock.

    `drops` counts the datagrams that were thrown away, by why; `fault` says why the other end is not believed any more.
    """

    def __init__(self, opening: Door | Knock) -> None:
        self._opening = opening
        self._channel: LinkChannel | None = None
        self._peer: Address | None = opening.host if isinstance(opening, Knock) else None
        self._replies: list[tuple[bytes, Address]] = []
        self._fault: str | None = None
        self._came = deque[bytes]()
        self.drops = Counter[Drop]()

    @property
    def is_open(self) -> bool:
        """Whether somebody is at the other end."""
        return self._channel is not None and (isinstance(self._opening, Door) or self._opening.let_in)

    @property
    def peer(self) -> Address | None:
        """Where the other end is."""
        return self._peer

    @property
    def fault(self) -> str | None:
        """Why nothing more is taken from the other end; None while all is well."""
        return self._fault if self._channel is None else self._channel.fault or self._fault

    @property
    def is_delivered(self) -> bool:
        """Whether the other end has all that was sent."""
        return self._channel is None or self._channel.is_delivered

    @property
    def round_trip_ns(self) -> float | None:
        """How long a question and its answer take, None before it is known."""
        return None if self._channel is None else self._channel.trips.smoothed_ns

    def is_cut(self, now_ns: int) -> bool:
        """Whether somebody was there, and has not been heard for too long."""
        return self._channel is not None and self._channel.is_cut(now_ns)

    def silent_ns(self, now_ns: int) -> int:
        """How long ago the other end was heard last; 0 where nobody is there."""
        return 0 if self._channel is None else now_ns - self._channel.heard_ns

    def hang_up(self) -> None:
        """Nobody is at the other end any more; a host's door is open again."""
        self._channel, self._fault = None, None
        self._came.clear()
        if isinstance(self._opening, Door):
            self._opening.release()
            self._peer = None

    # --- datagrams ---------------------------------------------------------------------------------------------------

    def handle(self, data: bytes, source: Address, now_ns: int) -> None:
        """Take a datagram."""
        dropped = (
            self._carried(data, source, now_ns) if kind_of(data) is Kind.CARRY else self._opened(data, source, now_ns)
        )
        if dropped is not None:
            self.drops[dropped] += 1

    def _carried(self, data: bytes, source: Address, now_ns: int) -> Drop | None:
        if self._channel is None:
            return Drop.SESSION
        carry = self._channel.handle(data, now_ns)
        if isinstance(carry, Drop):
            return carry
        if isinstance(self._opening, Knock):
            self._opening.let_in = True
        if self._channel.is_newest(carry):
            self._peer = source
        return None

    def _opened(self, data: bytes, source: Address, now_ns: int) -> Drop | None:
        answer = self._opening.handle(data, source, now_ns)
        if isinstance(answer, Drop):
            return answer
        if answer.reply is not None:
            self._replies.append((answer.reply, source))
        if answer.key is not None:
            self._channel, self._peer = LinkChannel(answer.key, now_ns), source
        return None

    def due(self, now_ns: int) -> list[tuple[bytes, Address]]:
        """The datagrams that are to be sent now, and whither."""
        sent, self._replies = self._replies, []
        if self._peer is not None:
            ours = self._opening.due(now_ns) if isinstance(self._opening, Knock) else []
            ours += [] if self._channel is None else self._channel.due(now_ns)
            sent += [(data, self._peer) for data in ours]
        return sent

    # --- messages ----------------------------------------------------------------------------------------------------

    def send(self, message: Message) -> None:
        """Have `message` arrive; raises `DeviceError` where the other end has taken nothing for far too long."""
        assert self._channel is not None, "nobody is there"
        self._channel.send(encoded(message))

    def message(self) -> Message | None:
        """What the other end said next, None where that is all; what does not fit ends the belief in it."""
        if self._channel is None or self.fault is not None:
            return None
        if not self._came:
            self._came.extend(self._channel.messages())
        if not self._came:
            return None
        try:
            return decoded(self._came.popleft(), WHO)
        except BadInput as fault:
            self.drops[Drop.MALFORMED] += 1
            self._fault = str(fault)
            return None

    def messages(self) -> Iterator[Message]:
        """All that the other end has said since."""
        while (message := self.message()) is not None:
            yield message

    def disbelieve(self, fault: str) -> None:
        """What the other end said fits its type, but not the battle."""
        self._fault = self._fault or fault
