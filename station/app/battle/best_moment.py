"""What of a battle is worth being seen again: the best bar that was improvised, or the hardest phrase repeated."""

from dataclasses import dataclass

import numpy as np

from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.judging.best_bar import best_bar
from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.session.cues.click_pattern import click_cues
from station.practice.session.cues.listening import RING_NS, Listening, cues_between, played_cues
from station.practice.session.cues.stroke_cues import in_order


@dataclass(frozen=True, eq=False)
class BestMoment:
    """`bars` of a `turn` from `bar` (from 0) on."""

    turn: JudgedTurn
    bar: int
    bars: int


def best_moment(result: BattleResult) -> BestMoment | None:
    """The moment; None where nothing was played that is worth it."""
    improvised = [turn for turn in result.turns if isinstance(turn.marks, ImprovisationMarks)]
    found = best_bar([turn.marks for turn in improvised if isinstance(turn.marks, ImprovisationMarks)])
    if found is not None:
        return BestMoment(improvised[found[0]], found[1], 1)
    target = result.rules.target
    won = [turn for turn in result.turns if isinstance(turn.marks, AnswerMarks) and turn.marks.is_won(target)]
    if not won:
        return None
    best = max(won, key=lambda turn: (turn.planned.step or 0, turn.planned.index))
    return BestMoment(best, 0, best.planned.bars)


def moment_words(moment: BestMoment, name: str) -> str:
    """Whose it is, and where."""
    what = f"bar {moment.bar + 1} of" if isinstance(moment.turn.marks, ImprovisationMarks) else "the phrase of"
    return f"{name}, {what} round {moment.turn.planned.round}"


def heard_again(result: BattleResult, moment: BestMoment) -> Listening:
    """The moment with its click, to be heard once; it begins at its place in the battle."""
    assert moment.turn.played is not None, "what has marks was played"
    ground, planned = result.rules.ground, moment.turn.planned
    turn_ns = ground.ns_of_bars(planned.first_bar)
    start_ns = ground.ns_of_bars(planned.first_bar + moment.bar)
    end_ns = ground.ns_of_bars(planned.first_bar + moment.bar + moment.bars)
    strokes = played_cues(moment.turn.played.played.shifted(turn_ns))
    clicks = click_cues(ground.tempo_map, planned.end_bar * ground.bar_ticks, result.rules.click)
    cues = in_order([strokes, clicks])
    is_early = (cues["at_ns"] < start_ns) & (cues["at_ns"] >= start_ns - result.rules.early_ns)
    cues["at_ns"] = np.where(is_early, start_ns, cues["at_ns"])  # a first stroke before the bar belongs to it
    return Listening(cues_between(cues, start_ns, end_ns), end_ns - start_ns + RING_NS, start_ns)
