"""What is chosen of a battle before it begins, as one value, and the rules that come of it."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum

from station.core.errors import BadInput
from station.practice.battle.battle_rules import (
    USUAL_BARS,
    USUAL_LIVES,
    USUAL_ROUNDS,
    USUAL_TARGET,
    BattleMode,
    BattleRules,
)
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_discovery import DEFAULT_PORT
from station.practice.battle.link.link_socket import MOST_PORT
from station.practice.battle.opponents.opponent import OPPONENTS, USUAL_OPPONENT, Opponent, find_opponent
from station.practice.battle.people.player import Player
from station.practice.exam.exam_sitting import drawn_seed
from station.practice.session.cues.click_pattern import SILENT, ClickPattern
from station.scoring.matching.hit_windows import Level

MOST_NAME = 24
"""Letters of a player's name that the board has room for (our choice)."""


class People(Enum):
    """Who battles whom: what it is called, and what that means."""

    ALONE = "You and the drummer", "One kit, and the computer's drummer answers"
    HOT_SEAT = "Two at one kit", "Two of you change places at the same kit, bar for bar"
    TWO_KITS = "Two kits here", "Two of you, a kit each, both on this computer"
    NETWORK = "A friend on the network", "Two of you, each at your own station and kit"

    def __init__(self, words: str, about: str) -> None:
        self.words, self.about = words, about

    @property
    def needs_friend(self) -> bool:
        """Whether another person plays."""
        return self is not People.ALONE


@dataclass(frozen=True, slots=True)
class ChosenBattle:
    """What is chosen: `bars` a turn, `target` percent of a phrase that wins a round of repeating, at `level`.

    `friend` is what the other person is called, empty for a name of no matter. `is_fair`:
    players are measured against what they did in earlier battles. `seed` draws the phrases, None for others each time.
    With a friend on the network this station `joins` the one at `address`, or hosts at `port`, both as they were typed;
    `guest_begins`: the first turn of a trade is theirs.
    """

    mode: BattleMode = BattleMode.REPEAT
    opponent: str = USUAL_OPPONENT
    ground: Ground = field(default_factory=lambda: OPPONENTS[USUAL_OPPONENT].ground)
    bars: int = USUAL_BARS
    rounds: int = USUAL_ROUNDS
    target: int = round(100 * USUAL_TARGET)
    people: People = People.ALONE
    friend: str = ""
    lives: int = USUAL_LIVES
    level: Level = Level.BEGINNER
    is_clicked: bool = True
    keeps_time: bool = True
    is_fair: bool = False
    seed: int | None = None
    joins: bool = False
    guest_begins: bool = False
    port: str = f"{DEFAULT_PORT}"
    address: str = ""

    @property
    def is_linked(self) -> bool:
        """Whether the other person plays at another station."""
        return self.people is People.NETWORK

    @property
    def is_guest(self) -> bool:
        """Whether the other station hosts, and chooses what is played."""
        return self.is_linked and self.joins

    @property
    def drummer(self) -> Opponent:
        """Who plays on the computer's side."""
        return find_opponent(self.opponent)

    def against(self, name: str) -> "ChosenBattle":
        """The same against another drummer, on the ground that is usual for them."""
        return replace(self, opponent=name, ground=find_opponent(name).ground)


FRIEND = "Friend"
"""What the other person is called who gave no name."""


def chosen_rules(setup: ChosenBattle, student: str, kits: Sequence[str], click: ClickPattern) -> BattleRules:
    """The rules that were chosen, for the `student` on the `kits` that are there; raises `BadInput`."""
    return BattleRules(
        setup.ground,
        setup.mode,
        setup.opponent,
        _players(setup, student, kits),
        setup.rounds,
        bars=setup.bars,
        lives=setup.lives,
        target=setup.target / 100,
        level=setup.level,
        seed=drawn_seed() if setup.seed is None else setup.seed,
        click=click if setup.is_clicked else SILENT,
        keeps_time=setup.keeps_time,
    )


def port_of(setup: ChosenBattle) -> int:
    """The port that was typed, 0 for any; raises `BadInput` where it is none."""
    typed = setup.port.strip()
    if typed.isascii() and typed.isdigit() and len(typed) <= len(f"{MOST_PORT}") and int(typed) <= MOST_PORT:
        return int(typed)
    raise BadInput("port", typed, f"a port is a number up to {MOST_PORT}, such as {DEFAULT_PORT}")


def _players(setup: ChosenBattle, student: str, kits: Sequence[str]) -> tuple[Player, ...]:
    friend = setup.friend.strip() or FRIEND
    match setup.people:
        case People.HOT_SEAT:
            return Player(student), Player(friend)
        case People.TWO_KITS if len(kits) < 2:
            raise BadInput("players", setup.people.words, f"two kits are needed, and {_found(kits)}")
        case People.TWO_KITS:
            return Player(student, kits[0]), Player(friend, kits[1])
        case _:
            return (Player(student),)


def _found(kits: Sequence[str]) -> str:
    return f"{kits[0]} alone is here" if kits else "none is here"
