"""People at the drums, for tests: an even player with what is no fault in anyone, and what a test adds to that.

Nothing here is shared with the code under test. Every stroke is off by what its whole moment is off, a first-order
autoregression from moment to moment (lag-1 .3, HUMANS), and by what is its own; each piece leans by some ms, velocities
vary by 8 % (HUMANS: professionals 6–10 %). Without a click time begins anywhere and runs at the player's own tempo.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.analysis.summary import Summary, SummaryView, summarise

Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, eq=False)
class Human:
    """Who plays: SD in ms, SD of the leans of pieces in ms, CV of velocities, what the stand against the click is."""

    sd_ms: float = 12.0
    lean_sd_ms: float = 5.0
    velocity_cv: float = 0.08
    stand_ms: float = -5.0


@dataclass(frozen=True, eq=False)
class Added:
    """What is added to a take: ms and dB a note, a factor on its own scatter, its openness, rows that are not played.

    `course` maps time as written to time as played, both in s.
    """

    shift_ms: Floats | float = 0.0
    level_db: Floats | float = 0.0
    scatter: Floats | float = 1.0
    openness: Floats | None = None
    left_out: NDArray[np.bool_] | None = None
    course: Callable[[NDArray[np.float64]], NDArray[np.float64]] | None = None


def human_hits(score: Score, seed: int, human: Human | None = None, added: Added | None = None) -> NDArray[np.void]:
    """The hits of a take (n,), in the order of the notes, in the score's own time."""
    human, added, rng = human or Human(), added or Added(), np.random.default_rng(seed)
    moments, moment = np.unique(score.notes["tick"], return_inverse=True)
    common = rng.normal(size=len(moments))
    for k in range(1, len(moments)):
        common[k] = 0.3 * common[k - 1] + (1 - 0.3**2) ** 0.5 * common[k]
    own = rng.normal(size=len(score))
    off = human.sd_ms * np.asarray(added.scatter) * (0.5**0.5 * common[moment] + 0.5**0.5 * own)
    leans = rng.normal(0.0, human.lean_sd_ms, 256)[score.notes["piece"]]
    at_ms = score.onset_ns / NS_PER_MS + off * np.where(score.is_grace, 0.5, 1.0) + leans + human.stand_ms
    at_ms = at_ms + np.asarray(added.shift_ms)
    hits = np.zeros(len(score), HIT_DTYPE)
    for name in ("piece", "zone", "articulation", "openness"):
        hits[name] = score.notes[name]
    hits["position"], hits["limb"] = np.nan, -1
    if added.openness is not None:
        hits["openness"] = added.openness
    at_s = at_ms / 1e3
    if added.course is not None:
        at_s = added.course(at_s)
    hits["at_ns"] = np.rint(np.asarray(at_s) * 1e9).astype(np.int64)
    loud = score.notes["velocity"] * 10 ** (np.asarray(added.level_db) / 40)
    hits["velocity"] = np.clip(np.rint(loud * (1 + human.velocity_cv * rng.normal(size=len(score)))), 1, 127)
    return hits if added.left_out is None else hits[~added.left_out]


def human_take(
    score: Score,
    seed: int,
    added: Added | None = None,
    human: Human | None = None,
    clocked: bool = True,
    view: SummaryView | None = None,
) -> Summary:
    """What a take shows."""
    performance = Performance.from_array(human_hits(score, seed, human, added))
    if not clocked:
        performance = performance.shifted(7_300_000_000)
    return summarise(score, performance, align(score, performance, clocked, may_share_base=False), view)
