"""When no stroke of a player could be heard: their device was gone, or the engine had ended.

Nothing that was not heard counts for or against anybody. Spans are told in battle time.
"""

from collections.abc import Callable, Sequence

from station.core.events import Choke, DeviceFound, DeviceLost, Hit
from station.engine.messages import EngineEvent, Unheard
from station.practice.battle.people.player import Player
from station.practice.session.engine_state import EngineState
from station.scoring.matching.unheard import Span, merged

ToBattle = Callable[[int], int | None]
"""The battle time of a session time; None while the transport stands."""


class Hearing:
    """One player's ears: hand `handle` every event of the engine, and `close` them where the transport stops."""

    def __init__(self, player: Player) -> None:
        self._player = player
        self._heard = EngineState()
        self._kept: list[Span] = []
        self._told = 0

    def handle(self, event: EngineEvent) -> None:
        """Take one event."""
        match event:
            case Hit() | Choke() | DeviceLost() | DeviceFound() if self._player.plays_on(event.device):
                self._heard.handle(event)
            case Unheard():
                self._heard.handle(event)
            case _:
                pass

    def spans(self, now_ns: int, battle_ns: ToBattle) -> Sequence[Span]:
        """The spans until session time `now_ns`, in battle time, in order."""
        spans = [*self._heard.unheard[self._told :]]
        if self._heard.deaf_since_ns is not None:
            spans.append((self._heard.deaf_since_ns, max(now_ns, self._heard.deaf_since_ns)))
        ends = [(battle_ns(begin_ns), battle_ns(end_ns)) for begin_ns, end_ns in spans]
        return merged([*self._kept, *((begin, end) for begin, end in ends if begin is not None and end is not None)])

    def close(self, now_ns: int, battle_ns: ToBattle, from_ns: int) -> None:
        """The transport stops: keep what could not be heard until now, but for what is played again `from_ns` on."""
        self._kept = [(begin, min(end, from_ns)) for begin, end in self.spans(now_ns, battle_ns) if begin < from_ns]
        self._heard.stop_listening(now_ns)
        self._told = len(self._heard.unheard)
