"""Benchmarks of the mastery policy: what it saves and what sticks, beside a fixed ladder, on simulated learners.

A short form of the trial that `benchmarks/mastery.py` runs at length: a learner of each of some kinds, so that the
figures move with chance; docs/mastery.md has those of more learners of every kind.
"""

from statistics import fmean

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.mastery_trial import repetitions, trial

OURS, PEER = "ours", "fixed ladder"
_KINDS = ("usual", "gifted", "slow", "swapped_toms", "quitter")
_WEEK_KINDS = ("usual", "gifted")
"""Kinds that some policy brings to the criterion within the trial's hour; fewer where the whole hour is played."""
_LIMIT_S = 90.0


def _repetitions() -> Measurement:
    means = {t: fmean(repetitions(t, kind, i) for i, kind in enumerate(_KINDS)) for t in (OURS, PEER)}
    return Measurement(means[OURS] / means[PEER], 1.0, f"{means[OURS]:.0f} repetitions against {means[PEER]:.0f}")


def _week() -> Measurement:
    kept = {t: fmean(trial(t, kind, i).week_pct for i, kind in enumerate(_WEEK_KINDS)) for t in (OURS, PEER)}
    note = f"{kept[OURS]:.0f} % of the notes right, blind, against {kept[PEER]:.0f} %"
    return Measurement(kept[OURS] - kept[PEER], 0.0, note)


BENCHMARKS = (
    Benchmark("mastery_repetitions_vs_ladder", "", 0.8, "lower", PEER, _repetitions, limit_s=_LIMIT_S),
    Benchmark("mastery_blind_after_a_week_vs_ladder", "points", 0.0, "higher", PEER, _week, limit_s=_LIMIT_S),
)
