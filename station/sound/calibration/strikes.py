"""Input latency by strikes: pads struck in front of a microphone while their MIDI comes.

Each stroke's stamp is compared with the moment at which the recording says that it sounded. The input's own error, the
part that its driver does not report, is in the result with its sign turned; `loopback` over the same input has it the
right way round, so that the sum of both, which is what judgement subtracts, is free of it.

A module's own sound on a line input serves as well; then the result is how much later the MIDI comes than that sound.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.errors import DeviceError
from station.core.pieces import Piece
from station.core.units import NS_PER_MS, NS_PER_S
from station.sound.calibration.latency_estimate import Floats, LatencyEstimate, estimate_of, inliers
from station.sound.calibration.stroke_onsets import onsets
from station.sound.calibration.timeline import TimedRecording

SPEED_OF_SOUND_M_S = 343.0
LEAST_MS, MOST_MS = -300.0, 300.0
"""The delays that are looked at (our choice: wireless MIDI and a late input)."""
NEAR_MS = 15.0
"""A stroke and a sound this near the common delay are one (our choice: kits jitter by single ms)."""
ENOUGH = 0.7
"""The share of the strokes that must be heard (our choice)."""
ENOUGH_STROKES = 8
PAD_STROKES = 5
"""A pad has a latency of its own from so many strokes on (our choice)."""
RIVAL_SHARE = 0.8
"""Another delay that so many strokes agree with, of those that agree with the best, leaves it open (our choice)."""
MAX_SD_MS = 4.0
"""More jitter than this is no kit's (our choice: MIDI's four notes at once are 3.84 ms, ANCHORS)."""
UNLIKELY_MS = (-60.0, 150.0)


@dataclass(frozen=True, slots=True)
class Strikes:
    """What strikes told: of the kit as a whole, and of each pad that was struck often enough."""

    kit: LatencyEstimate
    pads: Mapping[Piece, LatencyEstimate]


def strikes(
    stamps_ns: NDArray[np.int64], pieces: Sequence[Piece], recording: TimedRecording, distance_m: float = 0.0
) -> Strikes:
    """How much later than they sounded strokes were stamped (n,), each on its piece.

    `distance_m` from the pads to the microphone. Raises `DeviceError` where stamps and sounds do not answer each other.
    """
    if len(stamps_ns) < PAD_STROKES:
        raise DeviceError(f"too few strokes: {len(stamps_ns)}; strike each pad ten times")
    heard_ns = [_heard_ns(recording, channel, distance_m) for channel in range(recording.sound.shape[1])]
    lag_ms, rivals, sounds_ns = min((_common(stamps_ns, each) for each in heard_ns), key=lambda found: -found[1][0])
    offsets = _nearest_ms(stamps_ns, sounds_ns, lag_ms)
    near = np.abs(offsets - lag_ms) <= NEAR_MS
    if near.sum() < PAD_STROKES:
        raise DeviceError(
            f"of {len(stamps_ns)} strokes {int(near.sum())} were heard; is the microphone near, is it the right input?"
        )
    struck = np.array([int(piece) for piece in pieces])
    groups = {piece: _good(offsets[near & (struck == piece)]) for piece in np.unique(struck[near]).tolist()}
    kit = estimate_of([np.concatenate(list(groups.values()))])
    assert kit is not None, "more than the least number were near"
    pads = {
        Piece(piece): _checked(pad)
        for piece, values in groups.items()
        if len(values) >= PAD_STROKES and (pad := estimate_of([values])) is not None
    }
    return Strikes(_doubted(_checked(kit), near, rivals, recording), MappingProxyType(pads))


def _heard_ns(recording: TimedRecording, channel: int, distance_m: float) -> Floats:
    at_ns = recording.timeline.at_ns(onsets(recording.sound[:, channel], recording.rate_hz))
    return at_ns - distance_m / SPEED_OF_SOUND_M_S * NS_PER_S


def _common(stamps_ns: NDArray[np.int64], sounds_ns: Floats) -> tuple[float, tuple[int, int], Floats]:
    """The delay that most strokes agree with; how many do, and how many with the next best; the sounds themselves."""
    apart_ms = ((stamps_ns[:, None] - sounds_ns) / NS_PER_MS).ravel()
    apart_ms = np.sort(apart_ms[(apart_ms >= LEAST_MS) & (apart_ms <= MOST_MS)])
    if len(apart_ms) == 0:
        return 0.0, (0, 0), sounds_ns
    width = NEAR_MS / 2
    votes = np.searchsorted(apart_ms, apart_ms + width, "right") - np.searchsorted(apart_ms, apart_ms - width)
    most = votes.max()
    lag_ms = float(np.median(apart_ms[votes == most]))
    rival = votes[np.abs(apart_ms - lag_ms) > 2 * NEAR_MS]
    return lag_ms, (int(most), int(rival.max(initial=0))), sounds_ns


def _nearest_ms(stamps_ns: NDArray[np.int64], sounds_ns: Floats, lag_ms: float) -> Floats:
    """Each stroke's stamp less the time of the sound that lies nearest to where the common delay puts it."""
    if len(sounds_ns) == 0:
        return np.full(len(stamps_ns), np.inf)
    expected = stamps_ns - lag_ms * NS_PER_MS
    nearest = np.abs(expected[:, None] - sounds_ns).argmin(axis=1)
    apart: Floats = (stamps_ns - sounds_ns[nearest]) / NS_PER_MS
    return apart


def _good(values: Floats) -> Floats:
    return values[inliers(values)]


def _checked(estimate: LatencyEstimate) -> LatencyEstimate:
    """With the doubts that its own figures raise."""
    if estimate.sd_ms > MAX_SD_MS:
        estimate = estimate.doubted(f"single strokes scatter by {estimate.sd_ms:.1f} ms")
    if not UNLIKELY_MS[0] <= estimate.value_ms <= UNLIKELY_MS[1]:
        estimate = estimate.doubted(f"{estimate.value_ms:+.0f} ms is beyond what kits do")
    return estimate


def _doubted(
    kit: LatencyEstimate, near: NDArray[np.bool_], rivals: tuple[int, int], recording: TimedRecording
) -> LatencyEstimate:
    """With the doubts that the recording as a whole raises."""
    if kit.count < ENOUGH_STROKES:
        kit = kit.doubted(f"only {kit.count} strokes; strike each pad ten times")
    if near.mean() < ENOUGH:
        kit = kit.doubted(f"only {int(near.sum())} of {len(near)} strokes were heard by the microphone")
    if rivals[1] >= RIVAL_SHARE * rivals[0]:
        kit = kit.doubted("another delay fits as well: strike more slowly and less evenly")
    if recording.lost_blocks:
        kit = kit.remarked(f"{recording.lost_blocks} blocks were lost while it was recorded")
    return kit
