"""Who plays what: a limb for every stroke of a score.

`station` (the default) chooses the hands that are cheapest together over the whole score (`sticking`), `smed` runs the
five passes of the thesis (`smed_limbs`). Both leave the feet where the pedals are and a written limb as it is written.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece
from station.motion.hand_notes import HandNotes, Hands
from station.motion.kit import Kit
from station.motion.smed_limbs import smed_hands
from station.motion.sticking import choose_hands
from station.music.score import Score

METHODS = ("station", "smed")


@dataclass(frozen=True, eq=False)
class Assignment:
    """`limbs` (n,) of `Limb` in the order of the score's notes, `why` each was chosen, and by which `method`.

    `warnings` name what is beyond a human, such as "bar 12 needs 14 strokes a second of one hand".
    """

    limbs: NDArray[np.int8]
    why: tuple[str, ...]
    method: str
    warnings: tuple[str, ...]


def assign_limbs(score: Score, kit: Kit, method: str = "station", hands: Hands | None = None) -> Assignment:
    """A limb for every note; `hands` is who leads, as the kit is built where it is not said.

    Raises `BadInput` for an unknown method.
    """
    if method not in METHODS:
        raise BadInput("method", method, f"no such method of limb assignment; there are {' and '.join(METHODS)}")
    lead = hands or (Hands.LEFT if kit.left_handed else Hands.RIGHT)
    limbs, why = _feet(score, lead)
    rows = np.flatnonzero(limbs == Limb.UNKNOWN)
    written = score.notes["limb"] != Limb.UNKNOWN
    if len(rows):
        notes = HandNotes.of(score, kit, rows, lead)
        chosen, reasons = choose_hands(notes) if method == "station" else smed_hands(notes)
        limbs[rows] = chosen
        for row, reason in zip(rows, reasons, strict=True):
            why[row] = "written" if written[row] else reason
    return Assignment(limbs, tuple(why), method, _beyond_human(score, limbs))


def _feet(score: Score, lead: Hands) -> tuple[NDArray[np.int8], list[str]]:
    """The notes that a foot plays; `Limb.UNKNOWN` and no reason at the others."""
    pieces, written = score.notes["piece"], score.notes["limb"]
    limbs = np.full(len(score), Limb.UNKNOWN, np.int8)
    why = [""] * len(score)
    kick, hat = (Limb.LEFT_FOOT, Limb.RIGHT_FOOT) if lead is Hands.LEFT else (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
    for piece, foot, reason in ((Piece.KICK, kick, "the kick's foot"), (Piece.HIHAT_PEDAL, hat, "the hi-hat's foot")):
        for row in np.flatnonzero(pieces == piece):
            said = written[row] in (Limb.LEFT_FOOT, Limb.RIGHT_FOOT)
            limbs[row] = written[row] if said else foot
            why[row] = "written" if said else reason
    return limbs, why


FASTEST_HZ = {True: 10.0, False: 11.0}
"""Strokes a second of one hand (Fujii 2009) and one foot (HUMANS) that champions reach."""
_BOUNCE_S = 0.04
"""The second stroke of a double may come this soon: it is a rebound (HUMANS has 50–90 ms)."""


def _beyond_human(score: Score, limbs: NDArray[np.int8]) -> tuple[str, ...]:
    """One sentence for each bar and limb in which three strokes come faster than any human's."""
    found: dict[tuple[int, Limb], float] = {}
    for limb in (Limb.RIGHT_HAND, Limb.LEFT_HAND, Limb.RIGHT_FOOT, Limb.LEFT_FOOT):
        rows = np.flatnonzero(limbs == limb)
        rows = rows[np.argsort(score.onset_ns[rows], kind="stable")]
        times = score.onset_s[rows]
        if len(times) < 3:
            continue
        rate = 2.0 / np.maximum(times[2:] - times[:-2], 1e-3)
        together = np.diff(times)[1:] < _BOUNCE_S / 2
        for i in np.flatnonzero((rate > FASTEST_HZ[limb.is_hand] * 1.25) | together):
            bar = int(score.bar[rows[i + 1]])
            found[bar, limb] = max(found.get((bar, limb), 0.0), float(min(rate[i], 1.0 / _BOUNCE_S)))
    return tuple(
        f"bar {bar + 1} needs {rate:.0f} strokes a second of one {'hand' if limb.is_hand else 'foot'}"
        for (bar, limb), rate in sorted(found.items())
    )
