"""The beat told before it is certain, so that sensor and loudspeaker have time: from the stroke itself, and the loop.

A hit that has sounded cannot be taken back, so nothing is foretold that is not sure:

* by the stroke: the way from a stroke's fastest point to its beat is the player's own habit. Once the tip is being
  braked, as hard as in earlier strokes of like speed, its beat comes where theirs came, if they agreed;
* by the loop: where the phase of a repeated motion is known (`PhaseEstimate`), and strokes of this hand have come at
  one phase loop after loop, a stroke that has begun is expected there.

A forecast that no beat follows clears what was learnt: six strokes must agree anew.
"""

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from statistics import fmean, median, pstdev
from typing import NamedTuple

from station.core.events import PhaseEstimate
from station.core.units import NS_PER_MS, NS_PER_S
from station.sync.air.air_strokes import BRAKED, AirBeat, brake_of
from station.sync.air.air_swing import Swing, wrapped
from station.sync.air.air_zones import AirZone

AGREE_NS = 5 * NS_PER_MS
"""Forecasts scatter by no more: half of what is full marks, 10 ms (HUMANS)."""
FEWEST_STROKES = 6
"""So many strokes of like speed must agree (our choice: their deviation is then known to a third)."""
_LIKE_SPEED = 1.5
"""Strokes whose speeds differ by no more than this factor are alike: 3.5 dB (our choice)."""
_KEPT = 48
"""So many strokes are remembered (our choice: half a minute of eighths)."""
_AS_HARD = 0.5
"""Braked at least at this share of the usual (our choice)."""
FEWEST_LOOPS = 3
"""So often a stroke must have come at one place of the loop (our choice)."""
_SAME_PLACE_NS = 40 * NS_PER_MS
"""Strokes of a hand that come nearer to each other in the loop are at one place: no hand strikes twice within a flam's
15–40 ms (HUMANS)."""
_SURE_PHASE = 0.8
"""The confidence from which the phase counts (our choice, as for zones)."""
_AS_FAST = 0.7
"""The stick must fall with this share of the speed that it usually has there (our choice)."""
_PLACES = 64
"""So many places of a loop are remembered; our choice: sixteenths of four bars."""


class _Habit(NamedTuple):
    speed_m_s: float
    lead_ns: int
    brake_m_s2: float


class StrokeForecast:
    """What one hand's strokes have shown of the way from their fastest point to the beat."""

    def __init__(self) -> None:
        self._habits: deque[_Habit] = deque(maxlen=_KEPT)
        self._braked: tuple[int, float] | None = None

    def beat_ns(self, fastest: Swing, now: Swing) -> int | None:
        """When the beat of a stroke that is being braked comes, or None where that is not sure."""
        if now.speed_m_s >= BRAKED * fastest.speed_m_s:
            return None
        if self._braked is None or self._braked[0] != fastest.at_ns:
            self._braked = fastest.at_ns, brake_of(fastest, now)
        like = [each for each in self._habits if 1 / _LIKE_SPEED <= each.speed_m_s / fastest.speed_m_s <= _LIKE_SPEED]
        leads = [each.lead_ns for each in like]
        if len(like) < FEWEST_STROKES or pstdev(leads) > AGREE_NS:
            return None
        usual = median(each.brake_m_s2 for each in like)
        return fastest.at_ns + round(median(leads)) if self._braked[1] >= _AS_HARD * usual else None

    def told(self, beat: AirBeat) -> None:
        """A stroke's beat has become certain."""
        if self._braked is not None and self._braked[0] == beat.fastest_ns:
            self._habits.append(_Habit(beat.speed_m_s, beat.at_ns - beat.fastest_ns, self._braked[1]))
        self._braked = None

    def failed(self) -> None:
        """No beat followed a forecast."""
        self._habits.clear()


@dataclass(slots=True)
class LoopPlace:
    """Where in the loop a hand strikes: the zone, and of each stroke its phase after the first, speed, elevation."""

    phase_rad: float
    zone: AirZone
    offsets_rad: deque[float]
    speeds_m_s: deque[float]
    elevations_rad: deque[float]

    @property
    def speed_m_s(self) -> float:
        """The tip's usual speed there."""
        return median(self.speeds_m_s)

    @property
    def elevation_rad(self) -> float:
        """The stick's usual elevation at the beat."""
        return median(self.elevations_rad)


class LoopForecast:
    """At which phases of a repeated motion one hand has struck, and when it will be there again."""

    def __init__(self) -> None:
        self._phase: PhaseEstimate | None = None
        self._places: list[LoopPlace] = []

    def phase(self, estimate: PhaseEstimate) -> None:
        """Where the loop is; what is not locked, sure and going forward counts as not known."""
        is_known = estimate.locked and estimate.confidence >= _SURE_PHASE and estimate.cadence_rad_s > 0.0
        self._phase = estimate if is_known else None

    def told(self, beat: AirBeat, zone: AirZone) -> None:
        """A stroke's beat and zone have become certain."""
        if self._phase is None:
            return
        phase = self._phase_at(self._phase, beat.at_ns)
        reach = _SAME_PLACE_NS / NS_PER_S * self._phase.cadence_rad_s / 2.0
        for place in self._places:
            offset = wrapped(phase - place.phase_rad)
            if place.zone is zone and abs(offset - fmean(place.offsets_rad)) <= reach:
                place.offsets_rad.append(offset)
                place.speeds_m_s.append(beat.speed_m_s)
                place.elevations_rad.append(beat.elevation_rad)
                return
        if len(self._places) < _PLACES:
            self._places.append(LoopPlace(phase, zone, _few(0.0), _few(beat.speed_m_s), _few(beat.elevation_rad)))

    def beat_ns(self, fastest: Swing, now: Swing) -> tuple[int, LoopPlace] | None:
        """When and where the stroke that falls now is expected, or None where that is not sure."""
        if self._phase is None:
            return None
        here, cadence = self._phase_at(self._phase, now.at_ns), self._phase.cadence_rad_s
        coming = [(self._ahead(place, here) / cadence, place) for place in self._places]
        near = [(ahead_s, place) for ahead_s, place in coming if ahead_s * NS_PER_S <= 2 * _SAME_PLACE_NS]
        if len(near) != 1 or not _is_steady(near[0][1].offsets_rad, cadence):
            return None
        ahead_s, place = near[0]
        return (
            (now.at_ns + round(ahead_s * NS_PER_S), place) if fastest.speed_m_s >= _AS_FAST * place.speed_m_s else None
        )

    def failed(self) -> None:
        """No beat followed a forecast."""
        self._places.clear()

    @staticmethod
    def _phase_at(estimate: PhaseEstimate, at_ns: int) -> float:
        return estimate.phase_rad + estimate.cadence_rad_s * (at_ns - estimate.at_ns) / NS_PER_S

    @staticmethod
    def _ahead(place: LoopPlace, phase_rad: float) -> float:
        return (place.phase_rad + fmean(place.offsets_rad) - phase_rad) % (2.0 * pi)


def _few(first: float) -> deque[float]:
    return deque([first], maxlen=2 * FEWEST_STROKES)


def _is_steady(offsets_rad: Sequence[float], cadence_rad_s: float) -> bool:
    return len(offsets_rad) >= FEWEST_LOOPS and pstdev(offsets_rad) / cadence_rad_s * NS_PER_S <= AGREE_NS
