"""Two stations live, each in a thread, over real sockets of loopback, with virtual students on clocks that run fast."""

import threading
import time
from functools import partial
from pathlib import Path

import pytest

from station.core.clock import MonotonicClock, monotonic_ns
from station.core.errors import DeviceError, StationError
from station.core.units import NS_PER_S
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_handshake import Address
from station.practice.battle.link.linked_battle import LinkedBattle, LinkEnd
from station.practice.battle.link.linked_document import network_fields, network_report
from station.practice.battle.link.linked_play import LinkedPlay
from station.practice.battle.link.linked_station import LinkedStation, hosts_here, introduction
from station.practice.battle.people.player import Player
from station.practice.headless.end_signals import EndAsked
from station.practice.headless.linked_live import LinkedSetup, meet, play_linked
from station.practice.headless.linked_text import LinkedText
from station.practice.headless.virtual_partner import VirtualPartner
from station.simulation.student_spec import parse_spec
from tests.fakes.linked_stations import drum

LOOPBACK = "127.0.0.1"
TIMES = 25
"""So many seconds of a battle pass in a second."""


class HastyClock:
    """Runs as the world does, and `TIMES` as fast from some moment on."""

    def __init__(self) -> None:
        self._since_ns: int | None = None

    def hasten(self) -> None:
        self._since_ns = self._since_ns or monotonic_ns()

    def now_ns(self) -> int:
        now_ns, since_ns = monotonic_ns(), self._since_ns
        return now_ns if since_ns is None else now_ns + (TIMES - 1) * (now_ns - since_ns)


def rules_of(name: str, mode: BattleMode) -> BattleRules:
    return BattleRules(Ground(240.0), mode, players=(Player(name),), rounds=2, bars=1, has_final=False)


class End:
    """One station, from meeting to leaving."""

    def __init__(self, clock: HastyClock, station: LinkedStation, spec: str) -> None:
        self.clock = clock
        self.engine = VirtualPartner(parse_spec(spec), clock)
        self.words: list[str] = []
        self.asked = EndAsked()
        self.setup = LinkedSetup(self.engine, clock, station, LinkedText(self.words.append).show, asked=self.asked)
        self.battle: LinkedBattle | None = None
        self.fault: StationError | None = None

    def play(self, capture: Path | None = None) -> None:
        with self.setup.station:
            met = meet(self.setup, self.words.append)
            if met is None:
                return
            self.clock.hasten()
            self.engine.battle = self.battle = LinkedBattle(met.agreed, self.setup.station.line, drum)
            for event in met.events:
                self.battle.handle(event)
            self.fault = play_linked(self.setup, LinkedPlay(self.setup.station, self.battle), capture)


def hosting(mode: BattleMode) -> tuple[LinkedStation, Address]:
    rules = rules_of("Ann", mode)
    station = LinkedStation.hosting(introduction("Ann", rules, "The shed"), rules, (LOOPBACK, 0))
    return station, station.port.address


def joining(address: Address, clock: HastyClock) -> LinkedStation:
    rules = rules_of("Ben", BattleMode.REPEAT)
    return LinkedStation.joining(introduction("Ben", rules), rules, address, clock.now_ns())


@pytest.mark.parametrize("mode", BattleMode, ids=lambda mode: mode.value)
def test_two_virtual_students_play_a_whole_battle_over_loopback(mode: BattleMode, tmp_path: Path) -> None:
    (station, address), clock = hosting(mode), HastyClock()
    host = End(clock, station, "pro,seed=3")
    guest = End(clock, joining(address, clock), "intermediate,seed=4")
    beside = threading.Thread(target=guest.play)
    beside.start()
    host.play(tmp_path / "battle.capture")
    beside.join()
    assert host.battle is not None
    assert guest.battle is not None
    assert host.battle.ended is guest.battle.ended is LinkEnd.COMPLETE
    assert (host.fault, guest.fault) == (None, None)
    assert network_fields(host.battle)["agree"] is network_fields(guest.battle)["agree"] is True
    assert network_fields(host.battle)["turns"] == network_fields(guest.battle)["turns"]
    assert all(len(one.turn.played) > 0 for one in host.battle.rounds.shared.standing())
    assert "the other station has the same" in network_report(host.battle)
    assert "Ben at " in host.words[0]
    assert "Ann at The shed hosts" in guest.words[0]
    assert (tmp_path / "battle.capture").stat().st_size > 1000


def test_who_has_the_end_asked_for_leaves_the_lobby_and_the_port_is_free_again() -> None:
    station, address = hosting(BattleMode.REPEAT)
    host = End(HastyClock(), station, "pro")
    host.asked.note(2)
    host.play()
    assert host.battle is None
    again = LinkedStation.hosting(
        introduction("Ann", rules_of("Ann", BattleMode.REPEAT)), rules_of("Ann", BattleMode.REPEAT), address
    )
    with again:
        assert again.port.address == address


def test_nobody_there_is_said_in_time() -> None:
    station, address = hosting(BattleMode.REPEAT)
    station.port.close()
    clock = HastyClock()
    clock.hasten()
    with pytest.raises(DeviceError, match="nobody hosts a battle"):
        End(clock, joining(address, clock), "pro").play()


def test_a_host_is_found_while_it_hosts_and_no_longer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("station.practice.battle.link.linked_station.LOOK_NS", NS_PER_S // 5)
    station, address = hosting(BattleMode.IMPROVISE)
    clock, pause = MonotonicClock(), partial(time.sleep, 0.002)
    with station:
        ended = threading.Event()

        def host() -> None:
            while not ended.is_set():
                station.advance(clock.now_ns())
                time.sleep(0.001)

        beside = threading.Thread(target=host)
        beside.start()
        (found,) = hosts_here(address[1], clock, pause, whom=LOOPBACK)
        ended.set()
        beside.join()
    assert (found.address, found.station, found.about) == (address, "The shed", "Ann: improvise, 240 bpm rock")
    assert not found.is_busy
    assert hosts_here(address[1], clock, pause, whom=LOOPBACK) == ()
