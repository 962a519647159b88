"""Benchmark of advice: a planted fault is the first thing that is said, and without one nothing is said.

Shipped lessons are played by virtual students. For each fault and each lesson that has places for it, fault-free
sessions tell how much the effect scatters; then the fault is planted with six times that scatter, and beyond what feel
allows, and the first sentence must name it. A soak benchmark: minutes rather than seconds.
"""

from collections.abc import Iterator
from functools import cache
from itertools import combinations
from types import MappingProxyType

import numpy as np

from station.bench.benchmark import Benchmark, Measured
from station.drills.library import find_lesson, lesson_names
from station.music import passages
from station.practice.plan import Plan, Wishes, plan_practice
from station.practice.student_spec import parse_spec
from station.practice.virtual_student import play
from station.scoring.advice import advise
from station.scoring.align import align
from station.scoring.points import FREE_LEAN_MS, FREE_SWING
from station.scoring.summary import Summary, View, summarise

STUDENT = "sd_ms=12,velocity_sd=6,bias_ms=-8,miss_pct=2,extra_pct=1"
SIZE_IN_ERRORS = 6.0
_BEYOND_FEEL = 3.0
"""Standard errors by which a fault lies beyond what is free, where anything is."""

_FREE_DB = 2.0
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
"""Each fault's effect in `station.scoring.habits`, and what is free in its unit."""

_CALM_SEEDS = range(1, 25)
_FAULT_SEEDS = range(101, 111)
_PAIR_SEEDS = range(201, 204)
_SMALLEST = 0.01
"""An effect that never scatters by as much concerns strokes that a virtual student cannot misplace."""

_FEWEST_PLACES, _FEWEST_MOMENTS = 8, 6
"""A lesson with fewer strokes or moments of a kind does not exercise it."""


@cache
def _plan(lesson: str) -> Plan:
    return plan_practice(find_lesson(lesson), Wishes())


def _session(lesson: str, spec: str) -> tuple[Summary, dict[str, int]]:
    """What one session shows, and how many strokes each planted fault concerned."""
    plan = _plan(lesson)
    student = play(plan.score, parse_spec(spec))
    alignment = align(plan.score, student.performance, clocked=True)
    view = View(pass_bars=plan.section.bar_count, first_bar=plan.first_bar)
    return summarise(plan.score, student.performance, alignment, view), student.habit_strokes


@cache
def _calm(lesson: str) -> list[Summary]:
    return [_session(lesson, f"seed={seed},{STUDENT}")[0] for seed in _CALM_SEEDS]


def fault_size(lesson: str, fault: str) -> float | None:
    """The size to plant in this lesson; None where the lesson does not exercise the fault or has no room for it."""
    effect, free = EFFECTS[fault]
    seen = [summary.habits.effects[effect] for summary in _calm(lesson) if effect in summary.habits.effects]
    if len(seen) < len(_CALM_SEEDS) or min(e.slots for e in seen) < _FEWEST_MOMENTS:
        return None
    error = float(np.std([e.value for e in seen], ddof=1))
    if fault == "straight_swing":
        return _swing_size(lesson, error)
    return max(SIZE_IN_ERRORS * error, free + _BEYOND_FEEL * error if free else 0.0)


def _swing_size(lesson: str, error: float) -> float | None:
    """The loss of ratio that is six errors of the offbeats' place, and ends straighter than feel allows."""
    flags, _, places = passages.swung(_plan(lesson).score)
    place = float(np.median(places[flags]))
    written = place / (1 - place)
    straight = place - SIZE_IN_ERRORS * error
    size = max(written - straight / (1 - straight), written - FREE_SWING[0] + 2 * error / (1 - place) ** 2)
    return size if size < written - 1.0 else None


def _planted() -> Iterator[tuple[str, str, float]]:
    for lesson in lesson_names():
        for fault in EFFECTS:
            size = fault_size(lesson, fault)
            if size is not None and size >= _SMALLEST:
                yield lesson, fault, size


def _said(lesson: str, spec: str) -> tuple[list[str], int]:
    """The faults that advice names, and the fewest strokes that a planted one concerned."""
    summary, strokes = _session(lesson, spec)
    return [advice.fault for advice in advise(summary)], min(strokes.values(), default=0)


def _first_named() -> Measured:
    """The worst fault's share, and the share of all."""
    right = dict.fromkeys(EFFECTS, 0)
    tried = dict.fromkeys(EFFECTS, 0)
    for lesson, fault, size in _planted():
        for seed in _FAULT_SEEDS:
            said, strokes = _said(lesson, f"seed={seed},{STUDENT},fault={fault}:{size:.4f}")
            if strokes < _FEWEST_PLACES:
                break
            tried[fault] += 1
            right[fault] += said[:1] == [fault]
    shares = {fault: right[fault] / tried[fault] for fault in EFFECTS if tried[fault]}
    note = ", ".join(f"{fault} {100 * share:.1f} of {tried[fault]}" for fault, share in shares.items())
    return Measured(100 * min(shares.values()), None, note)


def _silent_without() -> Measured:
    said = [bool(advise(summary)) for lesson in lesson_names() for summary in _calm(lesson)]
    return Measured(100 * (1 - float(np.mean(said))), None, f"{len(said)} sessions")


def _both_named() -> Measured:
    """Pairs of faults, three for each lesson, drawn by a seed."""
    sizes: dict[str, dict[str, float]] = {}
    for lesson, fault, size in _planted():
        if fault != "straight_swing":
            sizes.setdefault(lesson, {})[fault] = size
    rng, right, tried = np.random.default_rng(0), 0, 0
    for lesson, of in sizes.items():
        pairs = list(combinations(sorted(of), 2))
        for k in rng.permutation(len(pairs))[:3].tolist():
            one, other = pairs[k]
            for seed in _PAIR_SEEDS:
                faults = f"fault={one}:{of[one]:.4f},fault={other}:{of[other]:.4f}"
                said, strokes = _said(lesson, f"seed={seed},{STUDENT},{faults}")
                if strokes < _FEWEST_PLACES:
                    break
                tried += 1
                right += {one, other} <= set(said)
    return Measured(100 * right / tried, None, f"{tried} sessions")


BENCHMARKS = (
    Benchmark("advice_first_names_fault_worst", "%", 95, "higher", None, _first_named, is_soak=True, limit_s=1800),
    Benchmark("advice_silent_without_fault", "%", 98, "higher", None, _silent_without, is_soak=True, limit_s=600),
    Benchmark("advice_names_both_faults", "%", 85, "higher", None, _both_named, is_soak=True, limit_s=600),
)
