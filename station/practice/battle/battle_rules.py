"""What a battle is played by: the mode, the ground, the rounds, what is won by, and who plays.

Sides are numbered: 0 is the drummer on the screen, 1 … the players in their order. Rounds count from 1; the one after
the last is the final, if there is one.
"""

from dataclasses import dataclass, field
from enum import Enum
from functools import cached_property

from station.core.errors import BadInput
from station.core.units import NS_PER_MS, NS_PER_S
from station.music.score import MAX_LATE_MS
from station.practice.battle.ground import Ground
from station.practice.battle.people.handicap import Expectation
from station.practice.battle.people.player import Player, check_players, is_hot_seat
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.staircase import FIRST_STEPS, Staircase
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.scoring.matching.hit_windows import Level

DRUMMER = 0
"""The side of the drummer on the screen."""
TURN_BARS = (1, 2, 4, 8)
"""Bars of an improvised turn: ones, twos, fours and eights are traded."""
MOST_ROUNDS, MOST_LIVES = 32, 9
"""Our choice: longer than anybody plays without a rest."""
MOST_SEED = (1 << 62) - 1
"""The largest whole number that is read again from a capture (`log_values.whole`), and a message can carry it."""
USUAL_ROUNDS, USUAL_BARS, USUAL_LIVES, USUAL_TARGET = 6, 2, 3, 0.9
"""What a battle is of where nobody chooses, in the window and in a terminal: rounds before the final, bars of an
improvised turn, lives, and the accuracy that wins a round (our choice: two or three minutes)."""
FINAL_WEIGHT = 2
"""The final counts so many times (our choice: it can turn a battle, and not by itself win one)."""
CHANGEOVER_S = 8.0
"""How long two players take to change seats with their own sticks in hand (our choice)."""
LONG_COUNT_IN_BELOW_S = 1.6
"""Where a bar is shorter two are counted in: one is over before anybody has lifted their sticks (our choice)."""
CHOSEN_AHEAD_NS = 600 * NS_PER_MS
"""So long before a turn begins it is chosen, or a beat where that is longer: time for the figure to prepare and for the
sound to come, whatever the computer does meanwhile. Where bars are too short half a bar (our choice)."""


class BattleMode(Enum):
    """Repeat what the drummer plays, or trade improvised phrases."""

    REPEAT = "repeat"
    IMPROVISE = "improvise"


