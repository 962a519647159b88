"""Where the beats of a bar lie that notation shows: what beams join and no note crosses without a tie."""

from collections.abc import Iterator

from station.core.units import PPQ
from station.music.tempo import MeterChange

COMPOUND = 3 * PPQ // 2
"""The beat of 6/8 and its like, a dotted quarter."""


def beat_groups(meter: MeterChange, length: int) -> list[tuple[int, int]]:
    """Start and end of the beats of a bar `length` ticks long (the last bar before a change may be short).

    Quarters, or the groups of the meter where they are of eighths: those longer than three fall into twos, the last
    of them a three where they are odd (7/8 reads 2 + 2 + 3 where nothing else is said).
    """
    is_grouped = meter.unit >= 8 and max(meter.felt_groups) > 1
    felt = [(s, min(e, length)) for s, e in meter.pulses if s < length] if is_grouped else [(0, length)]
    return [group for start, end in felt for group in _beats(start, end)]


def _beats(start: int, end: int) -> Iterator[tuple[int, int]]:
    while start < end:
        stop = end if end - start <= PPQ or end - start == COMPOUND else start + PPQ
        yield start, stop
        start = stop
