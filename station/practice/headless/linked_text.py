"""A battle of two stations as a terminal shows it: who plays, who is waited for, what each turn was worth."""

from collections.abc import Callable

from station.practice.battle.battle_view import BattleView, Doing
from station.practice.battle.battle_words import points_words, round_words
from station.practice.battle.link.linked_battle import LinkedBattle
from station.practice.battle.link.linked_record import SharedTurn
from station.practice.battle.link.linked_view import linked_view
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_plan import TurnKind


class LinkedText:
    """Hands `write` each line that is new."""

    def __init__(self, write: Callable[[str], None]) -> None:
        self._write = write
        self._last = ""
        self._round = self._notices = 0
        self._told: set[tuple[int, int]] = set()

    def show(self, battle: LinkedBattle) -> None:
        """Show what is new in `battle`."""
        view = linked_view(battle)
        for notice in battle.heard.notices[self._notices :]:
            self._write(notice)
        self._notices = len(battle.heard.notices)
        if view.round not in (0, self._round):
            self._round = view.round
            self._write(round_words(view.rules, view.round))
        now = _now(view)
        if now not in ("", self._last):
            self._last = now
            self._write(f"  {now}")
        for shared in battle.rounds.shared.standing():
            self._tell(shared, view)

    def _tell(self, shared: SharedTurn, view: BattleView) -> None:
        slot = shared.round, shared.side
        if slot not in self._told:
            self._told.add(slot)
            self._write(f"    {view.sides[shared.side].name}: {_worth(shared, view)}")


def _now(view: BattleView) -> str:
    if view.message or view.turn is None:
        return view.message or ("count-in" if view.doing is Doing.COUNT_IN else "")
    turn = view.turns[view.turn]
    repeats = turn.kind is TurnKind.ANSWER and turn.phrase is not None
    return f"{view.sides[turn.side].name} {'answers' if repeats else 'plays'}"


def _worth(shared: SharedTurn, view: BattleView) -> str:
    marks = shared.marks
    if shared.is_disputed:
        return "the stations judge it otherwise; nobody gets it"
    if marks is None or marks.points is None:
        return "not heard, not counted"
    if not isinstance(marks, AnswerMarks):
        return points_words(marks.points)
    return f"{marks.percent} %, {'won' if marks.is_won(view.rules.target) else 'lost'}"
