"""The report of a battle in words: who won, every round, what it was worth and by what, what to practise."""

from collections.abc import Iterable, Iterator
from itertools import groupby

from station.practice.battle.battle_result import BattleResult, JudgedTurn, is_lost
from station.practice.battle.battle_rules import DRUMMER, BattleMode
from station.practice.battle.battle_words import points_words, round_words
from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.records.battle_advice import advice_lines
from station.practice.battle.records.battle_document import side_name
from station.practice.battle.records.handicap_words import handicap_words
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_marks import TurnMarks

_MODES = {BattleMode.REPEAT: "repeat what is played", BattleMode.IMPROVISE: "trade improvised phrases"}


def battle_report(result: BattleResult) -> str:
    """The report, in lines that end."""
    return "\n".join(_lines(result)) + "\n"


def _lines(result: BattleResult) -> Iterator[str]:
    rules, ground = result.rules, result.rules.ground
    names = " against ".join(side_name(rules, side) for side in _competing(result))
    yield names
    feel = "" if ground.feel.value == "straight" else f", {ground.feel.value}s"
    yield f"{_MODES[rules.mode]}, {ground.tempo_bpm:g} bpm in {ground.beats}/{ground.unit}{feel}, {rules.level.words}"
    yield ""
    yield _outcome(result)
    for side in _competing(result):
        yield _score(result, side)
    if result.played_on_after is not None:
        yield played_on_words(result)
    answered = [turn for turn in result.turns if turn.marks is not None]
    for number, turns in groupby(answered, key=lambda turn: turn.planned.round):
        yield ""
        yield round_words(rules, number).capitalize()
        yield from _round(result, turns)
    advice = advice_lines(result)
    if advice:
        yield ""
        yield from advice


def _competing(result: BattleResult) -> tuple[int, ...]:
    sides = result.rules.player_sides
    return (*sides, DRUMMER) if result.rules.drummer_competes else sides


def played_on_words(result: BattleResult) -> str:
    """That it went on although it was decided by the windows of now."""
    return f"By these windows it would have ended after round {result.played_on_after}; it was played on."


def _outcome(result: BattleResult) -> str:
    if result.is_complete and result.rules.has_handicap:
        return handicap_words(result)
    if result.winner is not None:
        return f"Won by {side_name(result.rules, result.winner)}"
    return "A draw" if result.is_complete else "Stopped early: nobody has won"


def _score(result: BattleResult, side: int) -> str:
    standing, rules = result.standings[side], result.rules
    parts = [f"{standing.rounds_won} rounds won"]
    if side != DRUMMER or rules.mode is BattleMode.IMPROVISE:
        parts.insert(0, points_words(standing.points))
    if standing.lives is not None:
        parts.append(f"{standing.lives} of {rules.lives} lives left")
    played = " as played" if standing.handicapped is not None else ""
    return f"{side_name(rules, side)}{played}: {', '.join(parts)}"


def _round(result: BattleResult, turns: Iterable[JudgedTurn]) -> Iterator[str]:
    for turn in turns:
        if turn.marks is not None:
            step = "" if turn.planned.step is None else f"step {turn.planned.step}, "
            yield f"  {side_name(result.rules, turn.planned.side)}: {step}{_marks(result, turn, turn.marks)}"
            yield from _evidence(turn.marks)


def _marks(result: BattleResult, turn: JudgedTurn, marks: TurnMarks) -> str:
    if not isinstance(marks, AnswerMarks):
        return points_words(marks.points)
    if marks.accuracy is None:
        return "not heard, not counted"
    won = "lost" if is_lost(result.rules, turn) else "won"
    faults = [f"{marks.extras} extra" if marks.extras else "", f"{marks.wrong_pieces} on a wrong piece"]
    told = ", ".join(filter(None, (faults[0], faults[1] if marks.wrong_pieces else "")))
    return f"{marks.percent} %, {won}: {marks.right} of {marks.known} right{', ' if told else ''}{told}"


def _evidence(marks: TurnMarks) -> Iterator[str]:
    for one in marks.components if isinstance(marks, ImprovisationMarks) else ():
        points = "  –" if one.points is None else f"{one.points:3.0f}"
        yield f"    {one.component:12}{points}  {one.words}"
