"""Is a late entry recognised, and is nobody told of one who is in time: takes of both, counted.

    .venv/bin/python benchmarks/late_entries.py [--takes 2000]

`station/bench/rigs/journeys/late_entries.py` says what is played. Of each level and shift: what was told at the end
(right: the shift itself; none; another), separately for takes whose place an ear could tell; how often the last
live word was right, and after how many strokes it was first told, by median and 95th percentile.
"""

import argparse
from collections import Counter, defaultdict
from collections.abc import Iterable
from itertools import chain

import numpy as np

from station.bench.rigs.journeys.late_entries import (
    LEVELS,
    OTHER,
    SHIFTS,
    EntryTake,
    gmd_entries,
    lesson_take,
    other_take,
)
from station.practice.session.judging import Judging
from station.scoring.align import align
from station.scoring.analysis.entries import entries

_FEWEST = 8
"""Strokes of a take that is worth asking about."""
_SAME = 0.26
"""Quarters: the shift itself, and what is counted in halves of a beat beside a compound meter's."""


def told(take: EntryTake) -> float:
    """Quarters late by which the entry is told at the end, 0 for none."""
    found = entries(take.score, take.performance, align(take.score, take.performance, clocked=True))
    return max(found, key=lambda entry: entry.strokes).quarters if found else 0.0


def live(take: EntryTake) -> tuple[int | None, float]:
    """The stroke, from 1, at which an entry was first told while it was played, and the last word."""
    judging, first = Judging(take.score, clocked=True), None
    for number, hit in enumerate(take.performance, 1):
        judging.hit(hit)
        if first is None and judging.beats_behind:
            first = number
    return first, judging.beats_behind


def report(takes: Iterable[EntryTake]) -> str:
    """The table of confusions, a line a level and shift."""
    verdicts: dict[tuple[str, str, bool], Counter[str]] = defaultdict(Counter)
    after: dict[tuple[str, str, bool], list[int]] = defaultdict(list)
    for take in takes:
        if len(take.performance) < _FEWEST:
            continue
        key = take.level, take.shift, take.can_be_told or not take.quarters
        said, (number, last) = told(take), live(take)
        is_right = abs(said - take.quarters) < _SAME
        verdicts[key]["right" if is_right else "none" if said == 0 else "other"] += 1
        is_live = abs(last - take.quarters) < _SAME
        verdicts[key]["live"] += is_live
        if take.quarters and is_live and number is not None:
            after[key].append(number)
    lines = [
        "| who | beats late | an ear can tell | takes | right | none | other | live right | strokes (median, p95) |",
        "|---|---|---|---|---|---|---|---|---|",
    ]
    for level in (*LEVELS, OTHER, "gmd"):
        for shift in SHIFTS:
            lines += [
                _line(level, shift, ear, verdicts, after) for ear in (True, False) if (level, shift, ear) in verdicts
            ]
    return "\n".join(lines)


def _line(
    level: str,
    shift: str,
    ear: bool,
    verdicts: dict[tuple[str, str, bool], Counter[str]],
    after: dict[tuple[str, str, bool], list[int]],
) -> str:
    counts, strokes = verdicts[level, shift, ear], after[level, shift, ear]
    takes = counts["right"] + counts["none"] + counts["other"]
    when = f"{np.median(strokes):.0f}, {np.percentile(strokes, 95):.0f}" if strokes else ""
    shares = [f"{100 * counts[name] / takes:.0f} %" for name in ("right", "none", "other", "live")]
    hear = "" if shift == "0" else "yes" if ear else "no"
    return f"| {level} | {shift} | {hear} | {takes} | {' | '.join(shares)} | {when} |"


def main() -> None:
    """Play and print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--takes", type=int, default=2000)
    asked = parser.parse_args()
    others = map(other_take, range(asked.takes // 8))
    print(report(chain(map(lesson_take, range(asked.takes)), others, *(gmd_entries(seed) for seed in range(3)))))


if __name__ == "__main__":
    main()
