"""What a stage and a window show of a battle: one frozen state, as of the last time that the battle was told.

Times are battle time, ns from the first downbeat after the count-in; strokes of a turn are in its own time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from station.core.events import Hit
from station.music.judgement import Judgement
from station.practice.battle.battle_rules import BattleRules
from station.practice.battle.phrase import Phrase
from station.practice.battle.turn_marks import TurnMarks
from station.practice.battle.turn_plan import TurnKind


class Doing(Enum):
    """What goes on."""

    WAITING = "waiting"
    """It has not begun to sound."""
    COUNT_IN = "count_in"
    CALL = "call"
    ANSWER = "answer"
    CHANGEOVER = "changeover"
    PAUSED = "paused"
    OVER = "over"


@dataclass(frozen=True, eq=False)
class TurnView:
    """A turn that is over, runs, or is known to come.

    `side` is an index of `BattleView.sides`; `phrase` what the drummer plays, or what is to be repeated; `keeping` how
    the drummer keeps time under a player's turn. `played` are the player's strokes so far, `judged` what is said of
    them while they repeat a phrase (by their places in `played` and in the phrase), and `marks` the final judgement,
    None until the turn's last stroke can have come.
    """

    index: int
    round: int
    side: int
    kind: TurnKind
    start_ns: int
    bars: int
    phrase: Phrase | None
    keeping: Phrase | None
    step: int | None
    played: Sequence[Hit] = ()
    judged: Sequence[Judgement] = ()
    marks: TurnMarks | None = None


@dataclass(frozen=True, slots=True)
class SideView:
    """One side. `points` is None of a drummer who does not compete for them, `lives` where there are none to lose.

    `handicapped` are the points that decide where players are measured against themselves, else None.
    """

    name: str
    is_drummer: bool
    points: float | None
    lives: int | None
    rounds_won: int
    handicapped: float | None = None


@dataclass(frozen=True, eq=False)
class BattleView:
    """`turns` are all so far and those known to come; `turn` is the index of the one that runs, None before and after.

    `round` counts from 1 (0 before the first), `rounds` includes the final. `winner` is an index of `sides`, None until
    it is over, and of a draw. `message` is a line to read, empty where there is nothing to say.
    """

    rules: BattleRules
    at_ns: int | None
    doing: Doing
    turn: int | None
    turns: tuple[TurnView, ...]
    sides: tuple[SideView, ...]
    round: int
    rounds: int
    message: str
    winner: int | None
