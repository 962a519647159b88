"""Who plays what: the station's hands beside those of the thesis's own algorithm, in recordings and in lessons.

    .venv/bin/python benchmarks/gmd_limbs.py [--data ../shared/data/gmd]

Of every file of the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0) that is there, and of every lesson with its
written sticking left out, for a right-handed, a left-handed and an open-handed player. Counted from the struck points
alone, by nobody's prices:

* two places: strokes whose hand struck another piece `AT_ONCE_S` before;
* crossed: hands more than `PAST_M` past each other, or more than `FAR_M`, where the other struck less than `RECENT_S`
  before; home posture, the leading hand on the hi-hat over the other on the snare, is none but for open hands;
* metres between the spots that a hand strikes in turn;
* hurried: moves of more than `A_MOVE_M` that must be faster than `HURRY_M_S` from strike to strike;
* thirds: strokes that follow two others of the same hand within `THIRD_S` each: the second was the rebound;
* laid: cross-sticks of one hand while the other still lies on the same drum.
"""

import argparse
from dataclasses import astuple, dataclass, fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Limb, Piece
from station.drills.library import find_lesson, lesson_names
from station.motion.kit.kit import Kit, load_kit
from station.motion.sticking.hand_notes import Hands
from station.motion.sticking.limbs import METHODS, assign_limbs
from station.motion.strokes.targets import strike_points
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import Score

AT_ONCE_S = (0.005, 0.010, 0.025, 0.050)
"""From the same instant for a pad to what no hand does in another place (our choice)."""
RECENT_S = 0.6
"""A hand that struck longer ago is out of the other's way (our choice)."""
PAST_M, FAR_M = 0.03, 0.60
"""Hands are past each other by more than this (our choice: more than half of what parts two spots of a head), and so
far that one arm lies across the other (a forearm is .26 m long, a stick .41)."""
A_MOVE_M, HURRY_M_S = 0.10, 3.0
"""A shorter way is the wrist's; 3 m/s is the mean of a quick reach of the whole arm (HUMANS: 40 cm at a peak of 3)."""
THIRD_S = 0.105
"""Up to here one hand plays two notes as a rebound, which a third has none of (second bounce after 50–90 ms)."""


@dataclass(frozen=True, slots=True)
class Tally:
    """What one way of assigning limbs asks of the hands, as the module's head says."""

    within_5_ms: int = 0
    within_10_ms: int = 0
    within_25_ms: int = 0
    within_50_ms: int = 0
    crossed: int = 0
    crossed_far: int = 0
    metres: float = 0.0
    hurried: int = 0
    thirds: int = 0
    laid: int = 0

    def __add__(self, other: "Tally") -> "Tally":
        return Tally(*(a + b for a, b in zip(astuple(self), astuple(other), strict=True)))


@dataclass(frozen=True, slots=True)
class _Stroke:
    at_s: float
    piece: Piece
    point: NDArray[np.float64]
    cross_stick: bool


def tally(score: Score, kit: Kit, limbs: NDArray[np.int8], hands: Hands) -> Tally:
    """What `limbs` ask of the hands in `score` on `kit`."""
    points, result = strike_points(score, kit, limbs), Tally()
    leads = Limb.LEFT_HAND if hands is Hands.LEFT else Limb.RIGHT_HAND
    last: dict[int, list[_Stroke]] = {Limb.RIGHT_HAND: [], Limb.LEFT_HAND: []}
    notes = score.notes
    for row in np.argsort(score.onset_ns, kind="stable").tolist():
        limb = Limb(limbs[row])
        if not limb.is_hand:
            continue
        laid = bool(notes["articulation"][row] == Articulation.CROSS_STICK)
        now = _Stroke(float(score.onset_s[row]), kit.stand_in(Piece(notes["piece"][row])), points[row], laid)
        own, others = last[limb], last[1 - limb]
        result += _after_own(now, own)
        if others and now.at_s - others[-1].at_s < RECENT_S:
            other = others[-1]
            leading, following = (now, other) if limb is leads else (other, now)
            home = (leading.piece, following.piece) == (Piece.HIHAT, Piece.SNARE) and hands is not Hands.OPEN
            over = (other.point[0] - now.point[0]) * (1 if limb is Limb.RIGHT_HAND else -1)
            both = now.cross_stick and other.cross_stick and now.piece == other.piece
            result += Tally(crossed=int(over > PAST_M and not home), crossed_far=int(over > FAR_M), laid=int(both))
        last[limb] = [*own[-1:], now]
    return result


def _after_own(now: _Stroke, own: list[_Stroke]) -> Tally:
    """What a stroke asks of the hand that struck `own`, its last two."""
    if not own:
        return Tally()
    gap, way = now.at_s - own[-1].at_s, float(np.linalg.norm(now.point - own[-1].point))
    moved = own[-1].piece != now.piece
    third = len(own) > 1 and max(gap, own[-1].at_s - own[-2].at_s) < THIRD_S
    a, b, c, d = (int(moved and gap < s) for s in AT_ONCE_S)
    return Tally(a, b, c, d, 0, 0, way, int(way > max(A_MOVE_M, HURRY_M_S * gap)), int(third))


def unwritten(score: Score) -> Score:
    """`score` without the hands that it writes; its feet stay."""
    by_hand = np.isin(score.notes["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND))
    return score.with_limbs(np.where(by_hand, Limb.UNKNOWN, score.notes["limb"]).astype(np.int8))


def main() -> None:
    """Count and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    data = parser.parse_args().data
    files = sorted(data.rglob("*.mid"))
    if not files:
        parser.error(f"{data}: no MIDI files of the Groove MIDI Dataset in it; --data says where they are")
    recordings = {str(path.relative_to(data)): score_from_midi(read_midi(path)) for path in files}
    lessons = {name: unwritten(find_lesson(name).score) for name in lesson_names()}
    for title, scores in (("recordings", recordings), ("lessons", lessons)):
        for hands in Hands:
            print(f"{len(scores)} {title}, {sum(map(len, scores.values()))} strokes, {hands.value} hands")
            print(table(scores, hands))


def table(scores: dict[str, Score], hands: Hands) -> str:
    """Both methods' sums over `scores` in all columns, and in how many scores ours is worse, the first by name."""
    kit = load_kit("left_handed" if hands is Hands.LEFT else "four_piece")
    each = {m: [tally(s, kit, assign_limbs(s, kit, m, hands).limbs, hands) for s in scores.values()] for m in METHODS}
    ours, thesis = (each[method] for method in METHODS)
    lines = [f"{'':14}{METHODS[0]:>9}{METHODS[1]:>9}  worse in"]
    for column in fields(Tally):
        one, other = ([getattr(t, column.name) for t in found] for found in (ours, thesis))
        worse = [name for a, b, name in zip(one, other, scores, strict=True) if a > b]
        lines.append(f"{column.name:14}{sum(one):9.0f}{sum(other):9.0f}  {len(worse)} {', '.join(worse[:2])}")
    return "\n".join(lines)


if __name__ == "__main__":
    main()
