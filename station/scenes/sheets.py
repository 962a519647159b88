"""Bars of a lesson or of another score as a sheet on paper."""

from dataclasses import replace

from station.core.errors import BadInput
from station.drills.lesson import Lesson, tidy_bpm
from station.drills.transcription.grid_times import quantised_times
from station.music.drum_part import DrumPart
from station.music.score import Score
from station.music.swing import triplets_spelled_out
from station.render.files.pdf_file import pdf
from station.render.notation.sheet import PAPERS, SheetWords, sheet
from station.scenes.section_names import section_names

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
        sections=section_names(lesson.sections, first, last - first + 1),
        repeat=loop if first <= lesson.loop[0] and lesson.loop[1] <= last else None,
        first_bar=first + 1,
    )


def part_labels(part: DrumPart, bars: Bars, *, name: str) -> SheetWords:
    """What stands on the sheet of another part, called by its own title, else `name`."""
    score = part.score.bars(*bars)
    beats = round(tidy_bpm(score.tempo_map.tempos[0].us_per_quarter, part.beat_ticks), 1)
    return SheetWords(
        title=score.title or name,
        author=part.author,
        beats_a_minute=beats,
        beat_ticks=part.beat_ticks,
        about=" ".join(part.about.split()),
        sections=section_names(part.sections, bars[0], bars[1] - bars[0] + 1),
        first_bar=bars[0] + 1,
    )


def on_grid(part: DrumPart) -> DrumPart:
    """A part as a sheet writes it: what was played or swings on cells of the beat, under a mark.

    A part that says itself how it swings stays, and one with bars that no meter can name.
    """
    if not len(part.score) or part.score.notes["swing_ticks"].any():
        return part
    try:
        found = quantised_times(part.score, part.is_played).score
    except BadInput:
        return part
    return replace(part, score=triplets_spelled_out(found))


def pdf_of(score: Score, bars: Bars, words: SheetWords, paper: str, with_sticking: bool = True) -> bytes:
    """The sheet as a PDF file on `paper`, one of `PAPERS`."""
    size = PAPERS[paper]
    return pdf(sheet(score.bars(*bars), words, size, with_sticking), size, words.title, words.author)
