"""Teaching policies compared on simulated learners, at length: writes the tables of docs/mastery.md.

    python benchmarks/mastery.py --out OUTCOMES.jsonl [--seeds 100] [--tutors "ours;none"] [--jobs N]
    python benchmarks/mastery.py --out OUTCOMES.jsonl --tell           # prints what is there, computes nothing
    python benchmarks/mastery.py --out OUTCOMES.jsonl --tell --docs docs/mastery.md

The policy's numbers were chosen while watching learners with seeds below `FIRST_SEED`, so that none of those is counted
here; and every learner is taught twice, once as its kind says and once with each of its numbers, and each of the
model's, drawn anew within ± 30 %. Each costs seconds of computing. Outcomes are written to OUT as they come and are not
computed again. This validates the controller, not people.
"""

import argparse
import json
import sys
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict
from pathlib import Path
from statistics import fmean, stdev
from typing import NamedTuple

from station.bench.rigs.mastery_trial import TrialOutcome, trial
from station.bench.rigs.mastery_tutors import TUTORS
from station.core.disk.files import write_whole
from station.simulation.learner_kinds import LEARNERS

FIRST_SEED = 1000
SHARES = (0.0, 0.3)
OURS, PEER = "ours", "fixed ladder"
BEGIN, END = "<!-- tables: begin -->", "<!-- tables: end -->"


class Key(NamedTuple):
    """A trial: policy, kind of learner, seed, and how far numbers were drawn anew."""

    tutor: str
    kind: str
    seed: int
    share: float


Outcomes = dict[Key, TrialOutcome]

COLUMNS = (
    ("reached %", "reached", 100.0),
    ("minutes", "minutes", 1.0),
    ("repetitions", "repetitions", 1.0),
    ("wrong %", "wrong_pct", 1.0),
    ("day %", "day_pct", 1.0),
    ("week %", "week_pct", 1.0),
    ("transfer %", "transfer_pct", 1.0),
    ("weak bars found %", "found_pct", 1.0),
    ("turns", "turns", 1.0),
    ("unused min", "unused_min", 1.0),
    ("gone %", "gone", 100.0),
)


