"""A song and its sound in the window: listened to, pinned to the beats by points, followed, kept as a lesson.

Files are read and the band is followed in processes of their own. Whatever changes the points has the band followed
anew; until that is done the points alone say where the beats are. The sound goes through the engine, and the sound
card's clock says where in it a tap falls.
"""

from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import dataclass, replace
from pathlib import Path
from typing import assert_never

from station.app.actions.song_actions import (
    BringSound,
    MovePoint,
    OpenSong,
    PinAction,
    PlaySong,
    RemovePoint,
    SetPoint,
    SnapPoint,
    TapAlong,
)
from station.app.settings.settings_store import SettingsStore
from station.app.songs.opened_song import OpenedSong, opened_song
from station.app.songs.song_sync import PointOff, SyncedSong, points_off, synced_score
from station.app.worker_process import StartWork, Work, WorkerProcess
from station.core.disk.file_names import folder_name
from station.core.disk.files import write_whole
from station.core.errors import BadInput, StationError
from station.core.events import Hit
from station.core.units import NS_PER_S, ns_from_s
from station.drills.songs.song import Song, SongPoint, band_time
from station.drills.songs.song_file import SONG_ENDING, song_text
from station.drills.songs.tapped_points import tapped_points
from station.engine.messages import EngineEvent
from station.practice.session.cues.click_pattern import click_cues
from station.practice.session.cues.listening import Listening, cues_between
from station.sound.track import PreparedTrack

SNAP_REACH_S = 0.06
"""How far a rough point may be from its onset (our choice: twice what taps scatter)."""


@dataclass(frozen=True, slots=True, eq=False)
class SongView:
    """What the page shows.

    `opened` is the song that was read, None before; `song` has its points as they are now, `points` how far each is
    off. `bar_s` (n,) are the bars' times in the sound, `busy` what is going on in words, `at_s` where it sounds, None
    where nothing does, `sound` the file that was dropped, `is_followed` whether the band was followed through these
    points, `taps_from` the bar from which strokes are taps.
    """

    opened: OpenedSong | None = None
    song: Song | None = None
    points: tuple[PointOff, ...] = ()
    bar_s: tuple[float, ...] = ()
    busy: str = ""
    at_s: float | None = None
    sound: str = ""
    is_followed: bool = False
    taps_from: int | None = None
    fault: str = ""


@dataclass(frozen=True, slots=True)
class Ear:
    """Lets something sound in place of what does, says whether it does, ends it.

    `heard_ns` says of a stroke when what was heard with it left the station: what kit and output delay is taken off.
    """

    hear: Callable[[Listening], None]
    is_heard: Callable[[Listening], bool]
    quiet: Callable[[], None]
    heard_ns: Callable[[Hit], int]


