"""Real datagrams on loopback: a whole battle by way of a proxy in a thread, who hosts, and ports that cannot be had."""

import random
import select

import pytest

from station.core.errors import BadInput, DeviceError
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_datagram import MOST_BYTES
from station.practice.battle.link.link_discovery import DEFAULT_PORT, Lookout
from station.practice.battle.link.link_handshake import Door, Knock
from station.practice.battle.link.link_line import LinkLine
from station.practice.battle.link.link_messages import Card, Hello, encoded
from station.practice.battle.link.link_socket import MOST_AT_ONCE, LinkSocket, address_of
from station.practice.battle.link.linked_battle import LinkEnd
from station.practice.battle.link.linked_lobby import GuestLobby, HostLobby
from station.scoring.matching.hit_windows import Level
from tests.fakes.linked_stations import Network, Station, improvises
from tests.fakes.udp_proxy import UdpProxy

LOOPBACK = "127.0.0.1"
STEP_NS = 40 * NS_PER_MS
RULES = BattleRules(Ground(200.0), BattleMode.IMPROVISE, rounds=2, bars=2, has_final=False)


def door() -> Door:
    return Door(lambda is_busy: encoded(Card("The shed", "improvise", is_busy)), random.Random(1).randbytes)


def hello(name: str) -> Hello:
    return Hello(f"{name}'s room", name, Level.INTERMEDIATE, "0.1.0")


def test_a_battle_over_real_sockets_with_delay_loss_and_a_cut() -> None:
    now_ns = 0
    cut = (12 * NS_PER_S, 22 * NS_PER_S)
    network = Network(seed=3, delay_ns=200 * NS_PER_MS, loss=0.05, cuts=(cut,))
    player = improvises(10.0, (Piece.SNARE, Piece.KICK))
    with (
        LinkSocket(LOOPBACK) as at_host,
        LinkSocket(LOOPBACK) as at_guest,
        UdpProxy(at_host.address, network, lambda: now_ns) as proxy,
    ):
        knock = Knock(proxy.address, 0, random.Random(2).randbytes)
        lines = LinkLine(door()), LinkLine(knock)
        host = Station(HostLobby(lines[0], hello("Ann"), RULES), lines[0], player, 1)
        guest = Station(GuestLobby(lines[1], knock, hello("Ben"), RULES), lines[1], player, 2)
        sockets = (at_host, at_guest)
        while now_ns < 120 * NS_PER_S:
            now_ns += STEP_NS
            select.select(sockets, [], [], 0.001)
            for station, port in zip((host, guest), sockets, strict=True):
                for data, source in port.received():
                    station.line.handle(data, source, now_ns)
                station.step(now_ns)
                port.send(station.line.due(now_ns))
            battles = [station.battle for station in (host, guest) if station.battle is not None]
            if len(battles) == 2 and all(battle.over for battle in battles):
                break
    assert [battle.ended for battle in battles] == [LinkEnd.COMPLETE] * 2
    ours, theirs = (battle.rounds.shared for battle in battles)
    assert [(one.claim, one.checked) for one in ours.standing()] == [
        (one.claim, one.checked) for one in theirs.standing()
    ]
    assert len(ours.standing()) == 4
    assert not ours.disputed
    assert ours.digest == theirs.digest == battles[0].their_digest == battles[1].their_digest
    assert network.lost > 20
    assert now_ns > cut[1]


def test_who_asks_on_loopback_finds_the_host_while_it_hosts() -> None:
    with LinkSocket(LOOPBACK) as at_host, LinkSocket(LOOPBACK, may_broadcast=True) as asking:
        lookout, line = Lookout((at_host.address,), random.Random(4).randbytes), LinkLine(door())
        asking.send(lookout.due(0))
        assert select.select([at_host], [], [], 2.0)[0]
        for data, source in at_host.received():
            line.handle(data, source, 0)
        at_host.send(line.due(0))
        assert select.select([asking], [], [], 2.0)[0]
        for data, source in asking.received():
            assert lookout.handle(data, source, 3 * NS_PER_MS) is None
        (found,) = lookout.found
        assert (found.address, found.station, found.ping_ms) == (at_host.address, "The shed", 3.0)


def test_a_port_that_is_taken_is_said() -> None:
    with LinkSocket(LOOPBACK) as taken, pytest.raises(DeviceError, match=f"port {taken.address[1]} of UDP"):
        LinkSocket(LOOPBACK, taken.address[1])


def test_a_flood_is_read_in_bounded_portions_and_a_datagram_too_long_is_seen_as_such() -> None:
    with LinkSocket(LOOPBACK) as here, LinkSocket(LOOPBACK) as sender:
        sender.send([(bytes(MOST_BYTES + 500), here.address)])
        sender.send([(bytes(40), here.address)] * (2 * MOST_AT_ONCE))  # the system drops what it cannot hold
        assert select.select([here], [], [], 2.0)[0]
        portion = here.received()
        assert 1 < len(portion) <= MOST_AT_ONCE
        assert len(portion[0][0]) == MOST_BYTES + 1


def test_sending_to_nobody_is_no_fault() -> None:
    with LinkSocket(LOOPBACK) as gone:
        nobody = gone.address
    with LinkSocket(LOOPBACK) as sender:
        sender.send([(b"x", nobody)] * 3)
        select.select([sender], [], [], 0.01)
        assert sender.received() == []


@pytest.mark.parametrize(
    ("written", "address"),
    [
        ("127.0.0.1", ("127.0.0.1", DEFAULT_PORT)),
        (" 127.0.0.1:5000 ", ("127.0.0.1", 5000)),
        ("127.0.0.1:65535", ("127.0.0.1", 65535)),
    ],
)
def test_addresses_as_people_type_them(written: str, address: tuple[str, int]) -> None:
    assert address_of(written) == address


@pytest.mark.parametrize("written", ["127.0.0.1:0", "127.0.0.1:65536", "127.0.0.1:", "127.0.0.1:x", "1.2.3.4.5", ":5"])
def test_addresses_that_are_none(written: str) -> None:
    with pytest.raises(BadInput):
        address_of(written)
