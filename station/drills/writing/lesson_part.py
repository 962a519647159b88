"""A lesson as a drum part that any format can write, its bars once and its landing after them."""

import numpy as np

from station.drills.lesson import Lesson
from station.music.drum_part import DrumPart, PartSection
from station.music.score import Score


def part_of(lesson: Lesson) -> DrumPart:
    """The music of `lesson`, with what a sheet says beside it."""
    return DrumPart(
        _with_beyond(lesson),
        lesson.author,
        " ".join(lesson.about.split()),
        lesson.beat_ticks,
        lesson.swing,
        tuple(PartSection(s.name, s.first_bar, s.last_bar) for s in lesson.sections if s.name),
    )


def _with_beyond(lesson: Lesson) -> Score:
    """All bars once, also with what is beyond the player: other drummers, or machines, may play it."""
    score = lesson.played_once
    if not len(lesson.beyond):
        return score
    rows = np.concatenate([score.notes, lesson.beyond])
    return Score.from_array(rows, score.tempo_map, score.end_tick, score.title, score.loudness)