def main() -> int:
    """Run what is missing, and print the tables or put them into the page."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--kinds", default=",".join(LEARNERS))
    parser.add_argument("--tutors", default=";".join(TUTORS), help="names with semicolons between")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--tell", action="store_true", help="compute nothing")
    parser.add_argument("--docs", type=Path, help="the page whose tables are renewed")
    words = parser.parse_args()
    known = dict(_read(words.out)) if words.out.exists() else {}
    if not words.tell:
        seeds = range(FIRST_SEED, FIRST_SEED + words.seeds)
        tutors, kinds = words.tutors.split(";"), words.kinds.split(",")
        wanted = [Key(t, k, seed, share) for seed in seeds for share in SHARES for k in kinds for t in tutors]
        compute([key for key in wanted if key not in known], known, words.jobs, words.out)
    text = tables(known)
    if words.docs is None:
        print(text)
    else:
        page = words.docs.read_text(encoding="utf-8")
        before, after = page.split(BEGIN)[0], page.split(END)[1]
        write_whole(words.docs, f"{before}{BEGIN}\n{text}\n{END}{after}".encode())
    return 0


def compute(missing: list[Key], known: Outcomes, jobs: int, out: Path) -> None:
    """Add the `missing` outcomes to the `known` ones and to the file `out`."""
    with ProcessPoolExecutor(jobs) as pool:
        for done, (key, outcome) in enumerate(zip(missing, pool.map(_trial, missing), strict=True), 1):
            known[key] = outcome
            with out.open("a", encoding="utf-8") as file:
                file.write(json.dumps([*key, asdict(outcome)]) + "\n")
            if sys.stderr.isatty():
                print(f"\r{done} of {len(missing)}", end="", file=sys.stderr)


def tables(known: Outcomes) -> str:
    """Ours against the fixed ladder kind by kind, then all policies over all kinds; each for both sorts of learners."""
    parts = []
    for share in SHARES:
        sort = f"every number drawn anew within ± {100 * share:.0f} %" if share else "as their kinds say"
        parts += [f"#### Learners {sort}: {OURS} against {PEER}\n", *_duel(known, share), ""]
        parts += [f"#### Learners {sort}: all policies\n", *_all(known, share), ""]
    return "\n".join(parts).rstrip()


# --- ours against the fixed ladder ------------------------------------------------------------------------------------


def _duel(known: Outcomes, share: float) -> Iterable[str]:
    yield "| kind | learners | reach the criterion | repetitions | ratio | ratio where both reach | week, right blind |"
    yield "|---" * 7 + "|"
    everyone = []
    for kind in LEARNERS:
        seeds = sorted(k.seed for k in known if k[:2] == (OURS, kind) and k.share == share)
        pairs = [
            (known[Key(OURS, kind, seed, share)], known[Key(PEER, kind, seed, share)])
            for seed in seeds
            if Key(PEER, kind, seed, share) in known
        ]
        everyone += pairs
        if pairs:
            yield _duel_row(kind, pairs)
    if everyone:
        yield _duel_row("**all**", everyone)


def _duel_row(name: str, pairs: list[tuple[TrialOutcome, TrialOutcome]]) -> str:
    both = [(a.repetitions, b.repetitions) for a, b in pairs if a.reached and b.reached]
    gains = [a.week_pct - b.week_pct for a, b in pairs]
    error = stdev(gains) / len(gains) ** 0.5 if len(gains) > 1 else 0.0
    cells = (
        name,
        f"{len(pairs)}",
        _against(pairs, "reached", 100.0, " %"),
        _against(pairs, "repetitions"),
        f"{fmean(a.repetitions for a, _ in pairs) / fmean(b.repetitions for _, b in pairs):.2f}",
        f"{sum(a for a, _ in both) / sum(b for _, b in both):.2f} ({len(both)})" if both else "–",
        f"{_against(pairs, 'week_pct', 1.0, ' %')} ({fmean(gains):+.1f} ± {error:.1f})",
    )
    return f"| {' | '.join(cells)} |"


def _against(pairs: list[tuple[TrialOutcome, TrialOutcome]], field: str, scale: float = 1.0, unit: str = "") -> str:
    mean = [scale * fmean(getattr(pair[side], field) for pair in pairs) for side in (0, 1)]
    return f"{mean[0]:.0f}{unit} against {mean[1]:.0f}{unit}"


# --- all policies -----------------------------------------------------------------------------------------------------


def _all(known: Outcomes, share: float) -> Iterable[str]:
    """Over the trials that every policy has, so that all had the same learners."""
    there = [tutor for tutor in TUTORS if any(k.tutor == tutor and k.share == share for k in known)]
    common = set.intersection(*({k[1:] for k in known if k.tutor == tutor} for tutor in there)) if there else set()
    mine = sorted(key for key in common if key[2] == share)
    yield f"{len(mine)} learners of all kinds.\n"
    yield "| policy | " + " | ".join(title for title, _, _ in COLUMNS) + " |"
    yield "|---" * (len(COLUMNS) + 1) + "|"
    for tutor in there if mine else ():
        outcomes = [known[Key(tutor, *key)] for key in mine]
        cells = [_cell([getattr(o, field) for o in outcomes], scale) for _, field, scale in COLUMNS]
        yield f"| {tutor} | " + " | ".join(cells) + " |"


def _cell(values: list[float | None], scale: float) -> str:
    known = [scale * value for value in values if value is not None]
    return f"{fmean(known):.0f}" if known else "–"


# --- trials -----------------------------------------------------------------------------------------------------------


def _trial(key: Key) -> TrialOutcome:
    return trial(key.tutor, key.kind, key.seed, perturb_share=key.share)


def _read(path: Path) -> Iterable[tuple[Key, TrialOutcome]]:
    for line in path.read_text(encoding="utf-8").splitlines():
        *key, fields = json.loads(line)
        yield Key(*key), TrialOutcome(**fields)


if __name__ == "__main__":
    raise SystemExit(main())
