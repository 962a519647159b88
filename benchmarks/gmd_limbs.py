"""Who plays what in recordings: the station's hands beside those of the thesis's own algorithm.

    .venv/bin/python benchmarks/gmd_limbs.py [--data ../shared/data/gmd]

Of every file of the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0) that is there: strokes whose hand struck
another piece `AT_ONCE_S` before, hands past each other outside home posture (the leading one on the hi-hat over the
other on the snare), metres between the spots that a hand strikes in turn; and the files in which the station's hands
are asked for two places at once more often than the thesis's.
"""

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.motion.kit.kit import Kit, load_kit
from station.motion.sticking.limbs import METHODS, assign_limbs
from station.motion.strokes.targets import strike_points
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import Score

AT_ONCE_S = (0.005, 0.010, 0.025, 0.050)
"""From the same instant for a pad to what no hand does in another place (our choice)."""
RECENT_S = 0.6
"""A hand that struck longer ago is out of the other's way (our choice)."""
PAST_M = 0.03
"""Hands are past each other by more than this (our choice: more than half of what parts two spots of a head)."""


@dataclass(frozen=True, slots=True)
class Tally:
    """What one way of assigning limbs asks of the hands: `impossible` for each of `AT_ONCE_S`."""

    impossible: tuple[int, ...] = (0,) * len(AT_ONCE_S)
    crossings: int = 0
    travel_m: float = 0.0

    def __add__(self, other: "Tally") -> "Tally":
        both = tuple(a + b for a, b in zip(self.impossible, other.impossible, strict=True))
        return Tally(both, self.crossings + other.crossings, self.travel_m + other.travel_m)


def tally(score: Score, kit: Kit, limbs: NDArray[np.int8]) -> Tally:
    """What `limbs` ask of a right-handed player's hands in `score` on `kit`."""
    points, result = strike_points(score, kit, limbs), Tally()
    last: dict[int, tuple[float, Piece, NDArray[np.float64]]] = {}
    for row in np.argsort(score.onset_ns, kind="stable").tolist():
        limb, at, piece = int(limbs[row]), float(score.onset_s[row]), kit.stand_in(Piece(score.notes["piece"][row]))
        if not Limb(limb).is_hand:
            continue
        if limb in last:
            before_s, before, point = last[limb]
            bad = tuple(int(before != piece and at - before_s < s) for s in AT_ONCE_S)
            result += Tally(bad, 0, float(np.linalg.norm(points[row] - point)))
        other = last.get(1 - limb)
        if other is not None and at - other[0] < RECENT_S:
            over = (other[2][0] - points[row][0]) * (1 if limb == Limb.RIGHT_HAND else -1)
            home = (piece, other[1]) == (
                (Piece.HIHAT, Piece.SNARE) if limb == Limb.RIGHT_HAND else (Piece.SNARE, Piece.HIHAT)
            )
            result += Tally(crossings=int(over > PAST_M and not home))
        last[limb] = (at, piece, points[row])
    return result


def main() -> None:
    """Count and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    data = parser.parse_args().data
    files = sorted(data.rglob("*.mid"))
    if not files:
        parser.error(f"{data}: no MIDI files of the Groove MIDI Dataset in it; --data says where they are")
    total = dict.fromkeys(METHODS, Tally())
    kit, worse = load_kit(), []
    for path in files:
        score = score_from_midi(read_midi(path))
        found = {method: tally(score, kit, assign_limbs(score, kit, method).limbs) for method in METHODS}
        total = {method: total[method] + found[method] for method in METHODS}
        ours, thesis = (found[method].impossible for method in METHODS)
        worse += [path.name] if any(a > b for a, b in zip(ours, thesis, strict=True)) else []
    within = ", ".join(f"{1000 * s:.0f}" for s in AT_ONCE_S)
    print(f"{len(files)} files; two places within {within} ms; crossings; metres")
    for method, sums in total.items():
        print(f"{method:8} {sums.impossible}  {sums.crossings}  {sums.travel_m:.0f}")
    print("more often in two places than the thesis's:", ", ".join(worse) or "no file")


if __name__ == "__main__":
    main()