@dataclass(frozen=True)
class BattleRules:
    """All that is agreed before the count-in; the same rules and the same strokes are the same battle.

    `opponent` is a name of `opponents`; `rounds` come before the final (`has_final`); `bars` are those of an improvised
    turn, a phrase to repeat has its own. In repeat mode a round is won by `target` accuracy at the windows of `level`,
    a lost one costs one of the `lives`, and `first_step` is how hard the first phrase is; None: as the players' earlier
    answers ask where there is a handicap, else as `level` does.
    `keeps_time`: the drummer keeps time under the players' turns. With `expectations`, one for each of several players,
    they are measured against themselves (`people.handicap`): then no lives are lost. Raises `BadInput` for what nobody
    can play.
    """

    ground: Ground
    mode: BattleMode = BattleMode.REPEAT
    opponent: str = "steady"
    players: tuple[Player, ...] = (Player("student"),)
    rounds: int = USUAL_ROUNDS
    has_final: bool = True
    bars: int = USUAL_BARS
    lives: int = USUAL_LIVES
    target: float = USUAL_TARGET
    level: Level = Level.INTERMEDIATE
    first_step: int | None = None
    seed: int = 1
    click: ClickPattern = field(default=PLAIN)
    keeps_time: bool = False
    expectations: tuple[Expectation, ...] = ()

    def __post_init__(self) -> None:
        check_players(self.players)
        if self.expectations and (self.is_solo or len(self.expectations) != len(self.players)):
            raise BadInput("handicap", "", "it is for two players or more")
        _within("rounds", self.rounds, 1, MOST_ROUNDS)
        _within("lives", self.lives, 1, MOST_LIVES)
        if not 0 < self.target <= 1:  # also refuses NaN
            raise BadInput("target", f"{self.target:g}", "expected above 0 and up to 1")
        if self.bars not in TURN_BARS:
            raise BadInput("bars", f"{self.bars}", f"expected one of {', '.join(map(str, TURN_BARS))}")
        if not 0 <= self.seed <= MOST_SEED:
            raise BadInput("seed", f"{self.seed}", f"expected 0 to {MOST_SEED}")

    # --- who --------------------------------------------------------------------------------------------------------

    @property
    def is_solo(self) -> bool:
        """Whether one player stands against the drummer; else players stand against each other."""
        return len(self.players) == 1

    @property
    def is_hot_seat(self) -> bool:
        """Whether several players share one kit, and change seats."""
        return is_hot_seat(self.players)

    @property
    def has_handicap(self) -> bool:
        """Whether players are measured against themselves."""
        return bool(self.expectations)

    @property
    def staircase(self) -> Staircase:
        """By which the next step is found."""
        first_step = FIRST_STEPS[self.level] if self.first_step is None else self.first_step
        return Staircase(MOST_STEP, min(first_step, MOST_STEP))

    @property
    def has_lives(self) -> bool:
        """Whether a lost round costs a life."""
        return self.mode is BattleMode.REPEAT and not self.has_handicap

    @property
    def drummer_competes(self) -> bool:
        """Whether the drummer can win."""
        return self.is_solo

    def player_of(self, side: int) -> Player:
        """Who plays on a side; not the drummer's."""
        return self.players[side - 1]

    @property
    def player_sides(self) -> tuple[int, ...]:
        """The sides of people."""
        return tuple(range(1, len(self.players) + 1))

    # --- rounds -----------------------------------------------------------------------------------------------------

    @property
    def rounds_in_all(self) -> int:
        """The rounds, and the final."""
        return self.rounds + self.has_final

    def is_final(self, number: int) -> bool:
        """Whether round `number`, from 1, is the final."""
        return self.has_final and number == self.rounds_in_all

    def weight(self, number: int) -> int:
        """How many times the points of round `number` count."""
        return FINAL_WEIGHT if self.is_final(number) else 1

    # --- time -------------------------------------------------------------------------------------------------------

    @cached_property
    def bar_ns(self) -> int:
        """How long a bar lasts."""
        return self.ground.ns_of_bars(1)

    @cached_property
    def beat_ns(self) -> int:
        """How long a counted beat lasts."""
        return int(self.ground.tempo_map.ns_at(self.ground.beat_ticks))

    @cached_property
    def count_in_bars(self) -> int:
        """Bars that are counted before the first downbeat."""
        return 1 if self.bar_ns >= LONG_COUNT_IN_BELOW_S * NS_PER_S else 2

    @cached_property
    def changeover_bars(self) -> int:
        """Bars in which players change seats."""
        return max(2, -(-round(CHANGEOVER_S * NS_PER_S) // self.bar_ns))

    @cached_property
    def chosen_ahead_ns(self) -> int:
        """How long before it begins a turn is chosen."""
        return max(self.beat_ns, min(CHOSEN_AHEAD_NS, self.bar_ns // 2))

    @cached_property
    def early_ns(self) -> int:
        """So long before its downbeat a stroke belongs to the turn that follows: half a beat's quarter.

        It is never less than a stroke's own timing may be (`MAX_LATE_MS`).
        """
        return max(self.beat_ns // 8, round(MAX_LATE_MS * NS_PER_MS))

    @cached_property
    def late_ns(self) -> int:
        """So long after the last bar a stroke still belongs to the turn before: half a beat, as `Turn` has it."""
        return self.beat_ns // 2


def _within(name: str, value: int, least: int, most: int) -> None:
    if not least <= value <= most:
        raise BadInput(name, f"{value}", f"expected {least} to {most}")
