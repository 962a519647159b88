"""Units of time and the conversions between them.

Score time is integer ticks; session time is integer monotonic nanoseconds. Names carry their unit.
"""

PPQ = 107_520
"""Ticks a quarter note: 2^10 * 3 * 5 * 7, so triplets, quintuplets, septuplets and common MIDI divisions are exact."""

NS_PER_S = 1_000_000_000
NS_PER_MS = 1_000_000
NS_PER_US = 1_000


def ns_from_s(seconds: float) -> int:
    """Nearest whole nanosecond to `seconds`."""
    return round(seconds * NS_PER_S)


def ns_from_ms(milliseconds: float) -> int:
    """Nearest whole nanosecond to `milliseconds`."""
    return round(milliseconds * NS_PER_MS)


def s_from_ns(nanoseconds: int) -> float:
    """Seconds in `nanoseconds`."""
    return nanoseconds / NS_PER_S


def ms_from_ns(nanoseconds: int) -> float:
    """Milliseconds in `nanoseconds`."""
    return nanoseconds / NS_PER_MS
