"""A song as a lesson: its strokes lie where the band plays them. Expected times are reckoned by hand."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from station.core.errors import BadInput
from station.core.units import PPQ
from station.drills.lesson import DEFAULT_PASSES, Section
from station.drills.library import find_lesson
from station.drills.songs.song_lesson import read_song_lesson
from tests.fakes.song_files import BARS, write_song

BEATS = 4 * BARS


def point(bar: int, at_s: float, beat: float = 1) -> str:
    return f"[[point]]\nbar = {bar}\nbeat = {beat}\nat_s = {at_s}\n"


def test_with_the_times_of_all_beats_each_stroke_lies_on_its_beat(tmp_path: Path) -> None:
    steps = 0.5 + 0.02 * np.sin(np.arange(BEATS))  # a band that wavers by 4 %
    times = np.round(0.731 + np.concatenate([[0.0], np.cumsum(steps)]), 4)
    path = write_song(tmp_path, top=f"quarters_s = [{', '.join(map(str, times))}]")
    lesson = read_song_lesson(path)
    assert lesson.band is not None
    assert lesson.band.start_s == pytest.approx(0.731, abs=1e-6)
    assert lesson.band.others == (tmp_path / "band.wav",)
    at_s = lesson.band.start_s + lesson.score.onset_s
    assert np.abs(at_s - times[:-1]).max() < 1e-5
    assert lesson.tempo_bpm == pytest.approx(60 * BEATS / (times[-1] - times[0]), abs=0.06)


def test_two_points_stretch_the_written_tempo_evenly(tmp_path: Path) -> None:
    """120 bpm written; bar 1 at 1 s and bar 5, 16 beats later, at 9.8 s: 0.55 s a beat, 109.1 a minute."""
    lesson = read_song_lesson(write_song(tmp_path, point(1, 1.0) + point(5, 9.8)))
    assert lesson.band is not None
    assert lesson.band.start_s == pytest.approx(1.0, abs=1e-6)
    assert np.diff(lesson.score.onset_s) == pytest.approx([0.55] * (BEATS - 1), abs=1e-5)
    assert lesson.tempo_bpm == pytest.approx(109.1, abs=0.05)


def test_three_points_bend_the_tempo_and_the_first_may_lie_within_the_song(tmp_path: Path) -> None:
    """Beat 3 of bar 2 at 4 s, bar 4 at 7 s (6 beats of 0.5 s), bar 6 at 10.92 s (8 beats of 0.49 s)."""
    lesson = read_song_lesson(write_song(tmp_path, point(4, 7.0) + point(2, 4.0, beat=3) + point(6, 10.92)))
    assert lesson.band is not None
    at_s = lesson.band.start_s + lesson.score.tempo_map.seconds_at(np.array([6, 12, 20]) * PPQ)
    assert at_s == pytest.approx([4.0, 7.0, 10.92], abs=0.01)
    assert lesson.band.start_s == pytest.approx(1.0, abs=0.05)  # six beats before 4 s


def test_without_points_the_sound_begins_with_the_part(tmp_path: Path) -> None:
    lesson = read_song_lesson(write_song(tmp_path))
    assert lesson.band is not None
    assert lesson.band.start_s == 0.0
    assert lesson.tempo_bpm == 120.0


def test_a_song_is_found_by_its_path_and_looped_by_its_sections(tmp_path: Path) -> None:
    sections = '[[section]]\nname = "verse"\nbar = 3\n[[section]]\nname = "solo"\nbar = 7\n'
    lesson = find_lesson(str(write_song(tmp_path, sections)))
    assert (lesson.name, lesson.title) == ("our-song", "Our song")
    assert lesson.sections == (Section("", 0, 1), Section("verse", 2, 5), Section("solo", 6, 7))
    assert lesson.passes_of(lesson.loop) == 1
    assert lesson.passes_of((2, 5)) == DEFAULT_PASSES


@pytest.mark.parametrize(
    ("more", "words"),
    [
        (point(9, 1.0), "bars 1 to 8"),
        (point(2, 1.0, beat=5), "bar 2 is in 4/4"),
        (point(2, 5.0) + point(3, 5.0), "run backwards"),
        (point(1, 1.0) + point(2, 1.01), "of the written tempo"),
        (point(1, 1.0) + point(2, 400.0), "of the written tempo"),
        ('[[section]]\nname = "coda"\nbar = 9\n', "begins in bar 9"),
    ],
)
def test_what_cannot_be_is_refused(tmp_path: Path, more: str, words: str) -> None:
    with pytest.raises(BadInput, match=r"our-song\.song") as found:
        read_song_lesson(write_song(tmp_path, more))
    assert words in str(found.value)


def test_times_for_another_part_are_refused(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="3 times for the 32 quarters"):
        read_song_lesson(write_song(tmp_path, top="quarters_s = [0, 1, 2]"))


def test_a_part_that_is_not_there_is_named(tmp_path: Path) -> None:
    path = write_song(tmp_path)
    (tmp_path / "part.mid").unlink()
    with pytest.raises(BadInput, match=r"part\.mid: no such file"):
        read_song_lesson(path)


def test_a_lesson_may_be_the_part(tmp_path: Path) -> None:
    lesson = tmp_path / "beat.toml"
    lesson.write_text('title = "Beat"\ntempo_bpm = 100\n[grid]\nsnare = "|o-o-o-o-|"\n')
    path = write_song(tmp_path, point(1, 2.0))
    path.write_text(path.read_text().replace("part.mid", "beat.toml"))
    song = read_song_lesson(path)
    assert song.tempo_bpm == 100.0
    assert len(song.score) == 4


def test_a_folder_of_clone_hero_brings_its_own_sound(tmp_path: Path) -> None:
    write_song(tmp_path)
    shutil.copy(tmp_path / "part.mid", tmp_path / "notes.mid")
    for name in ("song.ogg", "Guitar.ogg", "drums_1.ogg", "drums_2.opus", "drums_2.ogg", "preview.ogg", "cover.png"):
        (tmp_path / name).write_bytes(b"")
    path = tmp_path / "my.song"
    path.write_text('title = "x"\npart = "notes.mid"\n')
    band = read_song_lesson(path).band
    assert band is not None
    assert [one.name for one in band.files(with_drums=False)] == ["song.ogg", "Guitar.ogg"]
    assert [one.name for one in band.drums] == ["drums_1.ogg", "drums_2.opus"]


def test_a_song_without_sound_is_refused(tmp_path: Path) -> None:
    path = write_song(tmp_path)
    path.write_text('title = "x"\npart = "part.mid"\n')
    with pytest.raises(BadInput, match="sound"):
        read_song_lesson(path)
