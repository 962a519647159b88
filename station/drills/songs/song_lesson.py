"""A song as a lesson: the part's strokes in the band's time, so that all that is done with a lesson is done with it.

The score is the part as its file has it, bar by bar: it is not transcribed, for bars that are left out or times that
are smoothed would no longer be the band's. What a part of one of our lessons says besides (goals, hints, swing) holds.
"""

from dataclasses import replace
from pathlib import Path

from station.core.errors import BadInput
from station.drills.band_sound import BandSound
from station.drills.lesson import Lesson, Section
from station.drills.reading.lesson_file import read_lesson
from station.drills.songs.song import Song, band_time
from station.drills.songs.song_file import read_song
from station.drills.songs.song_folder import sounds_beside
from station.drills.transcription.lesson_level import level_of
from station.drills.transcription.refused_parts import refuse_beyond_lessons
from station.music.drum_part import PartSection
from station.music.formats.format_table import is_music_file, read_part
from station.music.formats.text_score import TEXT_ENDING

_TAGS = ("song",)


def read_song_lesson(path: Path) -> Lesson:
    """The lesson of the song in the file at `path`; raises `BadInput` for a fault of it or of its part."""
    song = read_song(path)
    return song_lesson(song, read_written(song.part))


def read_written(part: Path) -> Lesson:
    """The part in a music file or a lesson file as it is written, without a band; raises `BadInput`."""
    if not is_music_file(part.name) or part.suffix.lower() == TEXT_ENDING:
        return replace(read_lesson(part), text="")
    found = read_part(part)
    refuse_beyond_lessons(found, str(part))
    plain = Lesson(
        part.stem,
        found.score.title or part.stem,
        found.score,
        author=found.author,
        about=found.about,
        tags=_TAGS,
        swing=found.swing,
        beat_ticks=found.beat_ticks,
        loop=(0, found.score.bar_count - 1),
        sections=_sections(found.sections, found.score.bar_count),
    )
    return replace(plain, level=level_of(plain))


def sounds_of(song: Song) -> tuple[tuple[Path, ...], tuple[Path, ...]]:
    """The sound of all others and of the drums: that which the song names, or what lies beside its chart.

    Raises `BadInput` where there is neither.
    """
    others, drums = (song.others, song.drums) if song.others or song.drums else sounds_beside(song.part)
    if not others and not drums:
        raise BadInput(song.source, "sound", 'is missing; expected sound = "our-song.ogg"')
    return others, drums


def song_lesson(song: Song, written: Lesson) -> Lesson:
    """The lesson of `song` with the part `written`: the band's tempo, its sections, its sound.

    It is played once and not demonstrated, unless only some bars are asked for (`Lesson.passes_of`). Raises `BadInput`.
    """
    tempo_map, start_s = band_time(song, written.score)
    others, drums = sounds_of(song)
    last = written.score.bar_count - 1
    named = _song_sections(song, last)
    return replace(
        written,
        name=song.name,
        title=song.title,
        author=song.author or written.author,
        about=song.about or written.about,
        score=replace(written.score, tempo_map=tempo_map),
        loop=(0, last),
        passes=1,
        demonstrations=0,
        landing=written.landing_after(last),
        sections=_sections(named, last + 1) if named else written.sections,
        band=BandSound(others, start_s, drums),
        mean_bpm=round(written.score.length_beats * 60e9 / int(tempo_map.ns_at(written.score.end_tick)), 1),
    )


def _song_sections(song: Song, last: int) -> tuple[PartSection, ...]:
    """The sections that the song's own file names, by bars from 0; raises `BadInput` for bars that are not there."""
    for one in song.sections:
        if one.bar > last + 1:
            raise BadInput(song.source, f"section {one.name}", f"begins in bar {one.bar}; the part has {last + 1}")
    ends = [*(one.bar - 2 for one in song.sections[1:]), last]
    return tuple(PartSection(one.name, one.bar - 1, end) for one, end in zip(song.sections, ends, strict=False))


def _sections(named: tuple[PartSection, ...], bars: int) -> tuple[Section, ...]:
    """Sections that cover all bars in order; those between the named ones have no name."""
    found, at = [], 0
    for one in sorted(named, key=lambda part: part.first_bar):
        if one.first_bar > at:
            found.append(Section("", at, one.first_bar - 1))
        if at <= one.last_bar and one.first_bar < bars:
            found.append(Section(one.name, max(at, one.first_bar), min(one.last_bar, bars - 1)))
            at = found[-1].last_bar + 1
    return (*found, Section("", at, bars - 1)) if at < bars else tuple(found)
