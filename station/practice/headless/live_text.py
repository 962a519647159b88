"""A session as a terminal shows it while it is played: a line a segment, a mark a judgement, notices between."""

from collections.abc import Callable, Mapping, Sequence
from typing import assert_never

from station.core.labels import limb_name
from station.core.pieces import Limb
from station.core.units import NS_PER_MS
from station.music.judgement import Judgement, Label
from station.practice.now.directions_now import direction_of
from station.practice.now.entry_now import entry_words
from station.practice.now.whereabouts import Doing, whereabouts
from station.practice.session.session import Session
from station.scoring.matching.hit_windows import Level, Windows

_EARLY, _ON_TIME, _LATE = "<", "|", ">"
_OF_LEAN = {-1: _EARLY, 0: _ON_TIME, 1: _LATE}
_UNTIMED, _MISS, _WRONG_PIECE, _EXTRA, _TAKEN_BACK, _IGNORED, _UNKNOWN = "·", "o", "x", "+", "~", "", "?"
_UNPLAYED = {
    Label.MISS: _MISS,
    Label.EXTRA: _EXTRA,
    Label.WRONG_PIECE: _WRONG_PIECE,
    Label.PENDING: _TAKEN_BACK,
    Label.UNKNOWN: _UNKNOWN,
}
LEGEND = (
    f"{_ON_TIME} on time  {_EARLY} early  {_LATE} late  {_MISS} missed  {_WRONG_PIECE} wrong piece  {_EXTRA} extra  "
    f"{_TAKEN_BACK} taken back  {_UNTIMED} hit, its time not shown  {_UNKNOWN} not heard"
)


def level_words(level: Level) -> str:
    """How strictly the marks are set."""
    return f"judged as {level}: on time is within {level.on_time_ms:g} ms"


def mark_of(verdict: Judgement, windows: Windows) -> str:
    """The mark of a verdict; none of a hit that nobody counts."""
    match verdict.label:
        case Label.MATCH:
            asynchrony_ns = verdict.asynchrony_ns
            return _UNTIMED if asynchrony_ns is None else _OF_LEAN[windows.lean(asynchrony_ns / NS_PER_MS)]
        case Label.IGNORED | Label.PLAYED_AGAIN:
            return _IGNORED
        case Label.MISS | Label.EXTRA | Label.WRONG_PIECE | Label.PENDING | Label.UNKNOWN as label:
            return _UNPLAYED[label]
        case _:
            assert_never(verdict.label)


class LiveText:
    """Hands `write` what is new; `ways_on` are the ways out of a pause, in words."""

    def __init__(self, write: Callable[[str], None], ways_on: Sequence[str]) -> None:
        self._write = write
        self._paused_words = f"paused: {' or '.join(ways_on)} to go on, Ctrl-C to end"
        self._paused = False
        self._session: Session | None = None
        self._where = ""
        self._shown = 0
        self._sensors: set[str] = set()
        self._said = self._entry = ""

    def show(self, session: Session, judged: tuple[Judgement, ...]) -> None:
        """Show what is new in `session`."""
        if session is not self._session:
            self._session, self._where, self._shown = session, "", 0
        notices = session.heard.notices[self._shown :]
        self._shown += len(notices)
        for notice in notices:
            self._write(f"\n{notice}")
        self._show_sensors(session.heard.sensors)
        self._show_segment(session)
        self._show_words(session)
        self._show_entry(session)
        marks = "".join(mark_of(verdict, session.plan.level.windows) for verdict in session.shown(judged))
        if marks:
            self._write(marks)
        if session.paused and not self._paused:
            self._write(f"\n{self._paused_words}\n")
        self._paused = session.paused

    def _show_sensors(self, sensors: Mapping[str, Limb]) -> None:
        """Say which sensors on sticks are here: nothing else in a terminal tells that one is heard."""
        for device in [device for device in sensors if device not in self._sensors]:
            hand = f", on the stick in the {limb_name(sensors[device])}" if sensors[device].is_hand else ""
            self._write(f"\n{device} is here{hand}")
        self._sensors = set(sensors)

    def _show_segment(self, session: Session) -> None:
        where = whereabouts(session)
        if where.words == self._where or where.doing in (Doing.READY, Doing.PAUSED, Doing.WAITING):
            return
        if not self._where and session.message:
            self._write(f"\n{session.message}")
        self._where = where.words
        self._write(f"\n{where.words:14}")

    def _show_entry(self, session: Session) -> None:
        """That the student came in beside the click, once as it is found."""
        words = entry_words(session)
        if words and words != self._entry:
            self._write(f"\n{words}\n{'':14}")
        self._entry = words

    def _show_words(self, session: Session) -> None:
        """The teacher's words, once as they come."""
        said = direction_of(session).say
        if said and said != self._said:
            self._write(f"\n{said}\n{'':14}")
        self._said = said

    def last_words(self, first: Session) -> None:
        """Show what is not yet shown of the session that ran last, `first` where none did, and end the line."""
        self.show(self._session or first, ())
        self._write("\n")
