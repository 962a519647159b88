"""How a friend at another station is met and left: this station hosts, or looks for hosts and joins one.

Driven by `advance` alone, without a thread: no socket of it ever waits. A port is open only while somebody looks,
hosts, joins, plays, or says their last word.
"""

from collections.abc import Callable
from time import sleep

from station.app.battle.friend_shown import FriendShown, HostShown
from station.core.clock import MonotonicClock
from station.core.errors import BadInput, StationError
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.link.link_discovery import DEFAULT_PORT, EVERYBODY, FoundStation, Lookout
from station.practice.battle.link.link_handshake import Address
from station.practice.battle.link.link_messages import Bye, Hello
from station.practice.battle.link.link_socket import LinkSocket, address_of, own_address
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LAST_WORD_NS, LinkedStation

ASKED: tuple[Address, ...] = ((EVERYBODY, DEFAULT_PORT), ("127.0.0.1", DEFAULT_PORT))
"""Who is asked whether they host: everybody on the network, and this computer."""
_THIS_COMPUTER = "127."
_ROUND_S = 0.005
"""Between two looks at the port while a window that closes says its last word."""


class FriendMeeting:
    """From nobody to an open line, and away again; `asked` are the addresses at which hosts are looked for."""

    def __init__(self, asked: tuple[Address, ...] = ASKED) -> None:
        self._asked = asked
        self._looking: tuple[LinkSocket, Lookout] | None = None
        self._station: LinkedStation | None = None
        self._leaving: tuple[LinkedStation, int] | None = None  # and until when
        self._waits: tuple[str, ...] = ()
        self._told = ""
        self._now_ns = 0

    def view(self) -> FriendShown:
        """What is shown of it."""
        hosts = () if self._looking is None else _hosts(self._looking[1].found)
        return FriendShown(hosts, self._waits, self._told)

    @property
    def waits(self) -> bool:
        """Whether somebody is waited for."""
        return self._station is not None

    @property
    def is_lively(self) -> bool:
        """Whether datagrams may come at any moment."""
        return any(one is not None for one in (self._station, self._looking, self._leaving))

    # --- what the user does ------------------------------------------------------------------------------------------

    def host(self, hello: Hello, rules: BattleRules, port: int, host_begins: bool) -> None:
        """Open `port` and wait for somebody."""

        def opened() -> tuple[LinkedStation, tuple[str, ...]]:
            station = LinkedStation.hosting(hello, rules, ("", port), host_begins)
            number = station.port.address[1]
            where = f"type {own_address() or 'the address of this computer'}:{number}"
            listed = f"press {hello.station} in the list, or " if number == DEFAULT_PORT else ""
            way = f"They let their station join, and {listed}{where}"
            return station, ("Waiting for your friend …", way)

        self._begin(opened)

    def join(self, hello: Hello, own: BattleRules, written: str) -> None:
        """Ask the host at an address that was `written` to let us in."""

        def asking() -> tuple[LinkedStation, tuple[str, ...]]:
            address = address_of(written, is_numeric=True)
            station = LinkedStation.joining(hello, own, address, self._now_ns)
            return station, (f"Asking {address[0]}:{address[1]} to let you in …",)

        self._begin(asking)

    def _begin(self, opened: Callable[[], tuple[LinkedStation, tuple[str, ...]]]) -> None:
        """Open a port and wait; where that cannot be it is told."""
        self.call_off()
        self.look(on=False)
        self._let_go()
        try:
            self._station, self._waits = opened()
        except StationError as fault:
            self._told = _words(fault)

    def call_off(self) -> None:
        """Wait for nobody any more; what was told is read."""
        station, self._station = self._station, None
        self._waits, self._told = (), ""
        if station is not None:
            if station.line.is_open:
                station.line.send(Bye("left"))
            self.leave(station)

    def look(self, on: bool) -> None:
        """Look who hosts, or no more."""
        if on and self._looking is None and self._station is None:
            try:
                self._looking = LinkSocket(may_broadcast=True), Lookout(self._asked)
            except StationError as fault:
                self._told = _words(fault)
        elif not on and self._looking is not None:
            self._looking[0].close()
            self._looking = None

    def decline(self, station: LinkedStation) -> None:
        """What was agreed on `station` cannot begin here: say so, and leave."""
        station.line.send(Bye("declined"))
        self.leave(station)

    def leave(self, station: LinkedStation) -> None:
        """Repeat the last word of `station` until it was heard, for a while, then give its port back."""
        self._let_go()
        self._leaving = station, self._now_ns + LAST_WORD_NS

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> tuple[LinkedStation, Agreed] | None:
        """Move on; the line and what was agreed on it, once somebody is there, None while nobody is."""
        self._now_ns = now_ns
        self._say_last_word(now_ns)
        self._ask_who_hosts(now_ns)
        station = self._station
        if station is None:
            return None
        try:
            agreed = station.advance(now_ns)
        except StationError as fault:
            self.call_off()
            self._told = _words(fault)
            return None
        self._told = station.lobby.notices[-1] if station.lobby.notices else ""
        if agreed is None:
            return None
        self._station, self._waits, self._told = None, (), ""
        return station, agreed

    def _ask_who_hosts(self, now_ns: int) -> None:
        if self._looking is None:
            return
        port, lookout = self._looking
        for data, source in port.received():
            lookout.handle(data, source, now_ns)
        lookout.forget(now_ns)
        port.send(lookout.due(now_ns))

    def _say_last_word(self, now_ns: int) -> None:
        if self._leaving is None:
            return
        station, until_ns = self._leaving
        station.exchange(now_ns)
        if station.line.is_delivered or now_ns > until_ns:
            self._let_go()

    def _let_go(self) -> None:
        """The port of whoever is left is given back, for the next one."""
        if self._leaving is not None:
            self._leaving[0].exchange(self._now_ns)
            self._leaving[0].port.close()
            self._leaving = None

    def close(self) -> None:
        """The window closes: whoever waits is told, and no port stays open; it may take `LAST_WORD_NS`."""
        self.call_off()
        self.look(on=False)
        if self._leaving is not None:
            self._leaving[0].take_leave(MonotonicClock(), lambda: sleep(_ROUND_S))
            self._let_go()


def _words(fault: StationError) -> str:
    """What went wrong, as the page tells it."""
    return f"{fault.place}: {fault.fault}" if isinstance(fault, BadInput) and fault.place else f"{fault}"


def _hosts(found: tuple[FoundStation, ...]) -> tuple[HostShown, ...]:
    """Who hosts, the nearest first; a station on this computer answers twice, and is shown by its address outside."""
    outside = {_who(one) for one in found if not one.address[0].startswith(_THIS_COMPUTER)}
    shown = (one for one in found if not (one.address[0].startswith(_THIS_COMPUTER) and _who(one) in outside))
    return tuple(
        HostShown(f"{one.address[0]}:{one.address[1]}", one.station, f"{one.about}, {one.ping_ms:.0f} ms", one.is_busy)
        for one in shown
    )


def _who(one: FoundStation) -> tuple[str, str, int]:
    return one.station, one.about, one.address[1]
