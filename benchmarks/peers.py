"""Alignment beside what others have made, on one workload in one run: exactness, time, growth.

    .venv/bin/pip install -c constraints.txt '.[peers]'
    .venv/bin/python benchmarks/peers.py [--notes 1000,3000] [--out docs/peers.md]

The work is that of `station bench`: 16th-note grooves with fills at 120 bpm, the tempo swaying by 3 %, 15 ms of noise,
3 % left out, 3 % added, 2 % on another piece. Times are processor time of the fastest of a few runs, without the first,
in which some compile. A peer that is not installed has a row that says so.
"""

import argparse
import math
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.bench.rigs.scoring_peers import PEERS
from station.bench.rigs.scoring_work import PlayedWork, WorkPlayer, f1, grooves, play
from station.bench.rows.scoring_rows import oracle_f1
from station.music.judgement import Label
from station.music.score import Score
from station.scoring.align import align

_SEED = 20
_QUICK_S, _TIMES = 2.0, 5
Matcher = Callable[[Score, PlayedWork], NDArray[np.int64]]


def ours(score: Score, played: PlayedWork) -> NDArray[np.int64]:
    """The note of each hit, −1 for none; of the score nothing is worked out yet."""
    fresh = Score(score.notes, score.tempo_map, score.end_tick, score.title)
    found = align(fresh, played.performance, clocked=False)
    return np.where(found.hit_label == Label.MATCH, found.note_of_hit, -1)


def measured(matcher: Matcher, notes: int) -> tuple[float, float]:
    """F1, and seconds of one run."""
    score = grooves(notes, _SEED)
    played = play(score, WorkPlayer(), _SEED)
    took: list[float] = []
    while not took or (len(took) < _TIMES and took[0] < _QUICK_S):
        begun = time.process_time()
        said = matcher(score, played)
        took.append(time.process_time() - begun)
    return f1(said, played), min(took)


def row(name: str, matcher: Matcher, sizes: list[int]) -> str:
    """A line of the table."""
    try:
        measured(matcher, 300)
    except ImportError:
        return f"| {name} | not installed |" + " |" * (2 * len(sizes))
    figures = [measured(matcher, notes) for notes in sizes]
    growth = math.log(figures[-1][1] / figures[0][1]) / math.log(sizes[-1] / sizes[0]) if len(sizes) > 1 else math.nan
    cells = " | ".join(f"{said:.4f} | {1e3 * took:,.0f} ms" for said, took in figures)
    return f"| {name} | {cells} | {growth:.2f} |"


def oracle_row(sizes: list[int]) -> str:
    """What who knows the true tempo reaches."""
    works = [(score, play(score, WorkPlayer(), _SEED)) for score in (grooves(notes, _SEED) for notes in sizes)]
    return "| oracle | " + " | ".join(f"{oracle_f1(score, played):.4f} | " for score, played in works) + " | |"


def main() -> None:
    """Print the table, and write it where asked."""
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("--notes", default="1000,3000")
    words.add_argument("--out", type=Path)
    asked = words.parse_args()
    sizes = [int(notes) for notes in asked.notes.split(",")]
    head = " | ".join(f"F1, {notes:,} notes | time" for notes in sizes)
    lines = [f"| | {head} | growth |", "|---|" + "---|" * (2 * len(sizes) + 1), row("**station**", ours, sizes)]
    lines += [row(name, matcher, sizes) for name, matcher in PEERS.items()] + [oracle_row(sizes)]
    table = "\n".join(lines) + "\n"
    print(table)
    if asked.out:
        asked.out.write_text(_PAGE.format(doc=(__doc__ or "").split("\n\n")[2], table=table), encoding="utf-8")


_PAGE = """# Alignment beside other programs

Written by `benchmarks/peers.py`. {doc}

{table}"""


if __name__ == "__main__":
    main()
