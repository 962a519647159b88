"""A battle of two stations in real time without a window: kit and network are heard in turns, a text shows it.

The engine runs before anybody has come, so that a kit which wakes slowly keeps nobody waiting. Judgement depends on the
strokes' own times alone, however late this loop comes round.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from time import sleep

from station.core.clock import Clock
from station.core.errors import DeviceError, StationError
from station.engine.messages import EngineEvent
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_play import LinkedPlay
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LinkedStation
from station.practice.headless.end_signals import EndAsked
from station.practice.headless.guarded_output import GuardedOutput
from station.practice.headless.live import EngineLink, begin, end

ROUND_S = 0.005
"""How long to wait for an event before the network is asked again (our choice: far below what any margin counts on)."""


@dataclass(frozen=True, slots=True)
class LinkedSetup:
    """Where a battle of two stations is played from: `engine`, `clock`, the `station` on the network, who may end it.

    A `show` that fails costs no battle: `telling` remembers it.
    """

    engine: EngineLink
    clock: Clock
    station: LinkedStation
    show: Callable[[LinkedBattle], None]
    telling: GuardedOutput = field(default_factory=GuardedOutput)
    asked: EndAsked = field(default_factory=EndAsked)


@dataclass(frozen=True, eq=False)
class Met:
    """What two stations agreed on, and what the engine said meanwhile."""

    agreed: Agreed
    events: tuple[EngineEvent, ...]


def meet(setup: LinkedSetup, said: Callable[[str], None]) -> Met | None:
    """Wait until somebody is there and all is agreed; None where the end was asked for before.

    `said` is told who came and went. Raises `DeviceError` and `BadInput` as the lobby does.
    """
    events: list[EngineEvent] = []
    lobby, told = setup.station.lobby, 0
    while not setup.asked:
        events += setup.engine.events(ROUND_S)
        agreed = setup.station.advance(setup.clock.now_ns())
        for notice in lobby.notices[told:]:
            said(notice)
        told = len(lobby.notices)
        if agreed is not None:
            return Met(agreed, tuple(events))
    return None


def play_linked(setup: LinkedSetup, play: LinkedPlay, capture: Path | None) -> StationError | None:
    """Play until it is over or the end is asked for, and take leave; returns what the players must know.

    Raises `DeviceError` if the engine dies before the transport runs: then there is nothing to report.
    """
    fault: StationError | None = None
    try:
        begin(setup.engine, play, capture)
        while not play.over and not setup.asked:
            _step(setup, play)
    except DeviceError as error:
        if not play.battle.started:
            raise
        fault = error
        play.stop()
    else:
        fault = end(setup.engine, play)
    setup.station.take_leave(setup.clock, lambda: sleep(ROUND_S))
    return fault or setup.telling.fault("not all could be shown while you played, the battle is kept")


def _step(setup: LinkedSetup, play: LinkedPlay) -> None:
    events = setup.engine.events(ROUND_S)
    for command in play.update(setup.clock.now_ns(), events):
        setup.engine.send(command)
    setup.telling.attempt(setup.show, play.battle)
