"""A battle of another day in the window: its result is shown and its best bar seen again; nobody plays it."""

from pathlib import Path

from station.app.engine_client import EngineClient
from station.app.sessions.battle_session import BattleSession, NewBattle, Notify
from station.engine.messages import EngineEvent
from station.practice.battle.battle import Battle
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_view import BattleView
from station.practice.battle.drummed import drummed
from station.scenes.battle.kept_views import KeptViews
from station.scenes.battle.motion_chain import Body


class KeptBattle(BattleSession):
    """The battle that came to `outcome`; `folder` is where it is kept, empty where that is gone."""

    def __init__(self, engine: EngineClient, outcome: BattleResult, folder: str, player: Body, notify: Notify) -> None:
        super().__init__(engine, Battle(outcome.rules, drummed), player, notify)
        self.outcome = outcome
        self._where = Path(folder) if folder else None

    @property
    def folder(self) -> Path | None:
        """Where it is kept, None where that is gone."""
        return self._where

    def handle(self, event: EngineEvent) -> None:
        """Strokes of now are none of it; what the engine says of kits and sound is taken in."""
        self.heard.handle(event)

    def advance(self, now_ns: int) -> bool:
        """Nothing moves: it is over."""
        del now_ns
        return True

    def view(self) -> BattleView:
        """How it stood at its end."""
        assert self.outcome is not None, "it is over"
        if self._view is None:
            kept = KeptViews(self.outcome)
            self._view = kept.at(kept.end_ns)
        return self._view


def battle_of_history(outcome: BattleResult, folder: str) -> NewBattle:
    """A battle that came to `outcome` on another day."""
    return lambda engine, latency, player, notify: KeptBattle(engine, outcome, folder, player, notify)
