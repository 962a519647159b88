"""What two stations agree on before the count-in: the host's rules, who plays on which side, and by which windows.

The host is side 1, the joiner side 2, whoever begins. Each player is judged by the level of their own station, so that
a child and a parent may play by different windows; both ends know both levels.
"""

from dataclasses import dataclass, replace

from station.core.errors import BadInput
from station.practice.battle.battle_rules import BattleMode, BattleRules
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_messages import MOST_NAME, Hello, Offer, encoded
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.people.player import Player
from station.practice.battle.repeating.demands import MOST_STEP
from station.scoring.matching.hit_windows import Level

HOST_SIDE, JOINER_SIDE = 1, 2


@dataclass(frozen=True, eq=False)
class Agreed:
    """A battle that both ends want: the `offer` as it crossed, both introductions, and which end this is."""

    offer: Offer
    host: Hello
    joiner: Hello
    is_host: bool
    rules: BattleRules

    @property
    def our_side(self) -> int:
        """The side of the player at this station."""
        return HOST_SIDE if self.is_host else JOINER_SIDE

    @property
    def their_side(self) -> int:
        """The side of the player at the other station."""
        return JOINER_SIDE if self.is_host else HOST_SIDE

    @property
    def order(self) -> tuple[int, int]:
        """The sides in the order in which they trade."""
        return (HOST_SIDE, JOINER_SIDE) if self.offer.host_begins else (JOINER_SIDE, HOST_SIDE)

    @property
    def their_name(self) -> str:
        """Who plays at the other station."""
        return self.rules.player_of(self.their_side).name

    def level_of(self, side: int) -> Level:
        """By which windows a side is judged."""
        return self.host.level if side == HOST_SIDE else self.joiner.level

    @property
    def as_bytes(self) -> bytes:
        """All that was agreed, the same at both ends."""
        return encoded(self.offer) + encoded(self.host) + encoded(self.joiner)


def offer_of(rules: BattleRules, host_begins: bool = True) -> Offer:
    """The host's rules as they are offered."""
    ground = rules.ground
    return Offer(
        mode=rules.mode.value,
        tempo_bpm=float(ground.tempo_bpm),
        beats=ground.beats,
        unit=ground.unit,  # type: ignore[arg-type]  # one of the units that a meter may have
        feel=ground.feel,
        style=ground.style,
        opponent=rules.opponent,
        rounds=rules.rounds,
        has_final=rules.has_final,
        bars=rules.bars,
        lives=rules.lives,
        target=float(rules.target),
        first_step=rules.first_step,
        seed=rules.seed,
        keeps_time=rules.keeps_time,
        host_begins=host_begins,
    )


def agreed(offer: Offer, host: Hello, joiner: Hello, is_host: bool, own: BattleRules) -> Agreed:
    """What both agree on; the click is this station's own. Raises `BadInput` for rules that nobody can play."""
    find_opponent(offer.opponent)
    if offer.first_step is not None and offer.first_step > MOST_STEP:
        raise BadInput("the host's rules", "first step", f"expected at most {MOST_STEP}")
    rules = BattleRules(
        ground=Ground(offer.tempo_bpm, offer.beats, offer.unit, offer.feel, offer.style),
        mode=BattleMode(offer.mode),
        opponent=offer.opponent,
        players=two_players(host.player, joiner.player),
        rounds=offer.rounds,
        has_final=offer.has_final,
        bars=offer.bars,
        lives=offer.lives,
        target=offer.target,
        level=host.level if is_host else joiner.level,
        first_step=offer.first_step,
        seed=offer.seed,
        click=own.click,
        keeps_time=offer.keeps_time,
    )
    return Agreed(offer, host, joiner, is_host, rules)


def two_players(host: str, joiner: str) -> tuple[Player, Player]:
    """Both by names that can be told apart."""
    first, second = Player(host or "host"), Player(joiner or "guest")
    if first.name.casefold() == second.name.casefold():
        second = replace(second, name=f"{second.name[: MOST_NAME - 2]} 2")
    return first, second
