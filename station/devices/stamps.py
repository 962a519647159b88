"""From a driver's own time to session time: the moment at which a message came, not the moment at which we looked.

A MIDI driver stamps each message as it arrives, on a clock of its own, and rtmidi hands on the differences between
those stamps. We see each message some time later, when we poll: always later, never earlier. So the offset between the
two clocks is the least (poll time − driver time) seen so far, let creep upwards slowly lest a driver's clock that runs
slow make every stamp early. The error left is the creep since the last prompt poll and the driver's own quantisation.

A serial line has no driver's time at all: there the moment of reading is all we know, and how long a byte takes on the
wire. `WireClock` makes the best of both.

Times are integer nanoseconds; rtmidi's differences are seconds in floating point.
"""

from station.core.units import NS_PER_S

CREEP_NS_PER_S = 100_000
"""How fast the offset may grow: 100 parts in a million, twice what an ordinary crystal strays (our choice)."""

_RESTART_AFTER_NS = 2 * NS_PER_S
"""A message that seems to have come this long before we last looked did not, for we would have found it then: the
driver dropped messages, and their differences with them (our choice: no driver holds a message back nearly so long)."""


class DriverClock:
    """Turns the delta times of one connection into session time."""

    def __init__(self) -> None:
        self._driver_ns = 0
        self._offset_ns: int | None = None
        self._last_ns = 0

    def stamp(self, delta_s: float, polled_ns: int, emptied_ns: int) -> int:
        """Session time of a message `delta_s` after the one before it, read at `polled_ns`; never goes back.

        `emptied_ns` is when the poll before began, which left no message behind: what came since may have waited.
        Never later than `polled_ns` unless an earlier message was already stamped later.
        """
        delta_ns = round(max(delta_s, 0.0) * NS_PER_S)
        self._driver_ns += delta_ns
        seen_ns = polled_ns - self._driver_ns
        may_have_waited_ns = polled_ns - emptied_ns
        if self._offset_ns is None or seen_ns - self._offset_ns > may_have_waited_ns + _RESTART_AFTER_NS:
            self._offset_ns = seen_ns
        else:
            crept_ns = self._offset_ns + delta_ns * CREEP_NS_PER_S // NS_PER_S
            self._offset_ns = min(seen_ns, crept_ns)
        self._last_ns = max(self._last_ns, self._driver_ns + self._offset_ns)
        return self._last_ns


BITS_A_BYTE = 10
"""A start bit, eight data bits and a stop bit (MIDI 1.0 Electrical Specification; every module's 8N1)."""


class WireClock:
    """Session time of every byte that was read at once from a line of `baud` bits a second.

    The last byte may have come just now; each before it came at least a byte's time earlier. The error left is the time
    between two polls, always late, never early.
    """

    def __init__(self, baud: int) -> None:
        self._byte_ns = BITS_A_BYTE * NS_PER_S // baud
        self._last_ns: int | None = None

    def stamp(self, count: int, read_ns: int) -> list[int]:
        """The times of `count` bytes read at `read_ns`, in order; they never go back."""
        floor_ns = read_ns - count * self._byte_ns if self._last_ns is None else self._last_ns
        times_ns = [max(floor_ns, read_ns - left * self._byte_ns) for left in reversed(range(count))]
        self._last_ns = times_ns[-1] if times_ns else self._last_ns
        return times_ns
