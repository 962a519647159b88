"""A battle in words for the board: who is on, and what the turns before were worth; the end is in `result_words`."""

from collections.abc import Mapping

from station.app.battle.battle_shown import BoardShown, Evidence, Verdict
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.battle_view import BattleView, Doing, TurnView
from station.practice.battle.battle_words import points_words as points_in_words
from station.practice.battle.judging.improvisation_marks import ImprovisationMarks
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_marks import TurnMarks
from station.scoring.report.technique_text import LEAST_MS


def board_of(view: BattleView, told: str = "", marks: Mapping[int, TurnMarks] | None = None) -> BoardShown:
    """The board as of `view`.

    `told` stands in the headline's place, if it is not empty; `marks` are those of each side's last turn, where the
    view does not have them.
    """
    last = _last_marks(view) if marks is None else marks
    verdicts = tuple(verdict_of(view.rules, side, last[side]) for side in sorted(last))
    return BoardShown(told or headline(view), _share(view, running_turn(view)), verdicts)


def names_of(rules: BattleRules) -> tuple[str, ...]:
    """What each side is called on the screen."""
    return (find_opponent(rules.opponent).title, *(player.name for player in rules.players))


def running_turn(view: BattleView) -> TurnView | None:
    """The turn that runs."""
    return None if view.turn is None else next((turn for turn in view.turns if turn.index == view.turn), None)


def headline(view: BattleView) -> str:
    """Who does what now."""
    turn = running_turn(view)
    name = "" if turn is None else names_of(view.rules)[turn.side]
    repeats, whose = view.rules.mode is BattleMode.REPEAT, "Your turn" if view.rules.is_solo else name
    return {
        Doing.WAITING: "It begins at once",
        Doing.COUNT_IN: "Count-in",
        Doing.CALL: f"Listen to {in_a_sentence(name)}" if repeats else f"{name} plays",
        Doing.ANSWER: f"{whose}: play it back" if repeats else f"{whose}: {_in_the_bars(view, turn)}",
        Doing.CHANGEOVER: f"Change seats: {name} is next",
        Doing.PAUSED: "Paused",
        Doing.OVER: "Over",
    }[view.doing]


def _in_the_bars(view: BattleView, turn: TurnView | None) -> str:
    """What to do in one's own bars; the last asks for the stroke after it (`judging.time_kept`)."""
    share = None if turn is None else _share(view, turn)
    if turn is None or share is None or share < max(1.0 - 1.0 / turn.bars, LAND_FROM):
        return "the bars are yours"
    return "land on one"


LAND_FROM = 0.5
"""Of a turn of one bar the second half is its last (our choice)."""


def in_a_sentence(title: str) -> str:
    """A drummer's title as it stands within a sentence."""
    return title.replace("The ", "the ", 1) if title.startswith("The ") else title


def _share(view: BattleView, turn: TurnView | None) -> float | None:
    if turn is None or view.at_ns is None:
        return None
    whole = view.rules.ground.ns_of_bars(turn.bars)
    return min(max((view.at_ns - turn.start_ns) / whole, 0.0), 1.0)


def _last_marks(view: BattleView) -> Mapping[int, TurnMarks]:
    """What each side's last turn was worth, in the order of the sides."""
    return {turn.side: turn.marks for turn in view.turns if turn.marks is not None}


def verdict_of(rules: BattleRules, side: int, marks: TurnMarks | None) -> Verdict:
    """What a turn of a side was worth that has marks."""
    assert marks is not None, "it has marks"
    return Verdict(names_of(rules)[side], points_words(marks, rules.target), evidence_of(marks))


def points_words(marks: TurnMarks, target: float) -> str:
    """What a turn was given; of a repeated phrase whether that was enough."""
    if isinstance(marks, ImprovisationMarks):
        return points_in_words(marks.points)
    if marks.accuracy is None:
        return "not heard"
    return f"{marks.percent} % right, {'won' if marks.is_won(target) else 'not enough'}"


def evidence_of(marks: TurnMarks) -> tuple[Evidence, ...]:
    """What the points of a turn are made of."""
    if isinstance(marks, AnswerMarks):
        return _answered(marks)
    return tuple(Evidence(each.component.value.capitalize(), each.points, each.words) for each in marks.components)


def _answered(marks: AnswerMarks) -> tuple[Evidence, ...]:
    """What was right of a phrase, what was not, and how it lay about the click."""
    lines = [f"{marks.right} of {marks.known} notes right"]
    missed = marks.known - marks.answered - marks.wrong_pieces
    for count, words in ((missed, "missed"), (marks.wrong_pieces, "on a wrong pad"), (marks.extras, "too many")):
        lines += [f"{count} {words}"] if count > 0 else []
    parts = [Evidence("Notes", None, ", ".join(lines))]
    if marks.mean_ms is not None:
        parts.append(Evidence("Time", None, _lean(marks.mean_ms)))
    return tuple(parts)


def _lean(mean_ms: float) -> str:
    if abs(mean_ms) < LEAST_MS:
        return "on the click"
    return f"{abs(mean_ms):.0f} ms {'late' if mean_ms > 0 else 'early'} on the whole"
