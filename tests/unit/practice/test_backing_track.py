"""The track of a session: its speed follows the tempo, and it begins with the first pass."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.drills.library import find_lesson
from station.engine.messages import Play, SetBacking
from station.practice.session.backing_track import Backing, BackingRequest
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.practice.session.session import Session
from tests.fakes.sound_files import stroke


def plan(share: float = 1.0) -> Plan:
    lesson = find_lesson("rock-1")
    return plan_practice(lesson, PlanOptions(lesson.tempo_bpm * share))


def test_the_track_is_as_much_slower_as_the_practice() -> None:
    request = BackingRequest(Path("song.mp3"))
    assert request.track(plan(0.8), 48_000).speed == pytest.approx(0.8)
    assert BackingRequest(Path("song.mp3"), speed=1.2).track(plan(0.8), 48_000).speed == 1.2


def test_a_speed_beyond_stretching_is_refused() -> None:
    with pytest.raises(BadInput, match="found 40%"):
        BackingRequest(Path("song.mp3")).track(plan(0.4), 48_000)


def test_it_begins_with_the_first_pass(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    file = tmp_path / "song.wav"
    file.write_bytes(stroke())
    backing, asked = Backing(BackingRequest(file)), plan()
    backing.ask(asked, 44_100)
    track = backing.ready(wait_s=None)
    assert track is not None
    assert track.rate_hz == 44_100
    backing.ask(asked, 44_100)
    assert backing.ready() is track  # it is kept
    _, first, second = Session(asked, backing=track).start()
    assert first == SetBacking(track, asked.passes_start_ns)
    assert isinstance(second, Play)


def test_a_file_that_cannot_be_read_is_told(tmp_path: Path) -> None:
    backing = Backing(BackingRequest(tmp_path / "none.wav"))
    backing.ask(plan(), 48_000)
    with pytest.raises(BadInput, match=r"none\.wav"):
        backing.ready(wait_s=None)
