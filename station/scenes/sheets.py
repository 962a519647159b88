"""Bars of a lesson or of another score as a sheet on paper."""

from collections.abc import Iterable, Iterator, Mapping

from station.drills.lesson import Lesson, Section, tidy_bpm
from station.music.drum_part import DrumPart, PartSection
from station.music.score import Score
from station.music.swing import STRAIGHT, Swing
from station.render.files.pdf_file import pdf
from station.render.notation.sheet import PAPERS, SheetWords, sheet
from station.render.notation.swing_words import swing_words

Bars = tuple[int, int]
"""First and last bar, from 0."""


def lesson_labels(lesson: Lesson, bars: Bars) -> SheetWords:
    """What stands on the sheet of a lesson's bars; where they hold its loop, that is repeated."""
    first, last = bars
    beats = tidy_bpm(lesson.played_once.bars(*bars).tempo_map.tempos[0].us_per_quarter, lesson.beat_ticks)
    loop = (lesson.loop[0] - first, lesson.loop[1] - first)
    feels = _feels(lesson, bars)
    return SheetWords(
        title=lesson.title,
        author=lesson.author,
        beats_a_minute=round(beats, 1),
        beat_ticks=lesson.beat_ticks,
        about=" ".join(lesson.about.split()),
        sections=tuple(_sections(lesson.sections, bars, dict(feels))),
        feels=feels,
        repeat=loop if first <= lesson.loop[0] and lesson.loop[1] <= last else None,
        first_bar=first + 1,
    )


def _sections(
    sections: Iterable[Section | PartSection], bars: Bars, feels: Mapping[int, str]
) -> Iterator[tuple[int, str]]:
    """Where sections begin, by the sheet's bars, with their names; one that is called after its feel has none."""
    first, last = bars
    for section in sections:
        bar = section.first_bar - first
        if section.name and bar in range(last - first + 1) and not feels.get(bar, "").startswith(section.name):
            yield bar, section.name


def _feels(lesson: Lesson, bars: Bars) -> tuple[tuple[int, str], ...]:
    """The feel of a lesson's bars where it is another one than before, by the sheet's bars; straight at first."""
    found, before = [], _feel(Swing())
    for bar in range(bars[0], bars[1] + 1):
        if (feel := _feel(lesson.swing_of_bar(bar))) != before:
            found.append((bar - bars[0], feel))
            before = feel
    return tuple(found)


def _feel(swing: Swing) -> str:
    return "straight" if swing.ratio == STRAIGHT else f"swing {swing.ratio:.3g} : 1"


def part_labels(part: DrumPart, bars: Bars, *, name: str) -> SheetWords:
    """What stands on the sheet of another part, called by its own title, else `name`."""
    score = part.score.bars(*bars)
    beats = round(tidy_bpm(score.tempo_map.tempos[0].us_per_quarter, part.beat_ticks), 1)
    is_swung = part.swing.ratio != STRAIGHT
    return SheetWords(
        title=score.title or name,
        author=part.author,
        beats_a_minute=beats,
        beat_ticks=part.beat_ticks,
        about=" ".join(part.about.split()),
        sections=tuple(_sections(part.sections, bars, {})),
        feels=((0, _feel(part.swing)),) if is_swung else tuple(swing_words(score).items()),
        first_bar=bars[0] + 1,
    )


def pdf_of(score: Score, bars: Bars, words: SheetWords, paper: str, with_sticking: bool = True) -> bytes:
    """The sheet as a PDF file on `paper`, one of `PAPERS`."""
    size = PAPERS[paper]
    return pdf(sheet(score.bars(*bars), words, size, with_sticking), size, words.title, words.author)
