"""What is written over a battle: how both sides stand, the round, the beat, the count before it, who has won."""

from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_view import BattleView, Doing, SideView
from station.practice.battle.battle_words import points_words as points_in_words
from station.practice.battle.battle_words import round_words
from station.practice.battle.opponents.opponent import find_opponent
from station.render.snapshot import Hud, ScoreLine, SideLine
from station.scenes.battle.cast import Sides


def battle_hud(view: BattleView, sides: Sides, at_ns: int) -> Hud:
    """The words at a battle time, of the two `sides` that are seen."""
    rules = view.rules
    line = ScoreLine((_side(view, sides[0]), _side(view, sides[1])), _middle(view))
    bar_ns = rules.ground.ns_of_bars(1)
    beat = 1 + int(at_ns % bar_ns // rules.beat_ns)
    is_running = view.turn is not None and view.doing not in (Doing.PAUSED, Doing.OVER)
    is_counted = view.doing is Doing.COUNT_IN and at_ns >= -rules.count_in_bars * bar_ns
    return Hud(
        title="",
        bar=1 + at_ns // bar_ns if is_running else None,
        beat=beat if is_running else None,
        beats=rules.ground.beats_a_bar,
        count_in=beat if is_counted else None,
        message=_message(view),
        halt="Paused" if view.doing is Doing.PAUSED else _ending(view),
        standings=line,
    )


def name_of(rules: BattleRules, side: SideView) -> str:
    """What a side is called on the stage: the opponent by its title."""
    return find_opponent(rules.opponent).title if side.is_drummer else side.name


def points_words(rules: BattleRules, side: SideView) -> str:
    """Points and rounds of a side in words; a drummer who does not compete for them is who is repeated."""
    points = None if side.points is None else points_in_words(side.points)
    is_counted = rules.mode is BattleMode.REPEAT or side.rounds_won
    won = f"{side.rounds_won} won" if is_counted else None
    return " · ".join(filter(None, (points, won)))


def _side(view: BattleView, index: int) -> SideLine:
    rules, side = view.rules, view.sides[index]
    plays = view.turn is not None and view.turns[view.turn].side == index
    return SideLine(
        name_of(rules, side),
        points_words(rules, side),
        side.lives or 0,
        0 if side.lives is None else rules.lives,
        side.rounds_won,
        plays and view.doing in (Doing.CALL, Doing.ANSWER),
    )


def _middle(view: BattleView) -> str:
    """The round, and whose turn it is while people play."""
    words = round_words(view.rules, view.round) if view.round else ""
    parts = [words[:1].upper() + words[1:], view.message if view.doing is Doing.ANSWER else ""]
    return " · ".join(filter(None, parts))


def _message(view: BattleView) -> str:
    """What stands over the scene while nobody plays; never over who does."""
    return view.message if view.doing is Doing.CHANGEOVER else ""


def _ending(view: BattleView) -> str:
    """Who has won, large; nothing before the end."""
    if view.doing is not Doing.OVER:
        return ""
    return "A draw" if view.winner is None else f"{name_of(view.rules, view.sides[view.winner])} wins"
