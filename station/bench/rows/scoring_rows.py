"""Benchmarks of scoring: how exact and how fast alignment and live judgement are.

Exactness is told against an oracle, the same pairing given the true tempo: what noise makes impossible is nobody's
fault. Peers, where they are installed, do the same work beside ours (`scoring_peers`).
"""

import time
import tracemalloc
from collections.abc import Callable, Sequence
from functools import cache, partial

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.bench.rigs.scoring_music import KINDS, music
from station.bench.rigs.scoring_peers import PEERS
from station.bench.rigs.scoring_work import PlayedWork, WorkPlayer, f1, flams, grooves, play
from station.music.judgement import Label
from station.music.performance import Performance
from station.music.score import Score
from station.scoring.align import align
from station.scoring.following.follower import Follower
from station.scoring.matching.alignment import Alignment

SIZES = (1_000, 3_000, 10_000, 100_000)
_PLAYER, _HARD_PLAYER, _LIVE_PLAYER = WorkPlayer(), WorkPlayer(drift=0.12), WorkPlayer(drift=0.0)
_SEED = 20
_SEEDS = range(20)
_LIVE_HITS = 3_000
_TIMES = 15


@cache
def _work(notes: int, player: WorkPlayer) -> tuple[Score, PlayedWork]:
    score = grooves(notes, _SEED)
    return score, play(score, player, _SEED)


def _fresh(score: Score) -> Score:
    """The same score with nothing worked out yet."""
    return Score(score.notes, score.tempo_map, score.end_tick, score.title)


def _matched(alignment: Alignment) -> NDArray[np.int64]:
    return np.where(alignment.hit_label == Label.MATCH, alignment.note_of_hit, -1)


def align_f1(score: Score, played: PlayedWork) -> float:
    """The F1 of alignment without a click."""
    return f1(_matched(align(score, played.performance, clocked=False)), played)


def oracle_f1(score: Score, played: PlayedWork) -> float:
    """The F1 of pairing hits that are brought to score time by the true tempo."""
    hits = played.performance.hits.copy()
    hits["at_ns"] = played.hit_score_ns
    order = np.argsort(hits["at_ns"], kind="stable")
    said = np.empty(len(hits), np.int64)
    said[order] = _matched(align(score, Performance.from_array(hits), clocked=True))
    return f1(said, played)


def _below_oracle(notes: int) -> Callable[[], Measurement]:
    def measure() -> Measurement:
        work = _work(notes, _PLAYER)
        oracle, ours = oracle_f1(*work), align_f1(*work)
        peer = peer_f1(_peer_for(notes), notes)
        below = None if peer is None else oracle - peer
        return Measurement(oracle - ours, below, f"F1 {ours:.4f}, oracle {oracle:.4f}")

    return measure


def _hard_f1() -> Measurement:
    return Measurement(align_f1(*_work(10_000, _HARD_PLAYER)), None, "tempo drifts by 12 %")


def _below_oracle_elsewhere() -> Measurement:
    """The worst kind of music's mean over the seeds."""
    below = {kind: float(np.mean([_below(kind, seed) for seed in _SEEDS])) for kind in KINDS}
    return Measurement(max(below.values()), None, ", ".join(f"{kind} {value:.4f}" for kind, value in below.items()))


def _below(kind: str, seed: int) -> float:
    score = music(kind, 1_000, seed)
    played = play(score, _PLAYER, seed)
    return oracle_f1(score, played) - align_f1(score, played)


def seconds(notes: int) -> float:
    """Our median time for so many notes, a score of which nothing is worked out yet."""
    score, played = _work(notes, _PLAYER)
    return median_s(lambda: align(_fresh(score), played.performance, clocked=False), _TIMES if notes < 50_000 else 3)


def _align_3k() -> Measurement:
    peer = peer_seconds(_PEER, 3_000, 3)
    return Measurement(seconds(3_000) * 1e3, None if peer is None else peer * 1e3)


def _align_100k() -> Measurement:
    return Measurement(seconds(100_000), peer_seconds(_QUICK_PEER, 100_000, 1))


def _growth() -> Measurement:
    """The exponent of time ~ notes^k by least squares in logarithms."""
    return _exponent([seconds(notes) for notes in SIZES])


def _exponent(took: Sequence[float]) -> Measurement:
    slope = np.polyfit(np.log(SIZES), np.log(took), 1)[0]
    return Measurement(
        float(slope), None, ", ".join(f"{n}: {s * 1e3:.1f} ms" for n, s in zip(SIZES, took, strict=True))
    )


def _flams_growth() -> Measurement:
    """The exponent where every second note is a grace stroke that nobody plays."""
    took = []
    for notes in SIZES:
        score, played = flams(notes), play(flams(notes, with_grace=False), _LIVE_PLAYER, _SEED)
        took.append(median_s(partial(_align_afresh, score, played.performance), 3))
    return _exponent(took)


def _align_afresh(score: Score, performance: Performance) -> Alignment:
    return align(_fresh(score), performance, clocked=True)


