"""The track that sessions play along to: brought, listened to, its tempo found, tapped or typed, its start set by ear.

It is in the settings, for every lesson whose tempo stays; a song's own band comes before it. A stranger's file is read
and listened to in a process of its own.
"""

from concurrent.futures import Future
from dataclasses import dataclass, replace
from pathlib import Path
from typing import assert_never

from station.app.actions.sound_actions import (
    BringTrack,
    EstimateTrack,
    HearTrack,
    SetTrack,
    StartTrackHere,
    TapTrack,
    TrackAction,
)
from station.app.engine_client import EngineClient
from station.app.sessions.session_control import SessionControl
from station.app.settings.settings_store import SettingsStore
from station.app.sound.preview_groove import click_bar
from station.app.worker_process import StartWork, Work
from station.core.errors import DeviceError, StationError
from station.core.units import NS_PER_S, ns_from_s
from station.music.tempo import MeterChange
from station.practice.control.tap_tempo import TapTempo
from station.practice.session.cues.click_pattern import PLAIN
from station.practice.session.cues.listening import Listening
from station.sound.track import PreparedTrack

LONGEST_START_S = 600.0
HEARD_BARS = 16
"""So much is heard with a click from the start on (our choice: a wrong tempo has drifted off by then)."""
_USUAL_BPM, _MOST_BPM = 120.0, 400.0


@dataclass(frozen=True, slots=True)
class TrackFacts:
    """What was found of a sound file: its length, and its beat, 0 beats a minute where it has none."""

    path: str
    length_s: float
    bpm: float = 0.0
    first_beat_s: float = 0.0


@dataclass(frozen=True, slots=True)
class TrackView:
    """What the page shows of the track: `busy` in words, `at_s` where it is heard, None where it is not.

    `length_s` is None before the file was read.
    """

    busy: str = ""
    fault: str = ""
    at_s: float | None = None
    length_s: float | None = None


def track_facts(path: str) -> TrackFacts:
    """Read and listen to a file; takes seconds. Raises `BadInput` for what is no sound."""
    from station.sound.songs.beat_estimate import estimated_beat
    from station.sound.songs.song_onsets import song_onsets

    onsets = song_onsets(Path(path).expanduser())
    beat = estimated_beat(onsets)
    if beat is None:
        return TrackFacts(path, onsets.length_s)
    return TrackFacts(path, onsets.length_s, beat.bpm, beat.first_beat_s)


class TrackDesk:
    """The track of the settings in `store`, heard through `sessions`; `start` begins work in a process of its own."""

    def __init__(self, store: SettingsStore, engine: EngineClient, sessions: SessionControl, start: StartWork) -> None:
        self._store, self._engine, self._sessions, self._start = store, engine, sessions, start
        self._work: Work[TrackFacts] | None = None
        self._ready: Future[PreparedTrack] | None = None
        self._listening: Listening | None = None
        self._taps = TapTempo()
        self._is_new = False
        self._view = TrackView()

    def view(self) -> TrackView:
        """What is shown."""
        return self._view

    def close(self) -> None:
        """End what is read."""
        if self._work is not None:
            self._work.end()
            self._work = None

    def advance(self, now_ns: int) -> None:
        """Take what was found or made ready, and move on with what is heard."""
        try:
            self._take_facts()
            self._take_ready()
        except StationError as fault:
            self.close()
            self._ready = None
            self._view = replace(self._view, busy="", fault=str(fault))
        if self._listening is not None:
            at_ns = self._listening.at_ns(now_ns)
            if not self._sessions.is_listening_to(self._listening):
                self._listening = None
                self._view = replace(self._view, at_s=None)
            elif at_ns is not None:
                self._view = replace(self._view, at_s=at_ns / NS_PER_S)

    def _take_facts(self) -> None:
        found = None if self._work is None else self._work.result()
        if found is None:
            return
        self.close()
        self._view = TrackView(length_s=found.length_s, fault="" if found.bpm else "no steady beat was found: tap it")
        if self._is_new:
            self._store.update(lambda settings: replace(settings, track=found.path, with_track=True))
        if found.bpm:
            self._store.update(
                lambda settings: replace(settings, track_bpm=found.bpm, track_start_s=found.first_beat_s)
            )

    def _take_ready(self) -> None:
        if self._ready is None or not self._ready.done():
            return
        ready, self._ready = self._ready, None
        self._view = replace(self._view, busy="")
        settings = self._store.now
        bpm = settings.track_bpm or _USUAL_BPM
        bars = click_bar(PLAIN, MeterChange(0, 4, 4), bpm, HEARD_BARS if settings.track_bpm else 0)
        length_ns = ns_from_s(HEARD_BARS * 4 * 60.0 / bpm)
        listening = Listening(bars.cues, length_ns, ns_from_s(settings.track_start_s), ready.result())
        self._sessions.listen_to(listening)
        self._listening = listening

    # --- what the user does ------------------------------------------------------------------------------------------

    def act(self, action: TrackAction) -> None:
        """Do what the user asks; raises `StationError`."""
        match action:
            case BringTrack(path) if path:
                self._listen_for_beat(path, is_new=True)
            case BringTrack():
                self.stop()
                self._store.update(lambda settings: replace(settings, track="", with_track=False))
                self._view = TrackView()
            case SetTrack(plays, bpm, start_s, stretched):
                self._store.update(
                    lambda settings: replace(
                        settings, with_track=plays, track_bpm=bpm, track_start_s=start_s, track_stretched=stretched
                    )
                )
            case HearTrack(on):
                self._hear() if on else self.stop()
            case StartTrackHere():
                self._start_here()
            case TapTrack(at_ns):
                self._tap(at_ns)
            case EstimateTrack():
                self._listen_for_beat(self._store.now.track, is_new=False)
            case _:
                assert_never(action)

    def _tap(self, at_ns: int) -> None:
        bpm = self._taps.tap(at_ns)
        if bpm is not None and bpm <= _MOST_BPM:
            self._store.update(lambda settings: replace(settings, track_bpm=round(bpm, 1)))

    def _listen_for_beat(self, path: str, is_new: bool) -> None:
        self.stop()
        self.close()
        self._is_new = is_new
        self._work = self._start(track_facts, path)
        self._view = replace(self._view, busy="listening for its beat…", fault="")

    def _hear(self) -> None:
        if self._sessions.practice.is_playing:
            raise DeviceError("end the session first: it needs the sound card")
        from station.sound.track_file import TrackRequest, prepare_in_background

        self.stop()
        settings = self._store.now
        path = Path(settings.track).expanduser()
        self._ready = prepare_in_background(TrackRequest(path, self._engine.rate_hz, start_s=settings.track_start_s))
        self._view = replace(self._view, busy="making it ready…", fault="")

    def _start_here(self) -> None:
        at_s = self._view.at_s
        if at_s is None:
            raise DeviceError("listen to the track first: here is where it sounds")
        self.stop()
        start_s = round(min(at_s, LONGEST_START_S), 3)
        self._store.update(lambda settings: replace(settings, track_start_s=start_s))

    def stop(self) -> None:
        """Hear it no longer."""
        self._ready = None
        if self._listening is not None and self._sessions.is_listening_to(self._listening):
            self._sessions.quiet()
        self._listening = None
        self._view = replace(self._view, at_s=None, busy="" if self._work is None else self._view.busy)
