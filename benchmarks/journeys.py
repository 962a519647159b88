"""Where is the player? Thousands of takes of people who begin anywhere, skip, repeat, stop and go on.

    .venv/bin/python benchmarks/journeys.py --quick [--kind KIND] [--click | --no-click]
    .venv/bin/python benchmarks/journeys.py --takes 2000 --processes 2 [--out FILE.md]
    .venv/bin/python benchmarks/journeys.py --show KIND SEED [--click]

`station/bench/rigs/journeys/journeys.py` says what is played, `journey_truth.py` what an ear can know of it. The
columns: F1 of the pairs below an oracle's who knows the way and the tempo, its median, its 95th percentile, and the
share of takes that lie more than .03 below; turns (skips, repeats, stops …) that could be heard and start no segment of
ours; takes with a segment that nobody began; notes on which the last live word is the final one, and hits on which it
is where notes that are alike count as one; the largest change of the score when the same take lies elsewhere in its
file; lessons whose passes are told exactly, all, and those whose loop no shorter figure makes up. `--show` prints the
true way of a take beside ours.
"""

import argparse
import time
from collections import defaultdict
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from itertools import islice, pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from station.bench.rigs.journeys.journey_takes import Take
from station.bench.rigs.journeys.journey_truth import Truth
from station.bench.rigs.journeys.journeys import CLICK_KINDS, KINDS, journey
from station.bench.rows.journey_rows import Result, matched, measure
from station.core.units import NS_PER_S
from station.scoring.align import align

_QUICK_TAKES = 200
_WORST = 3
_TOLD = 0.03
"""The part's bound for 95 % of takes."""


_COLUMNS = (
    *("kind", "takes", "median", "p95", "> .03", "turns missed", "with false turns"),
    *("live = final", "by hit", "score moves", "passes", "worst"),
)


class Task(NamedTuple):
    """One take, and what is asked of it."""

    kind: str
    seed: int
    clocked: bool
    offsets: bool


def run(task: Task) -> Result:
    """Measure it."""
    return measure(task.kind, task.seed, task.clocked, offsets=task.offsets)


