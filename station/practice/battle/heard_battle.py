"""What is known of any battle by its ear: what the engine has said, and the time."""

from abc import ABC, abstractmethod
from collections.abc import Iterable

from station.engine.messages import Command, EngineEvent
from station.practice.battle.battle_ear import BattleEar
from station.practice.session.engine_state import EngineState


class HeardBattle(ABC):
    """A battle, or one end of it, that is moved on by events and time."""

    ear: BattleEar
    """What was heard."""

    @property
    def heard(self) -> EngineState:
        """What the engine has said."""
        return self.ear.heard

    @property
    def at_ns(self) -> int | None:
        """Battle time now; None while the transport stands."""
        return self.ear.at_ns

    @property
    def began_ns(self) -> int | None:
        """The session time at which battle time 0 was heard; None while the transport stands."""
        return None if self.at_ns is None else self.ear.now_ns - self.at_ns

    def update(self, now_ns: int, events: Iterable[EngineEvent]) -> tuple[Command, ...]:
        """Take all `events`, then move on to the present."""
        commands = [command for event in events for command in self.handle(event)]
        return (*commands, *self.advance(now_ns))

    @abstractmethod
    def handle(self, event: EngineEvent) -> tuple[Command, ...]:
        """Take one event."""

    @abstractmethod
    def advance(self, now_ns: int) -> tuple[Command, ...]:
        """Move on to the present."""
