"""Planted faults of loudness: hands, accents, ghosts, graces, doubles against what they are compared with; fades.

Sizes are those of part 7's table.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from station.bench.rigs.planted.planted_player import Sheet
from station.bench.rigs.planted.planted_stage import FEWEST, MOST, Maker, Planted, Stage
from station.bench.rigs.planted.planted_strokes import Mask, Written, level_db

DOUBLE_DB, HAND_DB, FADE_DB = 4.0, 3.0, 6.0
BESIDE_DB = 1.0
"""Limits that read "less than" are passed by what the skilled just notice (HUMANS: 1 dB)."""
ACCENT_DB, GHOST_DB, GRACE_DB = 4.0 - BESIDE_DB, 8.0 - BESIDE_DB, 6.0 - BESIDE_DB

Compared = tuple[Mask, float]
"""Strokes that others are compared with, and by how many dB the faulty ones must change."""


def level(name: str, compared: Callable[[Written, Mask], Compared]) -> Maker:
    """Strokes that are too loud or too soft against others."""

    def make(stage: Stage) -> Planted | None:
        shape = stage.shapes["level"][name]
        strokes = shape != 0
        others, teachers = compared(stage.written, strokes)
        if min(strokes.sum(), others.sum()) < FEWEST or teachers <= 0:
            return None
        size = max(teachers, stage.least("level", shape))
        if size > MOST * max(teachers, HAND_DB):
            return None
        planted_db = stage.times * size
        return Planted(name, planted_db, strokes, "level", lambda sheet, _: sheet.louder(planted_db * shape))

    return make


def against_other_hand(written: Written, hand: Mask) -> Compared:
    """Where both hands play the same."""
    others = written.main & ~hand & np.isin(written.score.notes["limb"], (0, 1))
    return others, HAND_DB if written.compared_hands else 0.0


def ghosts(written: Written, ghosts: Mask) -> Compared:
    """Ghosts less than 8 dB under their taps."""
    others = written.ghosts_and_others[1]
    return others, _gap_db(ghosts, others, written) - GHOST_DB


def accents(written: Written, accents: Mask) -> Compared:
    """Accents less than 4 dB over their taps."""
    others = written.accents_and_taps[1]
    return others, _gap_db(accents, others, written) - ACCENT_DB


def graces(written: Written, graces: Mask) -> Compared:
    """Graces less than 6 dB under their main strokes."""
    mains = np.zeros_like(graces)
    mains[written.main_of[graces]] = True
    return mains, _gap_db(graces, mains, written) - GRACE_DB


def doubles(written: Written, _: Mask) -> Compared:
    """Second strokes of doubles 4 dB under the first."""
    return written.first_of_double, DOUBLE_DB


def _gap_db(these: Mask, those: Mask, written: Written) -> float:
    """How far apart the two are written; 0 where there is nothing to compare."""
    if not (these.any() and those.any()):
        return 0.0
    levels = level_db(written.score.notes["velocity"])
    return abs(float(levels[those].mean() - levels[these].mean()))


def fade(name: str, sign: int) -> Maker:
    """All strokes softer, or louder, from the first to the last."""

    def make(stage: Stage) -> Planted | None:
        written = stage.written
        least = max(FADE_DB, stage.least("level", stage.shapes["level"][name]))
        size = stage.times * least

        def plant(sheet: Sheet, _: np.random.Generator) -> Sheet:
            from_db = np.full(len(written.score), -size if sign > 0 else 0.0)  # grows from below: 127 is the loudest
            return replace(sheet.louder(from_db), fade_db=sign * size)

        return None if least > MOST * FADE_DB else Planted(name, size, written.main, "level", plant)

    return make
