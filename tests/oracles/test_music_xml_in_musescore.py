"""Our MusicXML as MuseScore plays it, and its own that it writes of ours: every stroke of the shipped lessons is there.

Lessons with grace strokes or slashes are left out, for MuseScore spaces them its own way, and those that swing, which
not every version of it plays.
"""

import json
import os
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from station.core.pieces import Ornament, Piece
from station.core.units import PPQ
from station.drills.lesson import Lesson
from station.drills.library import shipped_lessons
from station.drills.writing.lesson_part import part_of
from station.music.formats.format_table import read_part
from station.music.formats.music_xml.music_xml_format import MUSIC_XML
from station.music.formats.smf.chunk_reader import parse_midi

PROGRAM = next((found for name in ("mscore", "mscore3", "mscore4", "musescore") if (found := shutil.which(name))), "")
pytestmark = [pytest.mark.oracle, pytest.mark.timeout(600), pytest.mark.skipif(not PROGRAM, reason="no MuseScore here")]
MOST_SECONDS = 300
PER_QUARTER = 48
"""Places are compared to a 48th of a quarter note: MuseScore's MIDI has 480 ticks."""

_TOMS = {41, 43, 45, 47, 48, 50}
NUMBERS: dict[Piece, set[int]] = {
    Piece.KICK: {35, 36},
    Piece.SNARE: {37, 38, 40},
    Piece.HIHAT: {42, 46},
    Piece.HIHAT_PEDAL: {44},
    Piece.RIDE: {51, 53},
    Piece.RIDE_2: {59},
    Piece.CRASH_1: {49},
    Piece.CRASH_2: {57},
    Piece.SPLASH: {55},
    Piece.CHINA: {52},
    Piece.COWBELL: {56},
    Piece.TAMBOURINE: {54},
    Piece.CLAP: {39},
}
"""General MIDI level 1, percussion key map; toms are compared as one, and what is percussion by its time alone."""


def _lessons() -> list[Lesson]:
    """Every third plain lesson: half a minute of MuseScore (our choice)."""
    return [lesson for lesson in shipped_lessons() if _is_plain(lesson)][::3]


def _is_plain(lesson: Lesson) -> bool:
    notes = part_of(lesson).score.notes
    return bool((notes["ornament"] == Ornament.NONE).all() and not notes["swing_ticks"].any())


@pytest.fixture(scope="module")
def played(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """MuseScore's MIDI of the lessons; its MusicXML lies beside it."""
    folder = tmp_path_factory.mktemp("musescore")
    job: list[dict[str, object]] = []
    assert MUSIC_XML.write is not None
    for lesson in _lessons():
        score = folder / f"{lesson.name}.musicxml"
        score.write_bytes(MUSIC_XML.write(part_of(lesson)).data)
        job.append({"in": str(score), "out": [str(score.with_suffix(".mid")), str(score.with_suffix(".mxl"))]})
    (folder / "job.json").write_text(json.dumps(job))
    surroundings = {**os.environ, "QT_QPA_PLATFORM": "offscreen", "HOME": str(folder)}
    command = [PROGRAM, "-j", str(folder / "job.json")]
    subprocess.run(command, env=surroundings, capture_output=True, timeout=MOST_SECONDS, check=True)
    return {path.stem: path for path in folder.glob("*.mid")}


def _as_class(number: int) -> str:
    if number in _TOMS:
        return "tom"
    return next((piece.name for piece, numbers in NUMBERS.items() if number in numbers), "percussion")


def _piece_class(piece: Piece) -> str:
    return piece.name if piece in NUMBERS else "tom" if "TOM" in piece.name else "percussion"


def test_musescore_plays_every_stroke_where_the_lesson_has_it(played: dict[str, Path]) -> None:
    assert len(played) > 50
    for lesson in _lessons():
        midi = parse_midi(played[lesson.name].read_bytes(), lesson.name)
        heard = np.concatenate([track.notes for track in midi.tracks])
        score = part_of(lesson).score
        ours = Counter((round(note.tick * PER_QUARTER / PPQ), _piece_class(note.piece)) for note in score)
        theirs = Counter(
            (round(int(tick) * PER_QUARTER / midi.division.ticks), _as_class(int(number)))
            for tick, number in zip(heard["tick"], heard["number"], strict=True)
        )
        assert ours == theirs, lesson.name


def test_what_musescore_writes_of_ours_reads_as_the_lesson(played: dict[str, Path]) -> None:
    for lesson in _lessons():
        back = read_part(played[lesson.name].with_suffix(".mxl")).score
        ours, theirs = (
            Counter((round(note.tick * PER_QUARTER / PPQ), note.piece) for note in score)
            for score in (part_of(lesson).score, back)
        )
        assert ours == theirs, lesson.name
