"""A song in the window: its sound is made ready while it is looked at, and what was started begins by itself then."""

from concurrent.futures import Future
from pathlib import Path
from types import MappingProxyType

import pytest

from station.app.actions.practice_actions import Begin, EndSession, Leave
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.errors import BadInput
from station.core.events import Hit
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_S
from station.drills.songs.song_lesson import read_song_lesson
from station.engine.messages import Play, SetBacking
from station.practice.session import backing_track
from station.practice.session.device_latency import KitLatency, Latency
from station.practice.session.plan import PlanOptions, plan_practice
from station.sound.track import PreparedTrack
from station.sound.track_file import TrackRequest
from tests.fakes.song_files import write_song
from tests.fakes.stations import Line, choose, room, station_on, store_with


class Makers:
    """Makes tracks ready when a test says so."""

    def __init__(self) -> None:
        self.asked: list[TrackRequest] = []
        self.futures: list[Future[PreparedTrack]] = []

    def __call__(self, request: TrackRequest) -> Future[PreparedTrack]:
        self.asked.append(request)
        self.futures.append(Future())
        return self.futures[-1]

    def done(self) -> PreparedTrack:
        """The last one is ready."""
        track = PreparedTrack(Path("a.track"), self.asked[-1].rate_hz, 0, None)
        self.futures[-1].set_result(track)
        return track


@pytest.fixture
def makers(monkeypatch: pytest.MonkeyPatch) -> Makers:
    made = Makers()
    monkeypatch.setattr(backing_track, "prepare_in_background", made)
    return made


def station_with(folder: Path, line: Line) -> Controller:
    store = store_with(folder, ask_first=False)
    store.now.own_lessons_dir.mkdir(parents=True)
    song = read_song_lesson(write_song(store.now.own_lessons_dir))
    return station_on([line], store, Launch(plan_practice(song, PlanOptions())))


def plays(line: Line) -> list[Play]:
    return [command for command in line.heard if isinstance(command, Play)]


def test_what_is_started_begins_by_itself_once_its_sound_is_ready(tmp_path: Path, makers: Makers) -> None:
    line = Line()
    station = station_with(tmp_path, line)
    station.update(1)
    assert len(makers.asked) == 1, "it is made ready while the song is looked at"
    station.dispatch(Begin())
    station.update(2)
    assert len(makers.asked) == 1
    assert room(station).stage is Stage.IDLE
    assert "begins by itself" in station.view().toast
    track = makers.done()
    station.update(3)
    assert room(station).stage is Stage.PLAYING
    assert [command.track for command in line.heard if isinstance(command, SetBacking)] == [track]
    assert len(plays(line)) == 1


def test_what_was_ready_before_begins_at_once(tmp_path: Path, makers: Makers) -> None:
    station = station_with(tmp_path, Line())
    station.update(1)
    makers.done()
    station.dispatch(Begin())
    assert room(station).stage is Stage.PLAYING


@pytest.mark.parametrize("ends", [EndSession(), Leave()])
def test_who_ends_it_while_it_is_made_ready_is_not_surprised(
    tmp_path: Path, makers: Makers, ends: EndSession | Leave
) -> None:
    station = station_with(tmp_path, Line())
    station.update(1)
    station.dispatch(Begin())
    station.dispatch(ends)
    makers.done()
    station.update(2)
    assert room(station).stage is Stage.IDLE


def test_a_sound_that_cannot_be_made_ready_is_told_once(tmp_path: Path, makers: Makers) -> None:
    station = station_with(tmp_path, Line())
    station.update(1)
    station.dispatch(Begin())
    makers.futures[-1].set_exception(BadInput("band.wav", "", "is cut short"))
    station.update(2)
    assert "cut short" in station.view().toast
    station.update(20 * NS_PER_S)
    assert room(station).stage is Stage.IDLE


def test_the_tempo_of_a_song_is_chosen_and_stays(tmp_path: Path, makers: Makers) -> None:
    station = station_with(tmp_path, Line())
    station.update(1)
    choose(station, adapt=True, tempo_bpm=90.0)
    request = station.view().selection.request()
    assert request is not None
    assert (request.adapt, request.tempo_bpm) == (False, 90.0)
    station.dispatch(Begin())
    assert makers.asked[-1].speed == pytest.approx(0.75), "120 beats a minute of its own"


def test_a_tap_is_taken_for_what_was_heard_with_it(tmp_path: Path, makers: Makers) -> None:
    """A measured kit of 8 ms, an output of 40 ms: what sounded with the stroke had left the station 48 ms before."""
    station = station_with(tmp_path, Line())
    kits = MappingProxyType({"kit": KitLatency(8_000_000)})
    station.parts.sessions.trust(Latency(kits=kits, output_ns=40_000_000))
    assert (
        station.parts.sessions.heard_ns(Hit(NS_PER_S, Piece.SNARE, Zone.HEAD, 90, device="kit"))
        == NS_PER_S - 48_000_000
    )
    assert not makers.futures[0].done()
