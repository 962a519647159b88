"""How near the staircase comes to a player: logistic ones drawn at random, and virtual students on real phrases.

`python benchmarks/battle_staircase.py [BATTLES]` prints the share of battles after eight rounds of which the next step
is within two of the player's own. A virtual student here has a limit, in strokes a second of all limbs together, above
which more and more strokes fail (HUMANS, Heights, says where people's limits lie); what they play and how it is judged
is the station's own. Their own step is where they win three of four, found by many phrases at every step.
"""

import sys
from collections.abc import Callable

import numpy as np

from station.practice.battle.ground import Ground
from station.practice.battle.opponents.opponent import find_opponent
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.repeating.answer_marks import answer_marks
from station.practice.battle.repeating.demands import MOST_STEP
from station.practice.battle.repeating.phrase_to_repeat import phrase_to_repeat, strokes_per_s
from station.practice.battle.repeating.staircase import TARGET, Answered, Staircase
from station.scoring.matching.hit_windows import Level
from station.simulation.student_spec import parse_spec
from station.simulation.virtual_student import VirtualStudent

ROUNDS, NEAR, WON = 8, 2, 0.9
FIRST_STEP = 8
"""A third of the way up: eight rounds reach both ends."""
PHRASES_A_STEP = 12
GROUND = Ground(92)
LIMITS_HZ = (3.0, 4.5, 6.0, 7.5)
FADES_HZ, MOST_MISSED_PCT = 0.4, 40.0
"""Over so many strokes a second e-fold more strokes fail, up to so many."""
Wins = Callable[[int, np.random.Generator], bool]


def battle(wins: Wins, rng: np.random.Generator) -> int:
    """The step after eight rounds."""
    staircase, answered = Staircase(MOST_STEP, FIRST_STEP), list[Answered]()
    for _ in range(ROUNDS):
        step = staircase.next_step(answered)
        answered.append(Answered(step, wins(step, rng)))
    return staircase.next_step(answered)


def logistic(threshold: float, slope: float, slips: float) -> Wins:
    """A player who wins three of four at `threshold`."""
    return lambda step, rng: bool(
        rng.random() < (1 - slips) / (1 + np.exp((step - threshold) / slope - np.log(TARGET / (1 - TARGET))))
    )


def phrases(rng: np.random.Generator) -> list[list[Phrase]]:
    """Phrases of the steady one at every step."""
    opponent, ground = find_opponent("steady"), GROUND
    steps = range(MOST_STEP + 1)
    return [[phrase_to_repeat(opponent, ground, step, rng) for _ in range(PHRASES_A_STEP)] for step in steps]


def virtual(limit_hz: float, known: list[list[Phrase]]) -> Wins:
    """A virtual student with a limit."""

    def wins(step: int, rng: np.random.Generator) -> bool:
        phrase = known[step][int(rng.integers(PHRASES_A_STEP))]
        missed = MOST_MISSED_PCT / (1 + np.exp((limit_hz - strokes_per_s(phrase.score)) / FADES_HZ))
        student = VirtualStudent(parse_spec(f"sd_ms=10,miss_pct={missed:.2f},seed={int(rng.integers(1, 10**6))}"))
        turn = Turn(GROUND, phrase.bars, student.play(phrase.score).performance)
        return bool(answer_marks(phrase, turn, Level.INTERMEDIATE.windows).is_won(WON))

    return wins


def own_step(wins: Wins, rng: np.random.Generator) -> float:
    """The step at which three of four are won: a falling line through the shares of all steps, by pooled violators."""
    shares = [float(np.mean([wins(step, rng) for _ in range(2 * PHRASES_A_STEP)])) for step in range(MOST_STEP + 1)]
    blocks: list[tuple[float, int]] = []
    for share in shares:
        blocks.append((share, 1))
        while len(blocks) > 1 and blocks[-2][0] < blocks[-1][0]:
            (a, n), (b, m) = blocks[-2:]
            blocks[-2:] = [((a * n + b * m) / (n + m), n + m)]
    falling = np.repeat([share for share, _ in blocks], [count for _, count in blocks])
    steps = np.arange(MOST_STEP + 1)
    return float(np.interp(-TARGET, -falling, steps)) if falling[0] >= TARGET else 0.0


def main() -> None:
    """Print the table."""
    battles, rng = int(sys.argv[1]) if len(sys.argv) > 1 else 60, np.random.default_rng(14)
    offs = []
    for _ in range(20 * battles):
        threshold = float(rng.uniform(2, 20))
        offs.append(battle(logistic(threshold, rng.uniform(0.4, 2.0), rng.uniform(0, 0.04)), rng) - threshold)
    print(f"{'logistic, drawn':32} own step   -    within {NEAR}: {np.mean(np.abs(offs) <= NEAR):.1%}")
    known = phrases(rng)
    for limit_hz in LIMITS_HZ:
        wins = virtual(limit_hz, known)
        own = own_step(wins, rng)
        off = np.array([battle(wins, rng) - own for _ in range(battles)])
        words = f"virtual, limit {limit_hz:g} strokes/s"
        print(f"{words:32} own step {own:4.1f}   within {NEAR}: {np.mean(np.abs(off) <= NEAR):.1%}")


if __name__ == "__main__":
    main()
