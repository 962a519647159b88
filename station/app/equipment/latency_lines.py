"""What was measured of kits and sound outputs, in lines for a page: how late each is, how sure that is, and what to do.

Milliseconds, positive where a device is later than it reports; ± is half the 95 % interval.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from station.core.labels import piece_name
from station.core.measured_latency import MeasuredLatency, StoredCalibration

SURE_MS = 2.0
"""An interval up to so wide on either side changes no judgement (our choice: a tenth of the narrowest window)."""


@dataclass(frozen=True, slots=True)
class LatencyLine:
    """Of `what`; `words` say the number and how it was measured, `trust` whether to believe it, `good` in short."""

    what: str
    words: str
    trust: str
    good: bool


def latency_lines(known: StoredCalibration, kits: Sequence[str]) -> list[LatencyLine]:
    """A line an output, a kit and a pad that was measured, and one for each of `kits` that was not."""
    lines = [_line(name, measured) for name, measured in known.outputs.items()]
    if not lines:
        lines.append(LatencyLine("sound output", "not measured", "measure it below, best by Loopback", False))
    for name in kits:
        if name not in known.kits:
            lines.append(LatencyLine(name, "not measured", "measure it below, best by Strike", False))
    for name, kit in known.kits.items():
        lines.append(_line(name, kit.kit))
        lines += [_line(f"{name}, {piece_name(piece)}", measured) for piece, measured in sorted(kit.pads.items())]
    return lines


def _line(what: str, measured: MeasuredLatency) -> LatencyLine:
    words = f"{measured.latency_ms:+.1f} ± {measured.half_ms:.1f} ms, by {measured.by} on {measured.on}"
    if measured.doubts:
        return LatencyLine(what, words, f"don't trust this: {measured.doubts}", False)
    if measured.half_ms > SURE_MS:
        return LatencyLine(what, words, "a rough number: measure once more", False)
    return LatencyLine(what, words, "sure", True)
