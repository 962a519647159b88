"""The battling drummer by measure: steps that get harder, opponents who can be told apart, time that a phrase takes.

    PYTHONPATH=. .venv/bin/python benchmarks/battle_drummer.py [--seeds 3]

Steps: Spearman's rank correlation of the step with the measured difficulty (`drills/difficulty`) and with strokes a
second, over all steps and seeds, at each ground. Opponents: phrases of four bars on one ground, after the same bars,
told apart by linear discriminants (Fisher 1936) of ten plain figures, which are learned on half of them. Times are CPU
time of one phrase.
"""

import argparse
from collections.abc import Sequence
from itertools import product
from time import process_time

import numpy as np
from numpy.typing import NDArray
from scipy.stats import spearmanr

from station.core.pieces import CYMBALS, TOMS, Dynamic, Piece
from station.drills.difficulty import measured
from station.motion.feasibility.playable import impossible
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.improvising.improvise import improvised
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.phrase_to_repeat import phrase_to_repeat, strokes_per_s

METERS = ((4, 4), (3, 4), (6, 8), (5, 4), (7, 8))
TEMPI = (60, 110, 160)
PHRASES = 30
"""Of each opponent, half of them to learn from."""
Floats = NDArray[np.float64]


def steps_table(seeds: int) -> list[str]:
    """A line for each meter and feel."""
    rows = [
        "| meter | feel | difficulty 60 | 110 | 160 | strokes/s 60 | 110 | 160 |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for meter, feel in product(METERS, Feel):
        found = [_risen(Ground(tempo, *meter, feel), seeds) for tempo in TEMPI]
        columns = [*(f"{hard:.2f}" for hard, _ in found), *(f"{rate:.2f}" for _, rate in found)]
        rows.append(f"| {meter[0]}/{meter[1]} | {feel.value} | {' | '.join(columns)} |")
    return rows


def _risen(ground: Ground, seeds: int) -> tuple[float, float]:
    """Spearman's correlation of the step with difficulty, and with strokes a second."""
    opponents = list(OPPONENTS.values())
    steps, hard, rates = [], [], []
    for step, seed in product(range(MOST_STEP + 1), range(seeds)):
        phrase = phrase_to_repeat(opponents[(seed + step) % len(opponents)], ground, step, _rng(seed, step))
        assert not impossible(phrase.score), "every phrase can be played"
        steps.append(step)
        hard.append(measured(phrase.score, ground.beat_ticks).total)
        rates.append(strokes_per_s(phrase.score))
    return float(spearmanr(steps, hard).statistic), float(spearmanr(steps, rates).statistic)


def _rng(*seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)


# --- opponents --------------------------------------------------------------------------------------------------------


FIGURES = (
    "strokes/beat",
    "kick",
    "toms",
    "ride",
    "ghosts",
    "velocity",
    "its spread",
    "lean ms",
    "its spread ms",
    "notes",
)


def figures(phrase: Phrase, ground: Ground) -> list[float]:
    """Ten plain figures of a phrase, by `FIGURES`; shares are of its strokes, the last is how many differ in pitch."""
    rows = phrase.score.notes
    piece = rows["piece"]
    return [
        len(rows) / (phrase.bars * ground.beats_a_bar),
        float(np.mean(piece == Piece.KICK)),
        float(np.mean(np.isin(piece, TOMS))),
        float(np.mean(np.isin(piece, sorted(CYMBALS)))),
        float(np.mean(rows["dynamic"] == Dynamic.GHOST)),
        float(rows["velocity"].mean()),
        float(rows["velocity"].std()),
        float(rows["late_ms"].mean()),
        float(rows["late_ms"].std()),
        float(len(np.unique(piece))),
    ]


def opponents_table(ground: Ground) -> list[str]:
    """A line for each opponent: its mean figures, and how many of its phrases are told to be its own."""
    heard = [
        phrase_as_turn(improvised(OPPONENTS["steady"], ground, 4, [], [], _rng(seed)), ground) for seed in range(4)
    ]
    played = {name: _figures_of(name, ground, heard) for name in OPPONENTS}
    learned = {name: rows[: PHRASES // 2] for name, rows in played.items()}
    rows = [f"| opponent | {' | '.join(FIGURES)} | told |", f"|---|{'---|' * (len(FIGURES) + 1)}"]
    told = {name: _told(learned, found[PHRASES // 2 :]) for name, found in played.items()}
    for name, found in played.items():
        means = " | ".join(f"{value:.2f}" if value < 10 else f"{value:.0f}" for value in found.mean(axis=0))
        rows.append(f"| {name} | {means} | {np.mean([one == name for one in told[name]]):.0%} |")
    right = np.mean([one == name for name, some in told.items() for one in some])
    return [*rows, "", f"Told rightly: {right:.0%} of all; chance is {1 / len(OPPONENTS):.0%}."]


def _figures_of(name: str, ground: Ground, heard: Sequence[Turn]) -> Floats:
    phrases = (improvised(OPPONENTS[name], ground, 4, [heard[i % 4]], [], _rng(i, 7)) for i in range(PHRASES))
    return np.array([figures(phrase, ground) for phrase in phrases])


def _told(learned: dict[str, Floats], asked: Floats) -> list[str]:
    """Whose each of `asked` (m, 10) is likeliest to be, where all have one covariance."""
    centred = np.concatenate([rows - rows.mean(axis=0) for rows in learned.values()])
    inverse = np.linalg.inv(np.cov(centred.T) + 1e-6 * np.eye(centred.shape[1]))
    names = list(learned)
    off = [
        np.einsum("mi,ij,mj->m", asked - mean, inverse, asked - mean) for mean in (r.mean(0) for r in learned.values())
    ]
    return [names[at] for at in np.argmin(off, axis=0).tolist()]


# --- time -------------------------------------------------------------------------------------------------------------


def times_table() -> list[str]:
    """CPU ms of a phrase to repeat, and of an improvised one of four bars in the middle of a battle."""
    ground = Ground(100)
    opponent = OPPONENTS["pocket"]
    phrase_to_repeat(opponent, ground, 12, _rng(0))
    repeat: list[float] = []
    for step in range(MOST_STEP + 1):
        begun = process_time()
        phrase_to_repeat(opponent, ground, step, _rng(step))
        repeat.append(1000 * (process_time() - begun))
    heard: list[Turn] = []
    improvise: list[float] = []
    for turn in range(20):
        begun = process_time()
        phrase = improvised(opponent, ground, 4, heard, heard, _rng(turn))
        improvise.append(1000 * (process_time() - begun))
        heard.append(phrase_as_turn(phrase, ground))
    rows = ["| | median ms | most |", "|---|---|---|"]
    named = (("a phrase to repeat", repeat), ("an improvised one of four bars", improvise[4:]))
    return rows + [f"| {name} | {np.median(ms):.0f} | {max(ms):.0f} |" for name, ms in named]


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3)
    seeds = parser.parse_args().seeds
    for title, rows in (
        ("Steps", steps_table(seeds)),
        ("Opponents on rock at 100", opponents_table(Ground(100))),
        ("Times", times_table()),
    ):
        print(f"\n{title}\n", *rows, sep="\n")


if __name__ == "__main__":
    main()
