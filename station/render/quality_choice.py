"""Which quality a machine can hold at 60 pictures a second, found by drawing: times in, a level out.

It begins with the lowest. Where that leaves most of a picture's time the next is tried, and kept while it is in time;
one that is not is left for the one below, and not tried again for a picture of that size. What is given up first are
many lights and soft shadows; rims are as round at every level (`quality`). Between two looks pictures are not measured,
for to measure one the graphics card has to be waited for.
"""

from dataclasses import dataclass, replace
from statistics import median

MEASURED = 12
"""Pictures of a measurement (our choice: a fifth of a second, and one that another program delays does not count)."""
SETTLES = 4
"""Pictures after a change that say nothing: solids are uploaded, shaders compiled (our choice)."""
PAUSE = 300
"""Pictures between two measurements: five seconds (our choice)."""
SLOW_MS, FAST_MS = 11.0, 4.5
"""A sixtieth of a second less what panels, sound and hits take; and what leaves room for a level that takes 2.4 times
as long (our choice: a GPU takes about twice as long from level to level)."""
_SOFTWARE = ("llvmpipe", "softpipe", "swiftshader", "software")
"""What draws on the processor, by OpenGL's name of it: the second level takes it twenty times as long as the lowest."""


@dataclass(frozen=True, slots=True)
class QualityChoice:
    """The `level` to draw at; no level above `highest` is tried. `times_ms` is the measurement that goes on."""

    level: int = 0
    highest: int = 0
    times_ms: tuple[float, ...] = ()
    skips: int = SETTLES

    @property
    def wants_time(self) -> bool:
        """Whether the next picture shall be measured."""
        return self.skips == 0

    def drawn(self, took_ms: float | None, may_change: bool = True) -> "QualityChoice":
        """After another picture, with what it took where that was wanted.

        While it may not change the level, for somebody plays and would see it stop, a full measurement is put off.
        """
        if took_ms is None or self.skips:
            return replace(self, skips=max(self.skips - 1, 0))
        times = (*self.times_ms, took_ms)
        if len(times) < MEASURED:
            return replace(self, times_ms=times)
        level, highest, usual = self.level, self.highest, median(times)
        if may_change and usual > SLOW_MS and level > 0:
            level = highest = level - 1
        elif may_change and usual < FAST_MS and level < highest:
            level += 1
        return QualityChoice(level, highest, (), PAUSE if level == self.level else SETTLES)


def first_choice(renderer: str, levels: int) -> QualityChoice:
    """Where a machine begins whose OpenGL calls itself `renderer`, with so many `levels`."""
    draws_itself = any(word in renderer.lower() for word in _SOFTWARE)
    return QualityChoice(highest=0 if draws_itself else levels - 1)
