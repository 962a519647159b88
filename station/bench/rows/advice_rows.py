"""Benchmark of advice: a planted fault is the first thing that is said, and without one nothing is said.

Shipped lessons are played by virtual students. For each fault and each lesson that has places for it, fault-free
sessions tell how much the effect scatters; then the fault is planted with six times that scatter, and beyond what feel
allows, and the first sentence must name it. A soak benchmark: minutes rather than seconds;
`benchmarks/planted_faults.py` writes the same figures, fault by fault, into the documentation.
"""

from collections.abc import Iterable, Mapping
from functools import cache
from itertools import combinations
from types import MappingProxyType

import numpy as np

from station.bench.harness.benchmark import Benchmark, Measurement
from station.drills.library import find_lesson, lesson_names
from station.music import passages
from station.practice.session.plan import Plan, PlanOptions, plan_practice
from station.scoring.align import align
from station.scoring.analysis.points import FREE_LEAN_MS, FREE_SWING
from station.scoring.analysis.summary import Summary, SummaryView, summarise
from station.scoring.report.advice import advise
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import play

STUDENT = "sd_ms=12,velocity_sd=6,bias_ms=-8,miss_pct=2,extra_pct=1"
SIZE_IN_ERRORS = 6.0
_BEYOND_FEEL = 3.0
"""Standard errors by which a fault lies beyond what is free, where anything is."""

_FREE_DB = 2.0
"""What most hear (HUMANS: 2–3 dB; the skilled hear 1)."""

EFFECTS = MappingProxyType(
    {
        "late_kick": ("kick", FREE_LEAN_MS),
        "slow_hihat_foot": ("hihat_pedal", FREE_LEAN_MS),
        "rush_fills": ("fills", 0.0),
        "drag_slow": ("long_waits", 0.0),
        "uneven_doubles": ("doubles", 0.0),
        "wide_flams": ("flams", 0.0),
        "weak_left": ("left_level", _FREE_DB),
        "loud_ghosts": ("ghost_level", _FREE_DB),
        "flat_accents": ("accent_level", _FREE_DB),
        "straight_swing": ("swing", 0.0),
    }
)
"""Each fault's effect in `station.scoring.analysis.habits`, and what is free in its unit."""

_CALM_SEEDS = range(1, 97)
"""Fault-free sessions that tell how much an effect scatters, to 7 %. From 24 the luckiest of thirty lessons is given a
fault of four standard errors for one of six."""

FAULT_SEEDS, PAIR_SEEDS = range(101, 201), range(201, 221)
_PAIRS = 3
"""Pairs of faults that are planted together in each lesson, drawn by a seed."""

_SMALLEST = 0.01
"""An effect that never scatters by as much concerns strokes that a virtual student cannot misplace."""

_FEWEST_PLACES, _FEWEST_MOMENTS = 8, 6
"""A lesson with fewer strokes or moments of a kind does not exercise it."""


@cache
def _plan(lesson: str) -> Plan:
    return plan_practice(find_lesson(lesson), PlanOptions())


def _session(lesson: str, spec: str) -> tuple[Summary, dict[str, int]]:
    """What one session shows, and how many strokes each planted fault concerned."""
    plan = _plan(lesson)
    student = play(plan.score, parse_spec(spec))
    alignment = align(plan.score, student.performance, clocked=True)
    view = SummaryView(pass_bars=plan.section.bar_count, first_bar=plan.first_bar)
    return summarise(plan.score, student.performance, alignment, view), student.habit_strokes


@cache
def _calm(lesson: str) -> list[Summary]:
    return [_session(lesson, f"seed={seed},{STUDENT}")[0] for seed in _CALM_SEEDS]


def fault_size(lesson: str, fault: str) -> float | None:
    """The size to plant in this lesson; None where the lesson does not exercise the fault or has no room for it."""
    effect, free = EFFECTS[fault]
    if fault == "weak_left" and not passages.hands_compared(_plan(lesson).score, _FEWEST_PLACES).any():
        return None
    seen = [summary.habits.effects[effect] for summary in _calm(lesson) if effect in summary.habits.effects]
    if len(seen) < len(_CALM_SEEDS) or min(e.slots for e in seen) < _FEWEST_MOMENTS:
        return None
    error = float(np.std([e.value for e in seen], ddof=1))
    if fault == "straight_swing":
        return _swing_size(lesson, error)
    return max(SIZE_IN_ERRORS * error, free + _BEYOND_FEEL * error if free else 0.0)


