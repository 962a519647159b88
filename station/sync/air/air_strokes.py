"""Strokes in the air: the beat that was meant, found in the motion of one stick.

Nothing stops a stick in the air but the player, and what they mean by "now" is the sharp stop: the peak of the
acceleration's magnitude. L. Dahl, "Triggering sounds from discrete air gestures: what movement feature has the best
timing?", NIME 2014, measured it: that peak comes at the same time whatever the tempo, while the end of the movement
(the lowest point) comes after the beat, at a time that varies with the tempo. He measured hands; here it is the
stick's tip, where it is sharpest and does not depend on where the sensor sits.

A stroke is: the tip falls (`STARTS_M_S`) and loses much of its speed within a moment. The peak of acceleration counts
from the fastest point on, for the push that starts a stroke has a peak of its own. A stick that turns sideways, is
lowered or twirled, or comes up, makes none. The next one needs the stick to have risen again: armed by angle, not by
time.
"""

from enum import Enum, auto
from math import radians
from typing import NamedTuple

from station.core.units import NS_PER_MS, NS_PER_S
from station.sync.air.air_swing import Swing, wrapped

STARTS_M_S = 0.2
"""A tip that falls so fast may be a stroke; our choice: not quite half of the slowest one."""
SLOWEST_M_S = 0.45
"""At least so fast is a stroke: a free fall from an inch, the lowest ghost's height (our choice), ends at 0.7 m/s; a
third of a tip's speed is its hand's (HUMANS)."""
LEAST_FALL_RAD = radians(4.0)
"""An inch at the tip of a stick that turns a third from its butt (HUMANS): lower than any stroke that is meant."""
_DOWNWARD = 0.5
"""Share of the tip's speed that goes down where it is fastest: within 60° of the vertical (our choice)."""
BRAKED = 0.9
"""Below this share of its greatest speed a tip is being braked: beyond what noise does (our choice)."""
_STOPPED = 0.6
"""Below this share a stroke is told from a fall that goes on; our choice: a bell-shaped brake peaks at half."""
_PAST_PEAK = 0.97
"""Acceleration below this share of its highest is past the peak: beyond what noise does (our choice)."""
_TURNED_BACK = 0.5
"""A stick that goes up at this share of the speed it fell with has struck, wherever its peak was (our choice)."""
_LONGEST_STOP_NS = 25 * NS_PER_MS
"""From `BRAKED` to `_STOPPED` a stroke takes no longer. A hand that goes to and fro at 3 Hz would take so long, one at
5–7 Hz (HUMANS) 11–15 ms; a stick that is lowered within a quarter of a second takes 31 (by minimum jerk)."""
_LONGEST_BRAKE_NS = 250 * NS_PER_MS
"""Longer is no stop; our choice: a second's quarter is two strokes of a fast hand (HUMANS: 5–7 Hz)."""
_RISEN_RAD = radians(1.0)
"""A stick that has risen by this may strike again: soft strokes in quick succession hardly rise (our choice; the next
fall must be longer anyway)."""
_FEWEST_SAMPLES = 4
"""Fewer samples from the start of a fall to its end cannot show that it sped up and was stopped (our choice)."""


def most_strokes_hz(rate_hz: float) -> float:
    """How many strokes a second of one stick a sensor's rate tells apart: each falls and rises in as many samples."""
    return rate_hz / (2.0 * _FEWEST_SAMPLES)


class _State(Enum):
    SPENT = auto()
    """Has struck, and has not risen since."""
    LOWERED = auto()
    """Has fallen and was slowed too gently for a stroke; falls on."""
    ARMED = auto()
    FALLS = auto()
    BRAKES = auto()


class AirBeat(NamedTuple):
    """A stroke in the air: when it was meant, and how the stick stood then.

    `told_ns` is the sample at which it was certain; the tip was fastest at `fastest_ns`, with `speed_m_s`.
    """

    at_ns: int
    told_ns: int
    fastest_ns: int
    speed_m_s: float
    heading_rad: float
    elevation_rad: float


