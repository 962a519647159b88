"""Just play: a take, its folder, its pictures, and the take to be heard again.

Strokes light the kit before, in and after a take; only a take's are kept.
"""

from pathlib import Path

import numpy as np

from station.app.room_state import FreeRequest
from station.app.settings.settings_store import SettingsStore
from station.core.errors import DeviceError, StationError
from station.core.settings import setting_source
from station.core.units import NS_PER_S
from station.devices.capture.capture import read_capture
from station.engine.messages import EngineEvent
from station.motion.kinematics.figure import Figure, figure_of
from station.motion.kit.kit import Kit
from station.music.performance import Performance
from station.music.score import Score
from station.music.tempo import TempoMap
from station.practice.headless.live import EngineLink, begin, end
from station.practice.now.whereabouts import replay_place
from station.practice.records.save_session import SessionFolder
from station.practice.session.cues.click_options import parse_click
from station.practice.session.cues.listening import Listening
from station.practice.session.device_latency import Latency
from station.practice.session.free_play import BEATS, FreeClick, FreePlay, listening_back, take_of
from station.render.snapshot import Hud, SeenStrike, Snapshot, Strip
from station.scenes.session_scene import STRIKE_SHOWN_NS, strikes
from station.store.rows import SessionKind

IN_SIGHT = 256
"""The last strokes that the strip may show while a take runs: eight seconds of 32 a second; our choice."""
TITLE = "Just play"
FOLDER = "just-play"
_NO_SCORE = Score.from_notes([], TempoMap())


class FreeSession:
    """The take that runs or ran last, kept by the settings of `store`."""

    def __init__(self, store: SettingsStore, latency: Latency, figure: Figure | None = None) -> None:
        self._store, self._latency = store, latency
        self._figure = figure or figure_of()
        self._play = FreePlay(FreeClick(100.0, None), latency)
        self._folder: SessionFolder | None = None
        self._take: Performance | None = None
        self._shown = 0, Performance.from_hits([])
        self._end_ns = 0
        self.runs = False

    def delayed_by(self, latency: Latency) -> None:
        """Take devices to be so late from the next take on."""
        self._latency = latency

    @property
    def take(self) -> Path | None:
        """The capture of the last take, None where there is nothing to listen back to."""
        has_strokes = self._take is not None and len(self._take) > 0
        return self._folder.capture if has_strokes and self._folder is not None else None

    @property
    def notices(self) -> list[str]:
        """What a user should read once, in order."""
        return self._play.heard.notices

    @property
    def over(self) -> bool:
        """Whether the longest take is full."""
        return self._play.over

    # --- the take ----------------------------------------------------------------------------------------------------

    def begin(self, engine: EngineLink, request: FreeRequest) -> None:
        """Record from now on, to the click that is asked for; raises `StationError`."""
        settings = self._store.now
        pattern = parse_click(settings.click_pattern, setting_source("click_pattern")) if request.click else None
        play = FreePlay(FreeClick(request.tempo_bpm, pattern), self._latency)
        folder = SessionFolder.make(None, settings, FOLDER, SessionKind.TAKE)
        try:
            begin(engine, play, folder.capture)
        except StationError:
            folder.let_go()
            raise
        self._play, self._folder, self._take, self.runs = play, folder, None, True

    def handle(self, event: EngineEvent) -> None:
        """Handle one event of the engine."""
        if self.runs:
            self._play.handle(event)
        else:
            self._play.heard.handle(event)

    def advance(self, now_ns: int) -> None:
        """Move on to `now_ns`."""
        if self.runs:
            self._play.advance(now_ns)

    def finish(self, engine: EngineLink) -> StationError | None:
        """End the take and keep it; returns what went wrong."""
        fault = end(engine, self._play)
        self._end_ns = self._play.at_ns or 0
        self.runs = False
        self._take = Performance.from_hits(self._play.hits)
        if self._folder is not None:
            try:
                unkept = self._folder.keep_take(self._play.document(self._store.now.student))
                fault = fault or (None if unkept is None else DeviceError(unkept))
            except StationError as refused:
                fault = refused
        return fault

    @property
    def folder(self) -> Path | None:
        """Where the last take is kept."""
        return None if self._folder is None else self._folder.path

    def recall(self, take: Performance, click: FreeClick) -> Listening | None:
        """Have a take of another day in place of the last one, ready to sound; None where nothing was struck in it."""
        self._play, self._folder, self._take = FreePlay(click, self._latency), None, take
        self._end_ns = int(take.hits["at_ns"][-1]) if len(take) else 0
        return listening_back(take, click)

    # --- listening back ----------------------------------------------------------------------------------------------

    def listening(self) -> Listening | None:
        """The capture of the last take, ready to sound; None where there is none. Raises `StationError`."""
        if self.take is None:
            return None
        self._take = take_of(read_capture(self.take), self._latency, self._play.heard.output)
        return listening_back(self._take, self._play.click)

    # --- pictures ----------------------------------------------------------------------------------------------------

    def snapshot(self, kit: Kit, now_ns: int, heard_ns: int | None = None) -> Snapshot:
        """The kit, what was struck just now, and the strip; `heard_ns` is the place in the take that sounds."""
        at_ns = self._play.at_ns if self.runs else heard_ns if heard_ns is not None else self._end_ns
        shown = strikes(self._play.heard.recent, now_ns)
        if heard_ns is not None:
            shown += self._sounding(heard_ns)
        return Snapshot(
            score=_NO_SCORE,
            position_s=(at_ns or 0) / NS_PER_S,
            kit=kit,
            figure=self._figure,
            strikes=shown,
            hud=self._hud(at_ns, heard_ns is not None),
            strip=Strip(self._strokes(), self._beat_s, BEATS),
        )

    @property
    def _beat_s(self) -> float | None:
        click = self._play.click
        return None if click.pattern is None else click.beat_ns / NS_PER_S

    def _strokes(self) -> Performance:
        """What the strip shows."""
        if self._take is not None:
            return self._take
        count = len(self._play.hits)
        if count != self._shown[0]:
            self._shown = count, Performance.from_hits(self._play.hits[-IN_SIGHT:])
        return self._shown[1]

    def _sounding(self, heard_ns: int) -> tuple[SeenStrike, ...]:
        if self._take is None:
            return ()
        first, last = np.searchsorted(self._take.hits["at_ns"], (heard_ns - STRIKE_SHOWN_NS, heard_ns + 1)).tolist()
        struck = (self._take[index] for index in range(first, last))
        return tuple(SeenStrike(hit.piece, hit.velocity, (heard_ns - hit.at_ns) / NS_PER_S) for hit in struck)

    def _hud(self, at_ns: int | None, is_heard: bool) -> Hud:
        click, strokes = self._play.click, len(self._play.hits if self._take is None else self._take)
        counted = f"{strokes} stroke{'' if strokes == 1 else 's'}"
        words = replay_place(counted).words if is_heard else f"Recording: {counted}"
        if not self.runs and not is_heard:
            words = f"{counted} kept" if self._take is not None else "Ready"
        place = None
        if (self.runs or is_heard) and click.pattern is not None and at_ns is not None and at_ns >= 0:
            place = divmod(int(at_ns // click.beat_ns), BEATS)
        return Hud(
            TITLE,
            words,
            bar=None if place is None else place[0] + 1,
            beat=None if place is None else place[1] + 1,
            beats=BEATS,
            beats_a_minute=click.tempo_bpm if click.pattern is not None else None,
        )
