"""The window's monitor: when it goes, the window comes back on one that is there, and a line says so.

Systems that manage windows mostly move it themselves; where nobody does, it would stay where nothing shows it. Places
are in the system's screen coordinates, y down.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from station.core.units import NS_PER_S

GONE = "the monitor that showed the window has gone: here it is again, and nothing that was played is lost"
_SEEN = 0.5
"""A window of which less is on a monitor has to move (our choice: with half of it, it can still be dragged)."""
_MOST = 0.9
"""What a moved window may take of a monitor's width and height: its title and border need some too (our choice)."""
_LOOKS_EVERY_NS = NS_PER_S
"""How often is asked where the window is, which takes the system's answer (our choice)."""


@dataclass(frozen=True, slots=True)
class Rectangle:
    """A place on the screen: upper left corner, width, height."""

    left: int
    top: int
    width: int
    height: int

    def shared(self, other: "Rectangle") -> int:
        """How much both cover, as an area."""
        width = min(self.left + self.width, other.left + other.width) - max(self.left, other.left)
        height = min(self.top + self.height, other.top + other.height) - max(self.top, other.top)
        return max(width, 0) * max(height, 0)

    def way_to(self, other: "Rectangle") -> float:
        """How far the other's middle is from this one's, squared."""
        return sum(
            ((a + length / 2) - (b + other_length / 2)) ** 2
            for a, length, b, other_length in (
                (self.left, self.width, other.left, other.width),
                (self.top, self.height, other.top, other.height),
            )
        )


class Screen(Protocol):
    """The system's side: `monitors` by a name of the system's own, which lasts as long as they are plugged in."""

    def monitors(self) -> Sequence[int]:
        """The names of those that are there; asked in every frame."""
        ...

    def area(self, monitor: int) -> Rectangle:
        """What of a monitor windows may take."""
        ...

    def window(self) -> Rectangle:
        """Where the window is."""
        ...

    def move(self, place: Rectangle) -> None:
        """Put the window there."""
        ...


def home_for(window: Rectangle, areas: Sequence[Rectangle]) -> Rectangle | None:
    """Where a window goes that monitors of these `areas` hardly show, None where it can stay."""
    seen = sum(window.shared(area) for area in areas)
    if not areas or seen >= _SEEN * window.width * window.height:
        return None
    area = min(areas, key=window.way_to)
    width, height = min(window.width, round(_MOST * area.width)), min(window.height, round(_MOST * area.height))
    return Rectangle(area.left + (area.width - width) // 2, area.top + (area.height - height) // 2, width, height)


class MonitorWatch:
    """Looks after the window on `screen`, frame by frame."""

    def __init__(self, screen: Screen) -> None:
        self.screen = screen
        self._known = tuple(screen.monitors())
        self._shown_on: int | None = None
        self._looked_ns: int | None = None

    def check(self, now_ns: int) -> str:
        """Bring the window back if need be; returns what the user is to read of it, mostly nothing."""
        there = tuple(self.screen.monitors())
        if not there:  # a lid was closed, say: whatever comes back is looked at then
            return ""
        if there != self._known:
            self._known, self._looked_ns = there, None
            return self._changed()
        if self._looked_ns is None or now_ns - self._looked_ns >= _LOOKS_EVERY_NS:
            self._looked_ns, self._shown_on = now_ns, self._most_of_it()
        return ""

    def _changed(self) -> str:
        """Monitors have come or gone."""
        home = home_for(self.screen.window(), [self.screen.area(monitor) for monitor in self._known])
        if home is not None:
            self.screen.move(home)
        return GONE if home is not None or self._shown_on not in (None, *self._known) else ""

    def _most_of_it(self) -> int | None:
        """The monitor that shows most of the window."""
        window = self.screen.window()
        shares = {monitor: window.shared(self.screen.area(monitor)) for monitor in self._known}
        best = max(shares, key=lambda monitor: shares[monitor])
        return best if shares[best] else None
