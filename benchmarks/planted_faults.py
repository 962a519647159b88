"""How surely advice names what is wrong: faults of a teacher's sizes, planted word by word.

    python benchmarks/planted_faults.py --quick                    # some takes a word, a minute in all
    python benchmarks/planted_faults.py --quick --word late_kick   # one word, and the music on which it was missed
    python benchmarks/planted_faults.py --processes 2 --state planted.json --out docs/planted-faults.md   # resumable

`docs/planted-faults.md` says how it is done and what it found.
"""

import argparse
import json
import time
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from station.bench.rigs.planted.planted_faults import FAULTS
from station.bench.rigs.planted.planted_table import HEAD, measure, missed_on, row
from station.bench.rigs.planted.planted_trials import NONE, PAIRS, Tally

_QUICK_TAKES, _SOAK_TAKES = 15, 400
_MORE = 5
"""Times as many takes without a fault and in pairs as of a word: their limits are nearer to 0 and 100 %."""

_HEADING = "## What it found"


def tallies(asked: argparse.Namespace, names: list[str]) -> Iterator[tuple[str, Tally]]:
    """Each word's tally as it is done."""
    takes = {name: asked.takes * (_MORE if name in (NONE, PAIRS) else 1) for name in names}
    if asked.processes == 1:
        for name in names:
            yield name, measure(name, takes[name], asked.quick, asked.times)
        return
    with ProcessPoolExecutor(asked.processes) as pool:
        futures = {name: pool.submit(measure, name, takes[name], asked.quick, asked.times) for name in names}
        for name, future in futures.items():
            yield name, future.result()


def options() -> argparse.Namespace:
    """What was asked on the command line."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--quick", action="store_true", help="each music under one condition, few takes")
    words.add_argument("--word", action="append", help=f"only this word (or {NONE}, {PAIRS}); may be repeated")
    words.add_argument("--takes", type=int, help=f"takes a word ({_MORE} times as many without a fault and in pairs)")
    words.add_argument("--times", type=float, default=1.0, help="faults so many times their size")
    words.add_argument("--processes", type=int, default=1)
    words.add_argument("--state", type=Path, help="rows of finished words are kept here and not played again")
    words.add_argument("--out", type=Path, help="the page whose last part, from its table's heading on, is rewritten")
    asked = words.parse_args()
    asked.takes = asked.takes or (_QUICK_TAKES if asked.quick else _SOAK_TAKES)
    return asked


def rewrite(page: Path, lines: list[str]) -> None:
    """Put a new table under the page's heading for it."""
    method = page.read_text(encoding="utf-8").split(_HEADING)[0]
    page.write_text("\n".join([method + _HEADING, "", *lines, ""]), encoding="utf-8")


def _how(asked: argparse.Namespace) -> str:
    music = "each music under one of the six conditions" if asked.quick else "all music under all six conditions"
    much = f"{asked.takes} takes a word, {_MORE} times as many without a fault and in pairs"
    return f"{much}; {music}; sizes are medians, in the words' units, times {asked.times:g}."


def main() -> None:
    """Play and print the table."""
    asked, begun = options(), time.monotonic()
    state = json.loads(asked.state.read_text()) if asked.state and asked.state.exists() else {}
    names = asked.word or [NONE, *FAULTS, PAIRS]
    print("\n".join([HEAD, *(state[name] for name in names if name in state)]))
    for name, tally in tallies(asked, [name for name in names if name not in state]):
        state[name] = row(name, tally)
        if state[name]:
            print(state[name], flush=True)
        if asked.word:
            print("  missed on:", missed_on(tally))
        if asked.state:
            asked.state.write_text(json.dumps(state))
    unplayed = ", ".join(f"`{name}`" for name in names if not state[name])
    closing = [f"\nNo music here exercises {unplayed}."] if unplayed else []
    print("\n".join([*closing, f"{time.monotonic() - begun:.0f} s"]))
    if asked.out:
        rewrite(asked.out, [_how(asked), "", HEAD, *(state[name] for name in names if state[name]), *closing])


if __name__ == "__main__":
    main()
