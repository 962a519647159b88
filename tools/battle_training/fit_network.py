"""Training the network by hand-written gradients: numpy alone, one thread, a fixed seed, a few minutes.

Adam (Kingma & Ba 2015) on the mean negative log-likelihood of a step's nine decisions; dropout of hidden units and of
whole rows' style, weight decay, a learning rate that falls to zero as a cosine does.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.beat_network import BeatNetwork
from station.practice.battle.improvising.beat_steps import INSTRUMENTS, STYLES, division_rows, step_rows, steps_of
from station.practice.battle.improvising.played_divisions import DIVISIONS
from tools.battle_training.takes import GrooveTake, weights_of

Floats = NDArray[np.float32]
HIDDEN, EPOCHS, BATCH = 96, 32, 256
RATE, DECAY = 3e-3, 2e-3
DROPOUT, NO_STYLE, NO_INPUT = 0.25, 0.5, 0.08


@dataclass(frozen=True, eq=False)
class Examples:
    """Rows (m, i) and what was played at each step (m, 9), weighted (m,); the same of beats and their divisions."""

    rows: Floats
    played: Floats
    weight: Floats
    beat_rows: Floats
    division: NDArray[np.int64]
    beat_weight: Floats


def examples_of(takes: Sequence[GrooveTake]) -> Examples:
    """All steps and beats of the takes."""
    parts = []
    for take, weight in zip(takes, weights_of(takes), strict=True):
        steps = steps_of(take.beats)
        every = np.arange(len(steps.at)), np.arange(len(take.beats))
        parts.append(
            (
                step_rows(steps, every[0], take.music),
                steps.played,
                np.full(len(every[0]), weight, np.float32),
                division_rows(steps, every[1], take.music),
                np.searchsorted(DIVISIONS, take.beats.division),
                np.full(len(every[1]), weight, np.float32),
            )
        )
    return Examples(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def fitted_network(takes: Sequence[GrooveTake], seed: int = 1, epochs: int = EPOCHS) -> BeatNetwork:
    """The network trained on the takes; the same for the same seed on one machine."""
    rng = np.random.default_rng(seed)
    examples = examples_of(takes)
    weights = _first_weights(examples, rng)
    _fit(weights, examples, rng, epochs)
    cut, cut_bias = _fitted_divisions(examples)
    return BeatNetwork(**weights, cut=cut, cut_bias=cut_bias)


def _first_weights(examples: Examples, rng: np.random.Generator) -> dict[str, Floats]:
    columns = examples.rows.shape[1]
    rate = np.average(examples.played, axis=0, weights=examples.weight).clip(1e-4, 1 - 1e-4)
    return {
        "seen": rng.normal(0, columns**-0.5, (columns, HIDDEN)).astype(np.float32),
        "seen_bias": np.zeros(HIDDEN, np.float32),
        "struck": rng.normal(0, 0.1, (INSTRUMENTS, HIDDEN)).astype(np.float32),
        "asked": rng.normal(0, HIDDEN**-0.5, (INSTRUMENTS, HIDDEN)).astype(np.float32),
        "asked_bias": np.log(rate / (1 - rate)).astype(np.float32),
        "straight": np.zeros((columns, INSTRUMENTS), np.float32),
    }


def _fit(weights: dict[str, Floats], examples: Examples, rng: np.random.Generator, epochs: int) -> None:
    """Change the weights in place."""
    moments = {name: (np.zeros_like(w), np.zeros_like(w)) for name, w in weights.items()}
    count = len(examples.rows)
    batches = -(-count // BATCH)
    step, last = 0, epochs * batches
    for _ in range(epochs):
        order = rng.permutation(count)
        for start in range(0, count, BATCH):
            chosen = order[start : start + BATCH]
            rows = _thinned(examples.rows[chosen], rng)
            gradients = _gradients(weights, rows, examples.played[chosen], examples.weight[chosen], rng)
            step += 1
            rate = RATE * 0.5 * (1 + np.cos(np.pi * step / last))
            _adam(weights, gradients, moments, step, rate)


def _thinned(rows: Floats, rng: np.random.Generator) -> Floats:
    """The rows, of some the style not told, of all some numbers missing."""
    style = rows.shape[1] - len(STYLES) - 2
    keep = rng.random(rows.shape, np.float32) > NO_INPUT
    thinned = rows * keep / np.float32(1 - NO_INPUT)
    thinned[:, style:] = rows[:, style:]
    thinned[rng.random(len(rows)) < NO_STYLE, style:-2] = 0.0
    return thinned


def _gradients(
    weights: dict[str, Floats], rows: Floats, played: Floats, weight: Floats, rng: np.random.Generator
) -> dict[str, Floats]:
    """The gradient of the weighted mean loss by each weight."""
    asked, struck = weights["asked"], weights["struck"]
    keep = (rng.random((len(rows), HIDDEN), np.float32) > DROPOUT) / np.float32(1 - DROPOUT)
    hidden = rows @ weights["seen"] + weights["seen_bias"]
    past = rows @ weights["straight"] + weights["asked_bias"]
    sums, errors = [], np.empty_like(played)
    share = weight / weight.sum()
    for k in range(INSTRUMENTS):
        active = np.maximum(hidden, 0) * keep
        sums.append((active, (hidden > 0) * keep))
        odds = active @ asked[k] + past[:, k]
        errors[:, k] = (1 / (1 + np.exp(-odds)) - played[:, k]) * share
        hidden = hidden + played[:, k, None] * struck[k]
    back = np.zeros_like(hidden)
    to_struck, to_asked = np.empty_like(struck), np.empty_like(asked)
    for k in reversed(range(INSTRUMENTS)):
        to_struck[k] = played[:, k] @ back
        to_asked[k] = errors[:, k] @ sums[k][0]
        back += errors[:, k, None] * asked[k] * sums[k][1]
    return {
        "seen": rows.T @ back,
        "seen_bias": back.sum(axis=0),
        "struck": to_struck,
        "asked": to_asked,
        "asked_bias": errors.sum(axis=0),
        "straight": rows.T @ errors,
    }


def _adam(
    weights: dict[str, Floats],
    gradients: dict[str, Floats],
    moments: dict[str, tuple[Floats, Floats]],
    step: int,
    rate: float,
) -> None:
    """One step of Adam with decoupled weight decay (Loshchilov & Hutter 2019)."""
    for name, gradient in gradients.items():
        mean, square = moments[name]
        mean += 0.1 * (gradient - mean)
        square += 0.001 * (gradient * gradient - square)
        change = (mean / (1 - 0.9**step)) / (np.sqrt(square / (1 - 0.999**step)) + 1e-8)
        if not name.endswith("bias"):
            change = change + DECAY * weights[name] * (10 if name == "straight" else 1) / RATE
        weights[name] -= np.float32(rate) * change


def _fitted_divisions(examples: Examples) -> tuple[Floats, Floats]:
    """Softmax regression on the beats by plain gradient descent with momentum."""
    rows, wanted = examples.beat_rows, np.eye(len(DIVISIONS), dtype=np.float32)[examples.division]
    cut, bias = np.zeros((rows.shape[1], len(DIVISIONS)), np.float32), np.zeros(len(DIVISIONS), np.float32)
    speed, bias_speed = np.zeros_like(cut), np.zeros_like(bias)
    share = examples.beat_weight[:, None] / examples.beat_weight.sum()
    for _ in range(600):
        scores = rows @ cut + bias
        chance = np.exp(scores - scores.max(axis=1, keepdims=True))
        error = (chance / chance.sum(axis=1, keepdims=True) - wanted) * share
        speed = 0.9 * speed - 0.3 * (rows.T @ error + 1e-3 * cut)
        bias_speed = 0.9 * bias_speed - 0.3 * error.sum(axis=0)
        cut, bias = cut + speed, bias + bias_speed
    return cut, bias
