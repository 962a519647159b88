"""Output latency by loopback: chirps that were played and recorded again, over a cable or through the air.

What is measured is how much later a sound comes back than the output's and the input's own reports say. Output and
input cannot be told apart by that; the whole is given to the output. Nothing is lost by it as long as strikes
(`strikes`) are recorded through the same input: there the same unknown lies on the other side, and judgement subtracts
the sum of both.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.units import NS_PER_MS
from station.sound.calibration.chirp import coherence, found_at, lags_s, mean_coherence
from station.sound.calibration.latency_estimate import Floats, LatencyEstimate, estimate_of
from station.sound.calibration.timeline import TimedRecording

LEAST_S, MOST_S = -0.3, 1.2
"""The delays that are looked at: drivers that report too much, and wireless headphones (our choice)."""
HEARD = 0.2
"""A coherence that noise does not reach: of the 20,000 independent places in `LEAST_S` … `MOST_S` the best by chance
has 0.15, by the exponential law of its square with the 800 degrees of freedom of a chirp."""
CLEAR = 2 * HEARD
"""A chirp that came back without doubt."""
NEAR_S = 0.002
"""So far from the common delay a single chirp is looked for."""
DIRECT_SHARE = 0.5
"""What comes earlier than the strongest and is at least so strong is the direct sound, the strongest an echo (our
choice: half is above the sidelobes of a chirp, 0.22, and the false places of the ruler, a sixth)."""
ENOUGH = 0.6
"""The share of the chirps that must be found (our choice)."""
MAX_MOVED_MS = 0.5
"""A delay that changes so much within one opening is none to subtract (our choice)."""
UNLIKELY_MS = (-30.0, 500.0)
"""A driver that exaggerates by more, or a path longer than any wireless headphone's, is rather a fault (our choice)."""


@dataclass(frozen=True, eq=False)
class LoopbackRound:
    """One opening of the devices: when each chirp left by the output's report, (k,) monotonic ns; what was recorded."""

    played_ns: NDArray[np.int64]
    recording: TimedRecording


def loopback(rounds: Sequence[LoopbackRound]) -> LatencyEstimate:
    """How much later than reported the output sounds; raises `DeviceError` where no chirp was heard."""
    found = [_lags_ms(each) for each in rounds]
    played = sum(len(each.played_ns) for each in rounds)
    estimate = estimate_of(found)
    if estimate is None:
        raise DeviceError(f"the chirps were not heard again: {_why([each.recording for each in rounds])}")
    if estimate.count < ENOUGH * played:
        estimate = estimate.doubted(f"only {estimate.count} of {played} chirps came back alike")
    moved_ms = max((_moved_ms(lags) for lags in found), default=0.0)
    if moved_ms > MAX_MOVED_MS:
        estimate = estimate.doubted(f"the delay moved by {moved_ms:.1f} ms while it was measured")
    low, high = UNLIKELY_MS
    if not low <= estimate.value_ms <= high:
        estimate = estimate.doubted(f"{estimate.value_ms:+.0f} ms is beyond what sound devices do")
    lost = sum(each.recording.lost_blocks for each in rounds)
    if lost:
        estimate = estimate.remarked(f"{lost} blocks were lost while it was recorded")
    if any(each.recording.clipped for each in rounds):
        estimate = estimate.remarked("the input was overdriven: turn it down")
    return estimate


def _lags_ms(each: LoopbackRound) -> Floats:
    """The delay of every chirp that was heard, in the channel that heard them best."""
    recording, rate_hz = each.recording, each.recording.rate_hz
    lags = lags_s(LEAST_S, MOST_S, rate_hz)
    channels = [coherence(channel, rate_hz) for channel in recording.sound.T]
    stacks = [mean_coherence(recording, coherent, each.played_ns, lags) for coherent in channels]
    best = int(np.argmax([stack.max() for stack in stacks]))
    lag = int(lags[_direct(stacks[best])])
    starts = recording.timeline.frame_at(each.played_ns.astype(np.float64))
    spots = [found_at(channels[best], round(start) + lag, round(NEAR_S * rate_hz)) for start in starts]
    heard = np.array([height >= HEARD for _, height in spots])
    at_ns = recording.timeline.at_ns(np.array([frame for frame, _ in spots]))
    found: Floats = (at_ns - each.played_ns)[heard] / NS_PER_MS
    return found


def _direct(stack: Floats) -> int:
    """The first strong peak: the greatest, or an earlier one of which the greatest is an echo."""
    start = int(np.argmax(stack >= DIRECT_SHARE * stack.max()))
    falls = np.flatnonzero(np.diff(stack[start:]) < 0)
    return start + (int(falls[0]) if len(falls) else 0)


def _moved_ms(lags_ms: Floats) -> float:
    """How far the delay went from the first half of a round to the second."""
    half = len(lags_ms) // 2
    return abs(float(np.median(lags_ms[half:]) - np.median(lags_ms[:half]))) if half else 0.0


def _why(recordings: Sequence[TimedRecording]) -> str:
    loudest = max((float(np.abs(each.sound).max(initial=0.0)) for each in recordings), default=0.0)
    if loudest == 0.0:
        return "the input recorded nothing at all; is it the right one, is it switched off?"
    if max(float(coherence(channel, each.rate_hz).max()) for each in recordings for channel in each.sound.T) > CLEAR:
        return "each came back after another delay; let the computer do nothing else meanwhile, and try larger blocks"
    level = f"the loudest that came in was {20 * np.log10(loudest):.0f} dB"
    return f"{level}; connect output and input by a cable, or hold the microphone to the loudspeaker, and turn it up"
