"""Who stands on the stage: the body of every side, and which two sides are seen."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from station.motion.kinematics.figure import figure_names, load_figure
from station.motion.style.style import ANYBODY
from station.motion.style.style_file import load_style
from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.battle_view import TurnView
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.turn_plan import TurnKind
from station.scenes.battle.motion_chain import Body

Sides = tuple[int, int]
"""The side on the left and the one on the right, as indices of the battle's sides."""


_FINISH = {"jazz": "maple", "steady": "maple"}
"""What an opponent's shells are made of; the others' are black (our choice: one tells the two kits apart)."""


def opponent_body(name: str, player: Body) -> Body:
    """The opponent of that name at a kit like the `player`'s of another finish, in its own style.

    Its figure is its own, but for one that looks like the player. Raises `BadInput` for a name that is none.
    """
    opponent = find_opponent(name)
    finish = _FINISH.get(name, "black")
    kit = replace(player.kit, finish=finish if finish != player.kit.finish else "teal")
    own = [] if opponent.figure == ANYBODY else [opponent.figure]
    figures = [load_figure(word) for word in (*own, *figure_names())]
    figure = next(figure for figure in figures if figure.look != player.figure.look)
    return Body(kit, figure, load_style(opponent.motion_style))


def cast_of(rules: BattleRules, player: Body, others: Mapping[int, Body] | None = None) -> dict[int, Body]:
    """A body for every side: the opponent's own on the player's kit, `player`'s for all players but the `others`.

    One figure for all who take turns at one place of the stage is best: another one has to be built, in a second or so.
    """
    bodies = {DRUMMER: opponent_body(rules.opponent, player)}
    bodies |= dict.fromkeys(rules.player_sides, player)
    return bodies | dict(others or {})


def sides_on_stage(rules: BattleRules, turns: Sequence[TurnView], at_ns: int) -> Sides:
    """Who is seen at a battle time: the drummer and who answers it, or the players who trade with each other."""
    if rules.is_solo:
        return DRUMMER, 1
    if rules.mode is BattleMode.IMPROVISE and len(rules.players) == 2:
        return 1, 2
    answers = [turn for turn in turns if turn.kind is TurnKind.ANSWER]
    begun = [turn for turn in answers if turn.start_ns <= at_ns]
    coming = next((turn for turn in answers if turn.start_ns > at_ns), None)
    now = begun[-1] if begun else coming
    if rules.mode is BattleMode.REPEAT:
        is_over = now is None or at_ns >= now.start_ns + rules.ground.ns_of_bars(now.bars)
        shown = coming if is_over and coming is not None else now
        return DRUMMER, 1 if shown is None else shown.side
    first = 1 if now is None else now.side
    return first, first % len(rules.players) + 1
