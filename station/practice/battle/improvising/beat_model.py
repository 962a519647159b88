"""The statistical model of an improvising drummer: what may come next, beat by beat.

The network (`beat_network`) knows how drummers play, the memory (`bar_memory`) what these two have just played. For an
instrument at a step, with z the network's log-odds and e_c what the memory's contexts say,

    z_mixed = w_0 z + sum_c w_c e_c + b_instrument,    P(struck) = 1 / (1 + exp(-z_mixed)),

with weights w learned on takes that neither had seen. The division d of a beat at a place of the bar, which has had it
n_d times of n, has P(d) = (n_d + a P_network(d)) / (n + a): a Dirichlet prior of strength a about the network's word.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Self

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.bar_memory import EVIDENCE, evidence_of
from station.practice.battle.improvising.beat_network import BeatNetwork
from station.practice.battle.improvising.beat_steps import (
    PHRASE_BARS,
    Music,
    Steps,
    division_rows,
    step_rows,
    steps_of,
)
from station.practice.battle.improvising.played_beats import Beats, joined
from station.practice.battle.improvising.played_divisions import DIVISIONS

MODEL_FILE = Path(__file__).parents[1] / "data" / "beat_model.npz"
MOST_HEARD_BARS = 64
"""So many of the last bars are listened to: eight rounds of eight (our choice)."""

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Surprise:
    """How surprising beats were, in bits: by `division` (n,) of each beat, and by `step` (s,), their cells in order."""

    division: Floats
    step: Floats
    beat: NDArray[np.int64]

    @property
    def of_beat(self) -> Floats:
        """Of each beat (n,), its division and its cells together."""
        total: Floats = self.division + np.bincount(self.beat, self.step, len(self.division))
        return total


@dataclass(frozen=True, eq=False)
class BeatModel:
    """Network, and the weights by which its word and the memory's are mixed.

    `mixing` (1 + EVIDENCE + 9,) are w_0, the w_c and the b of the module's head, `strength` its a.
    """

    network: BeatNetwork
    mixing: Floats
    strength: float

    @classmethod
    def load(cls) -> "BeatModel":
        """The model that ships with the station."""
        return _shipped()

    @classmethod
    def read(cls, path: Path) -> Self:
        """The model that was kept in a file."""
        with np.load(path, allow_pickle=False) as file:
            kept = dict(file)
        mixing, strength = kept.pop("mixing").astype(np.float64), float(kept.pop("strength"))
        return cls(BeatNetwork.of(kept), mixing, strength)

    def mixing_at(self, memory: float) -> Floats:
        """The weights where the memory counts so much: 0 the network alone, 1 as learned, beyond that ever more."""
        alone = np.zeros_like(self.mixing)
        alone[0] = 1.0
        weights: Floats = alone + memory * (self.mixing - alone)
        weights[0] = max(weights[0], 0.0)
        return weights

    def log_odds(self, steps: Steps, music: Music, memory: float = 1.0) -> Floats:
        """The log-odds (s, 9) of each instrument at each step, given all before it."""
        rows = step_rows(steps, np.arange(len(steps.at)), music)
        network = self.network.log_odds(rows, steps.played)
        weights = self.mixing_at(memory)
        mixed: Floats = weights[0] * network + weights[1 + EVIDENCE :]
        return mixed + evidence_of(steps) @ weights[1 : 1 + EVIDENCE] if memory else mixed

    def divisions(self, steps: Steps, beats: NDArray[np.int64], music: Music, memory: float = 1.0) -> Floats:
        """The probabilities (m, d) of the divisions of `beats` (m,), given all before them."""
        counts = np.zeros((len(beats), len(DIVISIONS)))
        if memory:
            counts = np.stack([_counts(steps, int(beat)) for beat in beats])
        return self.divisions_after(division_rows(steps, beats, music), counts, memory)

    def divisions_after(self, rows: NDArray[np.float32], counts: Floats, memory: float) -> Floats:
        """The same after `rows` (m, j), and `counts` (m, d) of the divisions that were heard at these places."""
        network = np.exp(self.network.divisions(rows)).astype(np.float64)
        if not memory:
            return network
        strength = self.strength / memory
        mixed: Floats = (counts + strength * network) / (counts.sum(axis=1, keepdims=True) + strength)
        return mixed

    def surprise(self, beats: Beats, music: Music, memory: float = 1.0) -> Surprise:
        """How surprising beats are to someone who has heard nothing before them."""
        steps = steps_of(beats)
        odds = self.log_odds(steps, music, memory)
        nats = np.logaddexp(0.0, np.where(steps.played > 0, -odds, odds)).sum(axis=1)
        every = np.arange(len(beats), dtype=np.int64)
        chance = self.divisions(steps, every, music, memory)[every, np.searchsorted(DIVISIONS, beats.division)]
        return Surprise(-np.log2(chance), nats / np.log(2.0), steps.beat)


@cache
def _shipped() -> BeatModel:
    return BeatModel.read(MODEL_FILE)


def _counts(steps: Steps, beat: int) -> Floats:
    """How often each division was heard at this place of the bar before."""
    past = steps.division[beat % steps.beats_a_bar : beat : steps.beats_a_bar]
    return np.bincount(np.searchsorted(DIVISIONS, past), minlength=len(DIVISIONS)).astype(np.float64)


def music_after(heard: Sequence[Beats], music: Music) -> tuple[list[Beats], Music]:
    """The last of what was heard, and `music` with the place in the phrase that its first bar then has."""
    bars = sum(part.bars for part in heard)
    kept = joined(heard).of_bars(max(bars - MOST_HEARD_BARS, 0), bars) if bars else None
    count = kept.bars if kept else 0
    return [kept] if kept else [], replace(music, phrase_bar=(music.phrase_bar - count) % PHRASE_BARS)
