"""What is taken along from a lesson; a small program stands in for the one that films."""

import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

from station.app.export import LOOP, SHEET, ExportedFile, Exporter, film_words
from station.app.music_files.part_export import WRITTEN, bars_of
from station.app.settings.view_settings import ViewSettings, view_settings_of
from station.cli.animation.animate_options import LEVELS, AnimateOptions
from station.cli.options.option_fields import read_options
from station.core.errors import DeviceError
from station.core.named_view import NamedView
from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import PPQ
from station.drills.lesson import BarCue, Lesson, Section
from station.drills.library import find_lesson
from station.motion.sticking.hand_notes import Hands
from station.music.formats.format_table import read_part
from station.music.formats.music_format import MusicFormat
from station.music.formats.smf.standard_midi import read_midi
from tests.fakes.work_at_once import WorkAtOnce
from tests.same_lesson import first_difference

ROCK = find_lesson("rock-1")
PATIENCE_S = 60.0
FILMS = "import sys; words = sys.argv; open(words[words.index('--out') + 1], 'w').write(' '.join(words[4:]))"
FAILS = "import sys; sys.exit('no graphics\\nno OpenGL: install it')"
WAITS = """
import pathlib, sys, time
pathlib.Path(sys.argv[sys.argv.index('--out') + 1]).write_text('half')
time.sleep(600)
"""

HELPER = """
import pathlib, sys, time
path = pathlib.Path(sys.argv[1])
path.touch()
while path.exists():
    time.sleep(0.01)
"""
HELPED = "import subprocess, sys, time; subprocess.Popen([sys.executable, '-c', *sys.argv[1:3]]); time.sleep(600)"


def settings(folder: Path) -> Settings:
    return Settings(sessions=str(folder), student="Ann")


def ended(files: Exporter) -> str | None:
    assert files.process is not None
    files.process.wait(PATIENCE_S)
    return files.news()


def written(lesson: Lesson, bars: tuple[int, int], folder: Path, ending: str) -> ExportedFile:
    files = Exporter(start=WorkAtOnce)
    files.music(lesson, bars, settings(folder), ending)
    assert files.view().is_writing
    said = files.written()
    made = files.view().written
    assert made is not None
    assert said is not None
    assert said.startswith(f"kept in {made.path}")
    assert not files.view().is_writing
    return made


@pytest.mark.parametrize("form", WRITTEN, ids=lambda form: form.endings[0])
def test_bars_in_every_format_come_back(form: MusicFormat, tmp_path: Path) -> None:
    """The second bar of Rock 1, as it is printed: eighths on the hi-hat, kick on 1 and 3, snare on 2 and 4."""
    made = written(ROCK, (1, 1), tmp_path, form.endings[0])
    score = read_part(made.path).score
    quarters = [note.tick / PPQ for note in score if note.piece == Piece.SNARE]
    assert quarters == [1.0, 3.0]
    assert sum(note.piece == Piece.HIHAT for note in score) == 8


def test_what_a_format_has_no_word_for_is_told(tmp_path: Path) -> None:
    """A Clone Hero chart has no sticking (its table)."""
    made = written(find_lesson("single-paradiddle"), (0, 0), tmp_path, ".chart")
    assert any("sticking" in line for line in made.lost)


def test_sections_are_cut_with_the_bars() -> None:
    lesson = find_lesson("rock-1")
    parts = (Section("a", 0, 0), Section("b", 1, 1))
    found = bars_of(replace(lesson, sections=parts), (1, 1)).sections
    assert [(part.name, part.first_bar, part.last_bar) for part in found] == [("b", 0, 0)]


def test_bars_as_midi(tmp_path: Path) -> None:
    """The first bar of Rock 1: eight hi-hats, two kicks, two snares."""
    path = written(ROCK, (0, 0), tmp_path, ".mid").path
    assert path == tmp_path / "Ann" / "take-along" / "rock-1_1-1.mid"
    assert sum(len(track.notes) for track in read_midi(path).tracks) == 12


def test_a_lesson_file_is_the_lesson_with_those_bars_as_its_loop(tmp_path: Path) -> None:
    path = Exporter().lesson(ROCK, (1, 1), settings(tmp_path))
    read = find_lesson(str(path))
    assert read.loop == (1, 1)
    assert first_difference(replace(read, loop=ROCK.loop), ROCK) == ""


def test_a_lesson_file_keeps_the_teachers_words_and_comments(tmp_path: Path) -> None:
    written = 'title = "T"  # for Ann\n[grid]\ntimes = 2\nleft_hand.snare = "o---"\n'
    (tmp_path / "own.toml").write_text(written)
    path = Exporter().lesson(find_lesson(str(tmp_path / "own.toml")), (1, 1), settings(tmp_path))
    assert path.read_text().splitlines() == [
        'title = "T"  # for Ann',
        "loop = [2, 2]",
        "[grid]",
        "times = 2",
        "#                    1 2 3 4",
        'left_hand.snare = "| o - - - |"',
    ]


