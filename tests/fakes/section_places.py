"""Where the notes of a plan whose passes are alike lie on its section: one after the other, pass by pass."""

from itertools import pairwise

import numpy as np

from station.practice.session.session import SessionResult
from station.scenes.report.take_notes import SectionPlace


def place_of(result: SessionResult) -> SectionPlace:
    """That of a session whose passes are all over one section."""
    plan, rows = result.plan, np.arange(len(result.score))
    count, tempo_map = len(plan.section), plan.section.tempo_map
    starts = [tempo_map.bar_start(bar) for bar in range(plan.section.bar_count + 1)]
    bars = [
        (each * plan.section.end_tick + start, start, end - start)
        for each in range(plan.passes)
        for start, end in pairwise(starts)
    ]
    return SectionPlace(np.where(rows < count * plan.passes, rows % count, -1), bars)
