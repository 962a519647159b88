"""What is heard of a battle, live and from a capture: every stroke in battle time, and when none could be heard.

A stroke's battle time = its stamp − its pad's latency − (the transport's zero + the output's latency) − the count-in,
as a session reckons it (`session.engine_state`). After a pause the count-in comes once more, and battle time goes on
from where the part that was cut begins.
"""

from dataclasses import replace

from station.core.events import Hit
from station.engine.messages import EngineEvent
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.people.hearing import Hearing
from station.practice.battle.phrase import Turn
from station.practice.battle.turn_plan import PlannedTurn
from station.practice.battle.turn_strokes import TurnStrokes
from station.practice.session.device_latency import Latency
from station.practice.session.engine_state import EngineState
from station.scoring.matching.unheard import Span


class BattleEar:
    """Hand `handle` every event of the engine, `advance` the time, and say when the battle pauses and goes on."""

    def __init__(self, rules: BattleRules, latency: Latency) -> None:
        self._rules = rules
        self.heard = EngineState(latency)
        """What the engine has said."""
        self.strokes = TurnStrokes(rules)
        """What was played."""
        self.now_ns = 0
        """The session time that it knows."""
        self.from_ns = 0
        """The battle time at which the count-in ends."""
        self._count_in_ns = rules.ground.ns_of_bars(rules.count_in_bars)
        self._hearing = {side: Hearing(rules.player_of(side)) for side in rules.player_sides}

    def handle(self, event: EngineEvent) -> Hit | None:
        """Take one event; the stroke in battle time, where it is one that may count."""
        self.heard.handle(event)
        for hearing in self._hearing.values():
            hearing.handle(event)
        if not isinstance(event, Hit) or (at_ns := self._of_stroke(event)) is None:
            return None
        if at_ns < self.from_ns - self._rules.early_ns:  # in the count-in
            return None
        stroke = replace(event, at_ns=at_ns)
        self.strokes.add(stroke)
        return stroke

    def advance(self, now_ns: int) -> None:
        """Tell the session time."""
        self.now_ns = max(now_ns, self.now_ns)

    @property
    def at_ns(self) -> int | None:
        """Battle time now, negative in the count-in; None while the transport stands."""
        return self._battle_ns(self.now_ns)

    def turn(self, planned: PlannedTurn, until_ns: int | None = None) -> Turn:
        """What was played in an answer, before `until_ns` of the battle if that is said."""
        return self.strokes.turn(planned, until_ns)

    def unheard(self, planned: PlannedTurn) -> tuple[Span, ...]:
        """When in an answer, in turn time, no stroke of its player could be heard."""
        start_ns, end_ns = (self._rules.ground.ns_of_bars(bar) for bar in (planned.first_bar, planned.end_bar))
        spans = self._hearing[planned.side].spans(self.now_ns, self._battle_ns)
        return tuple((begin - start_ns, end - start_ns) for begin, end in spans if begin < end_ns and end > start_ns)

    def pause(self, from_ns: int) -> None:
        """The transport stops; what was played from `from_ns` of the battle on is played again."""
        for hearing in self._hearing.values():
            hearing.close(self.now_ns, self._battle_ns, from_ns)
        self.strokes.forget_from(from_ns - self._rules.early_ns)
        self.heard.zero_ns, self.from_ns = None, from_ns

    def _battle_ns(self, at_ns: int) -> int | None:
        return self._counted(self.heard.transport_ns(at_ns))

    def _of_stroke(self, hit: Hit) -> int | None:
        return self._counted(self.heard.played_ns(hit))

    def _counted(self, transport_ns: int | None) -> int | None:
        return None if transport_ns is None else transport_ns - self._count_in_ns + self.from_ns
