"""What stage and window show of a battle of two stations: the same `BattleView` as of any other battle.

A bar in which the time goes on is a change-over, whose message says who is waited for; a bar of the other player's turn
is a call of their side, whose phrase is what they played.
"""

from collections.abc import Sequence

from station.practice.battle.battle_result import JudgedTurn, standings, winner_of
from station.practice.battle.battle_rules import DRUMMER
from station.practice.battle.battle_view import BattleView, Doing, SideView, TurnView
from station.practice.battle.link.linked_battle import LinkedBattle, LinkEnd
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.turn_plan import PlannedTurn, TurnKind

_DOING = {TurnKind.CALL: Doing.CALL, TurnKind.ANSWER: Doing.ANSWER, TurnKind.CHANGEOVER: Doing.CHANGEOVER}


def linked_view(battle: LinkedBattle) -> BattleView:
    """The battle as of the last time that it was told."""
    at_ns, rules = battle.ear.at_ns, battle.rules
    running = None if at_ns is None else _running(battle, at_ns)
    judged = battle.rounds.shared.judged()
    return BattleView(
        rules=rules,
        at_ns=at_ns,
        doing=_doing(battle, running),
        turn=running,
        turns=tuple(_turn_view(battle, turn) for turn in battle.plan),
        sides=_sides(battle, judged),
        round=battle.plan[running].round if running is not None else _last_round(battle),
        rounds=rules.rounds_in_all,
        message=_message(battle, running),
        winner=winner_of(rules, judged, battle.ended is LinkEnd.COMPLETE) if battle.over else None,
    )


def _running(battle: LinkedBattle, at_ns: int) -> int | None:
    if at_ns < battle.ear.from_ns:
        return None
    begun = [turn.index for turn in battle.plan if battle.rules.ground.ns_of_bars(turn.first_bar) <= at_ns]
    return begun[-1] if begun else None


def _doing(battle: LinkedBattle, running: int | None) -> Doing:
    if battle.over:
        return Doing.OVER
    if battle.standing:
        return Doing.PAUSED
    if battle.ear.at_ns is None:
        return Doing.WAITING
    return Doing.COUNT_IN if running is None else _DOING[battle.plan[running].kind]


def _message(battle: LinkedBattle, running: int | None) -> str:
    name = battle.agreed.their_name
    if battle.ended is not None:
        return f"The battle ended: {battle.ended.value}."
    if battle.is_cut:
        return f"The line to {name} is cut: waiting for {name}."
    if battle.pausing:
        who = "you" if battle.agreed.our_side in battle.pausing else name
        return f"A pause, asked for by {who}."
    if running is not None and battle.plan[running].kind is TurnKind.CHANGEOVER:
        return f"Waiting for {name}."
    if battle.rounds.shared.disputed:
        return "Both stations judge a turn otherwise: it counts for nobody."
    return ""


def _turn_view(battle: LinkedBattle, turn: PlannedTurn) -> TurnView:
    shared = battle.rounds.shared.turns.get((turn.round, turn.side))
    live = battle.own.live.get(turn.index)
    return TurnView(
        index=turn.index,
        round=turn.round,
        side=turn.side,
        kind=turn.kind,
        start_ns=battle.rules.ground.ns_of_bars(turn.first_bar),
        bars=turn.bars,
        phrase=turn.phrase,
        keeping=turn.keeping,
        step=turn.step,
        played=battle.ear.strokes.of(turn) if live is None else live.played,
        judged=() if live is None else live.judged,
        marks=None if shared is None or turn.kind is TurnKind.CHANGEOVER else shared.marks,
    )


def _sides(battle: LinkedBattle, judged: Sequence[JudgedTurn]) -> tuple[SideView, ...]:
    rules = battle.rules
    drummer, *players = standings(rules, judged)
    shown = [SideView(find_opponent(rules.opponent).title, True, None, None, drummer.rounds_won)]
    for side, standing in zip(rules.player_sides, players, strict=True):
        name = rules.player_of(side).name
        shown.append(SideView(name, False, standing.points, standing.lives, standing.rounds_won))
    assert shown[DRUMMER].is_drummer, "the drummer's side is the first"
    return tuple(shown)


def _last_round(battle: LinkedBattle) -> int:
    return battle.plan[-1].round if battle.plan and battle.standing else 0