class AirStrokes:
    """Finds the strokes of one stick, a sample at a time; `unresolved` counts those too quick for its samples."""

    def __init__(self) -> None:
        self.unresolved = 0
        self._state = _State.ARMED
        self._top_rad = self._lowest_rad = 0.0
        self._slowest_m_s = 0.0
        self._samples = 0
        self._since_fastest: list[Swing] = []

    @property
    def goes_on(self) -> bool:
        """Whether the tip falls or is being braked."""
        return bool(self._since_fastest)

    def begun(self, swing: Swing) -> Swing | None:
        """The fastest point of a stroke that goes on with this sample, the last that was fed, or None without one."""
        return self._since_fastest[0] if self._since_fastest and self._is_swung(swing) else None

    def feed(self, swing: Swing) -> AirBeat | None:
        """The stroke that is certain with this sample, or None."""
        if self._state is _State.SPENT:
            self._rest(swing)
        elif self._state is _State.LOWERED:
            self._lower(swing)
        elif self._state is _State.ARMED:
            self._wait(swing)
        else:
            return self._follow(swing)
        return None

    def _rest(self, swing: Swing) -> None:
        self._lowest_rad = min(self._lowest_rad, swing.elevation_rad)
        if swing.elevation_rad - self._lowest_rad >= _RISEN_RAD:
            self._state, self._top_rad = _State.ARMED, swing.elevation_rad

    def _lower(self, swing: Swing) -> None:
        self._slowest_m_s = min(self._slowest_m_s, swing.down_m_s)
        if swing.down_m_s < STARTS_M_S or BRAKED * swing.down_m_s > self._slowest_m_s:
            self._state = _State.ARMED
            self._wait(swing)

    def _wait(self, swing: Swing) -> None:
        self._top_rad = max(self._top_rad, swing.elevation_rad)
        if swing.down_m_s >= STARTS_M_S:
            self._state, self._samples, self._since_fastest = _State.FALLS, 1, [swing]

    def _follow(self, swing: Swing) -> AirBeat | None:
        """A sample of the fall or of what brakes it."""
        self._samples += 1
        fastest = self._since_fastest[0]
        if swing.speed_m_s >= fastest.speed_m_s and swing.down_m_s > 0.0:
            self._state, self._since_fastest = _State.FALLS, [swing]
            return None
        self._since_fastest.append(swing)
        if swing.speed_m_s < BRAKED * fastest.speed_m_s:
            self._state = _State.BRAKES
        if swing.at_ns - fastest.at_ns > _LONGEST_BRAKE_NS:
            self._lowered(swing)
            return None
        return self._told(swing) if self._state is _State.BRAKES else None

    def _told(self, swing: Swing) -> AirBeat | None:
        fastest = self._since_fastest[0]
        if swing.speed_m_s > _STOPPED * fastest.speed_m_s and swing.down_m_s > 0.0:
            return None
        hardest = max(range(len(self._since_fastest)), key=lambda index: self._since_fastest[index].jolt_m_s2)
        past = swing.jolt_m_s2 <= _PAST_PEAK * self._since_fastest[hardest].jolt_m_s2
        if not past and swing.down_m_s > -_TURNED_BACK * fastest.down_m_s:
            return None
        if not self._is_stroke(swing):
            self._lowered(swing)
            return None
        beat = self._beat(hardest)
        self._state, self._lowest_rad, self._since_fastest = _State.SPENT, swing.elevation_rad, []
        return beat

    def _lowered(self, swing: Swing) -> None:
        self._state, self._slowest_m_s, self._since_fastest = _State.LOWERED, swing.down_m_s, []

    def _is_stroke(self, swing: Swing) -> bool:
        """Whether the fall that this sample ends was meant to strike."""
        braked_ns, stopped_ns = self._passed_ns(BRAKED), self._passed_ns(_STOPPED)
        is_stopped = braked_ns is not None and stopped_ns is not None and stopped_ns - braked_ns <= _LONGEST_STOP_NS
        meant = is_stopped and self._is_swung(swing)
        if meant and self._samples < _FEWEST_SAMPLES:
            self.unresolved += 1
            return False
        return meant

    def _passed_ns(self, share: float) -> int | None:
        """When the tip first had less than this share of its greatest speed, between samples; None if it has more."""
        run, below = self._since_fastest, share * self._since_fastest[0].speed_m_s
        after = next((index for index, swing in enumerate(run) if swing.speed_m_s <= below), None)
        if after is None:
            return None
        one, other = run[after - 1], run[after]
        part = (one.speed_m_s - below) / (one.speed_m_s - other.speed_m_s)
        return one.at_ns + round((other.at_ns - one.at_ns) * part)

    def _is_swung(self, swing: Swing) -> bool:
        """Whether it fell as fast, as straight down and as far as a stroke does."""
        fastest = self._since_fastest[0]
        is_fast = fastest.speed_m_s >= SLOWEST_M_S and fastest.down_m_s >= _DOWNWARD * fastest.speed_m_s
        return is_fast and self._top_rad - swing.elevation_rad >= LEAST_FALL_RAD

    def _beat(self, hardest: int) -> AirBeat:
        """The stroke whose acceleration was greatest at this sample since the fastest one."""
        run = self._since_fastest
        offset = (
            _vertex(*(each.jolt_m_s2 for each in run[hardest - 1 : hardest + 2])) if 0 < hardest < len(run) - 1 else 0.0
        )
        beside = run[hardest + (1 if offset > 0 else -1)] if offset else run[hardest]
        share, near = abs(offset), run[hardest]
        return AirBeat(
            near.at_ns + round(share * (beside.at_ns - near.at_ns)),
            run[-1].at_ns,
            run[0].at_ns,
            run[0].speed_m_s,
            near.heading_rad + share * wrapped(beside.heading_rad - near.heading_rad),
            near.elevation_rad + share * (beside.elevation_rad - near.elevation_rad),
        )


def brake_of(fastest: Swing, now: Swing) -> float:
    """How hard the tip has been braked since its fastest point, m/s²; `now` is later."""
    return (fastest.speed_m_s - now.speed_m_s) * NS_PER_S / (now.at_ns - fastest.at_ns)


def _vertex(before: float, peak: float, after: float) -> float:
    """Where between its neighbours a parabola through three equidistant values is highest, −0.5 … 0.5 samples."""
    bend = before - 2.0 * peak + after
    return 0.5 * (before - after) / bend if bend < 0.0 else 0.0
