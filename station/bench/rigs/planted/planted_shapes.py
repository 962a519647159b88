"""What a word means: by how much each stroke is later or louder, for a fault of size 1, with its sign.

Shapes are (n,), a row a stroke, in ms or dB. They are there for all words that a stroke's time or level can confirm,
also those that are too rare in a piece of music to be planted there: they may still explain what was planted.
"""

from collections.abc import Mapping

import numpy as np

from station.bench.rigs.planted.planted_strokes import Floats, Mask, Written
from station.core.pieces import Limb, Ornament, Piece, word

HANDS: Mapping[str, Limb] = {"left_hand": Limb.LEFT_HAND, "right_hand": Limb.RIGHT_HAND}


def timing_shapes(written: Written) -> Mapping[str, Floats]:
    """Every word that says "these strokes are late or early"."""
    leaning: dict[str, Floats] = {word(p): _of(written.piece(p)) for p in written.pieces if p is not Piece.HIHAT_PEDAL}
    leaning |= {name: _of(written.limb(limb)) for name, limb in HANDS.items()}
    leaning["offbeats"] = _of(written.offbeats)
    both = (
        [(f"late_{name}", f"early_{name}", shape) for name, shape in leaning.items()]
        + [("late", "early", _of(written.main))]
        + [("slow_hihat_foot", "early_hihat_foot", _of(written.piece(Piece.HIHAT_PEDAL)))]
        + [("hard_swing", "straight_swing", _of(written.swung))]
        + [("drag_fills", "rush_fills", _fills(written))]
        + [("fill_lands_late", "fill_lands_early", _landings(written))]
        + [("drag_slow", "rush_slow", _of(written.after_wait))]
        + [("lazy_doubles", "uneven_doubles", _of(written.second_of_double))]
    )
    found = {late: shape for late, _, shape in both} | {early: -shape for _, early, shape in both}
    return found | {"swung_straight": _of(written.offbeats)}


def _of(mask: Mask) -> Floats:
    return mask.astype(np.float64)


def _fills(written: Written) -> Floats:
    """A fill that runs off: .4 of the mean at its first stroke, 1.6 at its last."""
    shape = np.zeros(len(written.score))
    for inside, _ in written.fills:
        at_s = written.time_s[inside]
        shape[inside] = 0.4 + 1.2 * (at_s - at_s[0]) / max(float(np.ptp(at_s)), 1e-9)
    return shape


def _landings(written: Written) -> Floats:
    """All of it on the one after a fill, half of it in the rest of that beat."""
    shape = np.zeros(len(written.score))
    for _, after in written.fills:
        shape[after] = np.where(written.place[after] == 0, 1.0, 0.5)
    return shape


def level_shapes(written: Written) -> Mapping[str, Floats]:
    """Every word that says "these strokes are too loud or too soft"."""
    ghosts, accents = written.ghosts_and_others[0], written.accents_and_taps[0]
    graces = written.score.is_grace & (written.score.notes["ornament"] != Ornament.NONE)
    through = (written.time_s - written.time_s.min(initial=0)) / max(float(np.ptp(written.time_s)), 1e-9)
    soft = {name: written.limb(limb) for name, limb in (("weak_left", Limb.LEFT_HAND), ("weak_right", Limb.RIGHT_HAND))}
    soft |= {"weak_doubles": written.second_of_double, "flat_accents": accents}
    loud = {"loud_ghosts": ghosts, "loud_graces": graces}
    return (
        {name: -_of(mask) for name, mask in soft.items()}
        | {name: _of(mask) for name, mask in loud.items()}
        | {"fades": -through, "grows": through}
    )