def test_a_video_is_filmed_by_another_process_and_told_of_once(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", FILMS))
    files.film(ROCK, (0, 1), settings(tmp_path), ("--quality", "low"))
    path = tmp_path / "Ann" / "take-along" / "rock-1_1-2.mp4"
    assert ended(files) == f"kept in {path}"
    assert path.read_text() == "--start-bar 1 --end-bar 2 --click --quality low"
    assert (files.news(), files.path) == (None, None)


def test_a_take_is_filmed_beside_its_capture(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", FILMS))
    (tmp_path / "session.capture").write_bytes(b"")
    files.film_take(tmp_path / "session.capture", ("--quality", "low"))
    with pytest.raises(DeviceError, match="one video at a time"):
        files.film_take(tmp_path / "session.capture")
    assert ended(files) == f"kept in {tmp_path / 'session.mp4'}"
    assert (tmp_path / "session.mp4").read_text() == "--quality low"


def test_it_is_filmed_as_it_is_seen() -> None:
    """Every word is one that the command knows."""
    look = ViewSettings(view=NamedView.EYES, mirrored=True)
    words = film_words(look, replace(Settings(), hands="left", figure="curls", stands="electronic"))
    read = read_options(AnimateOptions, ["rock-1", "--out", "x.mp4", *words])
    assert (read.style, read.drummer, read.drums.hands) == ("natural", "curls", Hands.LEFT)
    assert read.drums.drums == "electronic"
    assert (read.picture.view, read.picture.mirror, read.picture.quality) == (NamedView.EYES, True, LEVELS["low"])


def test_a_video_that_fails_says_why_in_one_line(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", FAILS))
    files.film(ROCK, (0, 1), settings(tmp_path))
    assert ended(files) == "no video: no OpenGL: install it"


def test_a_program_that_is_not_there_is_said(tmp_path: Path) -> None:
    files = Exporter(("no-such-program",))
    with pytest.raises(DeviceError, match="no video can be made"):
        files.film(ROCK, (0, 1), settings(tmp_path))
    assert files.path is None


def test_one_video_at_a_time_and_cancelled_it_is_gone(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", WAITS))
    files.film(ROCK, (0, 1), settings(tmp_path))
    with pytest.raises(DeviceError, match="one video at a time"):
        files.film(ROCK, (0, 1), settings(tmp_path))
    files.cancel()
    assert (files.process, files.path, files.news()) == (None, None, None)
    assert list((tmp_path / "Ann" / "take-along").iterdir()) == []
    files.cancel()


def test_cancelling_does_not_wait_for_who_helps_to_draw(tmp_path: Path) -> None:
    """A helper holds what the film says its errors to, and ends only when this test is over."""
    helper = tmp_path / "helper"
    files = Exporter((sys.executable, "-c", HELPED, HELPER, str(helper)))
    files.film(ROCK, (0, 1), settings(tmp_path))
    try:
        while not helper.exists():
            time.sleep(0.01)
        files.cancel()
        assert (files.process, files.path) == (None, None)
    finally:
        helper.unlink()


def test_a_film_that_says_more_than_a_pipe_holds_ends(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", "import sys; sys.exit('x' * 10**6 + '\\nthe end')"))
    files.film(ROCK, (0, 1), settings(tmp_path))
    assert ended(files) == "no video: the end"


def test_a_video_whose_place_is_taken_is_not_kept_elsewhere(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", FILMS))
    place = tmp_path / "Ann" / "take-along" / "rock-1_1-2.mp4"
    place.mkdir(parents=True)
    files.film(ROCK, (0, 1), settings(tmp_path))
    assert ended(files) == f"no video: {place}: cannot be written: it is no plain file"
    assert list(place.iterdir()) == []


def test_a_gif_is_filmed_without_a_click(tmp_path: Path) -> None:
    files = Exporter((sys.executable, "-c", FILMS, "animate"))
    files.film(ROCK, (0, 1), settings(tmp_path), ending=LOOP)
    message = ended(files)
    path = tmp_path / "Ann" / "take-along" / "rock-1_1-2.gif"
    assert message == f"kept in {path}"
    assert "--click" not in path.read_text()


def test_the_bars_as_a_sheet(tmp_path: Path) -> None:
    path = written(ROCK, (1, 1), tmp_path, SHEET).path
    assert path == tmp_path / "Ann" / "take-along" / "rock-1_2-2.pdf"
    assert path.read_bytes().startswith(b"%PDF-")


def test_a_film_leaves_to_the_lesson_what_its_cues_ask_for() -> None:
    look = view_settings_of(Settings())
    cues = (BarCue(0, say="Ghosts low"), BarCue(1, camera="feet"))
    assert "--view" not in film_words(look, Settings(), cues)
    assert "--style" in film_words(look, Settings(), cues)
    assert "--view" in film_words(look, Settings(), cues[:1])
    assert "--style" not in film_words(look, Settings(), (BarCue(0, style="funk"),))


def test_a_battle_is_filmed_into_its_own_folder(tmp_path: Path) -> None:
    films = "import sys; words = sys.argv; open(words[words.index('--film') + 1], 'w').write(words[1])"
    files = Exporter(battle=(sys.executable, "-c", films))
    files.film_battle(tmp_path)
    assert files.process is not None
    files.process.wait(20)
    assert files.news() == f"kept in {tmp_path / 'battle.mp4'}"
    assert (tmp_path / "battle.mp4").read_text() == str(tmp_path)
