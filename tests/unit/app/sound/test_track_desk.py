"""The track on the page of sounds: read beside the window, kept in the settings, laid under the sessions to come."""

from concurrent.futures import Future
from pathlib import Path

import pytest

from station.app.actions.action import Show
from station.app.actions.practice_actions import Begin, EndSession
from station.app.actions.sound_actions import BringTrack, SetTrack, StartTrackHere, TapTrack
from station.app.child_programs import ChildPrograms
from station.app.controller import Controller
from station.app.room_state import Stage
from station.app.sessions.launch import Launch
from station.core.errors import BadInput
from station.core.settings import Settings
from station.core.units import NS_PER_S
from station.drills.library import find_lesson
from station.practice.session.backing_track import track_request
from station.practice.session.plan import PlanOptions, plan_practice
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.track import PreparedTrack
from station.sound.track_file import TrackRequest
from station.sound.wav_file import write_wav
from tests.fakes.stations import Line, store_with
from tests.fakes.virtual_band import rock_track
from tests.fakes.work_at_once import WorkAtOnce


def station_at(folder: Path, **chosen: object) -> Controller:
    launch = Launch(plan_practice(find_lesson("rock-1"), PlanOptions(loops=1, demonstrations=0)))
    station = Controller(ChildPrograms(Line, work=WorkAtOnce), store_with(folder, **chosen), launch)
    station.dispatch(Show())
    return station


def test_a_track_that_is_brought_is_listened_to_and_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    path = tmp_path / "song.wav"
    write_wav(rock_track(97.3, 1.437), RATE_HZ, path)
    station = station_at(tmp_path)
    station.dispatch(BringTrack(str(path)))
    station.update(1)
    now = station.view().settings
    assert (now.track, now.with_track) == (str(path), True)
    assert now.track_bpm == pytest.approx(97.3, abs=0.2)
    assert now.track_start_s == pytest.approx(1.437, abs=0.01)
    station.dispatch(BringTrack(""))
    assert station.view().settings.track == ""


def test_what_is_no_sound_changes_nothing_and_is_said(tmp_path: Path) -> None:
    path = tmp_path / "song.mp3"
    path.write_bytes(b"rubbish")
    station = station_at(tmp_path)
    station.dispatch(Show(sound=False))
    station.dispatch(BringTrack(str(path)))
    station.update(1)
    assert "song.mp3" in station.parts.sound.track.view().fault
    assert station.view().settings.track == ""


def test_a_tempo_is_tapped_and_here_asks_for_sound(tmp_path: Path) -> None:
    station = station_at(tmp_path, track="song.mp3", with_track=True)
    for beat in range(5):
        station.dispatch(TapTrack(beat * NS_PER_S // 2))
    assert station.view().settings.track_bpm == pytest.approx(120.0)
    station.dispatch(SetTrack(plays=False, bpm=90.0, start_s=12.34, stretched=False))
    now = station.view().settings
    assert (now.with_track, now.track_bpm, now.track_start_s, now.track_stretched) == (False, 90.0, 12.34, False)
    station.dispatch(StartTrackHere())
    station.update(1)
    assert "listen to the track first" in station.view().toast


def test_its_own_tempo_says_how_fast_it_plays() -> None:
    plan = plan_practice(find_lesson("rock-1"), PlanOptions(tempo_bpm=80.0))
    settings = Settings(track="song.mp3", with_track=True, track_bpm=100.0, track_start_s=2.5)
    wanted = track_request(settings)
    assert wanted is not None
    request = wanted.track(plan, 48_000)
    assert (request.path, request.start_s) == (Path("song.mp3"), 2.5)
    assert request.speed == pytest.approx(0.8)
    straight = track_request(Settings(track="song.mp3", with_track=True, track_bpm=100.0, track_stretched=False))
    assert straight is not None
    assert straight.track(plan, 48_000).speed == 1.0
    assert track_request(Settings(track="song.mp3")) is None


def test_a_track_that_is_gone_costs_nobody_the_practice(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(_: TrackRequest) -> Future[PreparedTrack]:
        future: Future[PreparedTrack] = Future()
        future.set_exception(BadInput("gone.mp3", "", "no such file"))
        return future

    monkeypatch.setattr("station.practice.session.backing_track.prepare_in_background", refused)
    station = station_at(tmp_path, track="gone.mp3", with_track=True)
    station.dispatch(Begin())
    station.update(1)
    assert station.view().room.stage is Stage.PLAYING
    assert "gone.mp3: no such file; the session goes without its track" in station.view().toast
    station.dispatch(EndSession())
    station.close()