class SongPage:
    """One song, heard by `ear`.

    The settings of `store` say where songs are kept, `rate_hz` is the sound card's; `start` begins the reading.
    """

    def __init__(
        self,
        store: SettingsStore,
        ear: Ear,
        rate_hz: Callable[[], int],
        start: StartWork = WorkerProcess,
    ) -> None:
        self._store, self._start, self._rate_hz = store, start, rate_hz
        self._ear = ear
        self._reading: Work[OpenedSong] | None = None
        self._following: Work[SyncedSong] | None = None
        self._followed_points: tuple[SongPoint, ...] | None = None
        self._track: Future[PreparedTrack] | None = None
        self._listening: Listening | None = None
        self._asked = PlaySong(None)
        self._taps: list[float] = []
        self._untapped: tuple[SongPoint, ...] = ()  # the points before the taps
        self._view = SongView()

    def view(self) -> SongView:
        """What is shown."""
        return self._view

    def close(self) -> None:
        """End what is read."""
        for work in (self._reading, self._following):
            if work is not None:
                work.end()
        self._reading = self._following = None

    # --- as time goes by ---------------------------------------------------------------------------------------------

    def advance(self, now_ns: int) -> None:
        """Take what was read, followed or made ready, and move on with what is heard; raises `StationError`."""
        if self._listening is not None:
            self._move_on(self._listening, now_ns)
        try:
            self._take_read()
            self._take_followed()
            self._take_track()
        except StationError as fault:
            self.close()
            self._view = replace(self._view, busy="", fault=str(fault))
            raise

    def _move_on(self, listening: Listening, now_ns: int) -> None:
        at_ns = listening.at_ns(now_ns)
        is_over = not self._ear.is_heard(listening) or listening.is_over(now_ns)
        at_s = None if is_over else self._view.at_s if at_ns is None else at_ns / NS_PER_S
        self._view = replace(self._view, at_s=at_s)
        self._listening = None if is_over else listening

    def _take_read(self) -> None:
        opened = None if self._reading is None else self._reading.result()
        if opened is not None and self._reading is not None:
            self._reading.end()
            self._reading = None
            self._view = SongView(opened=opened, song=opened.song, is_followed=bool(opened.song.quarters_s))
            self._followed_points = opened.song.points if opened.song.quarters_s else None
            self._lay()

    def _take_followed(self) -> None:
        found = None if self._following is None else self._following.result()
        if found is not None and self._following is not None:
            self._following.end()
            self._following = None
            if self._view.song is not None and found.song.points == self._view.song.points:
                self._view = replace(self._view, song=found.song, is_followed=True, busy="")
                self._lay()
        song, opened = self._view.song, self._view.opened
        is_tapped = bool(self._taps) and self._listening is not None  # the next tap comes at once
        if song is None or opened is None or self._following is not None or len(song.points) < 2 or is_tapped:
            return
        if song.points != self._followed_points:
            self._followed_points = song.points
            self._following = self._start(synced_score, song, opened.score)
            self._view = replace(self._view, busy="following the band…", fault="")

    def _take_track(self) -> None:
        if self._track is not None and self._track.done():
            track, self._track = self._track, None
            self._play(track.result())

    def handle(self, event: EngineEvent) -> None:
        """A stroke is a tap while the song sounds and is tapped along to."""
        if isinstance(event, Hit) and self._view.taps_from is not None:
            self._tap(self._ear.heard_ns(event), self._view.taps_from)

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: PinAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case OpenSong(part, sound):
                self._open(part, sound)
            case BringSound(sound):
                self._view = replace(self._view, sound=sound)
            case SetPoint(bar, beat, at_s):
                self._set(SongPoint(bar, beat, round(at_s, 4)))
            case MovePoint(index, by_s):
                self._move(index, lambda at_s: at_s + by_s)
            case SnapPoint(index):
                self._move(index, self._snapped)
            case RemovePoint(index):
                self._change(self._points[:index] + self._points[index + 1 :])
            case PlaySong():
                self._ask(action)
            case TapAlong(bar):
                self._taps = []
                self._view = replace(self._view, taps_from=bar)
            case _:
                assert_never(action)

    def save(self, title: str) -> Path:
        """Keep the song under `title` among the user's own lessons; returns its file. Raises `StationError`."""
        song = self._view.song
        if song is None:
            raise BadInput("song", "", "open a part and a sound file first")
        if not title.strip():
            raise BadInput("song", "title", "name the song first")
        path = song.source
        if path.stem == "new" or song.title != title:
            path = self._store.now.own_lessons_dir / f"{folder_name(title)}{SONG_ENDING}"
        kept = replace(song, source=path, title=title.strip())
        write_whole(path, song_text(kept).encode())
        self._view = replace(self._view, song=kept)
        return path

    def _open(self, part: str, sound: str) -> None:
        self._stop()
        self.close()
        self._reading = self._start(opened_song, part, sound, self._store.now.own_lessons_dir)
        self._view = SongView(busy="reading…", sound=sound)

    # --- points ------------------------------------------------------------------------------------------------------

    @property
    def _points(self) -> tuple[SongPoint, ...]:
        return () if self._view.song is None else self._view.song.points

    def _set(self, point: SongPoint) -> None:
        others = tuple(p for p in self._points if (p.bar, round(p.beat, 6)) != (point.bar, round(point.beat, 6)))
        self._change((*others, point))

    def _move(self, index: int, moved: Callable[[float], float]) -> None:
        if 0 <= index < len(self._points):
            point = self._points[index]
            self._set(replace(point, at_s=round(moved(point.at_s), 4)))

    def _snapped(self, at_s: float) -> float:
        onset = None if self._view.opened is None else self._view.opened.likely_onset(at_s, SNAP_REACH_S)
        if onset is None:
            raise BadInput("song", f"{at_s:.3f} s", f"there is no onset within {1e3 * SNAP_REACH_S:.0f} ms")
        return onset

    def _change(self, points: tuple[SongPoint, ...]) -> None:
        song = self._view.song
        if song is None:
            return
        ordered = tuple(sorted(points, key=lambda point: (point.bar, point.beat)))
        before = self._view
        self._view = replace(before, song=replace(song, points=ordered, quarters_s=()), is_followed=False, fault="")
        try:
            self._lay()
        except StationError:
            self._view = before
            raise

    def _lay(self) -> None:
        """Where the bars are now, and how far the points are off; raises `BadInput` for points that cannot be."""
        song, opened = self._view.song, self._view.opened
        assert song is not None, "bars are laid once a song is open"
        assert opened is not None
        tempo_map, start_s = band_time(song, opened.score)
        ticks = [tempo_map.bar_start(bar) for bar in range(opened.score.bar_count)]
        points = points_off(song, opened.score) if song.points else ()
        self._view = replace(self._view, bar_s=tuple((start_s + tempo_map.seconds_at(ticks)).tolist()), points=points)

    # --- what is heard -----------------------------------------------------------------------------------------------

    def _ask(self, asked: PlaySong) -> None:
        self._stop()
        song = self._view.song
        if asked.from_s is None or song is None:
            return
        from station.sound.track_file import TrackRequest, prepare_in_background

        self._asked = replace(asked, from_s=max(0.0, asked.from_s))
        first, *beside = song.others + song.drums
        self._track = prepare_in_background(
            TrackRequest(first, self._rate_hz(), start_s=self._asked.from_s or 0.0, beside=tuple(beside))
        )

    def _play(self, track: PreparedTrack) -> None:
        """Let it sound from where it was asked for; raises `DeviceError`."""
        song, opened = self._view.song, self._view.opened
        if song is None or opened is None or self._asked.from_s is None:
            return
        begin_ns, end_ns = ns_from_s(self._asked.from_s), ns_from_s(opened.length_s)
        tempo_map, start_s = band_time(song, opened.score)
        cues = click_cues(tempo_map, opened.score.end_tick)[: None if self._asked.clicks else 0]
        cues["at_ns"] += ns_from_s(start_s)
        listening = Listening(cues_between(cues, begin_ns, end_ns), max(end_ns - begin_ns, 1), begin_ns, track)
        self._ear.hear(listening)
        self._listening = listening
        self._view = replace(self._view, at_s=self._asked.from_s)

    def _stop(self) -> None:
        self._track = None
        self._taps = []
        if self._listening is not None:
            self._ear.quiet()
            self._listening = None
        self._view = replace(self._view, at_s=None)

    def _tap(self, at_ns: int, bar: int) -> None:
        heard_ns = None if self._listening is None else self._listening.at_ns(at_ns)
        if heard_ns is None or self._view.opened is None:
            return
        if not self._taps:
            self._untapped = self._points
        self._taps.append(round(heard_ns / NS_PER_S, 4))
        tapped = tapped_points(self._view.opened.score, bar, self._taps)
        places = {(point.bar, round(point.beat, 6)) for point in tapped}
        self._change((*(p for p in self._untapped if (p.bar, round(p.beat, 6)) not in places), *tapped))
