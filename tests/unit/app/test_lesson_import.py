"""What becomes a lesson of the user's own: where it lies, what it is called, what is refused."""

import os
import shlex
from pathlib import Path

import pytest

from station.app.music_files.lesson_import import import_lesson, keep_import
from station.app.music_files.named_parts import is_lesson, load_part
from station.core.errors import BadInput
from station.core.pieces import Piece
from station.drills.library import find_lesson, lessons_dir, own_lessons

TAB = "Title: {title}\nHH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\nBD|o-------o-------|\n"
LINK = (
    "https://www.mikeslessons.com/groove/?TimeSig=4/4&Div=8&Tempo=90&Measures=1&H=|xxxxxxxx|&S=|--O---O-|&K=|o---o---|"
)
CHART = """[Song]
{
  Resolution = 192
}
[SyncTrack]
{
  0 = TS 4
  0 = B 120000
}
[ExpertDrums]
{
  0 = N 0 0
  192 = N 1 0
  384 = N 0 0
  576 = N 1 0
}
"""


def tab(path: Path, title: str = "Beat") -> Path:
    path.write_text(TAB.format(title=title))
    return path


def test_a_file_becomes_a_lesson_of_ones_own_that_its_name_finds(tmp_path: Path) -> None:
    kept = keep_import(str(tab(tmp_path / "My beat.tab")), tmp_path / "lessons")
    assert kept.path == tmp_path / "lessons" / "My-beat.toml"
    assert (kept.title, kept.bars, kept.is_new) == ("Beat", 1, True)
    assert sum(note.piece == Piece.SNARE for note in find_lesson(str(kept.path)).score) == 2
    assert list(own_lessons([], tmp_path / "lessons", [])) == ["My-beat"]


def test_the_same_again_is_kept_once_and_another_of_its_name_beside_it(tmp_path: Path) -> None:
    source, folder = tab(tmp_path / "beat.tab"), tmp_path / "lessons"
    first = keep_import(str(source), folder)
    again = keep_import(str(source), folder)
    other = keep_import(str(tab(source, "Another")), folder)
    assert (again.path, again.is_new) == (first.path, False)
    assert other.path == folder / "beat-2.toml"
    assert find_lesson(str(first.path)).title == "Beat", "what lay there stays"


def test_a_name_that_a_folder_a_pipe_or_a_broken_link_has_is_left_alone(tmp_path: Path) -> None:
    folder = tmp_path / "lessons"
    (folder / "beat.toml").mkdir(parents=True)
    os.mkfifo(folder / "beat-2.toml")
    (folder / "beat-3.toml").symlink_to(tmp_path / "gone.toml")
    kept = keep_import(str(tab(tmp_path / "beat.tab")), folder)
    assert (kept.path, kept.is_new) == (folder / "beat-4.toml", True)
    assert not (tmp_path / "gone.toml").exists()


def test_no_own_lesson_takes_the_name_of_one_that_ships(tmp_path: Path) -> None:
    kept = keep_import(str(tab(tmp_path / "rock-1.tab")), tmp_path / "lessons")
    assert kept.path.stem == "rock-1-2"


def test_a_lesson_file_is_kept_to_the_letter(tmp_path: Path) -> None:
    text = 'title = "From Anna"  # for you\n[grid]\nleft_hand.snare = "o---"\n'
    (tmp_path / "anna.toml").write_text(text)
    kept = keep_import(str(tmp_path / "anna.toml"), tmp_path / "lessons")
    assert kept.path.read_text() == text


def test_a_link_and_a_song_s_folder_are_imported(tmp_path: Path) -> None:
    """The folder of a Clone Hero song is named as the song is; its file is always called `notes`."""
    song = tmp_path / "Band - Song"
    song.mkdir()
    (song / "notes.chart").write_text(CHART)
    by_link = keep_import(LINK, tmp_path / "lessons")
    by_title = keep_import(f"{LINK}&Title=Half-time%20shuffle", tmp_path / "lessons")
    by_folder = keep_import(str(song), tmp_path / "lessons")
    assert (by_link.path.stem, by_link.bars) == ("groove", 1)
    assert by_title.path.stem == "half-time-shuffle"
    assert (by_folder.path.stem, by_folder.title) == ("Band-Song", "Band - Song")
    assert [note.piece for note in load_part(str(song)).score] == [Piece.KICK, Piece.SNARE] * 2
    assert not is_lesson(str(song))
    assert not any("station song new" in remark for remark in by_folder.remarks)
    (song / "song.ogg").write_bytes(b"")
    (said,) = (line for line in import_lesson(str(song), "x").remarks if "station song new" in line)
    assert shlex.split(said.split("`")[1])[:5] == ["station", "song", "new", "--part", str(song)]


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("none.mid", None, "none.mid: no such file"),
        ("broken.mid", "MThd", "broken.mid"),
        ("silent.chart", "[Song]\n{\n}\n", "silent.chart"),
        ("page.pdf", "%PDF", "page.pdf: expected a music file"),
        ("odd.toml", "title = 3\n", "odd.toml"),
        ("https://example.org/watch?v=1", None, "expected a music file"),
    ],
)
def test_what_is_refused_is_named(name: str, text: str | None, said: str, tmp_path: Path) -> None:
    path = name if "://" in name else str(tmp_path / name)
    if text is not None:
        Path(path).write_text(text)
    with pytest.raises(BadInput, match=said):
        keep_import(path, tmp_path / "lessons")
    assert not (tmp_path / "lessons").exists()


def test_a_folder_without_a_song_is_no_song(tmp_path: Path) -> None:
    with pytest.raises(BadInput, match="without notes"):
        keep_import(str(tmp_path), tmp_path / "lessons")


def test_the_command_makes_no_lesson_of_a_lesson() -> None:
    with pytest.raises(BadInput, match="expected a music file"):
        import_lesson(str(next(lessons_dir().rglob("rock-1.toml"))), "rock")
