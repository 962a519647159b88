"""What of a battle is worth being seen again: the best bar improvised, or one of the hardest phrase repeated."""

from dataclasses import dataclass

from station.practice.battle.battle_result import BattleResult, JudgedTurn
from station.practice.battle.judging.best_bar import best_bar
from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.repeating.answer_marks import AnswerMarks


@dataclass(frozen=True, eq=False)
class BestMoment:
    """The `bar`, from 0, of a `turn`."""

    turn: JudgedTurn
    bar: int


def best_moment(result: BattleResult) -> BestMoment | None:
    """The moment; None where nothing was played that is worth it."""
    improvised = [turn for turn in result.turns if isinstance(turn.marks, ImprovisationMarks)]
    found = best_bar([turn.marks for turn in improvised if isinstance(turn.marks, ImprovisationMarks)])
    if found is not None:
        return BestMoment(improvised[found[0]], found[1])
    target = result.rules.target
    won = [turn for turn in result.turns if isinstance(turn.marks, AnswerMarks) and turn.marks.is_won(target)]
    if not won:
        return None
    best = max(won, key=lambda turn: (turn.planned.step or 0, turn.planned.index))
    return BestMoment(best, best.planned.bars - 1)


def moment_words(moment: BestMoment, name: str) -> str:
    """Whose it is, and where."""
    return f"{name}, bar {moment.bar + 1} of round {moment.turn.planned.round}"
