"""A lane's picture as numbers: where bars and values lie in pixels, which point is meant, and what a drag draws.

Pixels count right and down. Bars count from 1; a drag draws on a grid of beats, so that a phrase begins on one.
"""

from dataclasses import dataclass

from station.motion.style.style import Automation

NEAR_PX = 10.0
"""A point is meant from so far (our choice: a fingertip's width is about 40 pixels, a mouse's aim 10)."""
_DIGITS = 6
"""So exactly is a bar told: the same beat is the same number, however it was reached."""


@dataclass(frozen=True, slots=True)
class LaneFrame:
    """A rectangle that shows `bars` whole bars of `beats` beats, and values from `low` to `high`."""

    left: float
    top: float
    width: float
    height: float
    bars: int
    beats: int
    low: float
    high: float

    def pixel(self, bar: float, value: float) -> tuple[float, float]:
        """Where a point is drawn."""
        x = self.left + (bar - 1) / self.bars * self.width
        return x, self.top + (self.high - value) / (self.high - self.low) * self.height

    def point(self, x: float, y: float) -> tuple[float, float]:
        """The bar, on the nearest beat, and the value that a pixel means; beyond the rectangle, at its edge."""
        beat = round((x - self.left) / self.width * self.bars * self.beats)
        share = min(max((self.top + self.height - y) / self.height, 0.0), 1.0)
        bar = 1 + min(max(beat, 0), self.bars * self.beats) / self.beats
        return round(bar, _DIGITS), self.low + share * (self.high - self.low)

    def nearest(self, lane: Automation, x: float, y: float) -> int | None:
        """Which point of the lane is meant by a pixel; None where none is near."""
        apart = [max(abs(px - x), abs(py - y)) for px, py in (self.pixel(*point) for point in lane)]
        if not apart or min(apart) > NEAR_PX:
            return None
        return apart.index(min(apart))

    def stroke(self, start: tuple[float, float], end: tuple[float, float]) -> list[tuple[float, float]]:
        """The points on every beat that a straight drag from one pixel to another passes, both ends with them."""
        (bar, value), (last_bar, last) = self.point(*start), self.point(*end)
        steps = round(abs(last_bar - bar) * self.beats)
        if steps == 0:
            return [(last_bar, last)]
        along = [step / steps for step in range(steps + 1)]
        return [(round(bar + a * (last_bar - bar), _DIGITS), value + a * (last - value)) for a in along]
