"""A song brought together with its sound: onsets found, the band followed through its points, every quarter timed.

Seconds of work and strangers' files: the window does it in a process of its own.
"""

from dataclasses import dataclass, replace
from pathlib import Path

from station.app.music_files.named_parts import song_file
from station.core.errors import BadInput
from station.drills.lesson import Lesson
from station.drills.songs.band_tempo import SHOWN_RESIDUAL_MS, BandTempo
from station.drills.songs.song import Song, SongPoint, band_time, follow_points, quarter_ticks, tick_of
from station.drills.songs.song_file import read_song
from station.drills.songs.song_folder import sounds_beside
from station.drills.songs.song_lesson import read_written, song_lesson, sounds_of
from station.music.score import Score


@dataclass(frozen=True, slots=True)
class PointOff:
    """A point as it was set, and by how many ms the band's curve comes later than it; earlier where negative."""

    point: SongPoint
    residual_ms: float

    @property
    def is_off(self) -> bool:
        """Whether a listener hears it beside the drums."""
        return abs(self.residual_ms) > SHOWN_RESIDUAL_MS


@dataclass(frozen=True, eq=False)
class SyncedSong:
    """A song whose quarters have their times, and how far each of its points is off; `tempo` says the rest."""

    song: Song
    tempo: BandTempo
    points: tuple[PointOff, ...]

    @property
    def confidence(self) -> float:
        """The share of the song, 0 … 1, that the sound itself bears out."""
        return float(self.tempo.confidence.mean()) if len(self.tempo.confidence) else 0.0


def new_song(source: Path, part: str, sound: tuple[str, ...], drums: tuple[str, ...] = (), title: str = "") -> Song:
    """The song that will stand at `source`; `part` may be a song's folder of Clone Hero, which brings its own sound.

    Raises `BadInput` for a part or a sound that cannot be read, or where there is none.
    """
    path = song_file(part) or Path(part)
    others, own_drums = tuple(map(Path, sound)), tuple(map(Path, drums))
    if not others and not own_drums:
        others, own_drums = sounds_beside(path)
    if not others and not own_drums:
        raise BadInput(part, "sound", "no sound beside it; name the file with --sound")
    _check_sound(*others, *own_drums)
    written = read_written(path).title
    own_title = source.stem if written == path.stem else written
    return Song(source, title or own_title, path, others, own_drums)


def onset_sound(song: Song) -> Path:
    """The file whose onsets tell most of the part: a stem of the drums, else the mix.

    Raises `BadInput` where the song has no sound.
    """
    others, drums = sounds_of(song)
    return (drums or others)[0]


def synced(song: Song, by_sound: bool = True) -> SyncedSong:
    """The song with the times of all quarters, by its points and, where wanted, by its sound's onsets.

    Two points at least. Raises `BadInput`.
    """
    return synced_score(song, read_written(song.part).score, by_sound)


def synced_score(song: Song, score: Score, by_sound: bool = True) -> SyncedSong:
    """The same where the part's `score` is known."""
    from station.sound.songs.song_onsets import song_onsets  # with libraries of sound, which no window loads

    tempo = follow_points(song, score, song_onsets(onset_sound(song)) if by_sound else None)
    times_s = tuple(round(tempo.seconds_at(tick), 4) for tick in quarter_ticks(score))
    timed = replace(song, quarters_s=times_s)
    return SyncedSong(timed, tempo, points_off(timed, score))


def points_off(song: Song, score: Score) -> tuple[PointOff, ...]:
    """How far each point is off the times that the song has, in the song's order."""
    tempo_map, start_s = band_time(song, score)
    ticks = [tick_of(score, point, song.source) for point in song.points]
    curve_s = (start_s + tempo_map.seconds_at(ticks)).tolist()
    return tuple(PointOff(point, 1e3 * (at_s - point.at_s)) for point, at_s in zip(song.points, curve_s, strict=True))


def checked_song(path: Path) -> tuple[Lesson, tuple[PointOff, ...]]:
    """The song in the file at `path` as it is practised, and how far its points are off.

    Raises `BadInput` for any fault of it, of its part, or of the heads of its sound files.
    """
    song = read_song(path)
    written = read_written(song.part)
    lesson = song_lesson(song, written)
    assert lesson.band is not None
    _check_sound(*lesson.band.files(with_drums=True))
    return lesson, points_off(song, written.score) if len(song.points) > 1 else ()


def _check_sound(*files: Path) -> None:
    """Raise `BadInput` for the first that is no sound file by its head."""
    from station.sound.track_file import file_length_s

    for file in files:
        file_length_s(file)