def _peak_mb() -> Measurement:
    score, played = _work(100_000, _PLAYER)
    tracemalloc.start()
    align(_fresh(score), played.performance, clocked=False)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return Measurement(peak / 1e6)


def followed_f1(score: Score, played: PlayedWork) -> float:
    """The F1 of what is judged live, by the last word on each hit, where there is no click to go by."""
    follower, said = Follower(score, clocked=False), np.full(len(played.performance), -1)
    for hit in played.performance:
        for verdict in follower.hit(hit, hit.at_ns):
            if verdict.hit_index is not None:
                matched = verdict.label is Label.MATCH and verdict.note_index is not None
                said[verdict.hit_index] = verdict.note_index if matched else -1
    return f1(said, played)


def _followed_below_oracle(player: WorkPlayer) -> Callable[[], Measurement]:
    def measure() -> Measurement:
        work = _work(3_000, player)
        oracle, ours = oracle_f1(*work), followed_f1(*work)
        return Measurement(oracle - ours, None, f"F1 {ours:.4f}, oracle {oracle:.4f}")

    return measure


def _hit_us(notes: int, percentile: float, clocked: bool = True) -> Callable[[], Measurement]:
    """A percentile of the time of a hit: with a click of the last hits of a score, without one of the first."""

    def measure() -> Measurement:
        score, played = _work(notes, _LIVE_PLAYER if clocked else _PLAYER)
        follower, hits = Follower(score, clocked=clocked), played.performance
        start = max(0, len(hits) - _LIVE_HITS) if clocked else 0
        taken = []
        for hit in (hits[i] for i in range(start, min(start + _LIVE_HITS, len(hits)))):
            begun = time.perf_counter_ns()
            follower.hit(hit, hit.at_ns)
            taken.append(time.perf_counter_ns() - begun)
        return Measurement(float(np.percentile(taken, percentile)) / 1e3, None, f"{len(score)} notes")

    return measure


# --- the peers --------------------------------------------------------------------------------------------------------


def peer_f1(name: str, notes: int) -> float | None:
    """A peer's F1; None where it is not installed."""
    score, played = _work(notes, _PLAYER)
    try:
        return f1(PEERS[name](score, played), played)
    except ImportError:
        return None


def peer_seconds(name: str, notes: int, times: int) -> float | None:
    """A peer's median time; None where it is not installed. Its first run, in which it compiles, does not count."""
    if peer_f1(name, _SMALL) is None:
        return None
    score, played = _work(notes, _PLAYER)
    return median_s(lambda: PEERS[name](score, played), times)


_SMALL = 300
_PEER, _QUICK_PEER = "synctoolbox", "mir_eval"
"""The most exact peer, and the only one that is done with 100k notes in seconds; parangonar takes a minute for 3k."""

_LARGE = 10_000


def _peer_for(notes: int) -> str:
    return _PEER if notes < _LARGE else _QUICK_PEER


BENCHMARKS = (
    *(
        Benchmark(f"align_f1_below_oracle_{n // 1000}k", "F1", 0.001, "lower", _peer_for(n), _below_oracle(n))
        for n in SIZES
    ),
    Benchmark("align_f1_below_oracle_other_music", "F1", 0.001, "lower", None, _below_oracle_elsewhere),
    Benchmark("align_f1_at_12_pct_drift", "F1", 0.99, "higher", None, _hard_f1),
    Benchmark("align_3k_notes", "ms", 15, "lower", _PEER, _align_3k),
    Benchmark("align_100k_notes", "s", 0.5, "lower", _QUICK_PEER, _align_100k),
    Benchmark("align_growth_exponent", "1", 1.1, "lower", None, _growth),
    Benchmark("align_growth_exponent_flams", "1", 1.1, "lower", None, _flams_growth),
    Benchmark("align_100k_peak_memory", "MB", 100, "lower", None, _peak_mb),
    Benchmark("live_hit_median", "µs", 20, "lower", None, _hit_us(3_000, 50)),
    Benchmark("live_hit_p99", "µs", 100, "lower", None, _hit_us(3_000, 99)),
    Benchmark("live_hit_median_100k_notes", "µs", 20, "lower", None, _hit_us(100_000, 50)),
    Benchmark("live_hit_p99_100k_notes", "µs", 100, "lower", None, _hit_us(100_000, 99)),
    Benchmark("no_click_f1_below_oracle_3_pct_drift", "F1", 0.001, "lower", None, _followed_below_oracle(_PLAYER)),
    Benchmark(
        "no_click_f1_below_oracle_12_pct_drift", "F1", 0.001, "lower", None, _followed_below_oracle(_HARD_PLAYER)
    ),
    Benchmark("no_click_hit_median", "µs", 20, "lower", None, _hit_us(3_000, 50, clocked=False)),
    Benchmark("no_click_hit_p99", "µs", 100, "lower", None, _hit_us(3_000, 99, clocked=False)),
    Benchmark("no_click_hit_median_100k_notes", "µs", 20, "lower", None, _hit_us(100_000, 50, clocked=False)),
)
