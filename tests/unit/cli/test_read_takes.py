"""A take as a score: where its bars are, by what is kept beside the capture."""

import os
from pathlib import Path

import pytest

from station.app.music_files.named_parts import is_lesson
from station.app.music_files.read_captures import is_capture
from station.app.music_files.read_takes import FREE_TITLE, take_as_score
from station.cli.command_line import main
from station.cli.input.read_scores import load_score
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.mapping.presets import GENERAL_MIDI_PRESET
from station.drills.library import find_lesson
from station.engine.engine import Engine
from station.engine.messages import RecordCapture
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.device_latency import Latency
from station.practice.session.free_play import LEAD_IN_NS, FreeClick, FreePlay

KIT = "kit"


def taken(folder: Path, has_transport: bool) -> Path:
    """A capture of the engine's: kick 2.1 s and snare 2.6 s after the transport's zero."""
    path = folder / "session.capture"
    engine, play = Engine(), FreePlay(FreeClick(120.0, PLAIN), Latency())
    engine.use_preset(KIT, GENERAL_MIDI_PRESET)
    engine.device_found(KIT, 0)
    engine.advance(0)
    for command in (RecordCapture(path), *(play.start() if has_transport else ())):
        engine.handle(command)
    engine.advance(LEAD_IN_NS)
    for at_ms, note in ((2100, 36), (2600, 38)):
        engine.advance(LEAD_IN_NS + at_ms * NS_PER_MS - 1)
        engine.feed(KIT, bytes([0x99, note, 100]), LEAD_IN_NS + at_ms * NS_PER_MS)
    engine.handle(RecordCapture(None))
    return path


def seconds(path: Path) -> list[float]:
    score = take_as_score(path)
    return [float(ns) / NS_PER_S for ns in score.tempo_map.ns_at(score.notes["tick"])]


def test_a_capture_of_any_name_is_a_score(tmp_path: Path) -> None:
    path = taken(tmp_path, has_transport=False).rename(tmp_path / "take.cap")
    assert len(load_score(str(path))) == 2
    assert not is_lesson(str(path))
    assert is_lesson("rock-1")
    assert is_lesson(str(tmp_path))


def test_a_take_is_imported_onto_the_grid_of_a_lesson(tmp_path: Path) -> None:
    """At 120 bpm the kick at 2.1 s and the snare at 2.6 s lie a fifth of a beat behind beats 1 and 2 of their bar."""
    out = tmp_path / "mine.toml"
    assert main(["lesson", "import", str(taken(tmp_path, has_transport=True)), "--out", str(out)]) == 0
    score = find_lesson(str(out)).score
    assert len(score) == 2
    assert set(score.notes["piece"].tolist()) == {Piece.KICK, Piece.SNARE}


@pytest.mark.parametrize(
    ("document", "title", "times_s"),
    [
        ('{"tempo_bpm": 120.0}', FREE_TITLE, [0.1, 0.6]),  # bars of 2 s
        ('{"tempo_bpm": 60.0}', FREE_TITLE, [2.1, 2.6]),  # bars of 4 s
        ('{"tempo_bpm": "fast"}', FREE_TITLE, [0.1, 0.6]),
        ('{"tempo_bpm": -3}', FREE_TITLE, [0.1, 0.6]),
        ("[1, 2", "session", [0.1, 0.6]),
        (None, "session", [0.1, 0.6]),
    ],
)
def test_a_free_take_begins_with_the_bar_of_its_first_stroke(
    document: str | None, title: str, times_s: list[float], tmp_path: Path
) -> None:
    path = taken(tmp_path, has_transport=True)
    if document is not None:
        (tmp_path / "take.json").write_text(document)
    assert take_as_score(path).title == title
    assert seconds(path) == pytest.approx(times_s, abs=1e-5)


def test_what_was_recorded_without_a_transport_begins_with_its_first_stroke(tmp_path: Path) -> None:
    assert seconds(taken(tmp_path, has_transport=False)) == pytest.approx([0.0, 0.5], abs=1e-5)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no such pipes")
def test_a_pipe_is_not_looked_into(tmp_path: Path) -> None:
    """Nobody writes to it: whoever opened it would wait for ever."""
    os.mkfifo(tmp_path / "pipe")
    assert not is_capture(str(tmp_path / "pipe"))
    assert not is_capture("no\0name")
    assert not is_capture(300 * "long")