def tasks(kinds: list[tuple[str, bool]], takes: int, first_seed: int) -> list[Task]:
    """So many takes, kind by kind in turn; offsets are asked of every third round, for they cost four alignments."""
    rounds = -(-takes // len(kinds))
    return [Task(kind, first_seed + i, clocked, (i // 3) % 3 == 0) for i in range(rounds) for kind, clocked in kinds]


def asked(kind: str | None, click: bool | None) -> list[tuple[str, bool]]:
    """Kinds and whether with a click."""
    free = [(k, False) for k in (*KINDS, "passes")] if click is not True else []
    clicked = [(k, True) for k in CLICK_KINDS] if click is not False else []
    return [each for each in (*free, *clicked) if kind in (None, each[0])]


def table(results: Iterable[Result]) -> str:
    """A line for each kind, without a click and with, and the seeds of the worst takes."""
    by: dict[tuple[bool, str], list[Result]] = defaultdict(list)
    for result in results:
        by[result.clocked, result.kind].append(result)
    lines = [f"| {' | '.join(_COLUMNS)} |", "|---" * len(_COLUMNS) + "|"]
    for clocked in (False, True):
        groups = {kind: group for (c, kind), group in by.items() if c == clocked}
        for kind, group in groups.items():
            lines.append(_line(f"{kind}{', click' if clocked else ''}", group))
        if len(groups) > 1:
            together = [result for group in groups.values() for result in group]
            lines.append(_line(f"**all{', click' if clocked else ''}**", together))
    return "\n".join(lines)


def _line(name: str, group: list[Result]) -> str:
    loss = np.array([result.loss for result in group])
    turns = sum(result.turns for result in group)
    moved = [result.score_change for result in group if result.score_change is not None]
    passes = [result for result in group if result.passes is not None]
    exact = [f"{_exact(some)}" for some in (passes, [result for result in passes if result.has_seam])]
    worst = sorted((r for r in group if r.loss > 0), key=lambda result: -result.loss)[:_WORST]
    return " | ".join(
        (
            f"| {name}",
            f"{len(group)}",
            f"{np.median(loss):.4f}",
            f"{np.percentile(loss, 95):.4f}",
            f"{100 * np.mean(loss > _TOLD):.1f} %",
            f"{100 * sum(result.turns_missed for result in group) / turns:.1f} %" if turns else "",
            f"{100 * np.mean([result.false_turns > 0 for result in group]):.1f} %",
            *_live(group),
            f"{max(moved):.1f}" if moved else "",
            " / ".join(exact) if passes else "",
            ", ".join(f"{r.kind + ' ' if '*' in name else ''}{r.seed} ({r.loss:.3f})" for r in worst) + " |",
        )
    )


def _exact(group: list[Result]) -> str:
    return f"{100 * np.mean([result.passes == result.passes_told for result in group]):.1f} %" if group else ""


def _live(group: list[Result]) -> tuple[str, str]:
    notes = sum(result.live_notes or 0 for result in group)
    hits = [result.live_hits for result in group if result.live_hits is not None]
    equal = sum(result.live_equal or 0 for result in group)
    return (f"{100 * equal / notes:.2f} %", f"{100 * np.mean(hits):.2f} %") if notes else ("", "")


# --- one take to look at ----------------------------------------------------------------------------------------------


def show(take: Take) -> str:
    """The true way of a take, then ours, a line for each segment."""
    truth = Truth(take)
    alignment = align(take.score, take.performance, clocked=take.clocked)
    said = matched(alignment)
    right, at_s = truth.right(said), take.performance.hits["at_ns"] / NS_PER_S
    tempo, player = take.score.tempo_map, take.player
    lines = [
        f"{take.name}: {len(take.score)} notes, {take.score.bar_count} bars of {tempo.meter_at(0).beats}/"
        f"{tempo.meter_at(0).unit} at {tempo.bpm_at(0):.0f}, {take.score.length_ns / NS_PER_S:.0f} s written",
        f"speed {player.speed:.2f}, drift {player.drift:+.2f} {'ramp' if player.ramps else 'sine'}, "
        f"SD {player.sd_ms:.0f} ms, {'click' if take.clocked else 'no click'}",
        f"F1 {truth.f1(said, alignment.hit_score_ns):.4f}, oracle {truth.f1(truth.oracle()):.4f}",
        "true way (bar.beat, from 1; other readings as shifts in beats):",
    ]
    for i, leg in enumerate(take.legs):
        rows = take.leg == i
        others = [
            f"{s / tempo.meter_at(0).beat_ticks:+g} in {_at(take, a)}-{_at(take, b)}"
            for s, a, b in truth.readings[i]
            if a < b
        ]
        lines.append(
            f"  {at_s[rows].min():7.2f}-{at_s[rows].max():7.2f} s  {_at(take, leg.first)} -> {_at(take, leg.last)}"
            f"  after {leg.wait_s:.1f} s, {rows.sum()} hits, {right[rows].sum()} right"
            f"{'; or ' + ', '.join(others[:4]) if others else ''}{' ...' if len(others) > 4 else ''}"
        )
    lines.append("our way (where the slope breaks, a new line):")
    for rows in _runs(alignment.segment, alignment.hit_score_ns / NS_PER_S, at_s):
        first, last = tempo.ticks_at_ns(np.maximum(alignment.hit_score_ns[rows[[0, -1]]], 0)).tolist()
        off = np.median(alignment.hit_score_ns[rows] - take.true_ns[rows]) / NS_PER_S
        lines.append(
            f"  {at_s[rows[0]]:7.2f}-{at_s[rows[-1]]:7.2f} s  {_at(take, first)} -> {_at(take, last)}"
            f"  segment {alignment.segment[rows[0]]}, {len(rows)} hits, {(said[rows] >= 0).sum()} matched,"
            f" {right[rows].sum()} right, {off:+.2f} s from the truth"
        )
    return "\n".join(lines)


def _at(take: Take, tick: int) -> str:
    position = take.score.tempo_map.position_at(int(tick))
    beat = take.score.tempo_map.meter_at(int(tick)).beat_ticks
    return f"{position.bar + 1}.{position.beat + 1 + position.tick / beat:.3g}"


_BREAK_S = 0.3
"""A jump of score time against real time by more than this is shown on a line of its own."""


def _runs(segment: np.ndarray, score_s: np.ndarray, at_s: np.ndarray) -> list[np.ndarray]:
    steps = np.diff(score_s), np.diff(at_s)
    rate = np.median(steps[0][steps[1] > 0] / steps[1][steps[1] > 0]) if len(at_s) > 1 else 1.0
    breaks = (np.diff(segment) != 0) | (np.abs(steps[0] - rate * steps[1]) > _BREAK_S)
    ends = [0, *(np.flatnonzero(breaks) + 1).tolist(), len(at_s)]
    return [np.arange(a, b) for a, b in pairwise(ends) if b > a]


# --- the command ------------------------------------------------------------------------------------------------------


def main() -> None:
    """Parse, measure, print."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--quick", action="store_true", help=f"about {_QUICK_TAKES} takes on one core")
    parser.add_argument("--takes", type=int, default=2_000)
    parser.add_argument("--kind", choices=sorted({*KINDS, *CLICK_KINDS, "passes"}))
    parser.add_argument("--click", action=argparse.BooleanOptionalAction, default=None)
    parser.add_argument("--first-seed", type=int, default=0)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--show", nargs=2, metavar=("KIND", "SEED"))
    parser.add_argument("--out", type=Path)
    options = parser.parse_args()
    if options.show:
        print(show(journey(options.show[0], int(options.show[1]), bool(options.click))))
        return
    takes = _QUICK_TAKES if options.quick else options.takes
    todo = tasks(asked(options.kind, options.click), takes, options.first_seed)
    begun = time.perf_counter()
    if options.quick or options.processes == 1:
        results = [run(task) for task in todo]
    else:
        with ProcessPoolExecutor(options.processes) as pool:
            results = list(pool.map(run, islice(todo, None), chunksize=8))
    text = f"{table(results)}\n\n{len(results)} takes in {time.perf_counter() - begun:.0f} s"
    print(text)
    if options.out:
        options.out.write_text(text + "\n")


if __name__ == "__main__":
    main()
