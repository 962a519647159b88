"""A station on the network, from its open port to its last word: a socket, a line, and the lobby in which one agrees.

Nothing opens a port but `hosting`, `joining` and `hosts_here`, and each gives it back with `close` or by itself.
"""

import platform
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from types import TracebackType

from station.core.clock import Clock
from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.link.link_discovery import EVERYBODY, FoundStation, Lookout
from station.practice.battle.link.link_handshake import Address, Door, Knock
from station.practice.battle.link.link_line import LinkLine
from station.practice.battle.link.link_messages import Card, Hello, encoded, shown_name
from station.practice.battle.link.link_socket import LinkSocket
from station.practice.battle.link.linked_lobby import GuestLobby, HostLobby
from station.practice.battle.link.linked_rules import Agreed

LAST_WORD_NS = 2 * NS_PER_S
"""How long a last word is repeated until it is acknowledged (our choice: twenty round trips of a bad network)."""
LOOK_NS = 1_500 * NS_PER_MS
"""How long hosts are looked for (our choice: two questions, and time to answer the second)."""
Pause = Callable[[], None]
"""Waits a moment, for datagrams to come."""


def introduction(player: str, rules: BattleRules, station: str = "") -> Hello:
    """Who this station is: by the name that is given, else by the computer's."""
    name = shown_name(station) or shown_name(platform.node(), "drum station")
    return Hello(name, shown_name(player, "player"), rules.level, version("drum-station"))


def card_of(hello: Hello, rules: BattleRules) -> Callable[[bool], bytes]:
    """What a host shows to whoever asks, by whether somebody is there already."""
    about = shown_name(
        f"{hello.player}: {rules.mode.value}, {rules.ground.beats_a_minute:.0f} bpm {rules.ground.style}"
    )
    return lambda is_busy: encoded(Card(hello.station, about, is_busy))


@dataclass(frozen=True, eq=False)
class LinkedStation:
    """One end with its open `port`; a context that closes it."""

    port: LinkSocket
    line: LinkLine
    lobby: HostLobby | GuestLobby

    @classmethod
    def hosting(cls, hello: Hello, rules: BattleRules, at: Address, host_begins: bool = True) -> "LinkedStation":
        """Open the port at `at` (an empty host: to every network of this computer) and wait for somebody."""
        line = LinkLine(Door(card_of(hello, rules)))
        return cls(LinkSocket(*at), line, HostLobby(line, hello, rules, host_begins))

    @classmethod
    def joining(cls, hello: Hello, own: BattleRules, host: Address, now_ns: int) -> "LinkedStation":
        """Go to the host at that address, from any port."""
        knock = Knock(host, now_ns)
        line = LinkLine(knock)
        return cls(LinkSocket(), line, GuestLobby(line, knock, hello, own))

    def exchange(self, now_ns: int) -> None:
        """Take what has come, send what is due."""
        for data, source in self.port.received():
            self.line.handle(data, source, now_ns)
        self.port.send(self.line.due(now_ns))

    def advance(self, now_ns: int) -> Agreed | None:
        """Wait in the lobby: what was agreed, None while nothing is; raises as the lobby does."""
        self.exchange(now_ns)
        found = self.lobby.advance(now_ns)
        self.exchange(now_ns)
        return found

    def take_leave(self, clock: Clock, pause: Pause) -> None:
        """Repeat the last word until it was heard, for a while."""
        until_ns = clock.now_ns() + LAST_WORD_NS
        self.exchange(clock.now_ns())
        while not self.line.is_delivered and clock.now_ns() < until_ns:
            pause()
            self.exchange(clock.now_ns())

    def __enter__(self) -> "LinkedStation":
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.port.close()


def hosts_here(port: int, clock: Clock, pause: Pause, whom: str = EVERYBODY) -> tuple[FoundStation, ...]:
    """Who hosts a battle on this network or on this computer, the nearest first; it takes `LOOK_NS`."""
    lookout = Lookout(tuple((host, port) for host in dict.fromkeys((whom, "127.0.0.1"))))
    until_ns = clock.now_ns() + LOOK_NS
    with LinkSocket(may_broadcast=True) as asking:
        while (now_ns := clock.now_ns()) < until_ns:
            for data, source in asking.received():
                lookout.handle(data, source, now_ns)
            asking.send(lookout.due(now_ns))
            pause()
    return lookout.found
