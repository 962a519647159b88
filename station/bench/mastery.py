"""Benchmarks of the mastery policy: what it saves and what sticks, beside a fixed ladder, on simulated learners.

A short form of the trial that `benchmarks/mastery.py` runs at length: one learner of each kind (three kinds after a
week), so that the figures move with chance; docs/mastery.md has those of a hundred each.
"""

from statistics import fmean

from station.bench.benchmark import Benchmark, Measured
from station.bench.mastery_trial import trial
from station.practice.learner_kinds import LEARNERS

OURS, PEER = "ours", "fixed ladder"
_WEEK_KINDS = ("usual", "gifted", "slow")


def _repetitions() -> Measured:
    means = {t: fmean(trial(t, kind, i).repetitions for i, kind in enumerate(LEARNERS)) for t in (OURS, PEER)}
    return Measured(means[OURS] / means[PEER], 1.0, f"{means[OURS]:.0f} repetitions against {means[PEER]:.0f}")


def _week() -> Measured:
    kept = {t: fmean(trial(t, kind, i).week_pct for i, kind in enumerate(_WEEK_KINDS)) for t in (OURS, PEER)}
    note = f"{kept[OURS]:.0f} % of the notes right, blind, against {kept[PEER]:.0f} %"
    return Measured(kept[OURS] - kept[PEER], 0.0, note)


BENCHMARKS = (
    Benchmark("mastery_repetitions_to_criterion", "× ladder", 0.8, "lower", PEER, _repetitions),
    Benchmark("mastery_blind_retention_a_week", "points", 0.0, "higher", PEER, _week),
)
