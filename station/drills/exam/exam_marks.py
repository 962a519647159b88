"""The marks of one take by the rubric: from the final alignment alone, over all written notes.

Strokes that nobody wrote cost in every line: whoever hammers on all pads hits everything and plays nothing. Where a
piece leans and how a swing is held cost nothing, as in every score of the station (`scoring.analysis.points`, whose
free part is taken off here too); the windows are those of the level.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.counts import counted
from station.drills.exam.rubric import KEPT_SHARE, Criterion, Mark, Marks, Rubric
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.analysis.loudness import dynamic_credit, dynamics, judged_notes
from station.scoring.analysis.points import ALL_FREE, Feel, free_ms
from station.scoring.analysis.timing_spread import asynchrony_ms
from station.scoring.matching.alignment import Alignment

Flags = NDArray[np.bool_]


def asks_loudness(score: Score) -> bool:
    """Whether the music has accents or ghosts: without them every loudness is as written."""
    return bool(judged_notes(score).any())


@dataclass(frozen=True, eq=False)
class ExamTake:
    """What was played of the whole `score`, its `alignment`, and what costs nothing, `feel`.

    `bars` (n,) are the bars that the notes count for.
    """

    score: Score
    bars: NDArray[np.int64]
    performance: Performance
    alignment: Alignment
    feel: Feel = ALL_FREE

    @property
    def answered(self) -> Flags:
        """Which notes were played, shape (n,)."""
        return np.asarray(self.alignment.note_label == Label.MATCH)

    @property
    def precision(self) -> float:
        """Strokes that answer a note, of all that were played."""
        right = int(self.answered.sum())
        besides = self.alignment.count(Label.EXTRA) + self.alignment.count(Label.WRONG_PIECE)
        return right / (right + besides) if right else 0.0


def marks_of(rubric: Rubric, take: ExamTake) -> Marks:
    """The marks of a take."""
    measure = {
        Criterion.NOTES: _notes,
        Criterion.TIME: lambda take: _time(rubric, take),
        Criterion.FLOW: _flow,
        Criterion.LOUDNESS: _loudness,
    }
    found = ((line, *measure[line.criterion](take)) for line in rubric.lines)
    return Marks(tuple(Mark(line, share * take.precision, words) for line, share, words in found))


def _notes(take: ExamTake) -> tuple[float, str]:
    """Notes played of those written."""
    right, notes = int(take.answered.sum()), len(take.score)
    wrong, besides = (take.alignment.count(label) for label in (Label.WRONG_PIECE, Label.EXTRA))
    words = f"{right} of {notes} played"
    words += f", {wrong} on a wrong piece" if wrong else ""
    words += f", {counted(besides, 'stroke')} besides" if besides else ""
    return right / max(notes, 1), words


def _time(rubric: Rubric, take: ExamTake) -> tuple[float, str]:
    """The mean credit of all notes by the level's windows; a grace stroke's spacing is the hand's choice."""
    timed = take.answered & ~take.score.is_grace
    if not timed.any():
        return 0.0, "nothing to measure"
    off_ms = asynchrony_ms(take.alignment) - free_ms(take.score, take.alignment, take.feel)
    off_ms = np.where(timed, off_ms, 0.0)
    credit = np.where(take.answered, rubric.level.windows.credit(off_ms), 0.0)
    inner = rubric.level.windows.edges_ms[0]
    inside = int((np.abs(off_ms[timed]) <= inner).sum())
    return float(credit.mean()), f"{inside} of {int(timed.sum())} within {inner:g} ms"


def _flow(take: ExamTake) -> tuple[float, str]:
    """Bars of which enough was played, of those that have notes."""
    notes, played = np.bincount(take.bars), np.bincount(take.bars, weights=take.answered)
    written = int((notes > 0).sum())
    kept = int((played >= np.maximum(KEPT_SHARE * notes, 1)).sum())
    return kept / max(written, 1), f"{kept} of {counted(written, 'bar')} played on"


def _loudness(take: ExamTake) -> tuple[float, str]:
    """The mean credit of the notes whose loudness the music asks for."""
    asked = judged_notes(take.score)
    off_db = dynamics(take.score, take.performance, take.alignment).off_db
    credit = np.where(take.answered, dynamic_credit(off_db), 0.0)[asked]
    heard = np.abs(off_db[asked & take.answered])
    words = f"{heard.mean():.1f} dB from what is written on average" if len(heard) else "nothing to measure"
    return float(credit.mean()), words
