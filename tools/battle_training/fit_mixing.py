"""How much the network and the memory of the player's own bars count: logistic mixing, by Newton's method.

The network must not have seen the takes on which its weight is learned, or it is believed too much: each half of the
takes is read by a network that was trained on the other half.
"""

from collections.abc import Iterator, Sequence

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.bar_memory import EVIDENCE, evidence_of
from station.practice.battle.improvising.beat_network import BeatNetwork
from station.practice.battle.improvising.beat_steps import INSTRUMENTS, step_rows, steps_of
from tools.battle_training.fit_network import fitted_network
from tools.battle_training.takes import GrooveTake, weights_of

Floats = NDArray[np.float64]
ROUNDS, PENALTY = 8, 3.0
"""Newton's method has converged long before; the penalty is a Gaussian prior about what the network says alone."""


def mixing_columns(network_odds: NDArray[np.float32], evidence: NDArray[np.float32]) -> NDArray[np.float32]:
    """What is mixed (m, 9, 1 + EVIDENCE + 9): the network's log-odds, the memory's, and 1 for each instrument."""
    ones = np.broadcast_to(np.eye(INSTRUMENTS, dtype=np.float32), (len(evidence), INSTRUMENTS, INSTRUMENTS))
    return np.concatenate([network_odds[:, :, None], evidence, ones], axis=2)


def fitted_mixing(takes: Sequence[GrooveTake], seed: int) -> Floats:
    """The weights (1 + EVIDENCE + 9,) of `mixing_columns`."""
    columns, played, weight = [], [], []
    for network, unseen in halves(takes, seed):
        for take, share in zip(unseen, weights_of(unseen), strict=True):
            steps = steps_of(take.beats)
            odds = network.log_odds(step_rows(steps, np.arange(len(steps.at)), take.music), steps.played)
            columns.append(mixing_columns(odds, evidence_of(steps)).reshape(-1, 1 + EVIDENCE + INSTRUMENTS))
            played.append(steps.played.reshape(-1))
            weight.append(np.full(len(played[-1]), share))
    return _newton(np.concatenate(columns).astype(np.float64), np.concatenate(played), np.concatenate(weight))


def halves(takes: Sequence[GrooveTake], seed: int) -> Iterator[tuple[BeatNetwork, list[GrooveTake]]]:
    """Two networks, each trained on every second take, and the takes that it has not seen."""
    for half in (0, 1):
        network = fitted_network([take for i, take in enumerate(takes) if i % 2 != half], seed)
        yield network, [take for i, take in enumerate(takes) if i % 2 == half]


def _newton(columns: Floats, played: NDArray[np.float32], weight: Floats) -> Floats:
    prior = np.zeros(columns.shape[1])
    prior[0] = 1.0
    found = prior.copy()
    for _ in range(ROUNDS):
        chance = 1 / (1 + np.exp(-(columns @ found)))
        slope = columns.T @ (weight * (chance - played)) + PENALTY * (found - prior)
        bend = (columns * (weight * chance * (1 - chance))[:, None]).T @ columns + PENALTY * np.eye(len(found))
        found = found - np.linalg.solve(bend, slope)
    return found
