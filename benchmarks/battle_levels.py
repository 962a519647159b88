"""Beginner, intermediate and professional: battles of each against the same drummer, judged turn by turn.

    .venv/bin/python benchmarks/battle_levels.py [--battles 60] [--rounds 4]

The battles of one seed have the same opponent on its usual ground, in turn each of `OPPONENTS`, and the same chance;
the drummer calls, the virtual student answers, as long. What a level chooses to play is `virtual_improviser`, how it
plays it `simulation`; neither knows the judge. A battle is in order where the points rise from level to level.
"""

import argparse
from dataclasses import replace

import numpy as np

from benchmarks.battle_judging import wilson
from station.practice.battle.improvising.improvise import improvised
from station.practice.battle.judging.improvisation_marks import Component, ImprovisationMarks
from station.practice.battle.judging.judged_improvisation import judged_improvisation
from station.practice.battle.opponents.opponent import OPPONENTS
from station.practice.battle.phrase import Turn
from station.practice.battle.phrase_as_turn import phrase_as_turn
from station.practice.battle.virtual_improviser import VirtualImproviser
from station.simulation.student_spec import PLAYERS

LEVELS = ("beginner", "intermediate", "pro")
BARS = 4


def battle(level: str, seed: int, rounds: int) -> list[ImprovisationMarks]:
    """The marks of the student's turns."""
    opponent = list(OPPONENTS.values())[seed % len(OPPONENTS)]
    ground, rng = opponent.ground, np.random.default_rng(seed)
    student = VirtualImproviser(replace(PLAYERS[level], seed=seed))
    calls: list[Turn] = []
    answers: list[Turn] = []
    marks = []
    for _ in range(rounds):
        calls.append(phrase_as_turn(improvised(opponent, ground, BARS, answers, calls, rng), ground))
        answers.append(Turn(ground, BARS, student.improvise(ground, BARS, calls, answers).performance))
        marks.append(judged_improvisation(answers[-1], answers[:-1], calls[-1]))
    return marks


def main() -> None:
    """Print how many battles are in order, and what each level earns."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--battles", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=4)
    asked = parser.parse_args()
    found = {level: [battle(level, seed, asked.rounds) for seed in range(asked.battles)] for level in LEVELS}
    points = np.array([[sum(turn.points for turn in turns) for turns in found[level]] for level in LEVELS])
    rising = np.diff(points, axis=0) > 0
    for words, right in (("all in order", rising.all(axis=0)), *zip(("low", "high"), rising, strict=True)):
        low, high = wilson(int(right.sum()), len(right))
        print(f"{words}: {right.sum()} of {len(right)} battles, {100 * low:.0f}–{100 * high:.0f} %")
    print("out of order:", np.flatnonzero(~rising.all(axis=0)).tolist())
    print(f"| | {' | '.join(LEVELS)} |\n|---|---|---|---|")
    print("| points a turn | " + " | ".join(f"{row.mean() / asked.rounds:.0f}" for row in points) + " |")
    for component in Component:
        print(f"| {component} | " + " | ".join(_mean(found[level], component) for level in LEVELS) + " |")


def _mean(battles: list[list[ImprovisationMarks]], component: Component) -> str:
    told = [p for turns in battles for turn in turns if (p := turn.of(component).points) is not None]
    return f"{np.mean(told):.0f}"


if __name__ == "__main__":
    main()
