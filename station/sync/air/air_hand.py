"""One hand in the air: its stick's strokes, the zones they mean, and what is told before it is certain."""

from collections import deque
from dataclasses import dataclass
from typing import NamedTuple

from station.core.events import PhaseEstimate
from station.core.imu import Mounting
from station.core.units import NS_PER_S
from station.sync.air.air_latency import LoopForecast, StrokeForecast
from station.sync.air.air_status import AirCounts, AirStatus, status_of
from station.sync.air.air_strokes import AirBeat, AirStrokes
from station.sync.air.air_swing import Swing, SwingReader, wrapped
from station.sync.air.air_zones import AirZone
from station.sync.air.heading_tracker import HeadingTracker
from station.sync.strokes.stick_orientation import LONGEST_GAP_S, StickMotion

_TURNS_ON = 0.75
"""From a forecast to the beat a stick turns on at this share of its rate: a bell-shaped brake has taken half of it by
then (our choice)."""
_PAD_WITHIN_NS = NS_PER_S // 4
"""How old a pad's hit may be when it is told: MIDI and its queue take far less (our choice)."""
_RATE_GAIN = 0.02
"""The mean of some fifty samples' intervals tells the rate (our choice)."""


class AirCall(NamedTuple):
    """A stroke that may sound: its beat, which may lie ahead, its zone, the tip's speed."""

    at_ns: int
    zone: AirZone
    speed_m_s: float


@dataclass(slots=True)
class _Pending:
    """A call that was made before its beat was certain."""

    call: AirCall
    made_ns: int


class AirHand:
    """One hand's stick; `feed` every motion, then `settle` the beat that it brought, or else `foretell`."""

    def __init__(self, mounting: Mounting, zones: tuple[AirZone, ...], ahead_ns: int | None) -> None:
        self.mounting = mounting
        self.tracker = HeadingTracker(zones)
        self._ahead_ns = ahead_ns
        self._strokes = AirStrokes()
        self._by_stroke, self._by_loop = StrokeForecast(), LoopForecast()
        self._reader = SwingReader(mounting.tip_m)
        self._before: StickMotion | None = None
        self._swings: deque[Swing] = deque()
        self._pending: _Pending | None = None
        self._interval_s: float | None = None
        self._counts = AirCounts()

    def feed(self, motion: StickMotion) -> AirBeat | None:
        """The stroke that is certain with this motion, or None."""
        before, self._before = self._before, motion
        if before is not None:
            self._follow(motion.at_ns - before.at_ns)
        swing = self._reader.feed(motion)
        if swing is None:
            return None
        self._swings.append(swing)
        while swing.at_ns - self._swings[0].at_ns > _PAD_WITHIN_NS:
            self._swings.popleft()
        return self._strokes.feed(swing)

    def phase(self, estimate: PhaseEstimate) -> None:
        """Where the loop is that is being played."""
        self._by_loop.phase(estimate)

    def fix(self, at_ns: int, index: int) -> None:
        """The stick pointed at zone `index` at that time, for a pad says so; nothing where that is too long ago."""
        at = next((swing for swing in reversed(self._swings) if swing.at_ns <= at_ns), None)
        if at is not None:
            self.tracker.fix(at.at_ns, index, at.heading_rad)

    def status(self) -> AirStatus:
        """How the hand does."""
        rate_hz = None if not self._interval_s else 1.0 / self._interval_s
        return status_of(
            self._counts, self.tracker.drift_rad, self.tracker.doubt_rad, rate_hz, self._strokes.unresolved
        )

    def settle(self, beat: AirBeat) -> AirCall | None:
        """A stroke is certain: the call for it, unless it was foretold or its zone is unclear."""
        pending, self._pending = self._pending, None
        self._by_stroke.told(beat)
        found = self.tracker.strike(beat.at_ns, beat.heading_rad, beat.elevation_rad)
        if found is not None:
            self._by_loop.told(beat, found[0])
        if pending is not None:
            self._counts.came(beat.told_ns - pending.made_ns, pending.call.at_ns - beat.at_ns)
            return None
        self._counts.told(found is not None)
        return None if found is None else AirCall(beat.at_ns, found[0], beat.speed_m_s)

    def foretell(self) -> AirCall | None:
        """The call for a stroke that has begun and is sure to come, once."""
        if not self._swings:
            return None
        now = self._swings[-1]
        if self._pending is not None:
            self._check()
            return None
        fastest = self._strokes.begun(now)
        if self._ahead_ns is None or fastest is None or len(self._swings) < 2:
            return None
        call = self._by_habit(fastest, now) or self._by_place(fastest, now)
        if call is None or now.at_ns < call.at_ns - self._ahead_ns:
            return None
        self._pending = _Pending(call, now.at_ns)
        self._counts.told(True)
        return call

    # --- inside -------------------------------------------------------------------------------------------------------

    def _follow(self, gone_ns: int) -> None:
        """A sample so long after the one before."""
        gone_s = gone_ns / NS_PER_S
        if gone_s > LONGEST_GAP_S:  # the orientation has started afresh, its heading anywhere
            self.tracker.lose()
            self._strokes, self._reader, self._pending = AirStrokes(), SwingReader(self.mounting.tip_m), None
            self._swings.clear()
            return
        self._interval_s = gone_s if self._interval_s is None else self._interval_s
        self._interval_s += _RATE_GAIN * (gone_s - self._interval_s)

    def _check(self) -> None:
        """A stroke that was foretold has ended without a beat: what foretold it is no longer believed."""
        if not self._strokes.goes_on:
            self._pending = None
            self._counts.failed += 1
            self._by_stroke.failed()
            self._by_loop.failed()

    def _by_habit(self, fastest: Swing, now: Swing) -> AirCall | None:
        at_ns = self._by_stroke.beat_ns(fastest, now)
        if at_ns is None:
            return None
        zone = self.tracker.clear_zone(now.at_ns, *self._aim(now, at_ns))
        return None if zone is None else AirCall(at_ns, zone, fastest.speed_m_s)

    def _by_place(self, fastest: Swing, now: Swing) -> AirCall | None:
        expected = self._by_loop.beat_ns(fastest, now)
        if expected is None:
            return None
        at_ns, place = expected
        zone = self.tracker.clear_zone(now.at_ns, self._aim(now, at_ns)[0], place.elevation_rad)
        return AirCall(at_ns, zone, max(fastest.speed_m_s, place.speed_m_s)) if zone is place.zone else None

    def _aim(self, now: Swing, at_ns: int) -> tuple[float, float]:
        """Heading and elevation at a beat soon after."""
        before = self._swings[-2]
        share = _TURNS_ON * max(0, at_ns - now.at_ns) / (now.at_ns - before.at_ns)
        turn = wrapped(now.heading_rad - before.heading_rad)
        return (
            wrapped(now.heading_rad + share * turn),
            now.elevation_rad + share * (now.elevation_rad - before.elevation_rad),
        )
