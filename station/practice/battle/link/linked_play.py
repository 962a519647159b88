"""One end of a battle of two stations as whoever plays it moves it on: the battle, and its station on the network.

It is played as a battle at one station is (`played_battle`); every `advance` also carries the line's datagrams.
"""

from collections.abc import Mapping

from station.engine.messages import Command, EngineEvent
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import BattleView
from station.practice.battle.heard_battle import HeardBattle
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_document import linked_result
from station.practice.battle.link.linked_station import LinkedStation
from station.practice.battle.link.linked_view import linked_view
from station.practice.battle.turn_marks import TurnMarks


class LinkedPlay(HeardBattle):
    """`battle`, whose line is that of `station`."""

    def __init__(self, station: LinkedStation, battle: LinkedBattle) -> None:
        self.station, self.battle, self.ear = station, battle, battle.ear
        self._now_ns: int | None = None

    @property
    def rules(self) -> BattleRules:
        """What it is played by."""
        return self.battle.rules

    @property
    def paused(self) -> bool:
        """Whether a pause was asked for here."""
        return self.battle.agreed.our_side in self.battle.pausing

    @property
    def over(self) -> bool:
        """Whether it has ended, for whatever reason."""
        return self.battle.over

    def start(self) -> tuple[Command, ...]:
        """Begin with the count-in."""
        return self.battle.start()

    def stop(self) -> tuple[Command, ...]:
        """End it, and say so to the other end."""
        commands = self.battle.stop()
        if self._now_ns is not None:
            self.station.exchange(self._now_ns)
        return commands

    def pause(self) -> tuple[Command, ...]:
        """Ask for a pause: both stations stand once the turn that each plays is over."""
        self.battle.pause()
        return ()

    def resume(self) -> tuple[Command, ...]:
        """Go on, where nobody else asked for a pause."""
        self.battle.resume()
        return ()

    def handle(self, event: EngineEvent) -> tuple[Command, ...]:
        """Take one event."""
        return self.battle.handle(event)

    def advance(self, now_ns: int) -> tuple[Command, ...]:
        """Take what has come over the network, move on to the present, send what that says."""
        self._now_ns = now_ns
        self.station.exchange(now_ns)
        commands = self.battle.advance(now_ns)
        self.station.exchange(now_ns)
        return commands

    def view(self) -> BattleView:
        """What a stage and a window show, as of the last event and time."""
        return linked_view(self.battle)

    def result(self) -> BattleResult:
        """The turns that stand, of both players."""
        return linked_result(self.battle)

    def last_marks(self) -> Mapping[int, TurnMarks]:
        """What the last turn of each player that stands is worth, by side; none of a turn that counts for nobody."""
        judged = self.battle.rounds.shared.judged()
        return {turn.planned.side: turn.marks for turn in judged if turn.marks is not None}
