"""From a drum part to the lesson that a teacher would have written of it: the one door for imports and takes.

First what belongs to the hand and not to the beat (flams, drags, buzzes), then the times (`grid_times`), the dynamics,
what is beyond one player, diddles, and last the page: sections, repeats, level.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import ceil
from statistics import median

from station.core.errors import BadInput
from station.core.units import NS_PER_S, PPQ
from station.drills.difficulty import difficulty
from station.drills.grid.grid_timing import MAX_BEATS, UNITS
from station.drills.grid.line_group import MAX_BARS
from station.drills.grid.lines_from_score import graces_of
from station.drills.grid.stroke_settings import Velocities
from station.drills.lesson import Lesson
from station.drills.transcription.form_finder import found_form
from station.drills.transcription.import_remarks import remarks_on
from station.drills.transcription.sticking_proposal import with_sticking
from station.drills.transcription.strokes.diddle_finder import with_diddles
from station.drills.transcription.strokes.letters import as_letter, unified
from station.drills.transcription.strokes.loudness_levels import with_dynamics
from station.drills.transcription.strokes.ornament_finder import FoundOrnaments, found_ornaments
from station.drills.transcription.strokes.playable_strokes import within_reach
from station.drills.transcription.strokes.ringing import with_lengths
from station.drills.transcription.strokes.steady_dynamics import steady_dynamics
from station.drills.transcription.timing.grid_times import GridTimes, quantised_times
from station.drills.transcription.timing.meter_finder import with_heard_meter
from station.drills.transcription.timing.stated_swing import readable, stated_times
from station.drills.transcription.timing.tempo_steps import steady
from station.drills.writing.lesson_writer import as_written
from station.music.drum_part import DrumPart, PartSection
from station.music.grace_strokes import with_graces
from station.music.score import Note, Score
from station.music.swing import STRAIGHT
from station.music.tempo import MAX_BPM, MIN_BPM, TempoMap

_LEVELS_FROM = (13.0, 18.5, 23.7, 27.9)
"""From which difficulty on a lesson is of level 2, 3, 4, 5: half way between the medians of the lessons that ship, at
the tempo to reach, which are 10.0, 16.0, 21.0, 26.4 and 29.4."""
_LEVEL_BARS = 2
"""Bars of the middle lesson that ships, of every level but the first. Longer runs of bars have more to know."""
_MOST_MEASURED = 50
"""Pairs of bars that tell the level of a piece, spread over it (our choice; a second at most)."""
MOST_STROKES = 12_000
"""Our choice: 20 minutes of ten a second, which take some seconds to read; the longest lesson that ships has 230."""
_MOST_CHARACTERS = 2000
"""Of a title, a name or what a file says of itself (our choice: a page)."""
_ABOUT = 1.01
"""A tempo of a file so little beyond a lesson's may be one that was rounded (our choice)."""
_TAGS = ("import",)


@dataclass(frozen=True, slots=True)
class Transcribed:
    """The `lesson`, read from the text that was written of it, and `remarks` on what was done, each a sentence."""

    lesson: Lesson
    remarks: tuple[str, ...]


def transcribe(part: DrumPart, name: str, source: str = "") -> Transcribed:
    """The lesson called `name` that `part` is; `source` is the file that errors name, `name` if it is empty.

    Raises `BadInput` of `source` for a part without strokes, or of more than a lesson may have.
    """
    try:
        return _transcribed(part, name)
    except BadInput as found:
        raise BadInput(source or name, found.place, found.fault) from None


def _transcribed(part: DrumPart, name: str) -> Transcribed:
    if not len(part.score):
        raise BadInput(name, "", "there is no drum note in it")
    if len(part.score) > MOST_STROKES:
        raise BadInput(name, "", f"{len(part.score):,} strokes; at most {MOST_STROKES:,} become a lesson")
    if part.score.bar_count > MAX_BARS:
        raise BadInput(name, "", f"{part.score.bar_count} bars; a lesson has at most {MAX_BARS}")
    if part.is_meter_said:
        _refuse_meters(part.score, name)
    _refuse_tempo(part.score, name)
    ornaments = found_ornaments(part.score, graces_of(part.score) if part.score.is_grace.any() else None)
    mains, empty_bars = _from_its_first_bar(part.score, ornaments)
    part = replace(part, sections=_earlier(part.sections, empty_bars), swing=readable(part.swing))
    is_stated = part.swing.stands_in_words and bool(mains.notes["swing_ticks"].any())
    times = stated_times(mains, part.swing) if is_stated else _heard_times(mains, part)
    whole = times
    if times.spread_ms:  # of a take, the bars that were played
        part = replace(part, sections=_earlier(part.sections, int(times.score.bar[0])))
        times = times.bars(int(times.score.bar[0]), int(times.score.bar[-1]))
    score = replace(times.score, tempo_map=steady(times.score.tempo_map, times.score.bar_count))
    strokes, velocities = with_dynamics([as_letter(note) for note in score])
    heard = strokes
    if times.spread_ms:
        strokes = steady_dynamics(strokes, score.notes["velocity"].tolist(), velocities, score.tempo_map)
    steadied = sum(a.dynamic is not b.dynamic for a, b in zip(heard, strokes, strict=True))
    strokes = unified(strokes) if times.spread_ms else strokes
    strokes = [_written(note, velocities) for note in strokes]
    reach = within_reach(strokes, ornaments.graces, score.tempo_map, score.end_tick)
    notes = with_diddles(with_lengths(reach, _ends(score, part), times), reach.beyond, score.tempo_map, velocities)
    rows = [row for note in notes for row in with_graces(note, ornaments.graces)]
    beyond = [replace(note, velocity=velocities.of(note.piece, note.dynamic)) for note in reach.beyond]
    lesson = Lesson(
        name,
        _printable(part.score.title) or name,
        Score.from_notes(rows, score.tempo_map, score.end_tick, beyond=beyond),
        author=_printable(part.author),
        about=_printable(part.about),
        tags=_TAGS,
        loop=(0, score.bar_count - 1),
        swing=part.swing if times.swing.ratio == STRAIGHT and not times.spread_ms else times.swing,
        beat_ticks=replace(part, score=score).beat_ticks,
        velocities=velocities,
    )
    form = found_form(lesson, part.sections)
    read = as_written(with_sticking(replace(lesson, level=_level(lesson)), form), form)
    return Transcribed(read, tuple(remarks_on(ornaments, whole, mains, reach, read, steadied)))


