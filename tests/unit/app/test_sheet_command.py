"""`station sheet`: the file, which bars, what is refused."""

from pathlib import Path

import pytest

from station.app.sheets import words_of_lesson
from station.cli import main
from station.drills.library import find_lesson
from tests.unit.app.test_cli import refused


def test_a_lesson_on_paper(tmp_path: Path) -> None:
    small, whole = tmp_path / "a.pdf", tmp_path / "b.pdf"
    assert main(["sheet", "rock-1", "--out", str(whole)]) == 0
    assert main(["sheet", "rock-1", "--out", str(small), "--end-bar", "1", "--paper", "letter", "--no-sticking"]) == 0
    assert b"[0 0 595.28 841.89]" in whole.read_bytes()
    assert b"[0 0 612 792]" in small.read_bytes()
    assert len(small.read_bytes()) < len(whole.read_bytes())


def test_the_words_are_the_lesson_s() -> None:
    words = words_of_lesson(find_lesson("six-eight-fill-1"), (0, 3))
    assert (words.author, words.beats_a_minute, words.repeat) == ("The drum station", 50.0, (0, 3))
    assert words.sections == ((0, "groove"), (3, "fill"))
    part = words_of_lesson(find_lesson("six-eight-fill-1"), (2, 3))
    assert (part.sections, part.repeat, part.first_bar) == (((1, "fill"),), None, 3), "not all of the loop is there"
    assert words_of_lesson(find_lesson("jazz-ride-1"), (0, 1)).feel == "swing 2 : 1"


def test_what_cannot_be_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def said(name: str, *words: str) -> str:
        return refused(capsys, "sheet", "rock-1", "--out", str(tmp_path / name), *words)

    assert "expected a name that ends in .pdf" in said("x.png")
    assert "expected bars within 1-2" in said("x.pdf", "--start-bar", "3")
    assert "expected bars within 1-2" in said("x.pdf", "--start-bar", "2", "--end-bar", "1")
    assert "no such choice" in said("x.pdf", "--paper", "a3")
    assert list(tmp_path.iterdir()) == []
