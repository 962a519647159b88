"""A lesson as a drum part that any format can write, its bars once and its landing after them."""

from station.drills.lesson import Lesson
from station.music.drum_part import DrumPart, PartSection


def part_of(lesson: Lesson) -> DrumPart:
    """The music of `lesson`, with what a sheet says beside it.

    All bars once, also with what is beyond the player: other drummers, or machines, may play it.
    """
    return DrumPart(
        lesson.played_once.whole[0],
        lesson.author,
        " ".join(lesson.about.split()),
        lesson.beat_ticks,
        lesson.swing,
        tuple(PartSection(s.name, s.first_bar, s.last_bar) for s in lesson.sections if s.name),
    )
