"""The section that a session practised, once, and which of its notes each judged note is: what a page engraves.

Where the tempo follows the student, passes differ in bars and tempo; they are laid over the lesson's own bars.
"""

from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score
from station.practice.session.plan import Plan
from station.practice.session.session import SessionResult

ELSEWHERE = -1
"""Of a judged note that is none of the section, such as the landing after the last pass."""


def practised_section(plan: Plan) -> Score:
    """The practised bars from tick 0, at the practice tempo."""
    if plan.rounds is None:
        return plan.section
    return plan.lesson.score.bars(*plan.bars).at_speed(plan.tempo_bpm / plan.lesson.tempo_bpm)


def section_notes(result: SessionResult, section: Score) -> NDArray[np.int64]:
    """For every judged note (n,) which note of `section` it is, `ELSEWHERE` for none."""
    known = defaultdict[tuple[int, ...], list[int]](list)
    for index, key in enumerate(_keys(section, np.arange(section.bar_count))):
        known[key].append(index)
    names = np.asarray(result.plan.bar_names) - result.plan.bars[0]
    found = np.full(len(result.score), ELSEWHERE, np.int64)
    met = defaultdict[tuple[int, ...], int](int)
    for row, (key, bar) in enumerate(zip(_keys(result.score, names), result.score.bar.tolist(), strict=True)):
        there = known.get(key, ())
        before = met[(bar, *key)]  # strokes on one piece at one moment come in one order
        if before < len(there):
            found[row] = there[before]
            met[(bar, *key)] += 1
    return found


def section_ticks(result: SessionResult, section: Score) -> list[tuple[int, int, int]]:
    """The bars of the judged score that are bars of `section`: tick where each starts, the section's tick, its length.

    In order of time; a pass begins where the section's tick falls back.
    """
    names, tempo_map = result.plan.bar_names, result.score.tempo_map
    rows = []
    for bar in range(min(result.score.bar_count, len(names))):
        there = names[bar] - result.plan.bars[0]
        if 0 <= there < section.bar_count:
            start, end = tempo_map.bar_start(bar), tempo_map.bar_start(bar + 1)
            rows.append((start, section.tempo_map.bar_start(there), end - start))
    return rows


def _keys(score: Score, names: NDArray[np.int64]) -> list[tuple[int, ...]]:
    """What a note is known by: its bar's name, its tick in the bar, its piece and whether it is a grace stroke."""
    starts = np.asarray([score.tempo_map.bar_start(bar) for bar in range(int(score.bar.max(initial=0)) + 1)])
    bar = score.bar
    rows = np.column_stack(
        [
            np.asarray(names, np.int64)[np.minimum(bar, len(names) - 1)],
            score.notes["tick"] - starts[bar],
            score.notes["piece"],
            np.rint(10 * score.notes["lead_ms"]).astype(np.int64),
        ]
    )
    return [tuple(row) for row in rows.tolist()]
