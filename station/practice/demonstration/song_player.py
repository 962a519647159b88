"""The player of a demonstration: where in the song it is at any time, and what its controls do (SMED, figure 4.2).

Pure and exact: a value that is asked for its position at a session time. It anchors the song at one instant and
computes every position from there in whole nanoseconds, so that it never drifts, however seldom or often it is asked.
Every control gives a new value. Song time is nanoseconds from the score's tick 0 at its written tempo, `now_ns` session
time.
"""

from dataclasses import dataclass, replace
from enum import Enum

from station.core.units import PPQ
from station.music.score import Score
from station.music.tempo import BarPosition, TempoMap

FLAGS = 8
"""Places in a song that can be kept (SMED)."""
MIN_SPEED_PERCENT, MAX_SPEED_PERCENT = 10, 200
WIND_PERCENT = 600
"""How fast forward and rewind go, of the written tempo (our choice: a minute in ten seconds)."""


class SongStep(Enum):
    """How far a step goes: to the next line of this grid; `ticks` None where the meter says."""

    SIXTEENTH = ("1/16", PPQ // 4)
    TRIPLET = ("triplet", PPQ // 3)
    EIGHTH = ("1/8", PPQ // 2)
    BEAT = ("beat", None)
    BAR = ("bar", None)

    def __init__(self, words: str, ticks: int | None) -> None:
        self.words = words
        self.ticks = ticks


@dataclass(frozen=True, eq=False)
class Song:
    """The bars that are played: a tempo map and the tick where the last bar ends."""

    tempo_map: TempoMap
    end_tick: int

    @classmethod
    def of(cls, score: Score) -> "Song":
        """The bars of `score`."""
        return cls(score.tempo_map, score.end_tick)

    @property
    def length_ns(self) -> int:
        """Song time of the end."""
        return int(self.tempo_map.ns_at(self.end_tick))

    @property
    def bar_count(self) -> int:
        """How many bars there are."""
        return int(self.tempo_map.bars_at(max(self.end_tick - 1, 0))) + 1

    def bar_start_ns(self, bar: int) -> int:
        """Song time where `bar`, from 0, begins; that after the last begins at the end."""
        return int(self.tempo_map.ns_at(min(self.tempo_map.bar_start(bar), self.end_tick)))

    def span_ns(self, bars: tuple[int, int]) -> tuple[int, int]:
        """From and until when the bars `first` to `last`, from 0, are played."""
        return self.bar_start_ns(bars[0]), self.bar_start_ns(bars[1] + 1)

    def tick_at(self, at_ns: int) -> int:
        """The tick nearest to a song time."""
        return int(self.tempo_map.ticks_at_ns(at_ns))

    def stepped_ns(self, at_ns: int, step: SongStep, way: int) -> int:
        """The next line of the grid after (`way` 1) or before (−1) `at_ns`; the song's ends at its ends."""
        tick = self.tick_at(at_ns)
        if way > 0:
            tick = min(self._line_after(tick, step), self.end_tick)
        elif tick > 0:
            tick = self._line_before(tick, step)
        return int(self.tempo_map.ns_at(tick))

    def _line_after(self, tick: int, step: SongStep) -> int:
        bar, start, ticks = self._grid(tick, step)
        return min(start + ((tick - start) // ticks + 1) * ticks, self.tempo_map.bar_start(bar + 1))

    def _line_before(self, tick: int, step: SongStep) -> int:
        _, start, ticks = self._grid(tick - 1, step)
        return start + (tick - 1 - start) // ticks * ticks

    def _grid(self, tick: int, step: SongStep) -> tuple[int, int, int]:
        """The bar that holds `tick`, where it begins, and the grid's width in it."""
        bar = int(self.tempo_map.bars_at(tick))
        meter = self.tempo_map.meter_at(tick)
        ticks = meter.bar_ticks if step is SongStep.BAR else step.ticks or meter.beat_ticks
        return bar, self.tempo_map.bar_start(bar), ticks


@dataclass(frozen=True, eq=False)
class SongPlayer:
    """A song, where it stood at one instant, and how it has gone on since.

    It stood at song time `at_ns` until session time `since_ns`. `wind` is −1 while it is rewound, 1 while it is wound
    forward. `loop` is the first and last bar, from 0, that are repeated; `flags` the song times that were kept.
    """

    song: Song
    at_ns: int = 0
    since_ns: int = 0
    playing: bool = False
    wind: int = 0
    reverse: bool = False
    speed_percent: int = 100
    loop: tuple[int, int] | None = None
    flags: tuple[int | None, ...] = (None,) * FLAGS

    @property
    def rate_percent(self) -> int:
        """How fast it goes, of the written tempo, negative backwards; 0 while it stands."""
        if self.wind:
            return self.wind * WIND_PERCENT
        if not self.playing:
            return 0
        return -self.speed_percent if self.reverse else self.speed_percent

    @property
    def is_heard(self) -> bool:
        """Whether it plays forward, the one way in which drums can sound."""
        return self.playing and not self.reverse and not self.wind

    @property
    def span_ns(self) -> tuple[int, int]:
        """From and until when it plays: the loop, or the song."""
        return (0, self.song.length_ns) if self.loop is None else self.song.span_ns(self.loop)

    def position_ns(self, now_ns: int) -> int:
        """Where in the song it is."""
        rate = self.rate_percent
        gone_ns = max(now_ns - self.since_ns, 0) * abs(rate) // 100
        at_ns = self.at_ns - gone_ns if rate < 0 else self.at_ns + gone_ns
        low, high = self.span_ns
        if self.loop is None or self.wind or not self.playing:
            return min(max(at_ns, 0), self.song.length_ns)
        return high - (high - at_ns) % (high - low) if rate < 0 else low + (at_ns - low) % (high - low)

    def place(self, now_ns: int) -> BarPosition:
        """Bar and beat, from 0; at the very end those of the last tick."""
        tick = min(self.song.tick_at(self.position_ns(now_ns)), self.song.end_tick - 1)
        return self.song.tempo_map.position_at(max(tick, 0))

    # --- what it does by itself --------------------------------------------------------------------------------------

    def stopped_at_end(self, now_ns: int) -> "SongPlayer":
        """The same, or stopped where it has come to an end of the song."""
        if not self.playing or self.wind or self.loop is not None:
            return self
        end_ns = 0 if self.reverse else self.song.length_ns
        return self.stopped(now_ns) if self.position_ns(now_ns) == end_ns else self

    def started(self, since_ns: int) -> "SongPlayer":
        """The same, standing where it was anchored until `since_ns`: its sound begins then."""
        return replace(self, since_ns=since_ns)

    # --- what the user does ------------------------------------------------------------------------------------------

    def played(self, now_ns: int) -> "SongPlayer":
        """Playing from where it stands: into the loop where it stands outside, anew where it stands at the end."""
        return replace(self._anchored(now_ns), playing=True)._entered()

    def stopped(self, now_ns: int) -> "SongPlayer":
        """Standing where it is."""
        return replace(self._anchored(now_ns), playing=False, wind=0)

    def sought(self, now_ns: int, at_ns: int) -> "SongPlayer":
        """At another place, playing on if it plays; where a loop is played, within it."""
        inside_ns = min(max(at_ns, 0), self.song.length_ns)
        there = replace(self, at_ns=inside_ns, since_ns=now_ns, wind=0)
        return there if self.loop is None else there._entered()

    def stepped(self, now_ns: int, step: SongStep, way: int) -> "SongPlayer":
        """Standing on the next line of the grid, forward (`way` 1) or back (−1)."""
        stands = self.stopped(now_ns)
        return replace(stands, at_ns=self.song.stepped_ns(stands.at_ns, step, way))

    def wound(self, now_ns: int, way: int) -> "SongPlayer":
        """Wound forward (1) or back (−1) from now on; 0 lets go: it goes on as before."""
        return replace(self._anchored(now_ns), wind=way)._entered()

    def at_speed(self, now_ns: int, percent: int) -> "SongPlayer":
        """At another speed from here on, within `MIN_SPEED_PERCENT` … `MAX_SPEED_PERCENT`."""
        within = min(max(percent, MIN_SPEED_PERCENT), MAX_SPEED_PERCENT)
        return replace(self._anchored(now_ns), speed_percent=within)

    def reversed(self, now_ns: int, reverse: bool) -> "SongPlayer":
        """Backwards, or forward again, from here on."""
        return replace(self._anchored(now_ns), reverse=reverse)._entered()

    def looped(self, now_ns: int, bars: tuple[int, int] | None) -> "SongPlayer":
        """Repeating `bars` (first, last, from 0, in either order, held within the song), None for the whole once."""
        if bars is not None:
            last = self.song.bar_count - 1
            first, final = sorted(min(max(bar, 0), last) for bar in bars)
            bars = first, final
        return replace(self._anchored(now_ns), loop=bars)._entered()

    def flagged(self, now_ns: int, slot: int) -> "SongPlayer":
        """With this place kept as flag `slot`, from 0."""
        flags = list(self.flags)
        flags[slot] = self.position_ns(now_ns)
        return replace(self, flags=tuple(flags))

    def at_flag(self, now_ns: int, slot: int) -> "SongPlayer":
        """At the place of flag `slot`; the same where none is kept."""
        at_ns = self.flags[slot]
        return self if at_ns is None else self.sought(now_ns, at_ns)

    # --- inside ------------------------------------------------------------------------------------------------------

    def _anchored(self, now_ns: int) -> "SongPlayer":
        return replace(self, at_ns=self.position_ns(now_ns), since_ns=now_ns)

    def _entered(self) -> "SongPlayer":
        """Within what is played, if it plays: from outside, and from where it would end, it begins anew."""
        if not self.playing or self.wind:
            return self
        low, high = self.span_ns
        if self.reverse:
            return self if low < self.at_ns <= high else replace(self, at_ns=high)
        return self if low <= self.at_ns < high else replace(self, at_ns=low)
