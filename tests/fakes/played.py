"""Hits made from a score for tests of scoring: every stroke is known, so is what should become of it."""

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_S, PPQ
from station.music.performance import HIT_DTYPE, Performance
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap

KICK, SNARE, HAT = 0, 1, 2


def varied_groove(bars: int, seed: int = 0, tempo_bpm: float = 120.0) -> Score:
    """Eighths on the hat, snare on 2 and 4; two kicks and a snare stroke elsewhere in each bar, no bar like another."""
    rng = np.random.default_rng(seed)
    rows = []
    for bar in range(bars):
        start = bar * 16
        rows += [(start + k, HAT) for k in range(0, 16, 2)] + [(start + k, SNARE) for k in (4, 12)]
        rows += [(start + int(k), KICK) for k in (0, *rng.choice(np.arange(1, 16), 2, replace=False))]
        rows.append((start + int(rng.choice([1, 3, 5, 6, 7, 9, 11, 13, 14, 15])), SNARE))
    table = np.zeros(len(rows), NOTE_DTYPE)
    table["tick"] = [step * PPQ // 4 for step, _ in rows]
    table["piece"], table["velocity"], table["dynamic"] = [piece for _, piece in rows], 80, 1
    table["limb"], table["openness"] = -1, np.nan
    return Score.from_array(table, TempoMap.constant(tempo_bpm))


def played(score: Score, at_s: NDArray[np.float64], rows: NDArray[np.int64]) -> Performance:
    """The strokes `rows` (m,) of `score` at `at_s` (m,), rising."""
    assert (np.diff(at_s) >= 0).all(), "the caller keeps rows and hits in one order"
    hits = np.zeros(len(rows), HIT_DTYPE)
    hits["at_ns"] = np.rint(at_s * NS_PER_S)
    hits["piece"], hits["velocity"] = score.notes["piece"][rows], score.notes["velocity"][rows]
    hits["openness"] = hits["position"] = np.nan
    hits["limb"] = -1
    return Performance.from_array(hits)


def with_noise(
    at_s: NDArray[np.float64], rows: NDArray[np.int64], sd_ms: float, seed: int = 0
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Times with normal noise, and the rows in their new order."""
    noisy = at_s + np.random.default_rng(seed).normal(0, sd_ms / 1000, len(at_s))
    order = np.argsort(noisy, kind="stable")
    return noisy[order], rows[order]
