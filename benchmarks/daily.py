"""Daily plans compared on simulated learners: prints the table of docs/daily-plan.md.

    python benchmarks/daily.py [--days 60] [--kinds usual,gifted] [--seed 1000] [--jobs N]

Each learner costs a second or two of computing a day. This validates the planner, not people.
"""

import argparse
import sys
from concurrent.futures import ProcessPoolExecutor

from station.bench.rigs.daily_trial import PLANNERS, DailyOutcome, daily_trial

COLUMNS = (
    *("planner", "learner", "days", "lessons held, of those begun", "a week later, right blind"),
    *("reviews, on their day or the next", "minutes", "longest wait, days"),
)


def main() -> int:
    """Print the table, a row as soon as it is known."""
    asked = _asked()
    print(f"| {' | '.join(COLUMNS)} |\n{'|---' * len(COLUMNS)}|")
    cases = [(planner, kind, asked.seed, asked.days) for kind in asked.kinds.split(",") for planner in PLANNERS]
    with ProcessPoolExecutor(asked.jobs) as pool:
        for (planner, kind, *_), outcome in zip(cases, pool.map(_outcome, cases), strict=True):
            print(row(planner, kind, outcome), flush=True)
    return 0


def row(planner: str, kind: str, outcome: DailyOutcome) -> str:
    """One line of the table."""
    on_day = "–" if outcome.on_day_pct is None else f"{outcome.reviews}, {outcome.on_day_pct:.0f} %"
    cells = (
        *(planner, kind, outcome.days, f"{outcome.held} of {outcome.begun}", f"{outcome.week_pct:.0f} %", on_day),
        *(f"{outcome.minutes_pct:.0f} %", outcome.longest_wait),
    )
    return f"| {' | '.join(map(str, cells))} |"


def _outcome(case: tuple[str, str, int, int]) -> DailyOutcome:
    return daily_trial(*case)


def _asked() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--days", type=int, default=60)
    parser.add_argument("--kinds", default="usual,gifted")
    parser.add_argument("--seed", type=int, default=1000)
    parser.add_argument("--jobs", type=int, default=1)
    return parser.parse_args()


if __name__ == "__main__":
    sys.exit(main())
