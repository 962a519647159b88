"""Where a battle stands, and how it ended: a function of the rules and of what each turn is worth, and of nothing else.

In repeat mode an answer earns 100 times its accuracy, an answer below the target costs a life, and

* against the drummer whoever has no life left has lost; whoever is left at the end wins by winning the final, or where
  there is none by being left;
* among players whoever alone has lives left has won, else whoever has most points. With a handicap nobody loses a life,
  and points against what is expected of each decide, in either mode.

In improvise mode a turn earns the points of its marks, the drummer's too, and most points win. The final counts
`FINAL_WEIGHT` times. Equal points are a draw. A battle that was stopped has no winner unless all but one were out.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

from station.practice.battle.battle_rules import DRUMMER, BattleMode, BattleRules
from station.practice.battle.phrase import Turn
from station.practice.battle.repeating.answer_marks import AnswerMarks
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import PlannedTurn
from station.practice.session.device_latency import Latency


@dataclass(frozen=True, eq=False)
class JudgedTurn:
    """A turn, what was played in it (None of a change-over) and what it is worth (None where it is not judged)."""

    planned: PlannedTurn
    played: Turn | None
    marks: TurnMarks | None


@dataclass(frozen=True, slots=True)
class Standing:
    """One side: its `points`, the `lives` that are left (None where there are none to lose), rounds that it has won.

    `handicapped`, 0–100, decides where players are measured against themselves, and is None else.
    """

    points: float
    lives: int | None
    rounds_won: int
    handicapped: float | None = None

    @property
    def is_in(self) -> bool:
        """Whether it still plays."""
        return self.lives is None or self.lives > 0


def standings(rules: BattleRules, turns: Sequence[JudgedTurn]) -> tuple[Standing, ...]:
    """Every side's standing, the drummer's first."""
    sides = (DRUMMER, *rules.player_sides)
    won = _rounds_won(rules, turns)
    lives = _lives(rules, turns)
    return tuple(
        Standing(
            sum(_points(rules, turn) or 0.0 for turn in turns if turn.planned.side == side),
            lives.get(side),
            won.count(side),
            handicapped_points(rules, turns, side) if rules.has_handicap and side != DRUMMER else None,
        )
        for side in sides
    )


def is_lost(rules: BattleRules, turn: JudgedTurn) -> bool:
    """Whether a turn costs a life."""
    return isinstance(turn.marks, AnswerMarks) and turn.marks.is_won(rules.target) is False


def is_decided(rules: BattleRules, turns: Sequence[JudgedTurn]) -> bool:
    """Whether nothing that is still to come can count: too few are left to play on."""
    return _is_decided_by(rules, _lives(rules, turns))


def decided_in(rules: BattleRules, turns: Sequence[JudgedTurn]) -> int | None:
    """The round after which too few were left and yet another was played; None where there was none.

    A battle ends there while it is played. Judged again by stricter windows it may have been played on.
    """
    answered = [turn for turn in turns if turn.marks is not None]
    lives = dict.fromkeys(rules.player_sides, rules.lives) if rules.has_lives else {}
    for number, group in groupby(answered, key=lambda turn: turn.planned.round):
        if _is_decided_by(rules, lives):
            return int(number) - 1
        for turn in group:
            if is_lost(rules, turn) and turn.planned.side in lives:
                lives[turn.planned.side] -= 1
    return None


def _is_decided_by(rules: BattleRules, lives: Mapping[int, int]) -> bool:
    left = sum(one > 0 for one in lives.values())
    return bool(lives) and (left == 0 or (left == 1 and not rules.is_solo))


def _lives(rules: BattleRules, turns: Sequence[JudgedTurn]) -> dict[int, int]:
    """The lives that each player has left, of rounds that were played on after the end none; empty without lives."""
    if not rules.has_lives:
        return {}
    last = decided_in(rules, turns)
    lost = [turn.planned.side for turn in turns if is_lost(rules, turn) and (not last or turn.planned.round <= last)]
    return {side: max(rules.lives - lost.count(side), 0) for side in rules.player_sides}


def winner_of(rules: BattleRules, turns: Sequence[JudgedTurn], is_complete: bool) -> int | None:
    """The side that has won; None of a draw, or where nothing was decided."""
    sides = standings(rules, turns)
    if is_decided(rules, turns):
        left = [side for side in rules.player_sides if sides[side].is_in]
        if left:
            return left[0]
        return DRUMMER if rules.is_solo else _most_points(rules, sides)
    if not is_complete:
        return None
    if rules.mode is BattleMode.REPEAT and rules.is_solo:
        return DRUMMER if any(is_lost(rules, turn) for turn in turns if rules.is_final(turn.planned.round)) else 1
    return _most_points(rules, sides)


def _most_points(rules: BattleRules, sides: Sequence[Standing]) -> int | None:
    competing = [DRUMMER, *rules.player_sides] if rules.drummer_competes else list(rules.player_sides)
    points = {
        side: sides[side].points if sides[side].handicapped is None else sides[side].handicapped for side in competing
    }
    best = max(one or 0.0 for one in points.values())
    first = [side for side in competing if points[side] == best]
    return first[0] if len(first) == 1 else None


def handicapped_points(rules: BattleRules, turns: Sequence[JudgedTurn], side: int) -> float:
    """The mean worth of a player's turns against what is expected of them, 0–100; 50 where none counts."""
    counted: list[tuple[int, float]] = []
    expected = rules.expectations[side - 1]
    for turn in turns:
        planned, marks = turn.planned, turn.marks
        if planned.side != side or marks is None or marks.points is None:
            continue
        is_answer = isinstance(marks, AnswerMarks)
        worth = expected.of_answer(marks.points) if is_answer else expected.of_improvisation(marks.points)
        counted.append((rules.weight(planned.round), worth))
    weight = sum(weight for weight, _ in counted)
    return sum(weight * worth for weight, worth in counted) / weight if weight else 50.0


