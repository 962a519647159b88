"""What can be asked of a battle: to choose it, to turn its settings, to begin, to go on from its result."""

from dataclasses import dataclass

from station.app.settings.chosen_battle import ChosenBattle
from station.scoring.matching.hit_windows import Level


@dataclass(frozen=True, slots=True)
class OpenBattle:
    """Show the page on which a battle is chosen."""


@dataclass(frozen=True, slots=True)
class CloseBattle:
    """Back to the lessons: nothing is battled, a result was read."""


@dataclass(frozen=True, slots=True)
class ChooseBattle:
    """Battle so from now on."""

    setup: ChosenBattle


@dataclass(frozen=True, slots=True)
class TurnLeaf:
    """What else pads may choose."""


@dataclass(frozen=True, slots=True)
class BeginBattle:
    """Begin what is chosen; beside a result the same once more."""


@dataclass(frozen=True, slots=True)
class CallOff:
    """Wait for no friend on the network any more."""


@dataclass(frozen=True, slots=True)
class ReplayBest:
    """See and hear the best bar again, or end that."""


@dataclass(frozen=True, slots=True)
class JudgeBattle:
    """Judge the battle that is over again, from what was kept of it, as strictly as `level` is."""

    level: Level


@dataclass(frozen=True, slots=True)
class FilmBattle:
    """Keep a video of the battle that is over."""


@dataclass(frozen=True, slots=True)
class PractiseFailed:
    """Make a lesson of the phrase that went worst, and choose it."""


BattleAction = (
    OpenBattle
    | CloseBattle
    | ChooseBattle
    | TurnLeaf
    | BeginBattle
    | CallOff
    | ReplayBest
    | JudgeBattle
    | FilmBattle
    | PractiseFailed
)
