"""The view of a battle, made of what it has planned, heard and judged."""

from collections.abc import Sequence
from dataclasses import dataclass

from station.practice.battle.battle_result import BattleResult, JudgedTurn, standings
from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.battle_view import BattleView, Doing, SideView, TurnView
from station.practice.battle.battle_words import message_of
from station.practice.battle.turn_plan import PlannedTurn, TurnKind

_DOING = {TurnKind.CALL: Doing.CALL, TurnKind.ANSWER: Doing.ANSWER, TurnKind.CHANGEOVER: Doing.CHANGEOVER}


@dataclass(frozen=True, eq=False)
class Moment:
    """Where a battle stands: `at_ns` of battle time, what it has `planned` and `judged`, and whether it is over."""

    rules: BattleRules
    at_ns: int | None
    planned: Sequence[PlannedTurn]
    judged: Sequence[JudgedTurn]
    from_ns: int = 0
    """Where the count-in ends."""
    is_paused: bool = False
    result: BattleResult | None = None

    @property
    def turn(self) -> int | None:
        """The index of the turn that runs."""
        if self.at_ns is None or self.at_ns < self.from_ns or self.result is not None:
            return None
        begun = [turn.index for turn in self.planned if self._start_ns(turn.first_bar) <= self.at_ns]
        last = self.planned[begun[-1]] if begun else None
        return None if last is None or self.at_ns >= self._start_ns(last.end_bar) else last.index

    @property
    def doing(self) -> Doing:
        """What goes on."""
        if self.result is not None:
            return Doing.OVER
        if self.is_paused:
            return Doing.PAUSED
        if self.at_ns is None:
            return Doing.WAITING
        turn = self.turn
        if turn is None and self.at_ns < self.from_ns:
            return Doing.COUNT_IN
        return _DOING[self.planned[-1 if turn is None else turn].kind]

    def _start_ns(self, bar: int) -> int:
        return self.rules.ground.ns_of_bars(bar)


def view_of(moment: Moment, turns: tuple[TurnView, ...]) -> BattleView:
    """The view of a moment with its `turns`."""
    rules, running = moment.rules, moment.turn
    number = 0 if running is None else moment.planned[running].round
    if running is None and moment.judged:
        number = moment.judged[-1].planned.round
    return BattleView(
        rules=rules,
        at_ns=moment.at_ns,
        doing=moment.doing,
        turn=running,
        turns=turns,
        sides=side_views(rules, moment.judged),
        round=number,
        rounds=rules.rounds_in_all,
        message=message_of(moment.rules, moment.doing, None if running is None else moment.planned[running]),
        winner=None if moment.result is None else moment.result.winner,
    )


def side_views(rules: BattleRules, judged: Sequence[JudgedTurn]) -> tuple[SideView, ...]:
    """Every side, the drummer first."""
    sides = standings(rules, judged)
    has_points = rules.mode is BattleMode.IMPROVISE and rules.drummer_competes
    drummer = SideView(
        rules.opponent, True, sides[DRUMMER].points if has_points else None, None, sides[DRUMMER].rounds_won
    )
    players = (
        SideView(
            rules.player_of(side).name,
            False,
            sides[side].points,
            sides[side].lives,
            sides[side].rounds_won,
            sides[side].handicapped,
        )
        for side in rules.player_sides
    )
    return (drummer, *players)
