"""The whole model from takes: the network, how it is mixed with the memory, and how sure it is of divisions."""

from collections.abc import Sequence
from dataclasses import fields, replace
from pathlib import Path

import numpy as np

from station.practice.battle.improvising.beat_model import BeatModel
from station.practice.battle.improvising.beat_network import BeatNetwork
from station.practice.battle.improvising.beat_steps import steps_of
from station.practice.battle.improvising.played_divisions import DIVISIONS
from tools.battle_training.fit_mixing import fitted_mixing, halves
from tools.battle_training.fit_network import fitted_network
from tools.battle_training.takes import GrooveTake

STRENGTHS = (0.5, 1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0)
"""Strengths of the prior on divisions to choose from."""


def fitted_model(takes: Sequence[GrooveTake], seed: int) -> BeatModel:
    """The model of the takes, its weights in the precision in which they are kept."""
    mixing = fitted_mixing(takes, seed)
    model = BeatModel(as_kept(fitted_network(takes, seed)), mixing.astype(np.float32).astype(np.float64), 1.0)
    return replace(model, strength=_strength(takes, mixing, seed))


def _strength(takes: Sequence[GrooveTake], mixing: np.ndarray, seed: int) -> float:
    """The strength under which the divisions of takes that the network has not seen are likeliest."""
    costs = np.zeros(len(STRENGTHS))
    for network, unseen in halves(takes, seed):
        for take in unseen:
            steps, every = steps_of(take.beats), np.arange(len(take.beats))
            said = np.searchsorted(DIVISIONS, take.beats.division)
            for i, strength in enumerate(STRENGTHS):
                chance = BeatModel(network, mixing, strength).divisions(steps, every, take.music)
                costs[i] -= np.log(chance[every, said]).sum()
    return STRENGTHS[int(np.argmin(costs))]


def as_kept(network: BeatNetwork) -> BeatNetwork:
    """The network in the half precision in which a file keeps it."""
    return BeatNetwork.of({field.name: getattr(network, field.name).astype(np.float16) for field in fields(network)})


def write_model(model: BeatModel, path: Path) -> None:
    """Keep the model in a file, the same bytes for the same model."""
    weights = {f.name: getattr(model.network, f.name).astype(np.float16) for f in fields(model.network)}
    path.parent.mkdir(parents=True, exist_ok=True)
    np.savez(path, **weights, mixing=model.mixing.astype(np.float32), strength=np.float32(model.strength))
