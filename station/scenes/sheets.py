"""Bars of a lesson or of another score as a sheet on paper."""

from dataclasses import replace

import numpy as np

from station.core.errors import BadInput
from station.core.pieces import Dynamic, Limb, Ornament
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.transcription.timing.grid_times import quantised_times
from station.drills.transcription.transcribe import transcribe
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.score import Score
from station.music.swing import triplets_spelled_out
from station.render.files.pdf_file import pdf
from station.render.notation.page.sheet import PAPERS, SheetWords, sheet
from station.scenes.score_words import section_names

Bars = tuple[int, int]
"""First and last bar, from 0."""


def lesson_labels(lesson: Lesson, bars: Bars) -> SheetWords:
    """What stands on the sheet of a lesson's bars; where they hold its loop, that is repeated."""
    first, last = bars
    first_bpm = lesson.played_once.bars(*bars).tempo_map.tempos[0].short_bpm(lesson.beat_ticks / PPQ)
    beats = first_bpm if lesson.band is None else round(lesson.beats_a_minute)
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
    beats = round(score.tempo_map.tempos[0].short_bpm(part.beat_ticks / PPQ), 1)
    return SheetWords(
        title=score.title or name,
        author=part.author,
        beats_a_minute=beats,
        beat_ticks=part.beat_ticks,
        about=" ".join(part.about.split()),
        sections=section_names(part.sections, bars[0], bars[1] - bars[0] + 1),
        first_bar=bars[0] + 1,
    )


def written_down(part: DrumPart) -> DrumPart:
    """A part as a sheet writes it: one that was played as an import writes it, others on cells of the beat.

    Played is also what tells strokes apart by velocities alone. Letters stand only where the part has hands; what is
    beyond two hands and two feet is small.
    """
    if not len(part.score) or not (part.is_played or _is_heard(part.score)):
        return on_grid(part)
    try:
        lesson = transcribe(part, part.score.title or "take").lesson
    except BadInput:
        return on_grid(part)
    found = replace(part_of(lesson), score=lesson.played_once)
    is_silent = (part.score.notes["limb"] == Limb.UNKNOWN).all()
    limbs = np.full_like(found.score.notes["limb"], Limb.UNKNOWN) if is_silent else found.score.notes["limb"]
    score = replace(triplets_spelled_out(found.score.with_limbs(limbs)), title=part.score.title)
    return replace(found, score=score, about=part.about)


def _is_heard(score: Score) -> bool:
    """Whether no word says how loud a stroke is, or how ornamented, and velocities do."""
    notes = score.notes
    is_plain = (notes["dynamic"] == Dynamic.NORMAL).all() and (notes["ornament"] == Ornament.NONE).all()
    return bool(is_plain and np.ptp(notes["velocity"]) > 0)


def on_grid(part: DrumPart) -> DrumPart:
    """A part whose strokes lie on cells of the beat, swing under a mark.

    A part that says itself how it swings stays, and one with bars that no meter can name.
    """
    if not len(part.score) or part.score.notes["swing_ticks"].any():
        return part
    try:
        found = quantised_times(part.score, part.is_played)
    except BadInput:
        return part
    return replace(part, score=triplets_spelled_out(found.score))


def pdf_of(score: Score, bars: Bars, words: SheetWords, paper: str, with_sticking: bool = True) -> bytes:
    """The sheet as a PDF file on `paper`, one of `PAPERS`."""
    size = PAPERS[paper]
    return pdf(sheet(score.bars(*bars), words, size, with_sticking), size, words.title, words.author)
