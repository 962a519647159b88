"""A battle as one JSON document, `drum-station/battle/1` (docs/documents.md): what was agreed, every round, who won.

Nothing in it depends on the day or on the computer, so that the same seed and the same strokes give the same bytes.
"""

from itertools import groupby

from station.core.units import NS_PER_S
from station.practice.battle.battle_result import BattleResult, JudgedTurn, Standing, is_lost
from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.records.battle_advice import practise_next
from station.practice.battle.records.marks_fields import marks_fields
from station.practice.battle.records.rules_fields import rules_fields
from station.practice.battle.turn_plan import TurnKind
from station.scoring.report.assessment_document import Json

SCHEMA = "drum-station/battle/1"
_PLACES = 3


def battle_document(result: BattleResult) -> dict[str, Json]:
    """All that is told of a battle that is over, or was stopped."""
    rules, winner = result.rules, result.winner
    by_round = groupby(result.turns, key=lambda turn: turn.planned.round)
    return {
        "schema": SCHEMA,
        "rules": rules_fields(rules),
        "complete": result.is_complete,
        "played_on_after": result.played_on_after,
        "winner": None if winner is None else side_name(rules, winner),
        "winner_side": winner,
        "scores": [_score(result, side, standing) for side, standing in enumerate(result.standings)],
        "rounds": [_round(result, number, list(turns)) for number, turns in by_round],
        "output": result.output,
        "latency": result.latency.words(result.devices[-1], result.output),
        "next": [{"text": one.text, "lesson": one.lesson} for one in practise_next(result)],
    }


def side_name(rules: BattleRules, side: int) -> str:
    """Who a side is, in words."""
    if side != DRUMMER:
        return rules.player_of(side).name
    return OPPONENTS[rules.opponent].title if rules.opponent in OPPONENTS else rules.opponent


def _score(result: BattleResult, side: int, standing: Standing) -> dict[str, Json]:
    rules = result.rules
    has_points = side != DRUMMER or (rules.mode is BattleMode.IMPROVISE and rules.drummer_competes)
    return {
        "side": side,
        "name": side_name(rules, side),
        "drummer": side == DRUMMER,
        "points": round(standing.points, _PLACES) if has_points else None,
        "lives": standing.lives,
        "rounds_won": standing.rounds_won,
        "handicapped": None if standing.handicapped is None else round(standing.handicapped, _PLACES),
        "device": result.devices[side],
    }


def _round(result: BattleResult, number: int, turns: list[JudgedTurn]) -> dict[str, Json]:
    rules = result.rules
    steps = [turn.planned.step for turn in turns if turn.planned.step is not None]
    return {
        "round": number,
        "final": rules.is_final(number),
        "weight": rules.weight(number),
        "step": steps[0] if len(set(steps)) == 1 else None,
        "turns": [_turn(rules, turn) for turn in turns],
    }


def _turn(rules: BattleRules, turn: JudgedTurn) -> dict[str, Json]:
    planned = turn.planned
    is_answer = planned.kind is TurnKind.ANSWER and turn.marks is not None
    is_repeat = rules.mode is BattleMode.REPEAT
    return {
        "turn": planned.index,
        "kind": planned.kind.value,
        "side": planned.side,
        "name": side_name(rules, planned.side),
        "first_bar": planned.first_bar + 1,
        "bars": planned.bars,
        "starts_s": round(rules.ground.ns_of_bars(planned.first_bar) / NS_PER_S, _PLACES),
        "answers": planned.call,
        "step": planned.step,
        "phrase": planned.phrase.words if planned.phrase is not None else None,
        "strokes": None if turn.played is None else len(turn.played.played),
        "won": not is_lost(rules, turn) if is_answer and is_repeat else None,
        "marks": None if turn.marks is None else marks_fields(turn.marks),
    }
