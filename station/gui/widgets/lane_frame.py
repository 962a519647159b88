"""The bars of a lane as one draws on them: on the grid of beats, within the control's range.

Bars count from 1; a drag draws a point on every beat, so that a phrase begins on one.
"""

from dataclasses import dataclass

_DIGITS = 6
"""So exactly is a bar given: the same beat is the same number, however it was reached."""


@dataclass(frozen=True, slots=True)
class LaneFrame:
    """`bars` whole bars of `beats` beats, and values from `low` to `high`."""

    bars: int
    beats: int
    low: float
    high: float

    def point(self, bar: float, value: float) -> tuple[float, float]:
        """The bar, on the nearest beat, and the value that are meant; beyond the frame, at its edge."""
        beat = min(max(round((bar - 1) * self.beats), 0), self.bars * self.beats)
        return round(1 + beat / self.beats, _DIGITS), min(max(value, self.low), self.high)

    def stroke(self, start: tuple[float, float], end: tuple[float, float]) -> list[tuple[float, float]]:
        """The points on every beat that a straight drag from one place to another passes, both ends with them."""
        (bar, value), (last_bar, last) = self.point(*start), self.point(*end)
        steps = round(abs(last_bar - bar) * self.beats)
        if steps == 0:
            return [(last_bar, last)]
        fractions = [step / steps for step in range(steps + 1)]
        return [(round(bar + a * (last_bar - bar), _DIGITS), value + a * (last - value)) for a in fractions]
