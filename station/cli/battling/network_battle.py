"""`station battle --host` and `--join`: a battle of two stations, in the terminal, on a kit or by a virtual student."""

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from time import sleep

from station.cli.battling.network_options import LIST, NetworkOptions
from station.cli.console import print_json, say, write
from station.core.clock import Clock, MonotonicClock
from station.core.errors import BadInput, StationError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.engine.engine_config import EngineConfig
from station.engine.supervisor import EngineSupervisor
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_words import LANDING_WORDS
from station.practice.battle.drummed import drummed
from station.practice.battle.link.link_socket import address_of, own_address
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_keeping import linked_record
from station.practice.battle.link.linked_play import LinkedPlay
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LinkedStation, hosts_here, introduction
from station.practice.battle.records.battle_folder import BattleFolder
from station.practice.battle.vocabulary.lesson_bars import lesson_bars
from station.practice.headless.end_signals import end_asked
from station.practice.headless.linked_live import ROUND_S, LinkedSetup, meet, play_linked
from station.practice.headless.linked_text import LinkedText
from station.practice.headless.live import EngineLink
from station.practice.headless.virtual_partner import VirtualPartner
from station.practice.session.device_latency import latency_of
from station.simulation.student_spec import parse_spec


@dataclass(frozen=True, slots=True)
class NetworkBattle:
    """What is played at this end: its rules (of a guest the click alone counts), who plays, where it is left."""

    rules: BattleRules
    settings: Settings
    network: NetworkOptions
    spec: str | None
    folder: BattleFolder
    as_json: bool


def list_hosts(network: NetworkOptions) -> None:
    """Print who hosts a battle here, a line each; raises `DeviceError` where no port can be had."""
    found = hosts_here(network.port, MonotonicClock(), partial(sleep, ROUND_S))
    for one in found:
        busy = "  (somebody is there already)" if one.is_busy else ""
        write(f"{one.address[0]}:{one.address[1]}  {one.station}  {one.about}  {one.ping_ms:.0f} ms{busy}")
    if not found:
        say("nobody hosts a battle on this network; type the host's address if you know it")


def play_over_network(asked: NetworkBattle) -> StationError | None:
    """Meet, play, keep and print; returns what the player must know that nobody has raised."""
    clock = MonotonicClock()
    with _engine(asked, clock) as engine, ExitStack() as until_saved:
        station = until_saved.enter_context(_station(asked, clock))
        text = LinkedText(say)
        setup = LinkedSetup(engine, clock, station, text.show, asked=until_saved.enter_context(end_asked()))
        met = meet(setup, say)
        if met is None:
            return None
        say(_agreed_words(met.agreed))
        if met.agreed.rules.mode is BattleMode.IMPROVISE:
            say(LANDING_WORDS)
        battle = LinkedBattle(met.agreed, station.line, drummed, latency_of(asked.settings, load_calibration()))
        if isinstance(engine, VirtualPartner):
            engine.battle = battle
        for event in met.events:
            battle.handle(event)
        fault = play_linked(setup, LinkedPlay(station, battle), asked.folder.capture)
        _leave(battle, asked)
    return fault


@contextmanager
def _engine(asked: NetworkBattle, clock: Clock) -> Iterator[EngineLink]:
    if asked.spec is not None:
        yield VirtualPartner(parse_spec(asked.spec), clock)
        return
    with EngineSupervisor(EngineConfig.from_settings(asked.settings)) as engine:
        yield engine


def _station(asked: NetworkBattle, clock: Clock) -> LinkedStation:
    network, rules = asked.network, asked.rules
    hello = introduction(rules.players[0].name, rules, network.name or "")
    if network.host:
        if rules.mode is BattleMode.REPEAT:
            lesson_bars(rules.ground.beats, rules.ground.unit, rules.ground.feel)  # read once, before anybody waits
        station = LinkedStation.hosting(hello, rules, (network.bind, network.port), not network.guest_begins)
        where = network.bind or own_address() or "this computer's address"
        say(f"{hello.station} hosts on port {station.port.address[1]} (UDP); the other types")
        say(f"  station battle --join {where}:{station.port.address[1]}")
        return station
    if network.join is None:
        raise BadInput("--join", "", f"expected an address, or {LIST}")
    return LinkedStation.joining(hello, rules, address_of(network.join, network.port), clock.now_ns())


def _agreed_words(agreed: Agreed) -> str:
    rules, ground = agreed.rules, agreed.rules.ground
    names = " against ".join(
        f"{rules.player_of(side).name} ({agreed.level_of(side).words})" for side in rules.player_sides
    )
    return f"{names}: {rules.mode.value}, {ground.tempo_bpm:g} bpm, {rules.rounds_in_all} rounds"


def _leave(battle: LinkedBattle, asked: NetworkBattle) -> None:
    """Keep what both ends have, and print it."""
    record = linked_record(battle)
    refused: StationError | None = None
    try:
        asked.folder.keep(record.document, record.report)
    except StationError as fault:
        refused = fault
    if asked.as_json:
        print_json(record.document)
    else:
        write(record.report, end="", flush=True)
    if refused is not None:
        raise refused
    say(f"report   {asked.folder.report}")
