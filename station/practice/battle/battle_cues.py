"""What sounds in a battle: the click, the drummer's phrases, the time that it keeps; cues in battle time."""

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.turn_plan import PlannedTurn, TurnKind
from station.practice.session.cues.click_pattern import click_cues, count_in, counting, leads_ns
from station.practice.session.cues.stroke_cues import demonstration_cues, in_order, moved_by


def count_in_cues(rules: BattleRules, until_ns: int) -> NDArray[np.void]:
    """The count before the downbeat at `until_ns`, (n,) of `CUE_DTYPE`."""
    before, ticks = count_in(rules.ground.tempo_map, rules.count_in_bars)
    cues = click_cues(before, ticks, counting(rules.click))
    return moved_by(cues, until_ns - rules.ground.ns_of_bars(rules.count_in_bars))


def turn_cues(rules: BattleRules, turn: PlannedTurn) -> NDArray[np.void]:
    """All that sounds because of a turn, (n,) of `CUE_DTYPE` in order; a landing sounds into the turn after it."""
    start_ns = rules.ground.ns_of_bars(turn.first_bar)
    parts = [_clicks(rules, turn)]
    said = turn.phrase if turn.kind is TurnKind.CALL else turn.keeping
    if said is not None:
        parts.append(moved_by(demonstration_cues(said.with_landing), start_ns))
    return in_order(parts)


def _clicks(rules: BattleRules, turn: PlannedTurn) -> NDArray[np.void]:
    ground = rules.ground
    cues = click_cues(ground.tempo_map, turn.end_bar * ground.bar_ticks, rules.click)
    inside: NDArray[np.void] = cues[cues["at_ns"] + leads_ns(cues) >= ground.ns_of_bars(turn.first_bar)]
    return inside
