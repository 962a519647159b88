"""How a hand in the air does, and what there is to say to its player."""

from collections import deque
from dataclasses import dataclass, field
from math import degrees, radians
from statistics import median

from station.core.units import ms_from_ns
from station.sync.air.air_strokes import most_strokes_hz

FASTEST_HAND_HZ = 10.0
"""A champion's single hand (HUMANS, Fujii 2009): a sensor that tells as many strokes apart tells all."""
_UNCLEAR_SHARE, _FEWEST = 0.1, 20
"""More unclear strokes than that, among so many, are worth a word (our choice)."""
_DOUBT_RAD = radians(15.0)
"""Half of the way between two pieces of a kit, about 30° apart (HUMANS' layout from the seat): beyond it zones blur."""
_KEPT = 32
"""So many forecasts tell how good they are (our choice)."""


@dataclass(slots=True)
class AirCounts:
    """What happens to one hand's strokes, counted as it happens."""

    named: int = 0
    unclear: int = 0
    failed: int = 0
    gains_ns: deque[int] = field(default_factory=lambda: deque(maxlen=_KEPT))
    errors_ns: deque[int] = field(default_factory=lambda: deque(maxlen=_KEPT))

    def told(self, is_clear: bool) -> None:
        """A stroke was told, to sound or with no clear zone."""
        self.named += is_clear
        self.unclear += not is_clear

    def came(self, gain_ns: int, error_ns: int) -> None:
        """A stroke that had been foretold so much earlier came; its beat had been put too late by the error."""
        self.gains_ns.append(gain_ns)
        self.errors_ns.append(error_ns)


@dataclass(frozen=True, slots=True)
class AirStatus:
    """How a hand does.

    `named` strokes made a hit, `unclear` had no clear zone, `unresolved` were too quick for the sensor, `failed` were
    foretold and did not come. `drift_rad` is how far the heading has turned, `doubt_rad` one deviation of that (None:
    not known at all). `gain_ms` is how much earlier than certain forecasts were, `error_ms` how late they put the beat,
    medians; None without any.
    """

    named: int
    unclear: int
    unresolved: int
    failed: int
    drift_rad: float
    doubt_rad: float | None
    rate_hz: float | None
    gain_ms: float | None
    error_ms: float | None

    def sentences(self) -> tuple[str, ...]:
        """What the player should know, most important first; nothing where all is well."""
        said = (self._where(), self._rolls(), self._unclear())
        return tuple(sentence for sentence in said if sentence)

    def _where(self) -> str:
        if self.doubt_rad is None:
            return "Strike this hand's first piece once, so that the stick's direction is known."
        if self.doubt_rad > _DOUBT_RAD:
            beside = f"{degrees(self.doubt_rad):.0f}°"
            return f"The stick may point {beside} beside: begin to play in the air anew, with its first piece."
        return ""

    def _rolls(self) -> str:
        if self.rate_hz is None or most_strokes_hz(self.rate_hz) >= FASTEST_HAND_HZ:
            return ""
        most, rate = most_strokes_hz(self.rate_hz), self.rate_hz
        return (
            f"At {rate:.0f} Hz this sensor tells at most {most:.0f} strokes a second apart; faster rolls are left out."
        )

    def _unclear(self) -> str:
        strokes = self.named + self.unclear
        if strokes < _FEWEST or self.unclear < _UNCLEAR_SHARE * strokes:
            return ""
        return f"{self.unclear} of {strokes} strokes lay between pieces: learn the zones again, further apart."


def status_of(
    counts: AirCounts, drift_rad: float, doubt_rad: float | None, rate_hz: float | None, unresolved: int
) -> AirStatus:
    """The status of a hand whose strokes were so counted."""
    return AirStatus(
        counts.named,
        counts.unclear,
        unresolved,
        counts.failed,
        drift_rad,
        doubt_rad,
        rate_hz,
        _median_ms(counts.gains_ns),
        _median_ms(counts.errors_ns),
    )


def _median_ms(times_ns: deque[int]) -> float | None:
    return ms_from_ns(round(median(times_ns))) if times_ns else None
