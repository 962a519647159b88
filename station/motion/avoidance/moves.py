"""What a hand may do differently: the table of moves, and how each is made.

A move adds `amounts` (k, fields) of a `Contact` to a hand's way, k alternatives of them, each as far as it is `made`
(n,) at the moments `on`. Sides are mirrored: amounts are the right hand's. Metres, radians, seconds.
"""

from dataclasses import dataclass
from functools import cached_property
from math import inf, sqrt

import numpy as np

from station.core.pieces import Articulation
from station.motion.avoidance.cost import Array, Hands, Moments
from station.motion.kinematics.arm import Contact
from station.motion.strokes.hand import HandPart
from station.motion.strokes.hand_events import WAIT
from station.motion.strokes.travel import HAND_M_S, MINIMUM_JERK_PEAK, moved_off

FIELDS = len(Contact._fields)
_AT = {name: k for k, name in enumerate(Contact._fields)}
MIRRORED = np.array([-1.0 if name in ("x", "stick_yaw", "hand_yaw", "wing") else 1.0 for name in Contact._fields])


def amounts(*names: str, values: list[tuple[float, ...]]) -> Array:
    """Rows of `Contact` fields, 0 but for those named, (k, FIELDS)."""
    rows = np.zeros((len(values), FIELDS))
    rows[:, [_AT[name] for name in names]] = values
    return rows


def _grid(*axes: tuple[float, ...]) -> list[tuple[float, ...]]:
    return [tuple(row) for row in np.stack(np.meshgrid(*axes, indexing="ij"), -1).reshape(-1, len(axes)).tolist()]


ROUND = amounts(
    "x",
    "y",
    "z",
    values=_grid((0.0, -0.08, 0.08, 0.16), (0.0, -0.08, -0.16, -0.24), (0.0, -0.14, -0.07, 0.06, 0.12, 0.2, 0.28))[1:],
)
"""Ways round in the middle of a stretch: to the hand's own side, forward, up."""
OFF = amounts("x", "y", "z", values=_grid((0.0, 0.1, 0.2, 0.3), (0.0, -0.1, -0.2), (0.0, 0.08, 0.16, 0.24, 0.32)))
"""Where a hand that rests may move off to while the other passes."""
SWING = amounts("wing", values=[(w,) for w in np.radians((-16.0, 16.0, 32.0, 48.0)).tolist()])
"""How much farther out the elbow may be about a contact."""
RISE = amounts("stick_rise", "hand_rise", values=[(r, r) for r in np.radians((4.0, 8.0, 12.0, 16.0, 20.0)).tolist()])
"""How much steeper a stick may be held."""
ASIDE = amounts("x", "y", "z", values=_grid((0.0, 0.06, 0.12), (0.0, -0.06, 0.08), (0.0, 0.06))[1:])
"""Where else a hand may wait."""
TURNS_ABOUT = (Articulation.NORMAL, Articulation.BUZZ, WAIT)
"""Here a stick may be steeper about its tip; a stick's shoulder and shaft lie as the piece does."""
LOWER = (0.5, 0.2)
"""To what share strokes may be lowered."""
MOST_M, MOST_RISE_RAD = 0.45, np.radians(20.5)
"""No way round is longer in all, no stick steeper (our choice)."""
_LEAST_MADE = 0.08
"""What is made less than this at the worst moment cannot help there (our choice)."""
_AFTER_S, _BEFORE_S, _MOVES_S, _QUICKEST_S, _SPARE_S = 0.05, 0.10, 0.25, 0.10, 0.03
"""A hand that moves off stays so long after its strike and is back so long before the next; that takes it so long, at
least if there is no more time, and it is off so much sooner (our choice)."""
_LOOKS = 24
"""So many moments of a longer move are looked at (our choice)."""


@dataclass(frozen=True, eq=False)
class Move:
    """A kind of move of one hand (0 right, 1 left) about event or stretch `index`."""

    kind: str
    side: int
    index: int
    on: Moments
    made: Array
    amounts: Array
    low: float = 1.0
    window: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @cached_property
    def lengths(self) -> list[tuple[float, float]]:
        """Of each row of the amounts how far it goes round and how far it turns."""
        ways, turns = self.amounts[:, :3], np.abs(self.amounts[:, 3:]).sum(1)
        return [(sqrt(way.dot(way)), turn) for way, turn in zip(ways, turns.tolist(), strict=True)]


def moves(hands: Hands, stretches: list[int], moments: Moments, worst: Moments) -> list[Move]:
    """The moves of both hands that may help at the troubled `moments`, the `worst` of them above all."""
    found: list[Move] = []
    for side, stretch in enumerate(stretches):
        found += _of_one(hands, side, stretch, moments, worst)
    return [m for m in found if len(m.on)]


