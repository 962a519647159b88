"""A battle that is over, in words: who won, round by round, what went worst and what best. Pure."""

from collections.abc import Iterable, Sequence

from station.app.battle.battle_shown import BattleResultShown, Evidence, RoundRow, Verdict
from station.app.battle.board_words import in_a_sentence, names_of, verdict_of
from station.practice.battle.battle_result import BattleResult, JudgedTurn, is_lost, standings
from station.practice.battle.battle_rules import DRUMMER, FINAL_WEIGHT, BattleMode, BattleRules
from station.practice.battle.battle_words import points_words as points_in_words
from station.practice.battle.judging.improvisation_marks import Component, ImprovisationMarks
from station.practice.battle.records.battle_advice import advice_lines
from station.practice.battle.records.handicap_words import handicap_words
from station.practice.battle.repeating.answer_marks import AnswerMarks, percent_of

_NOBODY = "—"


def result_of(result: BattleResult, folder: str = "") -> BattleResultShown:
    """What is shown of a battle that is over, kept in `folder`."""
    rules, shown = result.rules, compared_sides(result.rules)
    rows = [_round(result, number, shown) for number in _rounds_of(result)]
    failed = failed_turn(result)
    return BattleResultShown(
        winner_words(result),
        tuple(names_of(rules)[side] for side in shown),
        (_whole(result, shown), *rows) if rows else (),
        folder,
        "" if failed is None else _failed_words(failed),
        judged_as=rules.level if rules.mode is BattleMode.REPEAT and result.is_played else None,
        told=_told(result),
        advice=advice_lines(result),
    )


def _told(result: BattleResult) -> str:
    """What is to be known of the whole: that it is not kept, or what decides it."""
    if not result.is_played:
        return "Nobody has played a stroke: the battle is not kept"
    return handicap_words(result) if result.is_complete and result.rules.has_handicap else ""


def compared_sides(rules: BattleRules) -> tuple[int, ...]:
    """The sides that are compared: players, and the drummer where it competes."""
    return ((DRUMMER,) if rules.drummer_competes else ()) + rules.player_sides


def winner_words(result: BattleResult) -> str:
    """Who won."""
    names, winner = names_of(result.rules), result.winner
    if winner is None:
        return "A draw" if result.is_complete else "Stopped: nobody has won"
    if winner == DRUMMER:
        return f"{names[DRUMMER]} wins this time"
    if result.rules.is_solo:
        return f"You win against {in_a_sentence(names[DRUMMER])}"
    return f"{names[winner]} wins{' on the handicap' if result.rules.has_handicap else ''}"


# --- the table -------------------------------------------------------------------------------------------------------


def _rounds_of(result: BattleResult) -> range:
    """The rounds of which something was played to its end."""
    return range(1, max((turn.planned.round for turn in _judged(result)), default=0) + 1)


def _judged(result: BattleResult, number: int | None = None) -> list[JudgedTurn]:
    """The turns that have marks, of one round or of all."""
    turns = (turn for turn in result.turns if turn.marks is not None)
    return [turn for turn in turns if number is None or turn.planned.round == number]


def _whole(result: BattleResult, shown: Sequence[int]) -> RoundRow:
    """The whole battle: points in all, and what a side's turns were worth on the mean."""
    given = tuple(_total(result, side) for side in shown)
    means = (_means(result, side) for side in shown)
    won = frozenset(place for place, side in enumerate(shown) if side == result.winner)
    return RoundRow("Whole battle", given, won, tuple(mean for mean in means if mean is not None))


def _total(result: BattleResult, side: int) -> str:
    rules, stand = result.rules, standings(result.rules, result.turns)[side]
    won = f"{stand.rounds_won} won"
    if stand.handicapped is not None:
        return f"{stand.handicapped:.0f} of 100 by their own measure, {won}"
    is_caller = side == DRUMMER and rules.mode is BattleMode.REPEAT
    return won if is_caller else f"{points_in_words(stand.points)}, {won}"


def _round(result: BattleResult, number: int, shown: Sequence[int]) -> RoundRow:
    rules = result.rules
    judged = {turn.planned.side: verdict_of(rules, turn.planned.side, turn.marks) for turn in _judged(result, number)}
    title = f"Final, ×{FINAL_WEIGHT}" if rules.is_final(number) else f"{number}"
    won = _winners(result, number)
    given = tuple(_given(judged.get(side), side in won) for side in shown)
    won_by = frozenset(place for place, side in enumerate(shown) if side in won)
    return RoundRow(title, given, won_by, tuple(judged[side] for side in shown if side in judged))


def _given(verdict: Verdict | None, has_won: bool) -> str:
    """What a side was given in a round, and that it won it."""
    points = "" if verdict is None else verdict.points
    if not has_won or "won" in points:
        return points or _NOBODY
    return f"{points}, won" if points else "won"


def _winners(result: BattleResult, number: int) -> list[int]:
    """The sides that won a round: whose rounds won it has made more."""
    before, after = (
        [side.rounds_won for side in standings(result.rules, [t for t in result.turns if t.planned.round <= last])]
        for last in (number - 1, number)
    )
    return [side for side, (one, other) in enumerate(zip(before, after, strict=True)) if other > one]


def _means(result: BattleResult, side: int) -> Verdict | None:
    """What all turns of a side were worth on the mean, by its parts; None where none has marks."""
    marks = [turn.marks for turn in _judged(result) if turn.planned.side == side]
    name = names_of(result.rules)[side]
    improvised = [each for each in marks if isinstance(each, ImprovisationMarks)]
    if improvised:
        points = sum(each.points for each in improvised) / len(improvised)
        return Verdict(name, f"{points_in_words(points)} a turn", tuple(_mean_parts(improvised)))
    answers = [each for each in marks if isinstance(each, AnswerMarks)]
    return _answers(name, answers) if answers else None


def _mean_parts(turns: Sequence[ImprovisationMarks]) -> Iterable[Evidence]:
    for component in Component:
        told = [points for marks in turns if (points := marks.of(component).points) is not None]
        yield Evidence(component.value.capitalize(), sum(told) / len(told) if told else None)


def _answers(name: str, answers: Sequence[AnswerMarks]) -> Verdict:
    right, known = sum(each.right for each in answers), sum(each.known for each in answers)
    accuracy = [each.accuracy for each in answers if each.accuracy is not None]
    words = f"{percent_of(sum(accuracy) / len(accuracy))} % of a phrase" if accuracy else "nothing was heard"
    return Verdict(name, words, (Evidence("Notes", None, f"{right} of {known} notes right"),))


# --- what follows ----------------------------------------------------------------------------------------------------


def failed_turn(result: BattleResult) -> JudgedTurn | None:
    """The phrase that was repeated worst and cost a life; None where none did."""
    lost = [turn for turn in _judged(result) if is_lost(result.rules, turn)]
    return min(lost, key=lambda turn: (_accuracy(turn), turn.planned.index), default=None)


def _accuracy(turn: JudgedTurn) -> float:
    return (turn.marks.accuracy or 0.0) if isinstance(turn.marks, AnswerMarks) else 0.0


def _failed_words(turn: JudgedTurn) -> str:
    return f"The phrase of round {turn.planned.round}: {percent_of(_accuracy(turn))} % right"
