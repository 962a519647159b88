"""A live session in the terminal: the engine's process plays and hears, every stroke is shown as it is judged."""

import sys
from pathlib import Path

from station.core.clock import MonotonicClock
from station.core.errors import DeviceError
from station.core.measured_latency import load_calibration
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.devices.device_ports import no_kit
from station.engine.engine_config import EngineConfig
from station.engine.supervisor import EngineSupervisor
from station.music.judgement import Judgement, Label
from station.practice.control.pad_pause import PadPause
from station.practice.headless.live import LiveOutcome, Room, practise_live, practise_rounds, wait_for_kits
from station.practice.session.adaptation import Adaptation
from station.practice.session.backing_track import Backing, BackingRequest
from station.practice.session.device_latency import latency_of
from station.practice.session.plan import Plan, Segment
from station.practice.session.session import Session
from station.scoring.matching.hit_windows import Windows
from station.sound.track import PreparedTrack

KIT_WAIT_S = 5.0
"""How long to look for a kit before giving up: a USB kit announces itself within two seconds; our choice."""

_MARKS = {Label.MATCH: "·", Label.MISS: "o", Label.EXTRA: "+", Label.WRONG_PIECE: "x", Label.IGNORED: ""}
_GOOD, _EARLY, _LATE = "|", "<", ">"
_LEANS = {-1: _EARLY, 0: _GOOD, 1: _LATE}
LEGEND = f"{_GOOD} on time  {_EARLY} early  {_LATE} late  o missed  x wrong piece  + extra  · hit, its time not shown"


class _Display:
    """Writes to standard error: a line a segment, a mark a judgement, notices between."""

    def __init__(self, paused_words: str) -> None:
        self._paused_words = paused_words
        self._paused = False
        self._session: Session | None = None
        self._segment: Segment | None = None
        self._told = 0

    def tell(self, session: Session, judged: tuple[Judgement, ...]) -> None:
        """Show what is new."""
        if session is not self._session:
            self._session, self._segment, self._told = session, None, 0
        for notice in session.heard.notices[self._told :]:
            self._line(f"\n{notice}")
        self._told = len(session.heard.notices)
        state = session.state()
        if state.transport_ns is not None and state.segment != self._segment:
            if self._segment is None and session.message:
                self._line(f"\n{session.message}")
            self._segment = state.segment
            self._line(f"\n{session.plan.words(state.segment):14}")
        marks = "".join(_mark(verdict, session.windows) for verdict in session.told(judged))
        if marks:
            self._line(marks)
        if session.paused and not self._paused:
            self._line(f"\n{self._paused_words}\n")
        self._paused = session.paused

    def last_words(self, first: Session) -> None:
        """Show what is still untold of the session that ran last, `first` where none did."""
        self.tell(self._session or first, ())

    @staticmethod
    def _line(text: str) -> None:
        sys.stderr.write(text)
        sys.stderr.flush()


def _mark(verdict: Judgement, windows: Windows) -> str:
    if verdict.label is not Label.MATCH or verdict.asynchrony_ns is None:
        return _MARKS[verdict.label]
    return _LEANS[windows.lean(verdict.asynchrony_ns / NS_PER_MS)]


def practise_in_terminal(
    asked: Plan | Adaptation, settings: Settings, capture: Path, wish: BackingRequest | None = None
) -> LiveOutcome:
    """Practise a plan, along to a track if one is wished for, or what an adaptation asks for pass by pass.

    Raises `BadInput` for a track that cannot be had, `DeviceError` where there is no kit, or where the engine dies
    before it began.
    """
    latency = latency_of(settings, load_calibration())
    session = Session(asked, latency) if isinstance(asked, Plan) else asked.session(latency)
    attended = sys.stdin.isatty() and sys.stderr.isatty()
    pads = PadPause(settings, session.plan.score, whole=isinstance(asked, Adaptation), attended=attended)
    display = _Display(pads.words)
    clock = MonotonicClock()
    config = EngineConfig.from_settings(settings)
    sys.stderr.write("looking for a kit and a sound output …\n")
    with EngineSupervisor(config) as engine:
        wait_for_kits(engine, session, clock, KIT_WAIT_S, len(config.kits))
        if not session.heard.devices:
            raise DeviceError(f"{no_kit(config.kits)}; station practice --virtual-student intermediate needs none")
        try:
            if len(session.heard.devices) < len(config.kits):
                here = ", ".join(session.heard.devices)
                sys.stderr.write(f"\nof {len(config.kits)} kits there is {here}; the others may come")
            sys.stderr.write(f"\n{LEGEND}\n")
            if wish is not None:
                session.backing = _track(wish, session, settings)
            room = Room(engine, clock, display.tell, pads)
            if isinstance(asked, Plan):
                return practise_live(room, session, capture)
            return practise_rounds(room, asked, session, capture)
        finally:
            display.last_words(session)
            sys.stderr.write("\n")


def _track(wish: BackingRequest, session: Session, settings: Settings) -> PreparedTrack | None:
    sys.stderr.write("\nmaking the track ready …\n")
    backing = Backing(wish)
    backing.ask(session.plan, session.heard.rate_hz or settings.rate_hz)
    return backing.take(wait_s=None)