def _of_one(hands: Hands, side: int, stretch: int, moments: Moments, worst: Moments) -> list[Move]:
    part, grid = hands.parts[side], hands.stage.grid
    mirror = MIRRORED if side else np.ones(FIELDS)
    times = part.events.time_s
    begins, ends = (times[stretch] if stretch else -inf), (times[stretch + 1] if stretch + 1 < len(times) else inf)
    here = np.flatnonzero((grid >= begins) & (grid < ends))
    _, hump = part.way.humps(grid[here])
    found = []
    if hump[np.isin(here, moments)].max(initial=0.0) > _LEAST_MADE:
        so_far = np.zeros(FIELDS)
        so_far[:3] = part.bump[stretch, :3] - hands.stage.straight[side][stretch, :3]
        ways = np.concatenate((ROUND * mirror, ROUND * mirror - so_far)) if so_far.any() else ROUND * mirror
        ways = ways[np.linalg.norm(part.bump[stretch, :3] + ways[:, :3], axis=1) <= MOST_M]
        on = _thinned(here[hump > 0], worst)
        made = part.way.humps(grid[on])[1]
        found += [Move("round", side, stretch, on, made, ways, low) for low in (1.0, *LOWER)]
    nearest, _ = part.way.nearest(grid[moments])
    for event in np.unique(nearest).tolist():
        around, share = part.way.about(event, grid)
        kinds = [("contact", SWING)]
        if part.events.key[event, 2] in TURNS_ABOUT and not part.lies[int(part.which[event])].shoulder_of_stick:
            left = MOST_RISE_RAD - (part.contacts[event, 3] - part.lies[int(part.which[event])].contact.stick_rise)
            kinds.append(("contact", RISE[RISE[:, _AT["stick_rise"]] <= left]))
        if part.events.key[event, 2] == WAIT:
            kinds.append(("contact", ASIDE))
        on = _thinned(around, worst)
        made = share[np.searchsorted(around, on)]
        found += [Move(kind, side, event, on, made, rows * mirror) for kind, rows in kinds if len(rows)]
    on = _thinned(here, worst)
    none = np.zeros((1, FIELDS))
    found += [Move("lower", side, stretch, on, np.zeros(len(on)), none, low) for low in LOWER]
    found += _off(hands, side, stretch, (moments, worst), mirror)
    return found


def _off(hands: Hands, side: int, stretch: int, troubled: tuple[Moments, Moments], mirror: Array) -> list[Move]:
    """A hand at rest moves off while the other passes; once in a rest."""
    part, grid, (moments, worst) = hands.parts[side], hands.stage.grid, troubled
    times, already = part.events.time_s, part.gives[stretch]
    leaves, returns = (
        (float(times[stretch]) + _AFTER_S, float(times[stretch + 1]) - _BEFORE_S)
        if stretch + 1 < len(times)
        else (float(times[stretch]) + _AFTER_S if len(times) > 1 else -inf, inf)
    )
    if already.any() or returns - leaves < 2 * _QUICKEST_S:
        return []
    first, last = float(grid[moments[0]]), float(grid[moments[-1]])
    room = min(first - _SPARE_S - max(leaves, first - 1), min(returns, last + 1) - last - _SPARE_S)
    lasts = max(min(_MOVES_S, room), _QUICKEST_S)
    off, back = max(first - _SPARE_S - lasts, leaves), min(last + _SPARE_S + lasts, returns)
    on = _thinned(np.flatnonzero((grid > off) & (grid < back)), worst)
    rows = OFF[1:] * mirror
    rows = rows[MINIMUM_JERK_PEAK * np.linalg.norm(rows[:, :3], axis=1) <= HAND_M_S * lasts]
    return [
        Move("off", side, stretch, on, moved_off(grid[on], off, back, 1 / lasts), rows, 1.0, (off, back, 1 / lasts))
    ]


def _thinned(on: Moments, worst: Moments) -> Moments:
    """Not too many of `on`, in order, with the `worst` moments that are among them."""
    return np.union1d(on[:: max(len(on) // _LOOKS, 1)], worst[np.isin(worst, on)])


def done(part: HandPart, move: Move, chosen: int) -> HandPart:
    """`part` after a move by row `chosen` of its amounts."""
    row, k = move.amounts[chosen], move.index
    bump, most, contacts, gives = part.bump.copy(), part.strokes.most.copy(), part.contacts.copy(), part.gives.copy()
    if move.kind == "round":
        bump[k, :3] += row[:3]
    elif move.kind == "contact":
        contacts[k] += row
    elif move.kind == "off":
        gives[k] = *move.window, *row[:3]
    if move.low < 1.0:
        about = slice(k, k + 2)
        least = np.minimum(LEAST_HEIGHT_M / np.maximum(part.strokes.height_m[about], 1e-6), 1.0)
        most[about] = np.minimum(most[about], np.maximum(move.low * np.minimum(most[about], 1.0), least))
    return part.led(bump, most, contacts, gives)


LEAST_HEIGHT_M = 0.04
"""No stroke is lowered under this (our choice)."""
