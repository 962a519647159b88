"""Which bar holds most of the mistakes, by a tally that forgets.

A bar's faults are strokes left out, on a wrong pad, or clearly out of time. Later passes weigh more.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from station.drills.mastery.pass_measures.pass_facts import BarResult
from station.drills.mastery.rules import Rules


@dataclass(frozen=True, slots=True)
class BarTally:
    """Of the lesson's bar `bar` (from 0): notes and faults of late, older passes weighing less."""

    bar: int
    notes: float
    faults: float


@dataclass(frozen=True, slots=True)
class WeakBar:
    """A bar with so many of all the `faults` of late."""

    bar: int
    faults: float
    of: float


def tallied(tally: tuple[BarTally, ...], bars: Iterable[BarResult], rules: Rules) -> tuple[BarTally, ...]:
    """The tally after one more pass over the whole."""
    old = {row.bar: row for row in tally}
    new = {}
    for result in bars:
        before = old.get(result.bar, BarTally(result.bar, 0.0, 0.0))
        new[result.bar] = BarTally(
            result.bar,
            rules.tally_kept * before.notes + result.notes,
            rules.tally_kept * before.faults + result.notes - result.right,
        )
    return tuple(sorted((old | new).values(), key=lambda row: row.bar))


def without(tally: tuple[BarTally, ...], bar: int) -> tuple[BarTally, ...]:
    """The tally with one bar's past forgotten: it was practised since."""
    return tuple(row for row in tally if row.bar != bar)


def weakest(tally: tuple[BarTally, ...], rules: Rules) -> WeakBar | None:
    """The bar to practise alone; None where mistakes are few or everywhere."""
    notes, faults = sum(row.notes for row in tally), sum(row.faults for row in tally)
    if len(tally) < 2:
        return None
    worst = max(tally, key=lambda row: (row.faults / row.notes if row.notes else 0.0, -row.bar))
    share = worst.faults / worst.notes if worst.notes else 0.0
    others = (faults - worst.faults) / max(notes - worst.notes, 1.0)
    if worst.faults < rules.weak_faults or share < rules.weak_share or share < rules.weak_contrast * others:
        return None
    return WeakBar(worst.bar, worst.faults, faults)
