"""Benchmark of advice: a planted fault is the first thing that is said, and without one nothing is said.

`station.bench.rigs.planted.planted_table` plays lessons and human grooves with faults of a teacher's sizes, on code
that shares nothing with what judges them; `docs/planted-faults.md` says how. Soak benchmarks: minutes rather than
seconds.
"""

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.planted.planted_faults import FAULTS
from station.bench.rigs.planted.planted_table import measure
from station.bench.rigs.planted.planted_trials import NONE, PAIRS, Tally

_TAKES = 100
"""Of a word; a share of 95 % is then known to 2 %."""


_GROUP, _LIMIT_S = "planted faults", 7200.0
"""One process, for all need the same music with the oracle's sizes, which takes minutes to make."""


def _share(count: int, tally: Tally) -> float:
    return 100 * count / tally.takes


def _first_named() -> Measurement:
    """The worst word's share; all of them in the note."""
    tallies = {name: measure(name, _TAKES, quick=False) for name in FAULTS}
    shares = {name: _share(tally.first, tally) for name, tally in tallies.items() if tally.takes}
    return Measurement(min(shares.values()), None, ", ".join(f"{name} {share:.0f}" for name, share in shares.items()))


def _innocent_first() -> Measurement:
    """Takes in which a piece or limb without fault is blamed first, of all words."""
    total = Tally()
    for name in FAULTS:
        total.merge(measure(name, _TAKES // 4, quick=False))
    return Measurement(_share(total.innocent, total), None, f"{total.takes} takes")


def _silent_without() -> Measurement:
    tally = measure(NONE, 10 * _TAKES, quick=False)
    return Measurement(_share(tally.silent, tally), None, f"{tally.takes} takes")


def _both_named() -> Measurement:
    tally = measure(PAIRS, 10 * _TAKES, quick=False)
    return Measurement(_share(tally.first, tally), None, f"{tally.takes} takes")


BENCHMARKS = (
    Benchmark(
        "advice_first_names_fault_worst",
        "%",
        95,
        "higher",
        None,
        _first_named,
        is_soak=True,
        limit_s=_LIMIT_S,
        group=_GROUP,
    ),
    Benchmark(
        "advice_blames_innocent_first",
        "%",
        1,
        "lower",
        None,
        _innocent_first,
        is_soak=True,
        limit_s=_LIMIT_S,
        group=_GROUP,
    ),
    Benchmark(
        "advice_silent_without_fault",
        "%",
        99,
        "higher",
        None,
        _silent_without,
        is_soak=True,
        limit_s=_LIMIT_S,
        group=_GROUP,
    ),
    Benchmark(
        "advice_names_both_faults", "%", 85, "higher", None, _both_named, is_soak=True, limit_s=_LIMIT_S, group=_GROUP
    ),
)
