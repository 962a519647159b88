"""Bars of a lesson or of another score as a sheet on paper."""

from collections.abc import Iterator

from station.core.units import PPQ
from station.drills.lesson import Lesson, tidy_bpm
from station.music.score import Score
from station.render.files.pdf_file import pdf
from station.render.notation.sheet import PAPERS, SheetWords, sheet

Bars = tuple[int, int]
"""First and last bar, from 0."""


def lesson_labels(lesson: Lesson, bars: Bars) -> SheetWords:
    """What stands on the sheet of a lesson's bars; where they hold its loop, that is repeated."""
    first, last = bars
    beats = tidy_bpm(lesson.played_once.bars(*bars).tempo_map.tempos[0].us_per_quarter, lesson.beat_ticks)
    loop = (lesson.loop[0] - first, lesson.loop[1] - first)
    return SheetWords(
        title=lesson.title,
        author=lesson.author,
        beats_a_minute=round(beats, 1),
        beat_ticks=lesson.beat_ticks,
        about=" ".join(lesson.about.split()),
        sections=tuple(_sections(lesson, bars)),
        repeat=loop if first <= lesson.loop[0] and lesson.loop[1] <= last else None,
        first_bar=first + 1,
    )


def _sections(lesson: Lesson, bars: Bars) -> Iterator[tuple[int, str]]:
    """Where sections that have a name begin, by the sheet's bars."""
    first, last = bars
    for section in lesson.sections:
        if first <= section.first_bar <= last and section.name:
            yield section.first_bar - first, section.name


def score_labels(score: Score, bars: Bars, name: str) -> SheetWords:
    """What stands on the sheet of another score, called by its own title, else `name`."""
    tempo = score.bars(*bars).tempo_map.tempos[0]
    beats = round(tidy_bpm(tempo.us_per_quarter, PPQ), 1)
    return SheetWords(title=score.title or name, beats_a_minute=beats, first_bar=bars[0] + 1)


def pdf_of(score: Score, bars: Bars, words: SheetWords, paper: str, with_sticking: bool = True) -> bytes:
    """The sheet as a PDF file on `paper`, one of `PAPERS`."""
    size = PAPERS[paper]
    return pdf(sheet(score.bars(*bars), words, size, with_sticking), size, words.title, words.author)
