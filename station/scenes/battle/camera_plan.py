"""What the camera shows in each bar of a battle: whoever plays, both at hand-over and in the final, hands now and then.

A camera changes on a downbeat and never within a bar, nor sooner than `least_bars` after it changed: two bars, or one
where a bar is as long as two at a middling tempo. A turn is cut into shots from its own seed, so that the same battle
is always seen alike, however its turns become known. The first shot of a turn is of both, for light goes over there,
and of the final's turns twice as long; a turn that is too short for more is one shot, of both or of who plays. The
count-in, changes of seats and the end are of both.
"""

from dataclasses import dataclass
from enum import Enum

import numpy as np

from station.practice.battle.battle_view import TurnView
from station.practice.battle.ground import Ground
from station.practice.battle.turn_plan import TurnKind

LONG_BAR_S = 2.6
"""From here on a bar is a shot of its own: four beats at 92 a minute (our choice)."""


class ShotKind(Enum):
    """What is seen."""

    BOTH = "both"
    FRONT = "front"
    HANDS = "hands"
    SHOULDER = "shoulder"


_LIKELY = {ShotKind.FRONT: 0.45, ShotKind.HANDS: 0.30, ShotKind.SHOULDER: 0.25}
"""How often each is chosen of who plays (our choice)."""
_CLOSE = 0.5
"""How often a short turn is of who plays (our choice)."""


@dataclass(frozen=True, slots=True)
class Shot:
    """What is seen from bar `first_bar` of the battle on: both, or `side`, an index of the battle's sides."""

    first_bar: int
    kind: ShotKind = ShotKind.BOTH
    side: int | None = None


def least_bars(ground: Ground) -> int:
    """The fewest bars between two cuts."""
    return 1 if ground.ns_of_bars(1) >= LONG_BAR_S * 1e9 else 2


def shots_of(turn: TurnView, first_bar: int, ground: Ground, seed: int, is_final: bool = False) -> list[Shot]:
    """The shots of a turn that begins with `first_bar`, in order."""
    least = least_bars(ground)
    opening = Shot(first_bar)
    if turn.kind is TurnKind.CHANGEOVER:
        return [opening]
    wide = 2 * least if is_final else least
    rng = np.random.default_rng([seed, turn.index])
    if turn.bars < wide + least:
        is_close = not is_final and least <= turn.bars and bool(rng.random() < _CLOSE)
        return [Shot(first_bar, ShotKind.FRONT, turn.side)] if is_close else [opening]
    shots, at = [opening], wide
    while turn.bars - at >= least:
        kinds = [kind for kind in _LIKELY if kind is not shots[-1].kind]
        weights = np.array([_LIKELY[kind] for kind in kinds])
        kind = kinds[int(rng.choice(len(kinds), p=weights / weights.sum()))]
        shots.append(Shot(first_bar + at, kind, turn.side))
        at += least * int(rng.integers(1, 3))
    return shots


def shot_at(shots: list[Shot], bar: int) -> Shot:
    """The shot of a bar of the battle."""
    return next((shot for shot in reversed(shots) if shot.first_bar <= bar), Shot(bar))
