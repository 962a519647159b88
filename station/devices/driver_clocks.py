"""From a driver's own time to session time: the moment at which a message came, not the moment at which we looked.

A MIDI driver stamps each message as it arrives, on a clock of its own, and rtmidi hands on the differences between
those stamps. We see each message some time later, when we poll: always later, never earlier. So the offset between the
two clocks is the least (poll time − driver time) seen so far, let creep upwards slowly lest a driver's clock that runs
slow make every stamp early. The error left is the creep since the last prompt poll and the driver's own quantisation.

A serial line has no driver's time at all: there the moment of reading is all we know, and how long a byte takes on the
wire. `WireClock` makes the best of both.

Times are integer nanoseconds; rtmidi's differences are seconds in floating point.
"""

from collections.abc import Sequence

from station.core.units import NS_PER_MS, NS_PER_S

CREEP_NS_PER_S = 100_000
"""How fast the offset may grow: 100 parts in a million, twice what an ordinary crystal strays (our choice)."""

_RESTART_AFTER_NS = 2 * NS_PER_S
"""A message that seems to have come this long before we last looked did not, for we would have found it then: the
driver dropped messages, and their differences with them (our choice: no driver holds a message back nearly so long)."""


_PROMPT_NS = 5 * NS_PER_MS
"""Between two polls so near each other a message did not wait."""
_APART_NS = 3 * NS_PER_MS
_APART_MESSAGES = 16
"""So many messages in a row that were found promptly, and yet all seem to have come `_APART_NS` before we last looked:
the driver dropped one before them, and its difference with it (our choice: a stall of the driver's own thread, which
holds messages back likewise, ends sooner)."""


class DriverClock:
    """Turns the delta times of one connection into session time."""

    def __init__(self) -> None:
        self._driver_ns = 0
        self._offset_ns: int | None = None
        self._last_ns = 0
        self._apart_ns: list[int] = []  # the offsets that messages asked for that lie apart

    def stamps(self, found: Sequence[tuple[float, int]], emptied_ns: int) -> list[int]:
        """Session times of the messages that one poll `found`, in order; they never go back.

        Of each the time in s since the one before it, by the driver, and when we read it. `emptied_ns` is when the poll
        before began, which left no message behind: what came since may have waited. Never later than it was read unless
        an earlier message was already stamped later. All that a poll found says when the first of it came: a message
        that waited, even the first of a connection, is as well known as the last.
        """
        driver_ns = []
        for delta_s, read_ns in found:
            delta_ns = round(max(delta_s, 0.0) * NS_PER_S)
            self._driver_ns += delta_ns
            driver_ns.append(self._driver_ns)
            self._learn(read_ns - self._driver_ns, delta_ns, read_ns - emptied_ns)
        assert self._offset_ns is not None or not found, "learnt from the first message"
        times_ns = []
        for at_ns in driver_ns:
            self._last_ns = max(self._last_ns, at_ns + (self._offset_ns or 0))
            times_ns.append(self._last_ns)
        return times_ns

    def _learn(self, seen_ns: int, delta_ns: int, may_have_waited_ns: int) -> None:
        """Take in the offset that a message asks for at the most."""
        if self._offset_ns is None or seen_ns - self._offset_ns > may_have_waited_ns + _RESTART_AFTER_NS:
            self._offset_ns = seen_ns
            return
        if may_have_waited_ns < _PROMPT_NS:
            is_apart = seen_ns - self._offset_ns > may_have_waited_ns + _APART_NS
            self._apart_ns = [*self._apart_ns, seen_ns] if is_apart else []
        if len(self._apart_ns) == _APART_MESSAGES:
            self._offset_ns, self._apart_ns = min(self._apart_ns), []
            return
        crept_ns = self._offset_ns + delta_ns * CREEP_NS_PER_S // NS_PER_S
        self._offset_ns = min(seen_ns, crept_ns)


BITS_A_BYTE = 10
"""A start bit, eight data bits and a stop bit (MIDI 1.0 Electrical Specification; every module's 8N1)."""


class WireClock:
    """Session time of bytes from a line of `baud` bits a second, read now and then.

    A byte came after the poll that did not find it, and before the one that did, and those read after it came a byte's
    time later each. Between these bounds it came right after the byte before it, if it can have: modules send the
    bytes of a message without a pause, so each tells more of when all of them came. Else it began something new, and
    its stamp is the latest possible: late by at most the time between two polls, never early.
    """

    def __init__(self, baud: int, opened_ns: int) -> None:
        self._byte_ns = BITS_A_BYTE * NS_PER_S // baud
        self._last_ns: int | None = None
        self._emptied_ns = opened_ns

    def stamp(self, count: int, polled_ns: int, read_ns: int) -> list[int]:
        """The times of `count` bytes, in order; they never go back, and are never later than `read_ns`.

        At `polled_ns` the poll began, and at `read_ns` it had them; bytes that came before it would be among them.
        """
        times_ns = []
        for left in reversed(range(count)):
            latest_ns = read_ns - left * self._byte_ns
            self._last_ns = latest_ns if self._last_ns is None else self._next_ns(self._last_ns, latest_ns)
            times_ns.append(self._last_ns)
        self._emptied_ns = polled_ns
        return times_ns

    def _next_ns(self, last_ns: int, latest_ns: int) -> int:
        follows_ns = last_ns + self._byte_ns
        is_new = follows_ns < self._emptied_ns  # it would have been found by the poll before
        return max(last_ns, latest_ns if is_new else min(follows_ns, latest_ns))
