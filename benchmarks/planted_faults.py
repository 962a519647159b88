"""How surely advice names what is wrong: planted faults over all shipped lessons, fault by fault.

    .venv/bin/python benchmarks/planted_faults.py --minutes 30 --processes 2 --out docs/planted-faults.md

Sessions are played in rounds of ten seeds, all lessons and faults in each, so that whenever time ends every lesson and
fault has had the same number of seeds; the page says how many. `station.bench.rows.advice_rows` says how it is done.
"""

import argparse
import time
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import NamedTuple

import numpy as np

from station.bench.rows.advice_rows import (
    FAULT_SEEDS,
    PAIR_SEEDS,
    STUDENT,
    both_named,
    named_first,
    pairs_of,
    planted,
    silent,
)
from station.drills.library import lesson_names
from station.simulation.student_spec import FAULTS

_SEEDS_A_ROUND = 10
_NONE, _BOTH = "none", "both"


class Task(NamedTuple):
    """One lesson's sessions of one round, the faults with their sizes."""

    lesson: str
    sizes: dict[str, float]
    round: int


class Said(NamedTuple):
    """What a task found: of each fault (or none, or pairs), seed by seed, whether advice was right."""

    lesson: str
    sizes: dict[str, float]
    right: dict[str, list[bool]]


def play(task: Task) -> Said:
    """All sessions of a task."""
    first = task.round * _SEEDS_A_ROUND
    seeds, pair_seeds = (all_of[first : first + _SEEDS_A_ROUND] for all_of in (FAULT_SEEDS, PAIR_SEEDS))
    right = {fault: named_first(task.lesson, fault, size, seeds) for fault, size in task.sizes.items()}
    right[_NONE] = silent(task.lesson, seeds)
    right[_BOTH] = [said for pair in pairs_of(task.sizes) for said in both_named(task.lesson, pair, pair_seeds)]
    return Said(task.lesson, task.sizes, right)


def rounds(minutes: float, processes: int) -> Iterator[list[Said]]:
    """Round after round, until one more would not end in time or all seeds are played."""
    begun = time.monotonic()
    with ProcessPoolExecutor(processes) as pool:
        lessons = lesson_names()
        sizes = list(pool.map(planted, lessons))
        for k in range(len(FAULT_SEEDS) // _SEEDS_A_ROUND):
            tasks = [Task(lesson, of, k) for lesson, of in zip(lessons, sizes, strict=True)]
            yield list(pool.map(play, tasks))
            print(f"round {k + 1} after {time.monotonic() - begun:.0f} s", flush=True)
            if (time.monotonic() - begun) * (k + 2) / (k + 1) > 60 * minutes:
                return


def page(found: list[list[Said]]) -> str:
    """The page for people."""
    right: dict[str, list[bool]] = defaultdict(list)
    lessons: dict[str, dict[str, list[bool]]] = defaultdict(lambda: defaultdict(list))
    sizes: dict[str, list[float]] = defaultdict(list)
    for said in (said for one_round in found for said in one_round):
        for fault, results in said.right.items():
            right[fault] += results
            lessons[fault][said.lesson] += results
            sizes[fault] += [said.sizes[fault]] if fault in said.sizes and results else []
    seeds = len(found) * _SEEDS_A_ROUND
    lines = [_HEAD.format(seeds=seeds, student=STUDENT), "| fault | size | lessons | sessions | right | worst lesson |"]
    lines.append("|---|---|---|---|---|---|")
    for fault in (fault for fault in FAULTS if right[fault]):
        low, high = np.min(sizes[fault]), np.max(sizes[fault])
        lines.append(f"| `{fault}` | {low:.1f}–{high:.1f} {FAULTS[fault].unit} | {_figures(lessons[fault])} |")
    lines.append(f"| none: no sentence at all | | {_figures(lessons[_NONE])} |")
    lines.append(f"| two at once: both named | | {_figures(lessons[_BOTH])} |")
    return "\n".join(lines) + "\n"


def _figures(lessons: dict[str, list[bool]]) -> str:
    played = {lesson: results for lesson, results in lessons.items() if results}
    every = [right for results in played.values() for right in results]
    worst = min(played, key=lambda lesson: float(np.mean(played[lesson])))
    share, worst_share = 100 * float(np.mean(every)), 100 * float(np.mean(played[worst]))
    return f"{len(played)} | {len(every)} | **{share:.1f} %** | `{worst}` {worst_share:.0f} %"


_HEAD = """# How surely advice names what is wrong

Written by `benchmarks/planted_faults.py`; {seeds} seeds a lesson and fault, 20 at most for pairs.

A virtual student (`{student}`) plays every shipped lesson
that exercises a fault. The fault's size is six standard errors: six times the scatter of its effect over 96 sessions
without a fault; where feel is free, at least three standard errors beyond that. *Right* is the share of sessions whose
first sentence names the fault.

A lesson exercises a fault where it has at least 8 strokes and 6 moments of its kind. It exercises `weak_left` only
where a dynamic is played by both hands: where the left hand has all the accents, a weak left hand and flat accents
sound alike, and advice names what was written and not heard: the accents.
"""


def main() -> None:
    """Play and write the page."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--minutes", type=float, default=30)
    words.add_argument("--processes", type=int, default=2)
    words.add_argument("--out", type=Path, default=Path("docs/planted-faults.md"))
    asked = words.parse_args()
    asked.out.write_text(page(list(rounds(asked.minutes, asked.processes))), encoding="utf-8")


if __name__ == "__main__":
    main()
