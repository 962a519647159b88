"""A lesson for a smaller kit, as it is practised: the same lesson, its text folded."""

from collections.abc import Collection
from dataclasses import replace

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.editing.edit_lesson import edited
from station.drills.editing.lesson_edits import Fold
from station.drills.lesson import Lesson
from station.drills.reading.lesson_file import parse_lesson


def folded(lesson: Lesson, pieces: Collection[Piece]) -> Lesson:
    """The lesson on these pieces alone, itself where it needs no others; its title says that it is folded.

    Raises `BadInput` for what has no text, and where nothing is left to play, or a lesson that asks for what is gone.
    """
    if {note.piece for note in lesson.score} <= set(pieces):
        return lesson
    if not lesson.text:
        raise BadInput(lesson.name, "", "only a lesson file folds to a smaller kit")
    text = edited(lesson.text, Fold(frozenset(pieces)), lesson.name)
    found = parse_lesson(text, lesson.name, lesson.name)
    if found.lesson is None:
        raise BadInput(lesson.name, "", f"cannot be played on this kit: {found.faults[0].text}")
    title = f"{lesson.title} (smaller kit)"
    return replace(found.lesson, text=text, title=title, score=replace(found.lesson.score, title=title))
