"""`station sheet`: the file, which bars, what is refused."""

import os
import sys
from pathlib import Path

import numpy as np
import pytest

from station.app.music_files.named_parts import load_part
from station.cli.command_line import main
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.drills.library import find_lesson
from station.drills.writing.lesson_part import part_of
from station.music.drum_part import DrumPart
from station.music.formats.format_table import writer_for
from station.music.score import Note, Score
from station.music.tempo import TempoMap
from station.render.notation.swing_words import swing_marks
from station.scenes.sheets import lesson_labels, on_grid, written_down
from tests.unit.cli.test_cli import refused

UNTITLED = bytes.fromhex("4d546864 00000006 0000 0001 01e0  4d54726b 0000000d 00 992640 8360 892640 00 ff2f00")
"""A MIDI file of one stroke on the snare, a beat long."""


def test_a_lesson_on_paper(tmp_path: Path) -> None:
    small, whole = tmp_path / "a.pdf", tmp_path / "b.pdf"
    assert main(["sheet", "rock-1", "--out", str(whole)]) == 0
    assert main(["sheet", "rock-1", "--out", str(small), "--end-bar", "1", "--paper", "letter", "--no-sticking"]) == 0
    assert b"[0 0 595.28 841.89]" in whole.read_bytes()
    assert b"[0 0 612 792]" in small.read_bytes()
    assert len(small.read_bytes()) < len(whole.read_bytes())


def test_the_words_are_the_lesson_s() -> None:
    words = lesson_labels(find_lesson("six-eight-fill-1"), (0, 3))
    assert (words.author, words.beats_a_minute, words.repeat) == ("The drum station", 50.0, (0, 3))
    assert words.sections == ((0, "groove"), (3, "fill"))
    part = lesson_labels(find_lesson("six-eight-fill-1"), (2, 3))
    assert (part.sections, part.repeat, part.first_bar) == (((1, "fill"),), None, 3), "not all of the loop is there"


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere names of files are Unicode")
def test_a_file_may_have_a_name_that_is_no_text(tmp_path: Path) -> None:
    path = tmp_path / os.fsdecode(b"caf\xe9.mid")  # Latin-1's
    path.write_bytes(UNTITLED)
    assert main(["sheet", str(path), "--out", str(tmp_path / "x.pdf")]) == 0
    assert "caf?".encode("utf-16-be").hex().encode() in (tmp_path / "x.pdf").read_bytes()


def test_what_cannot_be_is_refused_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def said(name: str, *words: str) -> str:
        return refused(capsys, "sheet", "rock-1", "--out", str(tmp_path / name), *words)

    assert "expected a name that ends in .pdf" in said("x.png")
    assert "expected bars within 1-2" in said("x.pdf", "--start-bar", "3")
    assert "expected bars within 1-2" in said("x.pdf", "--start-bar", "2", "--end-bar", "1")
    assert "expected bars within 1-2" in said("x.pdf", "--end-bar", "0")
    assert "no such choice" in said("x.pdf", "--paper", "a3")
    assert list(tmp_path.iterdir()) == []


def midi_of(lesson: str) -> bytes:
    write = writer_for(Path("x.mid")).write
    assert write
    return write(part_of(find_lesson(lesson))).data


def test_a_midi_file_that_swings_is_written_straight_under_its_mark(tmp_path: Path) -> None:
    """A one drop at 3:2: its late eighths are three fifths into the beat, and no quintuplets."""
    path = tmp_path / "one-drop.mid"
    path.write_bytes(midi_of("reggae-one-drop"))
    score = on_grid(load_part(str(path))).score
    assert {bar: round(mark.ratio, 2) for bar, mark in swing_marks(score).items()} == {0: 1.5}
    assert set((score.as_written.notes["tick"] % (PPQ // 2)).tolist()) == {0}


def test_a_score_on_the_grid_stays(tmp_path: Path) -> None:
    path = tmp_path / "rock.mid"
    path.write_bytes(midi_of("rock-1"))
    before = load_part(str(path))
    assert on_grid(before).score.notes["tick"].tolist() == before.score.notes["tick"].tolist()


def printed(tmp_path: Path, lesson: str) -> DrumPart:
    """What a sheet prints of the lesson's MIDI file."""
    path = tmp_path / "x.mid"
    path.write_bytes(midi_of(lesson))
    return written_down(load_part(str(path)))


def test_what_velocities_and_times_say_is_printed_as_signs(tmp_path: Path) -> None:
    """MIDI has neither ghosts nor flams, and its beat is a quarter."""
    lesson = find_lesson("hip-hop-1").played_once
    assert printed(tmp_path, "hip-hop-1").score.notes["dynamic"].tolist() == lesson.notes["dynamic"].tolist()
    flams = printed(tmp_path, "flam-accent").score
    assert np.count_nonzero(flams.is_grace) == 4
    assert (flams.notes["limb"] == Limb.UNKNOWN).all(), "it says nothing of hands"
    assert printed(tmp_path, "six-eight-1").beat_ticks == 3 * PPQ // 2


def test_a_part_that_says_its_dynamics_stays() -> None:
    part = part_of(find_lesson("hip-hop-1"))
    assert written_down(part).score.notes.tobytes() == part.score.notes.tobytes()


def test_what_a_file_has_beyond_two_hands_stays_beyond_them_on_its_sheet() -> None:
    """Two velocities are somebody's playing, three drums at once three hands: the third is neither lost nor asked."""
    hands = (Piece.SNARE, Piece.TOM_1, Piece.RIDE)
    notes = [Note(k * PPQ, piece, velocity=80 + k % 2) for k in range(16) for piece in hands]
    score = written_down(DrumPart(Score.from_notes(notes, TempoMap.constant(100)))).score
    assert (len(score), len(score.beyond)) == (32, 16)
