"""An item to master and passes over it, made by hand: four bars of ten strokes, two seconds each, at 120 bpm."""

from collections.abc import Iterable
from datetime import date

from station.drills.mastery.mastery_state import ItemState
from station.drills.mastery.next_pass import new_item, next_step
from station.drills.mastery.pass_measures.pass_facts import BarResult, PassResult
from station.drills.mastery.practice_steps import PracticeItem
from station.drills.mastery.rules import DEFAULT_RULES, Rules

DAY = date(2024, 3, 1)
ITEM = PracticeItem("rock", 120.0, 0, (10, 10, 10, 10), (2.0, 2.0, 2.0, 2.0))
INTERVAL_MS = 250.0


def result(right: int = 40, notes: int = 40, sd_ms: float | None = 15.0, wrong_pads: int = 0) -> PassResult:
    """A pass without faults by bar."""
    return PassResult(notes, right, wrong_pads, sd_ms=sd_ms, lean_ms=0.0, interval_ms=INTERVAL_MS)


CLEAN = result()
BAD = result(right=34)
"""85 %: not the 90 of a clean pass, not below the 80 of a broken one."""
BROKEN = result(right=31)
"""77.5 %."""
LOOSE = PassResult(40, 40, sd_ms=45.0, lean_ms=0.0, interval_ms=500.0)
"""All right, spread 9 % of a slow interval, beyond the 35 ms of a clean pass."""


def weak_second_bar(right: int = 34) -> PassResult:
    """A pass all of whose faults lie in the second bar."""
    bars = tuple(BarResult(bar, 10, right - 30 if bar == 1 else 10) for bar in range(4))
    return PassResult(40, right, sd_ms=15.0, lean_ms=0.0, interval_ms=INTERVAL_MS, bars=bars)


def played(passes: Iterable[PassResult], rules: Rules = DEFAULT_RULES, state: ItemState | None = None) -> ItemState:
    """The state after `passes`."""
    state = state or new_item(ITEM, DAY, rules)
    for one in passes:
        state, _ = next_step(state, one, rules)
    return state


def asked(passes: Iterable[PassResult], rules: Rules = DEFAULT_RULES) -> list[tuple[str, float]]:
    """Kind and tempo (percent) of each pass, and of the one that is asked for after the last."""
    state = new_item(ITEM, DAY, rules)
    steps = [state.step]
    for one in passes:
        state, step = next_step(state, one, rules)
        steps.append(step)
    return [(step.kind.value, step.pct) for step in steps]
