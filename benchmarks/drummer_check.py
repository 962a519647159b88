"""Examines the drummer as an anatomist and a drum teacher would, from what it publishes alone.

    PYTHONPATH=. .venv/bin/python benchmarks/drummer_check.py --quick
    ... --lessons rock-1 jazz-ride-1 --style funk --drums seven_piece --figure beard --hands open
    ... --gmd 59 --seconds 30            files of the Groove MIDI Dataset (--data says where they are)
    ... --random 50 --first 100          own random scores, seeds 100 … 149, styles and kits in turn
    ... --pairwise 100                   lessons × styles × kits × figures × hands, every pair of them as far as it goes
    ... --score take.mid --seconds 20    anything that `station animate` takes
    ... --only through kink              only these kinds of faults;  --worst 20: so many places with their bars

It samples every millisecond and has its own solids for body, sticks and kit (`examiner/body.py`, `kit_solids.py`), its
own ranges and speeds of joints with their sources (`examiner/anatomy.py`), and says what is wrong: `limit`, `speed`,
`jump` (more than three times the greatest speed at 1 kHz), `kink` (velocity that breaks away from strikes),
`through`, `strike`, `foot`, `waiting`, `grip`, `height`, `number`, `alike` (strokes, seeds),
`stated` (angles that the file says and positions deny). A take is clean when it has none. Faults in bars that the
station itself calls beyond a human are counted apart.
"""

import argparse
from collections import defaultdict
from collections.abc import Iterable
from functools import partial
from multiprocessing import get_context
from pathlib import Path

from benchmarks.examiner import cases
from benchmarks.examiner.cases import Case, Report
from benchmarks.examiner.findings import Finding

WORKERS = 2
LIGHT = ("grip", "height", "waiting", "alike", "stated")
"""Faults of taste, beside those of a body that breaks."""
QUICK = (
    *(Case(name) for name in ("rock-1", "double-kick-1", "jazz-ride-1", "single-stroke-roll")),
    Case("funk-2", "funk", "seven_piece", "ponytail", "open"),
    Case("rock-fill-2", "sweeping", "left_handed", "beard"),
    *cases.random_cases(6),
)


def main() -> None:
    """Examine what is asked for and print."""
    options = _options()
    todo = list(_cases(options))
    if not todo:
        raise SystemExit("nothing to examine: see --help")
    with get_context("fork").Pool(options.workers, maxtasksperchild=20) as pool:
        reports = []
        for report in pool.imap(partial(cases.examine, most_s=options.seconds), todo):
            kept = [f for f in report.findings if not options.only or f.kind in options.only]
            report.findings[:] = kept
            reports.append(report)
            print(_line(report), flush=True)
    summary(reports, options.worst)


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a spread of 12, under two minutes")
    parser.add_argument("--lessons", nargs="*", help="these lessons, or all where none is named")
    parser.add_argument("--score", nargs="*", default=[], help="files or lessons")
    parser.add_argument("--gmd", type=int, nargs="?", const=1000, default=0, help="so many files of it, or all")
    parser.add_argument("--random", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    parser.add_argument("--pairwise", type=int, default=0, help="so many combinations at most")
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    parser.add_argument("--style", default="natural")
    parser.add_argument("--drums", default="four_piece")
    parser.add_argument("--figure", default="")
    parser.add_argument("--hands", default="")
    parser.add_argument("--seconds", type=float, default=12.0, help="of each score at most")
    parser.add_argument("--worst", type=int, default=15)
    parser.add_argument("--only", nargs="*", default=[])
    parser.add_argument("--workers", type=int, default=WORKERS)
    return parser.parse_args()


def _cases(options: argparse.Namespace) -> Iterable[Case]:
    rest = (options.style, options.drums, options.figure, options.hands)
    if options.quick:
        yield from QUICK
    if options.lessons is not None:
        yield from (Case(name, *rest) for name in options.lessons or cases.lesson_names())
    yield from (Case(name, *rest) for name in options.score)
    if options.gmd:
        yield from (Case(c.score, *rest) for c in cases.gmd(options.data, options.gmd))
    yield from cases.random_cases(options.random, options.first)
    yield from cases.pairwise_cases(options.pairwise)


def _line(report: Report) -> str:
    head = f"{report.case.name[:60]:60} "
    if report.crash or report.refused:
        return head + (f"CRASH {report.crash}" if report.crash else f"refused: {report.refused}")
    kinds: dict[str, int] = defaultdict(int)
    for finding in report.own:
        kinds[finding.kind] += 1
    counted = "  ".join(f"{kind} {n}" for kind, n in sorted(kinds.items())) or "clean"
    varies = "" if report.variation_mm is None else f" varies {report.variation_mm:.2f} mm"
    beyond = f" beyond {sorted(report.asked)[:4]}" if report.asked else ""
    return f"{head}{counted} |{varies} seeds {report.seeds_mm or 0:.1f} mm{beyond} ({report.took_s:.0f} s)"


def summary(reports: list[Report], worst: int) -> None:
    """The table of kinds and the gravest places."""
    done = [r for r in reports if not (r.crash or r.refused)]
    clean, unbroken = (sum(not [f for f in r.own if f.kind not in kinds] for r in done) for kinds in ((), LIGHT))
    length_s, strikes = sum(r.length_s for r in done), sum(r.strikes for r in done)
    cleaned = f"{clean} clean ({unbroken} but for {', '.join(LIGHT)})"
    print(f"\n{len(reports)} takes, {len(done)} played, {cleaned}, {length_s:.0f} s, {strikes} strikes")
    own = sum(len(r.own) for r in done)
    print(f"faults {own}, in bars beyond a human {sum(len(r.findings) for r in done) - own}")
    print(f"crashes {sum(bool(r.crash) for r in reports)}, refused {sum(bool(r.refused) for r in reports)}")
    table: dict[tuple[str, str], list[tuple[Finding, Report]]] = defaultdict(list)
    for report in done:
        for finding in report.own:
            table[finding.kind, finding.what].append((finding, report))
    print(f"\n{'kind':9} {'what':48} {'takes':>5} {'worst':>9}       where")
    for (kind, what), seen in sorted(table.items(), key=lambda item: (item[0][0], -len(item[1]))):
        finding, report = max(seen, key=lambda pair: pair[0].amount)
        place = f"{report.case.name[:50]} bar {finding.bar} ({finding.time_s:.2f} s)"
        print(f"{kind:9} {what:48} {len(seen):5} {finding.amount:9.1f} {finding.unit:4}  {place}")
    places = [(f, r) for r in done for f in r.own]
    print(f"\nThe {worst} gravest places")
    for finding, report in sorted(places, key=lambda pair: -pair[0].gravity)[:worst]:
        print(f"{finding}  {report.case.name}")


if __name__ == "__main__":
    main()
