"""What is said of a battle while it is played, in a line."""

from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.battle_view import Doing
from station.practice.battle.turn_plan import PlannedTurn


def round_words(rules: BattleRules, number: int) -> str:
    """Such as "round 3 of 8", or "the final"."""
    return "the final" if rules.is_final(number) else f"round {number} of {rules.rounds}"


LANDING_WORDS = "Land on one: the stroke on the downbeat after your bars is a quarter of what your time is worth."
"""Said before improvised turns (`judging.time_kept`)."""


def message_of(rules: BattleRules, doing: Doing, turn: PlannedTurn | None) -> str:
    """The line to read now; empty where there is nothing to say."""
    if doing is Doing.CHANGEOVER and turn is not None:
        return f"change seats: {rules.player_of(turn.side).name} plays next"
    if doing is Doing.CALL and turn is not None:
        return round_words(rules, turn.round)
    if doing is Doing.ANSWER and turn is not None and not rules.is_solo:
        return rules.player_of(turn.side).name
    return _WORDS.get(doing, "")


_WORDS = {Doing.PAUSED: "paused", Doing.OVER: "the battle is over", Doing.ANSWER: "your turn"}


def points_words(points: float) -> str:
    """Points as they are told everywhere: to a tenth, as whoever is ahead by less is not ahead to anybody's eye."""
    return f"{points:.1f} points"
