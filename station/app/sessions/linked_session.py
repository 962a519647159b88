"""A battle of two stations in the window: the friend's part of the stage, what is waited for, what is kept."""

from collections.abc import Mapping

from station.app.engine_client import EngineClient
from station.app.sessions.battle_session import BattleSession, NewBattle, Notify
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.drummed import drummed
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_keeping import linked_record
from station.practice.battle.link.linked_play import LinkedPlay
from station.practice.battle.link.linked_rules import Agreed
from station.practice.battle.link.linked_station import LinkedStation
from station.practice.battle.records.battle_folder import BattleFolder
from station.practice.battle.turn_marks import TurnMarks
from station.scenes.battle.cast import cast_of, opponent_body
from station.scenes.battle.motion_chain import Body


class LinkedSession(BattleSession):
    """One end of a battle: `play` moves it on, and its station is left by whoever opened it."""

    can_be_judged_again = False

    def __init__(self, engine: EngineClient, play: LinkedPlay, player: Body, notify: Notify) -> None:
        super().__init__(engine, play, player, notify)
        self._play = play

    @property
    def told(self) -> str:
        """Who or what is waited for, or why it is over."""
        return self.view().message

    def last_marks(self) -> Mapping[int, TurnMarks]:
        """What the last turn of each player that stands is worth."""
        return self._play.last_marks()

    @property
    def how_it_ended(self) -> str:
        """With whom it was, why it is over, and whether both stations have the same of it."""
        battle = self._play.battle
        assert battle.ended is not None, "it is over"
        shared = battle.rounds.shared
        if battle.their_digest is None:
            same = "the other station has not said what it has of it"
        elif battle.their_digest == shared.digest and not shared.disputed:
            same = "both stations have the same record"
        else:
            same = "the stations differ on a turn, which counts for nobody"
        fault = f" ({battle.fault})" if battle.fault else ""
        return f"With {battle.agreed.their_name} over the network: {battle.ended.value}{fault}; {same}"

    @property
    def _away(self) -> int:
        """The friend's side."""
        return self._play.battle.agreed.their_side

    def _cast(self) -> Mapping[int, Body]:
        """The friend stands there as the opponent would: another kit, another figure."""
        return cast_of(self.rules, self._player, {self._away: opponent_body(self.rules.opponent, self._player)})

    def _ended(self) -> None:
        """An engine that has died ends it for the friend too."""
        if not self._engine.alive:
            self._play.stop()

    def _keep(self, folder: BattleFolder, outcome: BattleResult) -> None:
        """Write what came of it, and how both stations agree."""
        del outcome
        record = linked_record(self._play.battle)
        self._notify(folder.keep(record.document, record.report) or "")


def battle_linked(station: LinkedStation, agreed: Agreed) -> NewBattle:
    """One end of what two stations agreed on."""
    return lambda engine, latency, player, notify: LinkedSession(
        engine, LinkedPlay(station, LinkedBattle(agreed, station.line, drummed, latency)), player, notify
    )
