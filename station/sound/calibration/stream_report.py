"""What an output's stream reports of itself: its latency, and how its clock runs against the computer's.

Both are corrected already wherever the station plays: every block has the time at which the driver says that it is
heard, and the drift is followed (`station.sound.output.dac_clock`). What the driver does not know, the converter's own
delay or that of wireless headphones, only `loopback` finds.
"""

from dataclasses import dataclass

from station.sound.calibration.timeline import Timeline

USUAL_PPM = 300.0
"""No card's crystal strays so far (our choice: three times what is sold); then the driver's times are at fault."""
LONG_MS = 100.0
"""A drummer hears the kit's own sound so late that they cannot play (our choice, ten times ANCHORS' 10 ms)."""


@dataclass(frozen=True, slots=True)
class StreamReport:
    """`latency_ms` as reported, `drift_ppm` ± `drift_half_ppm` fast against the monotonic clock (None: not known)."""

    latency_ms: float | None
    drift_ppm: float | None
    drift_half_ppm: float | None
    underflows: int
    doubts: tuple[str, ...]


def report_of(latency_ms: float | None, timeline: Timeline | None, underflows: int) -> StreamReport:
    """Judge what the stream said while it played."""
    drift = timeline.drift_ppm() if timeline is not None else None
    ppm, half_ppm = drift if drift is not None else (None, None)
    doubts = []
    if not latency_ms:
        doubts.append("the driver reports no latency: measure it by loopback")
    elif latency_ms > LONG_MS:
        doubts.append(f"{latency_ms:.0f} ms are too long to play with: choose another output, or smaller blocks")
    if ppm is not None and half_ppm is not None and abs(ppm) - half_ppm > USUAL_PPM:
        doubts.append(f"the card runs {ppm:+.0f} parts in a million off: its driver's times are at fault")
    if underflows:
        doubts.append(f"{underflows} blocks came too late: the computer is busy, or the blocks are too small")
    return StreamReport(latency_ms, ppm, half_ppm, underflows, tuple(doubts))
