"""Does the judge of improvisations hear music? Human phrases against versions of them.

    .venv/bin/python benchmarks/battle_judging.py [--data FOLDER] [--drummers tuning|held-out|all] [--seeds 1]

The weights and thresholds were chosen by looking at the `TUNING` drummers alone; the others were held out until all
stood. A pair counts where phrase and version differ in at least a fifth of their strokes (`changed_strokes`; for the
flat version with levels). Shares come with Wilson's 95 % interval (1927); phrases of one take are alike, so that the
truth is wider.
"""

import argparse
import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.battle_versions import VERSIONS, HumanPhrase, changed_strokes, glued, human_phrases, partners
from station.practice.battle.judging.judged_improvisation import judged_improvisation
from station.practice.battle.phrase import Turn

TUNING = frozenset({"drummer1", "drummer3", "drummer6", "drummer9"})
LEAST_CHANGED = 0.2
DATA = Path(__file__).resolve().parents[2] / "shared/data/gmd"
GLUED = "glued"


@dataclass(frozen=True, slots=True)
class Pair:
    """A phrase and a version of it: whose it is, which version, and the points of both."""

    drummer: str
    version: str
    human: float
    other: float


def versions(phrase: HumanPhrase, phrases: Sequence[HumanPhrase], rng: np.random.Generator) -> dict[str, Turn]:
    """All versions of a phrase; the glued one where three other takes fit."""
    made = {name: make(phrase, rng) for name, make in VERSIONS.items()}
    others = partners(phrase, phrases, rng)
    return made if others is None else {**made, GLUED: glued(phrase, others, rng)}


def pairs(phrases: Sequence[HumanPhrase], pool: Sequence[HumanPhrase], seed: int) -> Iterable[Pair]:
    """Every pair that differs enough; strangers' bars are taken from `pool`."""
    rng = np.random.default_rng(seed)
    for phrase in phrases:
        human = judged_improvisation(phrase.turn, (), None).points
        for name, turn in versions(phrase, pool, rng).items():
            if changed_strokes(phrase.turn, turn, levels=name == "flat") >= LEAST_CHANGED:
                yield Pair(phrase.drummer, name, human, judged_improvisation(turn, (), None).points)


def wilson(wins: int, count: int) -> tuple[float, float]:
    """The 95 % interval of a share."""
    z, share = 1.96, wins / count
    middle = (share + z * z / (2 * count)) / (1 + z * z / count)
    half = z / (1 + z * z / count) * math.sqrt(share * (1 - share) / count + z * z / (4 * count * count))
    return middle - half, middle + half


def print_table(found: Sequence[Pair]) -> None:
    """A line a version: pairs, how many the human phrase wins, the interval, the medians, the worst drummer."""
    print("| version | pairs | human above | 95 % | median points, human and version | least of a drummer with 10 |")
    print("|---|---|---|---|---|---|")
    for version in (*VERSIONS, GLUED):
        here = [pair for pair in found if pair.version == version]
        if here:
            print(_row(version, here))


def _row(version: str, here: Sequence[Pair]) -> str:
    wins = sum(pair.human > pair.other for pair in here)
    low, high = wilson(wins, len(here))
    medians = f"{np.median([p.human for p in here]):.0f}, {np.median([p.other for p in here]):.0f}"
    share = f"{100 * wins / len(here):.1f} % | {100 * low:.0f}–{100 * high:.0f}"
    return f"| {version} | {len(here)} | {share} | {medians} | {_worst(here)} |"


def _worst(here: Sequence[Pair]) -> str:
    of = {drummer: [p.human > p.other for p in here if p.drummer == drummer] for drummer in {p.drummer for p in here}}
    shares = [(sum(wins) / len(wins), drummer) for drummer, wins in of.items() if len(wins) >= 10]
    return "" if not shares else f"{100 * min(shares)[0]:.0f} % ({min(shares)[1]})"


def print_speed(phrases: Sequence[HumanPhrase]) -> None:
    """How long a turn takes that was not heard before, and one that was."""
    turns = [phrase.turn for phrase in phrases[:60]]
    for words in ("at first", "heard already"):
        start = time.perf_counter()
        for turn in turns:
            judged_improvisation(turn, (), None)
        print(f"{words}: {1e3 * (time.perf_counter() - start) / len(turns):.1f} ms a turn")


def main() -> None:
    """Print what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--drummers", choices=("tuning", "held-out", "all"), default="tuning")
    parser.add_argument("--seeds", type=int, default=1, help="how often each version is drawn")
    asked = parser.parse_args()
    everyone = human_phrases(asked.data)
    wanted = {"tuning": (True,), "held-out": (False,), "all": (True, False)}[asked.drummers]
    phrases = [phrase for phrase in everyone if (phrase.drummer in TUNING) in wanted]
    print(f"{len(phrases)} phrases of {len({p.take for p in phrases})} takes by {len({p.drummer for p in phrases})}")
    print_speed(phrases)
    print_table([pair for seed in range(asked.seeds) for pair in pairs(phrases, phrases, seed)])


if __name__ == "__main__":
    main()
