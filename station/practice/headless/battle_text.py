"""A battle as a terminal shows it while it is played: a line a turn, a mark a note, what each turn was worth."""

from collections.abc import Callable

from station.practice.battle.battle import Battle
from station.practice.battle.battle_view import BattleView, Doing, TurnView
from station.practice.battle.battle_words import points_words, round_words
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_plan import TurnKind
from station.practice.headless.live_text import mark_of

_WIDTH = 16


class BattleText:
    """Hands `write` what is new."""

    def __init__(self, write: Callable[[str], None]) -> None:
        self._write = write
        self._doing = Doing.WAITING
        self._turn: int | None = None
        self._round = self._notices = self._told = self._marks = 0

    def show(self, battle: Battle) -> None:
        """Show what is new in `battle`."""
        view = battle.view()
        for notice in battle.heard.notices[self._notices :]:
            self._write(f"\n{notice}")
        self._notices = len(battle.heard.notices)
        self._show_turn(view)
        self._show_marks(view)
        self._show_worth(view)

    def _show_turn(self, view: BattleView) -> None:
        if view.turn == self._turn and view.doing is self._doing:
            return
        self._turn, self._doing, self._marks = view.turn, view.doing, 0
        if view.doing is Doing.COUNT_IN:
            self._write("\ncount-in")
        if view.turn is None:
            return
        turn = view.turns[view.turn]
        if turn.round != self._round:
            self._round = turn.round
            self._write(f"\n\n{round_words(view.rules, turn.round)}")
        self._write(f"\n{_who(view, turn):{_WIDTH}}")

    def _show_marks(self, view: BattleView) -> None:
        if view.turn is None:
            return
        judged = view.turns[view.turn].judged
        new = [mark_of(verdict, view.rules.level.windows) for verdict in judged[self._marks :]]
        self._marks = len(judged)
        if any(new):
            self._write("".join(new))

    def _show_worth(self, view: BattleView) -> None:
        told = [turn for turn in view.turns if turn.marks is not None]
        for turn in told[self._told :]:
            self._write(f"\n{'':{_WIDTH}}{worth_words(view, turn)}")
        self._told = len(told)


def worth_words(view: BattleView, turn: TurnView) -> str:
    """What a judged turn was worth, and what its side has left."""
    marks, side = turn.marks, view.sides[turn.side]
    if marks is None or marks.points is None:
        return f"{side.name}: not heard, not counted"
    if not isinstance(marks, AnswerMarks):
        return f"{side.name}: {points_words(marks.points)}"
    lives = "" if side.lives is None else f"; lives {side.lives}"
    won = "won" if marks.is_won(view.rules.target) else "lost"
    return f"{side.name}: {marks.percent} %, {won}{lives}"


def _who(view: BattleView, turn: TurnView) -> str:
    name = view.sides[turn.side].name
    if turn.kind is TurnKind.CHANGEOVER:
        return f"change seats: {name} plays next"
    return f"{name} plays" if turn.kind is TurnKind.CALL else f"{name}:"
