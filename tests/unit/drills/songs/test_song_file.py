"""Song files: what they say, how they are written back, what is refused and where."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.drills.songs.song import SongPoint, SongSection
from station.drills.songs.song_file import read_song, song_text
from tests.fakes.song_files import write_song


def song_of(folder: Path, text: str) -> Path:
    path = folder / "one.song"
    path.write_text(text)
    return path


def test_a_song_says_its_files_points_beats_and_sections(tmp_path: Path) -> None:
    text = """
title = "Our song"
part = "parts/our-song.mid"
sound = ["bass.ogg", "guitar.ogg"]
drums = "drums.ogg"
quarters_s = [0.5, 1.0, 1.5]
[[point]]
bar = 1
at_s = 0.5
[[point]]
bar = 2
beat = 2.5
at_s = 3.25
[[section]]
name = "verse"
bar = 2
"""
    song = read_song(song_of(tmp_path, text))
    assert song.name == "one"
    assert song.part == tmp_path / "parts/our-song.mid"
    assert song.others == (tmp_path / "bass.ogg", tmp_path / "guitar.ogg")
    assert song.drums == (tmp_path / "drums.ogg",)
    assert song.points == (SongPoint(1, 1.0, 0.5), SongPoint(2, 2.5, 3.25))
    assert song.quarters_s == (0.5, 1.0, 1.5)
    assert song.sections == (SongSection("verse", 2),)


def test_what_is_written_says_the_same(tmp_path: Path) -> None:
    text = 'title = "A \\"b\\""\nauthor = "c"\npart = "p.mid"\nsound = "/else/where.ogg"\n'
    times = ", ".join(f"{0.5 * i:.4f}" for i in range(33))
    tables = '[[point]]\nbar = 3\nbeat = 2\nat_s = 7.1234\n[[section]]\nname = "solo"\nbar = 3\n'
    song = read_song(song_of(tmp_path, f"{text}quarters_s = [{times}]\n{tables}"))
    written = song_text(song)
    assert read_song(song_of(tmp_path, written)) == song
    assert 'sound = "/else/where.ogg"' in written
    assert 'part = "p.mid"' in written


@pytest.mark.parametrize(
    ("line", "place", "words"),
    [
        ('part = "../secret.mid"', "line 2", "beside the song or below"),
        ('part = "a/../../b.mid"', "line 2", "beside the song or below"),
        ('part = "..\\\\b.mid"', "line 2", "beside the song or below"),
        ('part = "//server/share.mid"', "line 2", "on this computer"),
        ('part = "http://example.org/a.mid"', "line 2", "on this computer"),
        ('part = "a\\u0000.mid"', "line 2", "control characters"),
        (f'part = "{"a" * 2000}"', "line 2", "2000 letters"),
        ('part = "p.mid"\nquarters_s = [0.5, nan]', "line 3", "expected a number"),
        ('part = "p.mid"\nquarters_s = [1e300]', "line 3", "expected a number from"),
        ('part = "p.mid"\nsound = []\n[[point]]\nbar = 0\nat_s = 1', "line 5", "whole number from 1"),
        ('part = "p.mid"\npont = 3', "line 3", "no such key: pont"),
        ('part = "p.mid"\n[[section]]\nname = "b"\nbar = 4\n[[section]]\nname = "a"\nbar = 4', "line 8", "after 4"),
        ("", "", "part is missing"),
    ],
)
def test_each_fault_is_told_with_its_place(tmp_path: Path, line: str, place: str, words: str) -> None:
    with pytest.raises(BadInput) as found:
        read_song(song_of(tmp_path, f'title = "x"\n{line}\n'))
    assert place in str(found.value)
    assert words in str(found.value)


@pytest.mark.parametrize(
    "text",
    [
        "quarters_s = [" + "0," * 140_000 + "]",
        "[[point]]\nbar=1\nat_s=1\n" * 10_000,
        'sound = ["' + '","'.join("a" * 3 for _ in range(40_000)) + '"]',
        "part = '''" + "x" * 900_000 + "'''",
    ],
    ids=["beats", "points", "files", "bytes"],
)
def test_a_flood_is_refused_in_one_line(tmp_path: Path, text: str) -> None:
    with pytest.raises(BadInput) as found:
        read_song(song_of(tmp_path, text))
    assert len(str(found.value)) < 800
    assert "\n" not in str(found.value)


def test_a_song_made_by_hand_is_read(tmp_path: Path) -> None:
    assert read_song(write_song(tmp_path)).title == "Our song"
