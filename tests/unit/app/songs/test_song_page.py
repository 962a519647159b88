"""The page of a song: what is read, pinned, followed, tapped and kept. The band is made; its beats are known."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.app.actions.song_actions import (
    BringSound,
    MovePoint,
    OpenSong,
    PlaySong,
    RemovePoint,
    SetPoint,
    SnapPoint,
    TapAlong,
)
from station.app.settings.settings_store import SettingsStore
from station.app.songs.song_page import Ear, SongPage
from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.drills.songs.song_file import read_song
from station.engine.messages import Play, SetBacking, Started
from station.practice.session.cues.listening import Listening
from tests.fakes.song_files import write_part
from tests.fakes.work_at_once import WorkAtOnce
from tests.unit.practice.test_song_sound import beats_s, write_band

BARS = 8


def band_s() -> NDArray[np.float64]:
    return beats_s(5, 4 * BARS + 1, wander=0.003)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("song")
    write_part(folder, BARS)
    write_band(folder / "band.wav", band_s())
    return folder


class Room:
    """A page, and what is heard of it."""

    def __init__(self, folder: Path) -> None:
        self.heard: list[Listening] = []
        self.late_ns = 0
        ear = Ear(self.heard.append, lambda one: one in self.heard, self.heard.clear, self._heard_ns)
        self.page = SongPage(SettingsStore(said={"sessions": str(folder)}), ear, lambda: 48_000, WorkAtOnce)

    def _heard_ns(self, stroke: Hit) -> int:
        return stroke.at_ns - self.late_ns

    def open(self, files: Path) -> None:
        self.page.act(OpenSong(str(files / "part.mid"), str(files / "band.wav")))
        self.page.advance(0)
        self.page.advance(1)

    def pin(self, *beats: int, off_s: float = 0.0) -> None:
        for beat in beats:
            self.page.act(SetPoint(beat // 4 + 1, beat % 4 + 1, band_s()[beat] + off_s))
        self.page.advance(2)
        self.page.advance(3)

    def play(self, from_s: float, now_ns: int = 10 * NS_PER_S) -> Listening:
        """The song from there, its start heard at `now_ns`."""
        self.page.act(PlaySong(from_s))
        track = self.page._track
        assert track is not None
        track.result(30.0)
        self.page.advance(now_ns)
        (listening,) = self.heard
        listening.handle(Started(now_ns))
        return listening


@pytest.fixture
def room(files: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Room]:
    monkeypatch.setenv("XDG_CACHE_HOME", str(files / "cache"))
    made = Room(tmp_path)
    made.open(files)
    yield made
    made.page.close()


def test_a_part_and_a_sound_are_read(room: Room) -> None:
    view = room.page.view()
    assert view.opened is not None
    assert view.opened.song.title == "part", "as its file is called"
    assert view.opened.length_s == pytest.approx(band_s()[-1] + 3.0, abs=0.01)
    assert len(view.bar_s) == BARS
    loud = np.flatnonzero(view.opened.peaks > 0.5) * view.opened.length_s / len(view.opened.peaks)
    assert all(np.abs(loud - at_s).min() < 0.02 for at_s in band_s()[:-1])


def test_pins_bend_the_bars_to_the_band(room: Room) -> None:
    room.pin(0, 12, 28)
    view = room.page.view()
    assert view.is_followed
    assert np.abs(np.array(view.bar_s) - band_s()[:-1:4]).max() < 0.010
    assert not any(one.is_off for one in view.points)


def test_a_pin_on_the_wrong_beat_is_shown_and_can_be_taken_away(room: Room) -> None:
    room.pin(0, 12, 28)
    room.page.act(SetPoint(3, 2, float(band_s()[8])))
    room.page.advance(4)
    room.page.advance(5)
    off = [one.is_off for one in room.page.view().points]
    assert off == [False, True, False, False]
    room.page.act(RemovePoint(1))
    assert len(room.page.view().points) == 3


def test_a_rough_pin_is_nudged_and_snapped_to_its_onset(room: Room) -> None:
    room.pin(4, off_s=0.03)
    room.page.act(MovePoint(0, -0.005))
    assert room.page.view().points[0].point.at_s == pytest.approx(band_s()[4] + 0.025, abs=1e-4)
    room.page.act(SnapPoint(0))
    assert room.page.view().points[0].point.at_s == pytest.approx(band_s()[4], abs=0.005)
    room.page.act(SetPoint(1, 1, -0.5))
    with pytest.raises(BadInput, match="no onset within 60 ms"):
        room.page.act(SnapPoint(0))


def test_it_sounds_with_clicks_on_the_beats_as_they_are_pinned(room: Room) -> None:
    room.pin(0, 28)
    listening = room.play(from_s=2.0)
    backing, play = listening.start()
    assert isinstance(backing, SetBacking)
    assert isinstance(play, Play)
    assert backing.track is not None
    assert backing.track.start == 2 * 48_000
    clicks_s = np.array(play.cues["at_ns"]) / NS_PER_S + 2.0
    expected_s = band_s()[(band_s() >= 2.0)][:-1]
    assert len(clicks_s) == len(expected_s)
    assert np.abs(clicks_s - expected_s)[:-3].max() < 0.010, "up to the last pin"
    room.page.advance(11 * NS_PER_S)
    assert room.page.view().at_s == pytest.approx(3.0, abs=1e-6)
    room.page.act(PlaySong(None))
    assert room.page.view().at_s is None
    assert not room.heard


def test_taps_pin_beat_after_beat(room: Room) -> None:
    room.play(from_s=0.0)
    room.page.act(TapAlong(2))
    for at_s in band_s()[4:12]:
        room.page.handle(Hit(10 * NS_PER_S + round(at_s * NS_PER_S), Piece.SNARE, Zone.HEAD, 90))
    points = [one.point for one in room.page.view().points]
    assert [(point.bar, point.beat) for point in points] == [(bar, beat) for bar in (2, 3) for beat in (1, 2, 3, 4)]
    assert [point.at_s for point in points] == pytest.approx(band_s()[4:12], abs=1e-4)


def test_taps_are_pinned_to_what_was_heard_with_them(room: Room) -> None:
    room.late_ns = 40_000_000
    room.play(from_s=0.0)
    room.page.act(TapAlong(1))
    room.page.handle(Hit(11 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90))
    assert [one.point.at_s for one in room.page.view().points] == pytest.approx([0.96], abs=1e-4)


def test_strokes_are_no_taps_where_nobody_asks(room: Room) -> None:
    room.play(from_s=0.0)
    room.page.handle(Hit(11 * NS_PER_S, Piece.SNARE, Zone.HEAD, 90))
    assert room.page.view().points == ()


def test_what_is_kept_is_a_lesson_that_can_be_opened_again(room: Room) -> None:
    room.pin(0, 12, 28)
    path = room.page.save("Our song")
    song = read_song(path)
    assert (song.title, len(song.points), len(song.quarters_s)) == ("Our song", 3, 4 * BARS + 1)
    assert find_lesson(str(path)).band is not None
    room.page.act(OpenSong(str(path)))
    room.page.advance(6)
    assert len(room.page.view().points) == 3
    assert room.page.save("Our song") == path


def test_nothing_is_kept_of_nothing(tmp_path: Path) -> None:
    page = Room(tmp_path).page
    with pytest.raises(BadInput, match="open a part"):
        page.save("x")
    page.act(BringSound("band.ogg"))
    assert page.view().sound == "band.ogg"


def test_a_part_that_is_none_is_told(tmp_path: Path) -> None:
    page = Room(tmp_path).page
    page.act(OpenSong(str(tmp_path / "none.mid"), str(tmp_path / "none.ogg")))
    with pytest.raises(BadInput, match=r"none\.ogg: no such file"):
        page.advance(1)
    assert "none.ogg" in page.view().fault
    assert not page.view().busy
