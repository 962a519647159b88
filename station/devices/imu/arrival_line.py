"""Where samples lie in session time, from when they came: a straight line under all arrivals.

A sample is seen later than it was measured, never earlier: it waits for its packet, for the radio's turn, for our next
look. So the line `session time = offset + slope · position` lies under every arrival, and touches those that did not
wait. Of all such lines the best is the one nearest to the arrivals on average; it runs through the edge of their lower
convex hull that spans the middle of the window (Moon, Skelly & Towsley, "Estimation and removal of clock skew from
network delay measurements", INFOCOM 1999). Unlike a mean it does not care how long the others waited; what is left
is the delay of the fastest, which is the same for all.

Positions are in any unit that the sensor counts in: its nanoseconds, or samples. Times are session ns.
"""

from collections import deque

from station.core.units import NS_PER_MS, NS_PER_S

_BLOCK_NS = 500 * NS_PER_MS
_BLOCKS = 120
"""The line goes by the last minute: long enough that some samples did not wait and that a slope is known to a few parts
in a million, short enough to follow a crystal that warms up (our choice)."""
_OFTEN_NS = 2 * NS_PER_S
"""So long after its beginning the line is drawn anew whenever something has come, then with every block."""

_Point = tuple[int, int]


class ArrivalLine:
    """The line under the arrivals of one sensor."""

    def __init__(self, least_slope: float, most_slope: float) -> None:
        """Slopes beyond these two do not occur; until two arrivals tell, the least holds."""
        self._least, self._most = least_slope, most_slope
        self._origin: _Point | None = None
        self._blocks: deque[list[_Point]] = deque(maxlen=_BLOCKS)
        self._block: list[_Point] = []
        self._block_end_ns = _BLOCK_NS
        self._offset_ns = 0.0
        self._is_due = False
        self.slope = least_slope
        """Session ns for each step of the position."""

    @property
    def is_new(self) -> bool:
        """Whether nothing has come yet."""
        return self._origin is None

    def at(self, position: int) -> int:
        """The session time of `position`, which may lie ahead."""
        assert self._origin is not None, "a line is drawn through something"
        return self._origin[1] + round(self._offset_ns + self.slope * (position - self._origin[0]))

    def add(self, position: int, at_ns: int) -> None:
        """Take in that `position` came at `at_ns`; positions rise, times do not fall."""
        if self._origin is None:
            self._origin = position, at_ns
        x, y = position - self._origin[0], at_ns - self._origin[1]
        if y >= self._block_end_ns:
            self._blocks.append(self._block)
            self._block, self._block_end_ns, self._is_due = [], y + _BLOCK_NS, True
        _extend_hull(self._block, (x, y))
        self._offset_ns = min(self._offset_ns, y - self.slope * x)
        self._is_due = self._is_due or y < _OFTEN_NS

    def narrow(self, least_slope: float, most_slope: float) -> None:
        """Only slopes between these two occur, as is known by now."""
        self._least, self._most, self._is_due = least_slope, most_slope, True

    def draw(self) -> None:
        """Draw the line anew, where enough has come since the last time."""
        if self._is_due:
            self._draw()
            self._is_due = False

    def _draw(self) -> None:
        hull: list[_Point] = []
        for block in (*self._blocks, self._block):
            for point in block:
                _extend_hull(hull, point)
        middle = (hull[0][0] + hull[-1][0]) / 2
        edge = next((i for i in range(1, len(hull)) if hull[i][0] >= middle), None)
        if edge is not None:
            (x0, y0), (x1, y1) = hull[edge - 1], hull[edge]
            self.slope = min(max((y1 - y0) / (x1 - x0), self._least), self._most)
        self._offset_ns = min(y - self.slope * x for x, y in hull)


def _extend_hull(hull: list[_Point], point: _Point) -> None:
    """Add a point on the right to a lower convex hull (Andrew's monotone chain)."""
    x, y = point
    while len(hull) > 1:
        (x0, y0), (x1, y1) = hull[-2], hull[-1]
        if (y1 - y0) * (x - x0) < (y - y0) * (x1 - x0):
            break
        hull.pop()
    hull.append(point)
