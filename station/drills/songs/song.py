"""A song to practise: a drum part, the sound of the band, and where in that sound each beat of the part lies.

Bars and beats count from 1, as in the file and on the screen; seconds are those of the sound file at its own speed. A
beat of a point is one of the meter's unit, an eighth in 6/8; times are kept for every quarter note.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.songs.band_following import follow_band
from station.drills.songs.band_tempo import BandPoint, BandTempo, tempo_map_of
from station.music.score import Score
from station.music.sound_onsets import SoundOnsets
from station.music.tempo import MAX_BPM, MIN_BPM, TempoMap


@dataclass(frozen=True, slots=True)
class SongPoint:
    """The band plays `beat` of `bar`, both from 1, at `at_s`; `beat` may lie between two, as 2.5 does."""

    bar: int
    beat: float
    at_s: float


@dataclass(frozen=True, slots=True)
class SongSection:
    """From `bar`, from 1, up to the next section the song is called `name`."""

    name: str
    bar: int


@dataclass(frozen=True, slots=True)
class Song:
    """A song; `source` is the file that it stands in, for errors.

    `part` is a music file or a lesson, `others` and `drums` the sound (`band_sound.BandSound`). `quarters_s` has a
    time for every quarter note of the part from its start and for its end; it is empty where nobody has synchronised
    it. `sections` are empty
    where the part's own hold.
    """

    source: Path
    title: str
    part: Path
    others: tuple[Path, ...] = ()
    drums: tuple[Path, ...] = ()
    points: tuple[SongPoint, ...] = ()
    quarters_s: tuple[float, ...] = ()
    sections: tuple[SongSection, ...] = ()
    author: str = ""
    about: str = ""

    @property
    def name(self) -> str:
        """What its lesson is called: the file's stem."""
        return self.source.stem


def quarter_ticks(score: Score) -> tuple[int, ...]:
    """The ticks of all quarter notes of the part and of its end, in order."""
    return (*range(0, score.end_tick, PPQ), score.end_tick)


def tick_of(score: Score, point: SongPoint, source: Path) -> int:
    """The tick of a point; raises `BadInput` of `source` where the part has no such beat."""
    place = f"point {point.bar}.{point.beat:g}"
    if not 1 <= point.bar <= score.bar_count:
        raise BadInput(source, place, f"the part has bars 1 to {score.bar_count}")
    start = score.tempo_map.bar_start(point.bar - 1)
    tick = start + round((point.beat - 1) * score.tempo_map.meter_at(start).beat_ticks)
    if not start <= tick < min(score.tempo_map.bar_start(point.bar), score.end_tick):
        raise BadInput(source, place, f"bar {point.bar} is in {score.tempo_map.meter_at(start)}")
    return tick


def band_points(song: Song, score: Score) -> tuple[BandPoint, ...]:
    """The points by their ticks, in order; raises `BadInput` for what is no beat of the part."""
    points = [BandPoint(tick_of(score, one, song.source), one.at_s) for one in song.points]
    return tuple(sorted(points, key=lambda point: (point.tick, point.at_s)))


def band_time(song: Song, score: Score) -> tuple[TempoMap, float]:
    """The part's tempo map as the band plays it, and the second of the sound at which its tick 0 lies.

    By `quarters_s`; without these by the points alone (`follow_band`); with one point at the written tempo, with none
    as if the sound began with the part (a chart of Clone Hero is written so). Raises `BadInput` for times that are not
    the part's, and for tempi that nobody plays.
    """
    ticks = quarter_ticks(score)
    if song.quarters_s and len(song.quarters_s) != len(ticks):
        counted = f"{len(song.quarters_s)} times for the {len(ticks) - 1} quarters of the part and its end"
        raise BadInput(song.source, "quarters_s", f"{counted}; synchronise it again")
    times_s = song.quarters_s or _times_by_points(song, score, ticks)
    _check_tempi(song, ticks, times_s)
    return tempo_map_of(score.tempo_map, ticks, times_s)


def _times_by_points(song: Song, score: Score, ticks: tuple[int, ...]) -> tuple[float, ...]:
    """The seconds of all `ticks`."""
    points = band_points(song, score)
    if len(points) >= 2:
        followed = follow_points(song, score, None)
        return tuple(map(followed.seconds_at, ticks))
    written_s = score.tempo_map.seconds_at(ticks)
    moved_s = points[0].at_s - float(score.tempo_map.seconds_at(points[0].tick)) if points else 0.0
    return tuple((written_s + moved_s).tolist())


def follow_points(song: Song, score: Score, onsets: SoundOnsets | None) -> BandTempo:
    """Where the band is by the song's points and the `onsets` of its sound; raises `BadInput` of the song's file."""
    try:
        return follow_band(score, band_points(song, score), onsets)
    except BadInput as fault:
        raise BadInput(song.source, fault.place, fault.fault) from None


def _check_tempi(song: Song, ticks: tuple[int, ...], times_s: tuple[float, ...]) -> None:
    for index, ((tick, end_tick), (at_s, end_s)) in enumerate(zip(pairwise(ticks), pairwise(times_s), strict=True)):
        tempo_bpm = (end_tick - tick) / PPQ * 60.0 / (end_s - at_s) if end_s > at_s else np.inf
        if not MIN_BPM <= tempo_bpm <= MAX_BPM:
            place = f"quarters_s, entry {index + 1}" if song.quarters_s else "point"
            limits = f"{MIN_BPM:g} to {MAX_BPM:g} beats a minute"
            raise BadInput(song.source, place, f"from {at_s:g} to {end_s:g} s is no beat; expected {limits}")