def _swing_size(lesson: str, error: float) -> float | None:
    """The loss of ratio that is six errors of the offbeats' place, and ends straighter than feel allows."""
    place = passages.swung(_plan(lesson).score).written_place
    written = place / (1 - place)
    straight = place - SIZE_IN_ERRORS * error
    size = max(written - straight / (1 - straight), written - FREE_SWING[0] + _BEYOND_FEEL * error / (1 - place) ** 2)
    return size if size < written - 1.0 else None


def planted(lesson: str) -> dict[str, float]:
    """The faults that a lesson exercises, with the size to plant."""
    sizes = {fault: fault_size(lesson, fault) for fault in EFFECTS}
    return {fault: size for fault, size in sizes.items() if size is not None and size >= _SMALLEST}


def named_first(lesson: str, fault: str, size: float, seeds: Iterable[int]) -> list[bool]:
    """Whether the first sentence names the fault, seed by seed; empty where it concerns too few strokes."""
    right = []
    for seed in seeds:
        said, strokes = _said(lesson, f"seed={seed},{STUDENT},fault={fault}:{size:.4f}")
        if strokes < _FEWEST_PLACES:
            break
        right.append(said[:1] == [fault])
    return right


def silent(lesson: str, seeds: Iterable[int]) -> list[bool]:
    """Whether a session without a fault gets no advice, seed by seed."""
    return [not _said(lesson, f"seed={seed},{STUDENT}")[0] for seed in seeds]


def pairs_of(sizes: Mapping[str, float]) -> list[dict[str, float]]:
    """Some pairs of `sizes`. Swing is left out: whoever plays straight plays no swing to judge."""
    pairs = list(combinations(sorted(fault for fault in sizes if fault != "straight_swing"), 2))
    drawn = np.random.default_rng(len(pairs)).permutation(len(pairs))[:_PAIRS]
    return [{fault: sizes[fault] for fault in pairs[k]} for k in drawn.tolist()]


def both_named(lesson: str, pair: Mapping[str, float], seeds: Iterable[int]) -> list[bool]:
    """Whether all sentences together name both faults, seed by seed; empty where one concerns too few strokes."""
    faults, right = ",".join(f"fault={fault}:{size:.4f}" for fault, size in pair.items()), []
    for seed in seeds:
        said, strokes = _said(lesson, f"seed={seed},{STUDENT},{faults}")
        if strokes < _FEWEST_PLACES:
            break
        right.append(set(pair) <= set(said))
    return right


def _said(lesson: str, spec: str) -> tuple[list[str], int]:
    """The faults that advice names, and the fewest strokes that a planted one concerned."""
    summary, strokes = _session(lesson, spec)
    return [advice.fault for advice in advise(summary)], min(strokes.values(), default=0)


def _first_named() -> Measurement:
    """The worst fault's share, and the share of all."""
    right: dict[str, list[bool]] = {fault: [] for fault in EFFECTS}
    for lesson in lesson_names():
        for fault, size in planted(lesson).items():
            right[fault] += named_first(lesson, fault, size, FAULT_SEEDS)
    shares = {fault: 100 * float(np.mean(said)) for fault, said in right.items() if said}
    note = ", ".join(f"{fault} {share:.1f} of {len(right[fault])}" for fault, share in shares.items())
    return Measurement(min(shares.values()), None, note)


def _silent_without() -> Measurement:
    said = [quiet for lesson in lesson_names() for quiet in silent(lesson, FAULT_SEEDS)]
    return Measurement(100 * float(np.mean(said)), None, f"{len(said)} sessions")


def _both_named() -> Measurement:
    right: list[bool] = []
    for lesson in lesson_names():
        for pair in pairs_of(planted(lesson)):
            right += both_named(lesson, pair, PAIR_SEEDS)
    return Measurement(100 * float(np.mean(right)), None, f"{len(right)} sessions")


BENCHMARKS = (
    Benchmark("advice_first_names_fault_worst", "%", 95, "higher", None, _first_named, is_soak=True, limit_s=3600),
    Benchmark("advice_silent_without_fault", "%", 98, "higher", None, _silent_without, is_soak=True, limit_s=1200),
    Benchmark("advice_names_both_faults", "%", 85, "higher", None, _both_named, is_soak=True, limit_s=1200),
)
