"""The habits that can be planted in a virtual student, as changes to what it would have played.

Each habit of `student_spec.FAULTS` changes one thing of a stroke: when it comes (`shift_ms`, negative is early), how
far a grace stroke leads (`lead_ms`), how loud it is (`level_db`, in the scale of HUMANS: 40·log10(velocity/127)), how
far the hi-hat is open (`openness`), how much longer a cymbal rings (`ring_ms`), or by how much a buzz ends early
(`short_ms`). Which strokes a habit concerns is read from the score by `music.passages`.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Limb, Piece
from station.music import passages
from station.music.score import Score
from station.simulation.student_spec import PlantedFault

Floats = NDArray[np.float64]

DB_PER_VELOCITY_DECADE = 40.0
"""HUMANS: a level is about 40·log10(velocity/127) dB."""


@dataclass(frozen=True, eq=False)
class PlantedHabits:
    """What all planted habits together do to each row, all of shape (n,): see the module's head."""

    shift_ms: Floats
    lead_ms: Floats
    level_db: Floats
    openness: Floats
    ring_ms: Floats
    short_ms: Floats
    strokes: dict[str, int]
    """How many strokes each habit concerns."""


CHANGES = ("shift_ms", "lead_ms", "level_db", "openness", "ring_ms", "short_ms")


def habits_of(score: Score, limbs: NDArray[np.int8], faults: Iterable[PlantedFault]) -> PlantedHabits:
    """All of `faults` applied to `score`, whose rows are played by `limbs` (n,)."""
    changes = {name: np.zeros(len(score)) for name in CHANGES}
    strokes: dict[str, int] = {}
    for fault in faults:
        what, effect = _EFFECTS[fault.name]
        change = effect(score, limbs, fault.size)
        changes[what] += change
        strokes[fault.name] = int(np.count_nonzero(change))
    return PlantedHabits(strokes=strokes, **changes)


def louder(velocity: Floats, level_db: Floats) -> Floats:
    """`velocity` changed by `level_db`, unrounded and unbounded."""
    changed: Floats = velocity * 10.0 ** (level_db / DB_PER_VELOCITY_DECADE)
    return changed


# --- the habits ------------------------------------------------------------------------------------------------------

Effect = Callable[[Score, NDArray[np.int8], float], Floats]


def _on(rows: NDArray[np.bool_], size: float | Floats) -> Floats:
    return np.where(rows, size, 0.0)


def _late_kick(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(score.notes["piece"] == Piece.KICK, size)


def _slow_hihat_foot(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(score.notes["piece"] == Piece.HIHAT_PEDAL, size)


def _drag_slow(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(passages.long_waits(score), size)


def _uneven_doubles(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(passages.second_of_doubles(score), -size)


def _rush_fills(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    """Ahead in proportion to how far into the fill a stroke is; the mean over each fill's strokes is `size`."""
    return -size * passages.fill_ramp(score)


def _straight_swing(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    swung = passages.swung(score)
    ratio = np.maximum(swung.places / (1.0 - swung.places) - size, 1.0)
    return _on(swung.flags, (ratio / (1.0 + ratio) - swung.places) * swung.span_ms)


def _wide_flams(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(score.is_grace, size)


def _weak_left(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(limbs == Limb.LEFT_HAND, -size)


def _loud_ghosts(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on((score.notes["dynamic"] == Dynamic.GHOST) & ~score.is_grace, size)


def _flat_accents(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(score.notes["dynamic"] == Dynamic.ACCENT, -size)


def _open_hats(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on((score.notes["piece"] == Piece.HIHAT) & (score.notes["openness"] == 0.0), size)


def _late_grabs(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on(score.notes["choke_ticks"] > 0, size)


def _short_buzz(score: Score, limbs: NDArray[np.int8], size: float) -> Floats:
    return _on((score.notes["articulation"] == Articulation.BUZZ) & ~score.is_grace, size)


_EFFECTS: dict[str, tuple[str, Effect]] = {
    "late_kick": ("shift_ms", _late_kick),
    "rush_fills": ("shift_ms", _rush_fills),
    "drag_slow": ("shift_ms", _drag_slow),
    "straight_swing": ("shift_ms", _straight_swing),
    "uneven_doubles": ("shift_ms", _uneven_doubles),
    "slow_hihat_foot": ("shift_ms", _slow_hihat_foot),
    "wide_flams": ("lead_ms", _wide_flams),
    "weak_left": ("level_db", _weak_left),
    "loud_ghosts": ("level_db", _loud_ghosts),
    "flat_accents": ("level_db", _flat_accents),
    "open_hats": ("openness", _open_hats),
    "late_grabs": ("ring_ms", _late_grabs),
    "short_buzz": ("short_ms", _short_buzz),
}