def _refuse_meters(score: Score, name: str) -> None:
    """Raise `BadInput` for the first bar played whose meter no lesson has: long bars would take long to be tried."""
    for bar in range(int(score.bar[0]), int(score.bar[-1]) + 1):
        meter = score.tempo_map.meter_at(score.tempo_map.bar_start(bar))
        if meter.beats > MAX_BEATS or meter.unit not in UNITS:
            expected = f"a lesson has 1 to {MAX_BEATS} beats of 1/{UNITS[0]} to 1/{UNITS[-1]}"
            raise BadInput(name, f"bar {bar + 1}", f"a meter of {meter}; {expected}")


def _refuse_tempo(score: Score, name: str) -> None:
    """Raise `BadInput` where its mean tempo is none of a lesson: all strokes at once would take long to be sorted."""
    mean_bpm = score.end_tick / PPQ * 60 * NS_PER_S / max(score.length_ns, 1)
    if not MIN_BPM / _ABOUT <= mean_bpm <= MAX_BPM * _ABOUT:
        expected = f"a lesson has {MIN_BPM:g} to {MAX_BPM:g}"
        raise BadInput(name, "", f"{mean_bpm:.4g} quarter notes a minute from end to end; {expected}")


def _heard_times(mains: Score, part: DrumPart) -> GridTimes:
    """The main strokes on the grid, under the meter that is heard where the file says none."""
    times = quantised_times(mains, part.is_played)
    heard = times.score if part.is_meter_said else with_heard_meter(times.score)
    if heard is times.score:
        return times
    tempo_map = TempoMap.build(mains.tempo_map.tempos, heard.tempo_map.meters)
    return quantised_times(Score.from_array(mains.notes, tempo_map, None, mains.title, mains.loudness), part.is_played)


def _from_its_first_bar(score: Score, ornaments: FoundOrnaments) -> tuple[Score, int]:
    """The main strokes as a score, and how many bars it begins later: those that only a grace stroke was in.

    A program that writes a flam on the first beat needs a bar before it.
    """
    mains = Score.from_notes(ornaments.mains, score.tempo_map, score.end_tick, score.title)
    mains = replace(mains, loudness=score.loudness)
    first = int(mains.bar[0]) if score.bar[0] < mains.bar[0] else 0
    return (mains.bars(first, mains.bar_count - 1), first) if first else (mains, 0)


def _earlier(sections: Sequence[PartSection], bars: int) -> tuple[PartSection, ...]:
    """The sections so many bars earlier."""
    moved = (PartSection(s.name, max(s.first_bar - bars, 0), s.last_bar - bars) for s in sections)
    return tuple(s for s in moved if s.last_bar >= 0)


def _level(lesson: Lesson) -> int:
    """How hard it is, 1–5: as hard as the middle one of its pairs of bars, for lessons that ship have two bars."""
    last = lesson.score.bar_count - 1
    step = _LEVEL_BARS * ceil((last + 1) / (_LEVEL_BARS * _MOST_MEASURED))
    parts = [replace(lesson, loop=(bar, min(bar + _LEVEL_BARS - 1, last))) for bar in range(0, last + 1, step)]
    middle = median([difficulty(each).total for each in parts if len(each.loop_score)] or [0.0])
    return 1 + sum(middle >= least for least in _LEVELS_FROM)


def _written(note: Note, velocities: Velocities) -> Note:
    """The stroke as its letter plays it, which may know no such dynamic."""
    lettered = as_letter(note)
    return replace(lettered, velocity=velocities.of(note.piece, lettered.dynamic))


def _printable(text: str) -> str:
    """Of words that another program may have written, what can be printed, in one line of no more than a page."""
    return " ".join("".join(c if c.isprintable() else " " for c in text[:_MOST_CHARACTERS]).split())


def _ends(score: Score, part: DrumPart) -> list[int]:
    """Where a roll must have ended: where the tempo or meter changes, or a section begins, and at the end."""
    bars = {s.first_bar for s in part.sections} | {s.last_bar + 1 for s in part.sections}
    changes = {t.tick for t in score.tempo_map.tempos} | {m.tick for m in score.tempo_map.meters}
    ticks = changes | {score.tempo_map.bar_start(bar) for bar in bars}
    return sorted({tick for tick in ticks if 0 < tick < score.end_tick} | {score.end_tick})
