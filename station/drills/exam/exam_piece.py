"""What is played in an exam: a lesson that was prepared, or unseen reading made from a seed. Once, whole, at one tempo.

Reading goes as graded drum exams have it: on the snare at first, on the kit from the fourth level on, 90 seconds to
look and try, one attempt. The same level and seed are the same piece, on any machine.
"""

from dataclasses import dataclass

from station.core.errors import BadInput
from station.drills.exam.exam_marks import asks_loudness
from station.drills.exam.rubric import Rubric, rubric_of
from station.drills.families.family_table import lesson_text
from station.drills.lesson import LEVELS, Lesson
from station.drills.reading.lesson_file import parse_lesson
from station.scoring.matching.hit_windows import Level

PREVIEW_S = 90.0
"""Rockschool's drum syllabus: 90 seconds to look through the music and try parts of it."""
MAX_PREVIEW_S = 600.0
"""Our choice: longer is practice."""
READING_BARS = 8
"""Our choice: two phrases, half a minute."""
_FAMILY_OF_LEVEL = {1: "reading", 2: "reading", 3: "reading", 4: "syncopation", 5: "linear"}
"""On the snare up to the third level, on the kit beyond, as exam boards have it."""


@dataclass(frozen=True, slots=True)
class Unseen:
    """Which unseen piece: `level` 1–5 of difficulty and `seed`."""

    level: int
    seed: int

    @property
    def name(self) -> str:
        """What its lesson is called."""
        return f"reading-{self.level}-{self.seed}"


@dataclass(frozen=True, eq=False)
class ExamPiece:
    """A `lesson` to be played once at `tempo_bpm` (quarter notes), after `preview_s` of looking, by `rubric`.

    `unseen` says which one it is where it was made for reading, None for a prepared piece.
    """

    lesson: Lesson
    tempo_bpm: float
    preview_s: float
    rubric: Rubric
    unseen: Unseen | None = None

    @property
    def beats_a_minute(self) -> float:
        """Its tempo in the beat that a teacher counts."""
        return self.lesson.beats_a_minute * self.tempo_bpm / self.lesson.tempo_bpm


def reading_piece(unseen: Unseen, level: Level | None = None, preview_s: float = PREVIEW_S) -> ExamPiece:
    """The unseen piece, judged at `level`, else as suits its difficulty; raises `BadInput` for what cannot be."""
    if unseen.level not in LEVELS:
        raise BadInput("--reading", str(unseen.level), f"expected {min(LEVELS)} to {max(LEVELS)}")
    text = lesson_text(_FAMILY_OF_LEVEL[unseen.level], unseen.level, unseen.seed, READING_BARS)
    text = text.partition("\n[landing]")[0]  # what is marked is what stands there
    lesson = parse_lesson(text, unseen.name, unseen.name).lesson
    assert lesson is not None, "what the families make reads"
    return _piece(lesson, lesson.tempo_bpm, level, preview_s, unseen)


def prepared_piece(
    lesson: Lesson, tempo_bpm: float | None = None, level: Level | None = None, preview_s: float = 0.0
) -> ExamPiece:
    """All bars of a lesson, at its target tempo where none is said; raises `BadInput`."""
    return _piece(lesson, tempo_bpm or lesson.target_tempo_bpm, level, preview_s, None)


def _piece(lesson: Lesson, tempo_bpm: float, level: Level | None, preview_s: float, unseen: Unseen | None) -> ExamPiece:
    if not 0.0 <= preview_s <= MAX_PREVIEW_S:
        raise BadInput("--preview", f"{preview_s:g}", f"expected 0 to {MAX_PREVIEW_S:g} seconds")
    rubric = rubric_of(lesson.levels.level(level), asks_loudness(lesson.score))
    return ExamPiece(lesson, tempo_bpm, preview_s, rubric, unseen)
