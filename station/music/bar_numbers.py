"""Bars as people name them: counted from 1, runs as ranges."""

from collections.abc import Iterable
from itertools import groupby

_RUNS_NAMED = 8
"""Runs of bars that a sentence names (our choice: what fits a line)."""


def bar_numbers(bars: Iterable[int]) -> str:
    """Bars, from 0, as people write them, from 1: "1–3, 5"; no more than fit a line."""
    ordered = sorted(set(bars))
    runs = [[bar for _, bar in run] for _, run in groupby(enumerate(ordered), key=lambda each: each[1] - each[0])]
    said = [f"{run[0] + 1}–{run[-1] + 1}" if len(run) > 1 else f"{run[0] + 1}" for run in runs]
    return ", ".join(said[:_RUNS_NAMED]) + (" …" if len(said) > _RUNS_NAMED else "")


def named_bars(bars: Iterable[int]) -> str:
    """The same after their noun: "bar 5" or "bars 1–3, 5"."""
    found = set(bars)
    return f"bar{'s' if len(found) != 1 else ''} {bar_numbers(found)}"
