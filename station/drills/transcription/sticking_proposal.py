"""A sticking for what a file says no hands of, written where it is as good as sure.

`motion.sticking` chooses the hands of each grid as it is played by itself, and says why. A bar gets a line where the
reasons are those of grooves: one hand keeps time, and the other is where that one is not. Held against the lessons that
ship, whose authors wrote their stickings, 360 of the 380 bars that this names are theirs to the letter; of all other
bars, rudiments above all, it would be one in four.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import HAND_PIECES, OTHER_HAND, Limb, Ornament, Piece
from station.drills.grid.sticking_line import RIGHT_FIRST
from station.drills.lesson import Lesson
from station.drills.writing.lesson_form import FormGrid, LessonForm
from station.motion.kit.kit import Kit, load_kit
from station.motion.sticking.limbs import limbs_and_reasons
from station.music.score import Score

_KEEPS_TIME = "the ostinato's hand"
_SURE = frozenset(
    {
        _KEEPS_TIME,
        "the cross-stick's hand",
        "one hand lies on the drum",
        "the nearer hand",
        "the other hand is elsewhere",
        "the hands stay uncrossed",
    }
)
_SURE_BESIDE_TIME = frozenset({"natural sticking", "so that the strokes after it fall well", "too quick for one hand"})
"""Reasons, as `motion.sticking` words them; the last ones in bars where a hand keeps time."""


def with_sticking(lesson: Lesson, form: LessonForm) -> Lesson:
    """`lesson`, its hands named where they are sure; as it is where its file says any hand.

    Bars in which the hands play the same, loud or soft, have the same hands: those of the first that is sure.
    """
    rows = lesson.score.notes.copy()
    if np.isin(rows["limb"], (Limb.RIGHT_HAND, Limb.LEFT_HAND)).any():
        return lesson
    kit, known = load_kit(), dict[bytes, NDArray[np.int8]]()
    for grid in form.grids:
        for written, hands in _sure_bars(_played(lesson.score, grid, grid.first_bar), kit):
            known.setdefault(written, hands)
    limbs = [_limbs(_played(lesson.score, grid, grid.first_bar), known) for grid in form.grids]
    for index, first_bar in _turns(form):
        grid, own = form.grids[index], limbs[index]
        start, end = (lesson.score.tempo_map.bar_start(b) for b in (first_bar, first_bar + grid.bars))
        rows["limb"][(rows["tick"] >= start) & (rows["tick"] < end)] = own
    score = replace(lesson.score, notes=rows)
    return replace(lesson, score=score)


def _played(score: Score, grid: FormGrid, first_bar: int) -> Score:
    return score.bars(first_bar, first_bar + grid.bars - 1)


def _turns(form: LessonForm) -> Iterator[tuple[int, int]]:
    """The index of each grid whenever it is played, and its first bar then."""
    bar = 0
    for index in form.order:
        for _ in range(form.grids[index].times):
            yield index, bar
            bar += form.grids[index].bars


def _limbs(score: Score, known: Mapping[bytes, NDArray[np.int8]]) -> NDArray[np.int8]:
    """The limb of each stroke (n,), the hands' only in bars that are known."""
    found: NDArray[np.int8] = score.notes["limb"].copy()
    for rows in _hands_by_bar(score):
        found[rows] = known.get(_as_written(score, rows), found[rows])
    return found


def _sure_bars(score: Score, kit: Kit) -> Iterator[tuple[bytes, NDArray[np.int8]]]:
    """What the hands have in each bar where they are sure, and which hand has it."""
    bars = _hands_by_bar(score)
    if not bars:
        return
    chosen, reasons = limbs_and_reasons(score, kit)
    chosen = _with_their_mains(score, chosen)
    for rows in bars:
        mains = [i for i in rows.tolist() if not score.is_grace[i]]
        if _is_sure({reasons[i] for i in mains}) and _can_be_said(score, chosen, mains):
            yield _as_written(score, rows), chosen[rows]


def _hands_by_bar(score: Score) -> list[NDArray[np.intp]]:
    """The rows of the hands in each bar that has any."""
    hands = np.isin(score.notes["piece"], sorted(HAND_PIECES))
    return [np.flatnonzero(hands & (score.bar == bar)) for bar in np.unique(score.bar[hands])]


def _as_written(score: Score, rows: NDArray[np.intp]) -> bytes:
    """What the hands have in a bar, whichever bar it is and however loud."""
    notes = score.notes[rows]
    start = score.tempo_map.bar_start(int(score.bar[rows[0]]))
    columns = (notes["tick"] - start, notes["piece"], notes["ornament"], notes["lead_ms"] > 0)
    return np.stack([column.astype(np.int64) for column in columns]).tobytes()


def _is_sure(reasons: set[str]) -> bool:
    return reasons <= (_SURE | _SURE_BESIDE_TIME if _KEEPS_TIME in reasons else _SURE)


def _with_their_mains(score: Score, limbs: NDArray[np.int8]) -> NDArray[np.int8]:
    """The limbs, those of grace strokes the other hand than that of their main stroke."""
    mains = {(n.tick, n.piece): Limb(limb) for n, limb in zip(score, limbs.tolist(), strict=True) if not n.lead_ms}
    found = limbs.copy()
    for i, note in enumerate(score):
        if note.lead_ms:
            found[i] = OTHER_HAND.get(mains.get((note.tick, note.piece), Limb.UNKNOWN), Limb.UNKNOWN)
    return found


def _can_be_said(score: Score, limbs: NDArray[np.int8], rows: Sequence[int]) -> bool:
    """Whether a sticking line says these hands: of two strokes the right hand's is that which comes first in it."""
    if any(score.notes["ornament"][i] in (Ornament.DIDDLE, Ornament.ROLL) for i in rows):
        return False
    for _, group in groupby(rows, key=lambda i: int(score.notes["tick"][i])):
        together = sorted(group, key=lambda i: RIGHT_FIRST.index(Piece(int(score.notes["piece"][i]))))
        if len(together) > 1 and [int(limbs[i]) for i in together] != [Limb.RIGHT_HAND, Limb.LEFT_HAND]:
            return False
    return True
