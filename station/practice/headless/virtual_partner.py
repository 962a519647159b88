"""A virtual student at a station on the network: an engine in this process on the computer's own clock, and a kit.

The other station hears them as it hears anybody, in real time.
"""

import heapq
from time import sleep

from station.core.clock import Clock
from station.engine.messages import Command, EngineEvent
from station.practice.battle.battle_rules import BattleMode
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.phrase import Turn
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.battle.virtual_improviser import VirtualImproviser
from station.practice.headless.engine_here import EngineHere
from station.simulation.student_midi import TimedBytes
from station.simulation.student_spec import StudentSpec
from station.simulation.virtual_student import VirtualStudent

DEVICE = "virtual student"


class VirtualPartner:
    """An `EngineLink` (`headless.live`) with somebody who plays; tell it the `battle` once there is one."""

    def __init__(self, spec: StudentSpec, clock: Clock) -> None:
        self.battle: LinkedBattle | None = None
        """What is played."""
        self._clock = clock
        self._engine = EngineHere([DEVICE])
        self._engine.advance_to(clock.now_ns())
        self._student, self._improviser = VirtualStudent(spec), VirtualImproviser(spec)
        self._coming: list[tuple[int, int, bytes]] = []
        self._performed = self._count = 0

    def send(self, command: Command) -> None:
        """Hand the engine a command."""
        self._engine.send(command)

    def events(self, wait_s: float = 0.0) -> list[EngineEvent]:
        """What has happened since the last call, after so long."""
        sleep(wait_s)
        self._perform()
        now_ns = self._clock.now_ns()
        found: list[EngineEvent] = []
        while self._coming and self._coming[0][0] <= now_ns:
            at_ns, _, data = heapq.heappop(self._coming)
            found += self._until(at_ns)
            self._engine.feed(DEVICE, data, at_ns)
        return found + self._until(now_ns)

    def _until(self, now_ns: int) -> list[EngineEvent]:
        self._engine.advance_to(now_ns)
        return self._engine.events()

    def _perform(self) -> None:
        """Have every turn of ours played that has been planned since."""
        if self.battle is None or (began_ns := self.battle.began_ns) is None:
            return
        plan = self.battle.plan
        for turn in plan[self._performed :]:
            if turn.kind is TurnKind.ANSWER:
                start_ns = began_ns + self.battle.rules.ground.ns_of_bars(turn.first_bar)
                for at_ns, data in self._played(turn, self.battle):
                    self._count += 1
                    heapq.heappush(self._coming, (start_ns + at_ns, self._count, data))
        self._performed = len(plan)

    def _played(self, turn: PlannedTurn, battle: LinkedBattle) -> list[TimedBytes]:
        if battle.rules.mode is BattleMode.REPEAT:
            assert turn.phrase is not None, "an answer repeats a phrase"
            return list(self._student.play(turn.phrase.score).midi)
        own, theirs = list[Turn](), list[Turn]()
        for (_, side), shared in battle.rounds.shared.turns.items():
            (own if side == battle.agreed.our_side else theirs).append(shared.turn)
        return list(self._improviser.improvise(battle.rules.ground, turn.bars, theirs, own).midi)
