"""Ways through a score, as people take them: from the middle, with skips, repeats, stops and fresh starts.

A way is a list of legs: each is played from its `first` to its `last` tick, after a silence or none.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.music.score import Score

Indices = NDArray[np.int64]
Rng = np.random.Generator

LATE_START_S = 12.0
"""Who begins in the middle begins so late in the written music, at least: there a search from the start is over."""
_ON_A_BAR = 0.6
"""Most who begin in the middle begin with a bar; our choice."""
_ALONE_S, _ALONE_BARS = 5.0, 2
"""Nobody changes place twice within so much music, so that an ear has something to go by."""
_SOON_S = 15.0
"""A player who may turn does so within this time, so that several turns find room in a minute."""
_SILENCE_S = 1.5, 6.0
"""How long who stopped stays silent."""
_MOST_BARS = 4
"""No skip and no repeat is of more bars: a line of music."""
_RESUMED = 0.92, 1.08
"""After a silence nobody without a click finds their tempo again but for some percent; our choice."""


@dataclass(frozen=True, slots=True)
class Leg:
    """What is played without a break: ticks `first` to `last` (without), after `wait_s` of silence.

    `speed` is that of the leg against the player's own.
    """

    first: int
    last: int
    wait_s: float = 0.0
    speed: float = 1.0


@dataclass(frozen=True, eq=False)
class Places:
    """Where a path may turn: the ticks of all bars and beats of a score, the end among them."""

    score: Score
    bars: Indices
    beats: Indices

    @classmethod
    def of(cls, score: Score) -> "Places":
        """Bars and counted beats (a dotted quarter in 6/8 and 12/8)."""
        bars = [score.tempo_map.bar_start(bar) for bar in range(score.bar_count)]
        meter = score.tempo_map.meter_at(0)
        by = 3 if meter.unit == 8 and meter.beats % 3 == 0 else 1
        beats = [tick for tick, index in score.tempo_map.beats_between(0, score.end_tick) if index % by == 0]
        return cls(score, np.array([*bars, score.end_tick]), np.array([*beats, score.end_tick]))

    @property
    def beat_s(self) -> float:
        """Length of a counted beat."""
        return self.seconds(int(self.beats[0]), int(self.beats[1]))

    def seconds(self, first: int, last: int) -> float:
        """Written time between two ticks."""
        at = self.score.tempo_map.seconds_at(np.array([first, last]))
        return float(at[1] - at[0])

    def after(self, tick: int, seconds: float, bars: int = 0) -> int:
        """The first tick that is so long, and so many bars, after `tick`."""
        by_time = int(self.score.tempo_map.ticks_at(self.score.tempo_map.seconds_at(tick) + seconds))
        return max(by_time, tick + bars * int(self.bars[1] - self.bars[0]))

    def alone_after(self, tick: int) -> int:
        """The first tick at which a player who came to `tick` may turn again."""
        return self.after(tick, _ALONE_S, _ALONE_BARS)


Turn = Callable[[Rng, Places, int], tuple[int, int, float] | None]
"""From the tick at which the player may turn on: where they turn, where they go, and how long they wait; None where the
score is too short for it."""


def _pick(rng: Rng, places: Indices, low: int, high: int) -> int | None:
    """One of `places` within [low, high]."""
    near = places[(places >= low) & (places <= high)]
    return int(rng.choice(near)) if len(near) else None


def _last_turn(places: Places) -> int:
    """The last tick after which there is music enough to tell where a player went."""
    ends = places.beats[[places.alone_after(int(b)) <= places.score.end_tick for b in places.beats]]
    return int(ends[-1]) if len(ends) else 0


def _turn_at(rng: Rng, places: Places, among: Indices, low: int) -> int | None:
    """Where to turn: soon after `low`, so that several turns find room."""
    return _pick(rng, among, low, min(places.after(low, _SOON_S), _last_turn(places)))


def _skip(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.bars, low)
    to = None if at is None else _pick(rng, places.bars, at + 1, places.after(at, 0.0, _MOST_BARS))
    return None if at is None or to is None or to > _last_turn(places) else (at, to, 0.0)


def _skip_beats(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.beats, low)
    to = None if at is None else _pick(rng, places.beats, at + 1, places.after(at, 0.0, 1) - 1)
    return None if at is None or to is None or to > _last_turn(places) else (at, to, 0.0)


def _repeat(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.bars, low)
    to = None if at is None else _pick(rng, places.bars, max(0, 2 * at - places.after(at, 0.0, _MOST_BARS)), at - 1)
    return None if at is None or to is None else (at, to, 0.0)


def _restart(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
    at = _turn_at(rng, places, places.beats, max(low, 1))
    return None if at is None else (at, 0, 0.0)


def _stop_to(where: Callable[[Places, int], int]) -> Turn:
    def stop(rng: Rng, places: Places, low: int) -> tuple[int, int, float] | None:
        at = _turn_at(rng, places, places.beats, max(low, 1))
        return None if at is None else (at, where(places, at), float(rng.uniform(*_SILENCE_S)))

    return stop


def _bar_back(places: Places, at: int) -> int:
    return int(places.bars[max(0, int(np.searchsorted(places.bars, at, side="right")) - 2)])


TURNS: Mapping[str, Turn] = MappingProxyType(
    {
        "skip": _skip,
        "skip_beats": _skip_beats,
        "repeat": _repeat,
        "restart": _restart,
        "stop_go_on": _stop_to(lambda _, at: at),
        "stop_bar_back": _stop_to(_bar_back),
        "stop_beginning": _stop_to(lambda _, at: 0),
    }
)
"""How a player leaves the written way."""


def way(rng: Rng, places: Places, first: int, turns: Sequence[str]) -> list[Leg]:
    """The legs of a player who begins at `first` and turns so, in this order, as far as there is room."""
    legs, at, wait = [], first, 0.0
    for name in turns:
        turn = TURNS[name](rng, places, places.alone_after(at))
        if turn is None:
            continue
        legs.append(Leg(at, turn[0], wait))
        at, wait = turn[1], turn[2]
    return [*legs, Leg(at, places.score.end_tick, wait)]


def beginning(rng: Rng, places: Places) -> int:
    """Somewhere in the middle: on a bar mostly, on any beat sometimes; music enough follows."""
    among = places.bars if rng.random() < _ON_A_BAR else places.beats
    low, end = places.after(0, LATE_START_S), places.score.end_tick
    return _pick(rng, among, low, max(low, end - places.after(0, LATE_START_S))) or 0


def on_click(places: Places, legs: Sequence[Leg]) -> tuple[Leg, ...]:
    """The legs of a player with a click: every silence lasts whole beats."""
    beat_s = places.beat_s
    return tuple(replace(leg, wait_s=round(leg.wait_s / beat_s) * beat_s) for leg in legs)


def resumed(rng: Rng, legs: Sequence[Leg]) -> tuple[Leg, ...]:
    """The legs of a player without a click: whoever stopped goes on at nearly the same tempo."""
    return tuple(replace(leg, speed=float(rng.uniform(*_RESUMED))) if leg.wait_s else leg for leg in legs)
