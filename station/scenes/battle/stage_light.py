"""How much light each of two drummers stands in: whoever plays is in it, and it goes over about the downbeat."""

from collections.abc import Sequence

from station.practice.battle.battle_view import TurnView
from station.practice.battle.turn_plan import TurnKind
from station.scenes.battle.pose_mix import minimum_jerk

Lights = tuple[float, float]
BOTH: Lights = (1.0, 1.0)
"""Before the first turn, and where nobody has won."""
CHANGING: Lights = (0.6, 0.6)
"""While players change seats (our choice)."""
FADES_BEATS = 1.0
"""How long light goes from one to the other, in beats, half of it before the downbeat (our choice)."""


def lights_at(turns: Sequence[TurnView], sides: tuple[int, int], at_ns: int, beat_ns: int) -> Lights:
    """The light of both `sides` at a battle time, by whose turns they are; `turns` in order."""
    half = FADES_BEATS * beat_ns / 2
    light = BOTH
    for turn in turns:
        share = minimum_jerk((at_ns - turn.start_ns + half) / (2 * half))
        if share <= 0:
            break
        lit = _of_turn(turn, sides)
        light = light[0] + share * (lit[0] - light[0]), light[1] + share * (lit[1] - light[1])
    return light


def _of_turn(turn: TurnView, sides: tuple[int, int]) -> Lights:
    if turn.kind is TurnKind.CHANGEOVER or turn.side not in sides:
        return CHANGING
    return (1.0, 0.0) if turn.side == sides[0] else (0.0, 1.0)