def _points(rules: BattleRules, turn: JudgedTurn) -> float | None:
    """What a turn adds to its side's points; None where it was not judged."""
    if turn.marks is None or turn.marks.points is None:
        return None
    return turn.marks.points * rules.weight(turn.planned.round)


def _rounds_won(rules: BattleRules, turns: Sequence[JudgedTurn]) -> list[int]:
    """Who won each round: whoever reached the target, against the drummer else the drummer; or who has most points."""
    won: list[int] = []
    for _, group in groupby(turns, key=lambda turn: turn.planned.round):
        of_round = [turn for turn in group if turn.marks is not None and turn.marks.points is not None]
        if rules.mode is BattleMode.REPEAT:
            won += [
                DRUMMER if rules.is_solo and is_lost(rules, turn) else turn.planned.side
                for turn in of_round
                if rules.is_solo or not is_lost(rules, turn)
            ]
            continue
        points = {turn.planned.side: turn.marks.points for turn in of_round if turn.marks is not None}
        best = [side for side, one in points.items() if one == max(points.values(), key=lambda p: p or 0.0)]
        if len(points) > 1 and len(best) == 1:
            won += best
    return won


@dataclass(frozen=True, eq=False)
class BattleResult:
    """A battle when it is over: every turn with what was played and what it is worth, and who has won.

    `is_complete` unless it was stopped before its end; `output` is what the click was heard on, None: nothing.
    `devices` are what most strokes of each side came from, None where there were none.
    """

    rules: BattleRules
    turns: tuple[JudgedTurn, ...]
    is_complete: bool
    latency: Latency
    output: str | None = None
    devices: tuple[str | None, ...] = ()

    @property
    def is_played(self) -> bool:
        """Whether any stroke of a player was heard, here or at another station."""
        answers = (turn.played for turn in self.turns if turn.planned.side != DRUMMER)
        has_strokes = any(played is not None and len(played.played) > 0 for played in answers)
        return has_strokes or any(device is not None for device in self.devices[1:])

    @property
    def standings(self) -> tuple[Standing, ...]:
        """Every side's standing, the drummer's first."""
        return standings(self.rules, self.turns)

    @property
    def played_on_after(self) -> int | None:
        """The round after which it would have ended by these rules, None where it ended there or later."""
        return decided_in(self.rules, self.turns)

    @property
    def winner(self) -> int | None:
        """The side that has won, as the module's head says."""
        return winner_of(self.rules, self.turns, self.is_complete)
