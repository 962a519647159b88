"""Teaching policies compared on simulated learners, at length: the table of docs/mastery.md.

    python benchmarks/mastery.py --seeds 100 [--kinds usual,slow] [--tutors ours,none] [--jobs N] [--out OUTCOMES.jsonl]

Each learner costs seconds of computing. Outcomes are written to OUT as they come, and those that stand there are not
computed again, so that a run can be broken off and taken up. This validates the controller, not people.
"""

import argparse
import json
import sys
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from pathlib import Path
from statistics import fmean, stdev

from station.bench.mastery_trial import Outcome, trial
from station.bench.mastery_tutors import TUTORS
from station.practice.learner_kinds import LEARNERS

Key = tuple[str, str, int]
"""Tutor, kind of learner, seed."""

COLUMNS = (
    ("reached %", "reached", 100.0),
    ("minutes", "minutes", 1.0),
    ("repetitions", "repetitions", 1.0),
    ("wrong %", "wrong_pct", 1.0),
    ("day %", "day_pct", 1.0),
    ("week %", "week_pct", 1.0),
    ("transfer %", "transfer_pct", 1.0),
    ("found %", "found_pct", 1.0),
    ("turns", "turns", 1.0),
    ("unused min", "unused_min", 1.0),
    ("gone %", "gone", 100.0),
)


def main() -> int:
    """Run what is missing and print the tables."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--kinds", default=",".join(LEARNERS))
    parser.add_argument("--tutors", default=";".join(TUTORS), help="names with semicolons between")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path)
    words = parser.parse_args()
    kinds, tutors = words.kinds.split(","), words.tutors.split(";")
    wanted = [(tutor, kind, seed) for seed in range(words.seeds) for kind in kinds for tutor in tutors]
    outcomes = outcomes_of(wanted, words.jobs, words.out)
    for kind in kinds:
        print(f"\n### {kind}\n")
        print_table((tutor, [outcomes[tutor, kind, seed] for seed in range(words.seeds)]) for tutor in tutors)
    print("\n### all kinds\n")
    print_table((t, [outcomes[t, k, seed] for k in kinds for seed in range(words.seeds)]) for t in tutors)
    return 0


def outcomes_of(wanted: list[Key], jobs: int, out: Path | None) -> dict[Key, Outcome]:
    """The outcomes of all trials, those in the file `out` taken from there."""
    known = dict(_read(out)) if out and out.exists() else {}
    missing = [key for key in wanted if key not in known]
    with ProcessPoolExecutor(jobs) as pool:
        for done, (key, outcome) in enumerate(zip(missing, pool.map(_trial, missing), strict=True), 1):
            known[key] = outcome
            if out:
                with out.open("a", encoding="utf-8") as file:
                    file.write(json.dumps([*key, asdict(outcome)]) + "\n")
            if sys.stderr.isatty():
                print(f"\r{done} of {len(missing)}", end="", file=sys.stderr)
    return known


def print_table(rows: Iterable[tuple[str, list[Outcome]]]) -> None:
    """A line a tutor: means, and of the repetitions the standard error."""
    print("| policy | " + " | ".join(title for title, _, _ in COLUMNS) + " |")
    print("|---" * (len(COLUMNS) + 1) + "|")
    for tutor, outcomes in rows:
        cells = [_cell([getattr(o, field) for o in outcomes], scale) for _, field, scale in COLUMNS]
        cells[2] += _error([o.repetitions for o in outcomes])
        print(f"| {tutor} | " + " | ".join(cells) + " |")


def _trial(key: Key) -> Outcome:
    return trial(*key)


def _read(path: Path) -> Iterable[tuple[Key, Outcome]]:
    for line in path.read_text(encoding="utf-8").splitlines():
        tutor, kind, seed, fields = json.loads(line)
        yield (tutor, kind, seed), Outcome(**fields)


def _cell(values: list[float | None], scale: float) -> str:
    known = [scale * value for value in values if value is not None]
    return f"{fmean(known):.1f}" if known else "–"


def _error(values: list[float]) -> str:
    return f" ± {stdev(values) / len(values) ** 0.5:.1f}" if len(values) > 1 else ""


if __name__ == "__main__":
    raise SystemExit(main())
