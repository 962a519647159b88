"""What the window shows of a battle: the page on which it is chosen, the board while it runs, the page of its result.

Everything is in words already: the window draws, and counts nothing.
"""

from dataclasses import dataclass, field
from enum import Enum, auto

from station.app.battle.friend_shown import FriendShown
from station.app.settings.chosen_battle import ChosenBattle
from station.scoring.matching.hit_windows import Level


class BattleStage(Enum):
    """How far a battle is."""

    CLOSED = auto()
    CHOOSING = auto()
    PLAYING = auto()
    OVER = auto()


@dataclass(frozen=True, slots=True)
class Evidence:
    """A part of what a turn was worth: 0 to 100, None where there is nothing to judge, and what was seen, in words."""

    title: str
    marks: float | None
    words: str = ""


@dataclass(frozen=True, slots=True)
class Verdict:
    """What a turn was worth: whose, its points in words, what it is made of, the best part first."""

    side: str
    points: str
    evidence: tuple[Evidence, ...] = ()


@dataclass(frozen=True, slots=True)
class BoardShown:
    """The board: what goes on in a few large words, and below what the turns of the last round were worth.

    `share` 0–1 of the turn is over, None where none runs. Points, lives and rounds stand in the picture.
    """

    headline: str = ""
    share: float | None = None
    verdicts: tuple[Verdict, ...] = ()


@dataclass(frozen=True, slots=True)
class RoundRow:
    """A line of the result: a round or, at first, the whole battle; what each side was given, and who won it."""

    title: str
    given: tuple[str, ...]
    won_by: frozenset[int] = frozenset()
    verdicts: tuple[Verdict, ...] = ()


@dataclass(frozen=True, slots=True)
class BattleResultShown:
    """The battle that is over: who won, what each of the `names` was given in the `rows`, where it is kept.

    `failed` names the phrase that went worst, empty where none did, `best` the bar that went best; `judged_as` is None
    where no windows are asked of a battle; `told` is what else is to be known, such as what came of judging it
    again; `films`: all of it can be filmed from what is kept. `advice` says what to practise, a
    sentence a player.
    """

    headline: str
    names: tuple[str, ...] = ()
    rows: tuple[RoundRow, ...] = ()
    folder: str = ""
    failed: str = ""
    best: str = ""
    judged_as: Level | None = None
    told: str = ""
    advice: tuple[str, ...] = ()
    films: bool = True


@dataclass(frozen=True, slots=True)
class BattleShown:
    """The battle's page.

    `fault` is why the chosen battle cannot begin, empty where it can; `replays` while the best of it is seen again.
    `friend` is what goes on with a friend on the network.
    """

    stage: BattleStage = BattleStage.CLOSED
    setup: ChosenBattle = field(default_factory=ChosenBattle)
    student: str = ""
    fault: str = ""
    board: BoardShown = field(default_factory=BoardShown)
    result: BattleResultShown | None = None
    replays: bool = False
    friend: FriendShown = field(default_factory=FriendShown)

    @property
    def covers_picture(self) -> bool:
        """Whether a page of words stands in the picture's place."""
        is_over = self.stage is BattleStage.OVER and not self.replays
        return self.stage is BattleStage.CHOOSING or is_over
