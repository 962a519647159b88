"""`station song new | sync | check`: a drum part and a band's sound made into a song to practise."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from station.cli.console import say, write
from station.cli.options.option_fields import Command, Verbs, argument, arguments, flag, option, repeated, required
from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.drills.songs.band_tempo import SHOWN_RESIDUAL_MS
from station.drills.songs.song import Song, SongPoint
from station.drills.songs.song_file import SONG_ENDING, read_song, song_text

if TYPE_CHECKING:
    from station.app.songs.song_sync import PointOff
    from station.drills.lesson import Lesson

_POINT_FORM = "--point BAR.BEAT=SECONDS"
_POINT_HELP = "the band plays this beat at that second of the sound, such as 1.1=0.512; two at least, about five for a "


@dataclass(frozen=True, slots=True, kw_only=True)
class NewSongOptions:
    """What is brought together, and where it goes."""

    part: str = required(
        "FILE", "the drum part: any music file, a lesson, or a song's folder of Clone Hero or YARG", str
    )
    sound: tuple[str, ...] = repeated(
        "--sound FILE", "the band's sound; once for each stem (what lies beside a chart of Clone Hero)"
    )
    drums: tuple[str, ...] = repeated("--drums FILE", "a stem that has the drums alone, which can be left out")
    point: tuple[str, ...] = repeated(_POINT_FORM, f"{_POINT_HELP}song that drifts")
    by_points: bool = flag("go by the points alone, and not by the onsets of the sound")
    title: str = option("TEXT", "what it is called (as the part is)", str, "")
    out: Path = required("FILE.song", "the song to write", Path)
    overwrite: bool = flag("also where there is one already")


@dataclass(frozen=True, slots=True, kw_only=True)
class SyncOptions:
    """A song that gets other points."""

    song: Path = argument("SONG", "a song file, which is written anew", Path)
    point: tuple[str, ...] = repeated(_POINT_FORM, f"{_POINT_HELP}song that drifts (those that it has)")
    by_points: bool = flag("go by the points alone, and not by the onsets of the sound")


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckOptions:
    """Songs to check."""

    songs: tuple[str, ...] = arguments("SONG", "a song file")


def _new(options: NewSongOptions) -> int:
    from station.app.songs.song_sync import new_song

    if options.out.suffix != SONG_ENDING:
        raise BadInput(options.out, "", f"expected a name that ends in {SONG_ENDING}")
    if options.out.exists() and not options.overwrite:
        raise BadInput(options.out, "", "is there already: choose another name, or say --overwrite")
    song = new_song(options.out, options.part, options.sound, options.drums, options.title)
    _write(replace(song, points=tuple(map(_point, options.point))), not options.by_points)
    return 0


def _sync(options: SyncOptions) -> int:
    song = read_song(options.song)
    points = tuple(map(_point, options.point)) or song.points
    _write(replace(song, points=points, quarters_s=()), not options.by_points)
    return 0


def _write(song: Song, by_sound: bool) -> None:
    """Time the song by its points, two at least, and write it; one with fewer goes by the part's own tempo."""
    from station.app.songs.song_sync import synced
    from station.drills.songs.song_lesson import read_written, song_lesson

    found = synced(song, by_sound) if len(song.points) >= 2 else None
    song = song if found is None else found.song
    lesson = song_lesson(song, read_written(song.part))  # names what cannot be practised
    write_whole(song.source, song_text(song).encode())
    if found is None:
        say("the part's own tempo holds: --point BAR.BEAT=SECONDS, twice or more, follows the band")
    else:
        _print_points(found.points)
    say(f"song     {song.source}: {_about(lesson)}")


def _about(lesson: Lesson) -> str:
    return f"{lesson.score.bar_count} bars, about {lesson.tempo_bpm:g} quarter notes a minute"


def _print_points(points: Iterable[PointOff]) -> None:
    write(f"{'point':>8} {'second':>10} {'off by':>9}")
    for one in points:
        place = f"{one.point.bar}.{one.point.beat:g}"
        warning = f"  more than {SHOWN_RESIDUAL_MS:g} ms: is it that beat?" if one.is_off else ""
        write(f"{place:>8} {one.point.at_s:>10.3f} {one.residual_ms:>+6.1f} ms{warning}")


def _check(options: CheckOptions) -> int:
    """Read each song as practice does, the heads of its sound files too; the first fault of each is told."""
    from station.app.songs.song_sync import checked_song

    faults = 0
    for name in options.songs:
        try:
            lesson, points = checked_song(Path(name))
        except BadInput as fault:
            faults += 1
            write(f"{fault}")
            continue
        write(f"{name}: {_about(lesson)}")
        if points:
            _print_points(points)
    counted = f"{len(options.songs)} song{'s' * (len(options.songs) != 1)}"
    say(f"{counted}, {faults} with a fault" if faults else f"{counted}, no fault")
    return 2 if faults else 0


def _point(text: str) -> SongPoint:
    """`12.3=45.678`: beat 3 of bar 12; raises `BadInput`."""
    place, _, second = text.partition("=")
    bar, _, beat = place.partition(".")
    try:
        return SongPoint(int(bar), float(beat or 1), float(second))
    except ValueError:
        raise BadInput("--point", text, "expected a bar, a beat and a second such as 1.1=0.512") from None


COMMAND = Verbs(
    (
        ("new", "a song of a drum part and a band's sound", Command(NewSongOptions, _new)),
        ("sync", "time a song anew, by other points", Command(SyncOptions, _sync)),
        ("check", "whether songs can be practised, and how far their points are off", Command(CheckOptions, _check)),
    )
)
