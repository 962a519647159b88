"""The network: how likely each instrument is at the next step, given all before, and how the next beat is divided.

One hidden layer reads what is known before a step. The nine instruments are then decided in a fixed order, each given
those before it, by a neural autoregressive estimator (NADE: Larochelle & Murray 2011, eqs. 4-5): what is struck is
added to the hidden units before the next instrument is asked. So the probabilities of all 512 chords of a step add up
to 1, and bits are honest. Trained by `tools/train_battle_model.py`; here it only computes.
"""

from dataclasses import dataclass, fields
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.beat_steps import INSTRUMENTS

Floats = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class BeatNetwork:
    """Weights in single precision, with i columns in a row, h hidden units, j columns of a beat, d divisions.

    `seen` (i, h) and `seen_bias` (h,) read a row, `struck` (9, h) adds what is struck, `asked` (9, h) and `asked_bias`
    (9,) are each instrument's own question, `straight` (i, 9) goes past the hidden units; `cut` (j, d) and `cut_bias`
    (d,) are the division's.
    """

    seen: Floats
    seen_bias: Floats
    struck: Floats
    asked: Floats
    asked_bias: Floats
    straight: Floats
    cut: Floats
    cut_bias: Floats

    @classmethod
    def of(cls, weights: dict[str, NDArray[np.float16]]) -> Self:
        """The network whose weights were kept by their names."""
        return cls(**{field.name: weights[field.name].astype(np.float32) for field in fields(cls)})

    @property
    def weights(self) -> int:
        """How many there are."""
        return sum(getattr(self, field.name).size for field in fields(self))

    def log_odds(self, rows: Floats, played: Floats) -> Floats:
        """The natural log-odds (m, 9) that each instrument is struck, given `played` (m, 9) of those before it."""
        hidden, begun = self.begun(rows)
        found = np.empty_like(played)
        for k in range(INSTRUMENTS):
            found[:, k] = self.question(k, hidden) + begun[:, k]
            hidden += played[:, k, None] * self.struck[k]
        return found

    def begun(self, rows: Floats) -> tuple[Floats, Floats]:
        """The hidden sums (m, h) before anything is struck, and what goes past them (m, 9)."""
        weights, bias = self._both
        both: Floats = rows @ weights + bias
        return both[:, : len(self.seen_bias)], both[:, len(self.seen_bias) :]

    @cached_property
    def _both(self) -> tuple[Floats, Floats]:
        """`seen` and `straight` side by side (i, h + 9), and their biases: one product for both."""
        bias = np.concatenate([self.seen_bias, self.asked_bias])
        return np.concatenate([self.seen, self.straight], axis=1), bias

    def question(self, instrument: int, hidden: Floats) -> Floats:
        """What the hidden sums (m, h) add to the log-odds (m,) of one instrument."""
        added: Floats = np.maximum(hidden, 0.0) @ self.asked[instrument]
        return added

    def questions(self, hidden: Floats) -> Floats:
        """What the hidden sums (m, h) add to the log-odds (m, 9) of all instruments, as if no more were struck."""
        added: Floats = np.maximum(hidden, 0.0) @ self.asked.T
        return added

    def divisions(self, rows: Floats) -> Floats:
        """The log-probabilities (m, d) of each division of a beat."""
        scores = rows @ self.cut + self.cut_bias
        scores -= scores.max(axis=1, keepdims=True)
        found: Floats = scores - np.log(np.exp(scores).sum(axis=1, keepdims=True))
        return found
