"""Where are we: ready, counted in, shown, in which pass, paused, waited for, or hearing something again."""

from dataclasses import dataclass
from enum import Enum, auto

from station.core.units import NS_PER_S, PPQ
from station.music.tempo import BarPosition
from station.practice.session.plan import Phase, Plan
from station.practice.session.session import Session


class Doing(Enum):
    """What is going on."""

    READY = auto()
    COUNT_IN = auto()
    DEMONSTRATION = auto()
    PASS = auto()
    PAUSED = auto()
    WAITING = auto()
    """The score waits for the student, who sets the tempo."""
    STOPPED = auto()
    """Ended before all was played."""
    REPLAY = auto()
    OVER = auto()


_WORDS = {
    Doing.READY: ("Ready", "Ready"),
    Doing.COUNT_IN: ("Count-in", "Count-in to p{}"),
    Doing.DEMONSTRATION: ("Demonstration", "Demonstration"),
    Doing.PASS: ("Playing", "P{}"),
    Doing.PAUSED: ("Paused", "Paused in p{}"),
    Doing.WAITING: ("Waiting for you", "P{}, waiting for you"),
    Doing.STOPPED: ("Stopped", "Stopped in p{}"),
    Doing.OVER: ("Over", "Over"),
}
"""What is said of each outside a pass, and with the pass."""


@dataclass(frozen=True, slots=True)
class Whereabouts:
    """What goes on: `number` of `passes` (from 1; 0 outside them), and in a pass that has its bars several times which.

    `bar` and `beat` count from 1 as the lesson does, None where there is none; a count-in has beats alone. `percent` is
    the speed of a demonstration, `whose` who is heard in a replay, in words.
    """

    doing: Doing
    number: int = 0
    passes: int = 0
    time: int = 1
    times: int = 1
    bar: int | None = None
    beat: int | None = None
    percent: int = 100
    whose: str = ""

    @property
    def words(self) -> str:
        """What is going on, for people."""
        if self.doing is Doing.REPLAY:
            return f"Replay of {f'bar {self.bar}' if self.bar else 'your take'}: {self.whose}"
        if self.doing is Doing.DEMONSTRATION and self.percent != 100:
            return f"Demonstration at {self.percent} %"
        alone, in_pass = _WORDS[self.doing]
        often = "" if self.times == 1 else f", time {self.time} of {self.times}"
        return in_pass.format(f"ass {self.number} of {self.passes}{often}") if self.number else alone

    @property
    def halt(self) -> str:
        """The one word that is to be read from afar while nothing moves, else empty."""
        return {Doing.PAUSED: "Paused", Doing.WAITING: "Waiting for you…"}.get(self.doing, "")


def whereabouts(session: Session) -> Whereabouts:
    """Where a session is."""
    state, plan = session.state(), session.plan
    segment = state.segment
    if state.transport_ns is None:
        return Whereabouts(Doing.READY)
    if segment.phase is Phase.OVER:
        return Whereabouts(Doing.OVER)
    bar, beat = place_of(session)
    led_to = plan.segment_at(segment.end_ns) if segment.phase is Phase.COUNT_IN else segment
    if session.stopped:
        doing = Doing.STOPPED
    elif session.paused:
        doing = Doing.PAUSED
    elif segment.phase is Phase.COUNT_IN:
        doing = Doing.COUNT_IN
    elif segment.phase is Phase.DEMONSTRATION:
        doing = Doing.DEMONSTRATION
    else:
        doing = Doing.WAITING if session.is_waiting else Doing.PASS
    if led_to.phase is not Phase.PASS:
        return Whereabouts(doing, bar=bar, beat=beat)
    if session.series is None:
        return Whereabouts(doing, led_to.index + 1, plan.passes, bar=bar, beat=beat)
    series = session.series
    return Whereabouts(doing, series.index + 1, series.passes, led_to.index + 1, plan.passes, bar, beat)


def place_of(session: Session) -> tuple[int | None, int | None]:
    """The lesson's bar and its beat, from 1, None where none is played; a count-in has beats alone."""
    state, plan = session.state(), session.plan
    segment = state.segment
    if state.transport_ns is None or state.transport_ns < segment.start_ns or segment.phase is Phase.OVER:
        return None, None
    if segment.phase is Phase.COUNT_IN:
        return None, _counted_beat(plan, segment.end_ns, state.transport_ns)
    music, start_ns = plan.music_of(segment)
    at = music.tempo_map.position_at(int(music.tempo_map.ticks_at_ns(state.transport_ns - start_ns)))
    within = at.bar - segment.index * plan.section.bar_count if segment.phase is Phase.PASS else at.bar
    return plan.first_bar + within + 1, at.beat + 1


def _counted_beat(plan: Plan, end_ns: int, at_ns: int) -> int:
    """The beat, from 1, that is counted: a bar of the meter and tempo in which the music begins at `end_ns`."""
    segment = plan.segment_at(end_ns)
    music, start_ns = plan.music_of(segment)
    tempo_map = music.tempo_map
    tick = int(tempo_map.ticks_at_ns(max(end_ns - start_ns, 0)))
    pickup = tempo_map.pickup_ticks(music.end_tick) if tick == 0 else 0
    meter = tempo_map.meter_at(tick + pickup)
    left = round((end_ns - at_ns) * tempo_map.bpm_at(tick) * PPQ / (60 * NS_PER_S))
    return (-left - pickup) // meter.beat_ticks % meter.beats + 1


def demonstration_place(at: BarPosition, percent: int, is_counted_in: bool) -> Whereabouts:
    """Where a demonstration is that goes so many `percent` as fast as written."""
    doing = Doing.COUNT_IN if is_counted_in else Doing.DEMONSTRATION
    return Whereabouts(doing, bar=at.bar + 1, beat=at.beat + 1, percent=percent)


def replay_place(whose: str, bar: int | None = None, beat: int | None = None) -> Whereabouts:
    """Something that was played before is heard again: a bar (from 1) of a result, or without one a take."""
    return Whereabouts(Doing.REPLAY, bar=bar, beat=beat, whose=whose)
