"""A battle judged again from its capture alone: the same strokes and phrases give the same result.

The capture's bytes go through the decoders again; what the battle of the day said of itself (`battle_log`) tells which
turns were played, and what was to be repeated in them. Nothing is drawn or chosen anew: under other windows the same
turns may be worth something else.
"""

from collections.abc import Iterable
from dataclasses import replace

from station.core.errors import BadInput
from station.core.events import Choke, DeviceFound, DeviceLost, Hit
from station.devices.capture.capture import Capture
from station.devices.capture.replay import Entry, LoggedText, OutputChanged, TransportZero, replay_all
from station.engine.messages import Sounding, Started, Unheard
from station.practice.battle.battle_ear import BattleEar
from station.practice.battle.battle_result import BattleResult
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.records.battle_log import (
    BattleBegan,
    BattleEnded,
    BattlePaused,
    BattleSaid,
    BattleUnheard,
    TurnChosen,
    TurnsCut,
    battle_said_in,
)
from station.practice.battle.turn_judging import result_of
from station.practice.battle.turn_plan import PlannedTurn
from station.scoring.matching.hit_windows import Level


def judge_battle_again(capture: Capture, level: Level | None = None) -> BattleResult:
    """The battle that `capture` holds, judged by the windows of `level`, None: as on the day.

    One that was cut off lasts as long as its capture. Raises `BadInput` where it cannot be read, or holds no battle.
    """
    until_ns = capture.records[-1].at_ns if capture.records else 0
    return RejudgedBattle(replay_all(capture), level).result(until_ns)


class RejudgedBattle:
    """A battle as it comes out of the `entries` of a capture."""

    def __init__(self, entries: Iterable[Entry], level: Level | None = None) -> None:
        self._level = level
        self._began: BattleBegan | None = None
        self._ear: BattleEar | None = None
        self._ended: BattleEnded | None = None
        self._output: str | None = None
        self.plan: list[PlannedTurn] = []
        """The turns that were chosen."""
        for entry in entries:
            self._handle(entry)

    @property
    def rules(self) -> BattleRules:
        """What it was played by, and the level that it is judged by now; raises `BadInput` where there is no battle."""
        if self._began is None:
            raise BadInput("capture", "", "there is no battle in it")
        rules = self._began.rules
        return rules if self._level is None else replace(rules, level=self._level)

    @property
    def ear(self) -> BattleEar:
        """What was heard; raises as `battle_rules` does."""
        rules = self.rules
        assert self._ear is not None, f"a battle of {rules.rounds} rounds was heard"
        return self._ear

    def result(self, until_ns: int) -> BattleResult:
        """The result; of one that nobody ended until `until_ns`."""
        ear, rules = self.ear, self.rules
        ear.advance(until_ns if self._ended is None else self._ended.now_ns)
        is_complete = self._ended is not None and self._ended.is_complete
        return result_of(rules, self.plan, ear, is_complete)

    def _handle(self, entry: Entry) -> None:
        match entry:
            case LoggedText():
                said = battle_said_in(entry)
                if said is not None:
                    self._apply(said, entry.at_ns)
            case OutputChanged(output):
                self._output = output
                if self._ear is not None:
                    self._ear.handle(Sounding(output))
            case TransportZero(at_ns) if self._ear is not None:
                self._ear.handle(Started(at_ns, self._output))
            case Hit() | Choke() | DeviceLost() | DeviceFound() if self._ear is not None:
                self._ear.handle(entry)
            case _:
                pass

    def _apply(self, said: BattleSaid, at_ns: int) -> None:
        if isinstance(said, BattleBegan):
            self._began = said
            self._ear = BattleEar(said.rules, said.latency)
            self._ear.handle(Sounding(self._output))
            self.plan, self._ended = [], None
            return
        ear = self.ear
        ear.advance(at_ns)
        match said:
            case TurnChosen(turn):
                self._choose(turn)
            case TurnsCut(index):
                del self.plan[index:]
            case BattlePaused(from_ns):
                ear.pause(from_ns)
            case BattleUnheard(from_ns, until_ns):
                ear.handle(Unheard(from_ns, until_ns))
            case BattleEnded():
                self._ended = said

    def _choose(self, turn: PlannedTurn) -> None:
        is_next = turn.index == len(self.plan) and turn.side <= len(self.rules.players)
        if not is_next or turn.first_bar != (self.plan[-1].end_bar if self.plan else 0):
            raise BadInput("capture", f"turn {turn.index}", "it does not follow the turn before")
        self.plan.append(turn)
