"""How notes are played: the lateness and the velocity of each stroke, as a human of that manner plays them.

Over the touch of a human phrase (`borrowed_touch`) an opponent has its own spread, lean, loudness and contrast; jazz
swings by the tempo, and a build grows louder.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.music.score import MAX_LATE_MS
from station.music.swing import MAX_RATIO, MIN_RATIO, TRIPLETS
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.borrowed_touch import BorrowedTouch, borrowed_touch
from station.practice.battle.improvising.phrase_plan import PlannedBar
from station.practice.battle.improvising.played_beats import Beats
from station.practice.battle.improvising.stroke_place import struck_cells
from station.practice.battle.opponents.opponent import Opponent

_MIDDLE = 72.0
"""About this velocity contrast is scaled: the middle of a normal stroke (HUMANS, Velocity: 60–95)."""
_SWINGING = "jazz"
Floats = NDArray[np.float64]


def expressed(beats: Beats, opponent: Opponent, plan: Sequence[PlannedBar], ground: Ground, rng: Generator) -> Beats:
    """`beats`, a bar for each of `plan`, with the velocities and the timing of `opponent`."""
    velocity, late_ms = np.zeros(beats.velocity.shape, np.uint8), np.zeros(beats.late_ms.shape, np.float32)
    at = tuple(struck_cells(beats).T)
    if not len(at[0]):
        return replace(beats, velocity=velocity, late_ms=late_ms)
    touch = borrowed_touch(beats, ground.beats_a_minute, rng)
    velocity[at] = np.rint(_velocity(beats, touch, opponent, plan)).astype(np.uint8)
    late_ms[at] = _late_ms(beats, touch, opponent, ground, rng)
    return replace(beats, velocity=velocity, late_ms=late_ms)


def _velocity(beats: Beats, touch: BorrowedTouch, opponent: Opponent, plan: Sequence[PlannedBar]) -> Floats:
    manner = opponent.manner
    bar = struck_cells(beats)[:, 0] // beats.beats_a_bar
    louder = np.array([one.loudness for one in plan])[bar]
    plain = _MIDDLE + (touch.velocity - manner.evenness * touch.louder - _MIDDLE) * manner.contrast
    return np.asarray(np.clip(plain * manner.loudness * louder, 5.0, 127.0))


def _late_ms(beats: Beats, touch: BorrowedTouch, opponent: Opponent, ground: Ground, rng: Generator) -> Floats:
    manner, mistakes = opponent.manner, opponent.mistakes
    struck = struck_cells(beats)
    late = touch.late_ms * manner.clock + manner.lean_ms + manner.lean_spread_ms * rng.normal()
    late += rng.normal(0.0, 1.0, len(struck)) * mistakes.spread_ms
    if _SWINGING in opponent.styles:
        late += swing_ms(beats, ground)[struck[:, 0], struck[:, 1]]
    if rng.random() < mistakes.lost_one:
        late[struck[:, 0] >= len(beats) - beats.beats_a_bar] += rng.uniform(0.3, 1.0) * MAX_LATE_MS
    return np.clip(late, -MAX_LATE_MS, MAX_LATE_MS)


def swing_ratio(beat_s: float) -> float:
    """Long to short of a jazz drummer's swung eighths, whose beat lasts so long (Friberg & Sundström 2002, HUMANS)."""
    return float(np.clip((1000 * beat_s - 100) / 100, MIN_RATIO, MAX_RATIO))


def swing_ms(beats: Beats, ground: Ground) -> NDArray[np.float64]:
    """By beat and cell (n, 8), how much later than the last triplet the last stroke of a swung beat is."""
    beat_s = 60 / ground.beats_a_minute
    later = _long_share(swing_ratio(beat_s)) - _long_share(TRIPLETS)
    found = np.zeros(beats.struck.shape[:2])
    for division, cell in ((3, 2), (6, 4)):
        found[beats.division == division, cell] = 1000 * beat_s * later
    return found


def _long_share(ratio: float) -> float:
    return ratio / (ratio + 1)
