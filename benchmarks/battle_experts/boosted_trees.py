"""A classifier of phrases: gradient-boosted regression trees on the logistic loss (Friedman 2001), in numpy alone.

Trees of depth 3 on features cut at their deciles, shrinkage 0.1, half of the phrases a tree; leaves by one step of
Newton's method with a penalty of 1 (Chen & Guestrin 2016). Small data: a few hundred phrases, about a hundred features.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
TREES, DEPTH, SHRINKAGE, SHARE, PENALTY, BINS, FEWEST = 150, 3, 0.1, 0.6, 1.0, 12, 5
FEATURES_A_TREE = 0.4


@dataclass(frozen=True, eq=False)
class _Node:
    feature: int
    edge: float
    below: "_Node | float"
    above: "_Node | float"


@dataclass(frozen=True, eq=False)
class BoostedTrees:
    """`trees` and what they add up from."""

    trees: tuple[_Node | float, ...]
    start: float

    @classmethod
    def fitted(cls, features: Floats, label: NDArray[np.bool_], seed: int) -> "BoostedTrees":
        """Trained on features (n, f) and labels (n,)."""
        rng = np.random.default_rng(seed)
        share = label.mean()
        start = float(np.log(share / (1 - share)))
        score = np.full(len(label), start)
        edges = np.quantile(features, np.linspace(0, 1, BINS + 1)[1:-1], axis=0)
        trees = []
        for _ in range(TREES):
            chance = 1 / (1 + np.exp(-score))
            chosen = np.nonzero(rng.random(len(label)) < SHARE)[0]
            columns = np.nonzero(rng.random(features.shape[1]) < FEATURES_A_TREE)[0]
            slope, bend = label - chance, chance * (1 - chance)
            tree = _grown(_Data(features, slope, bend, edges, columns), chosen, DEPTH)
            trees.append(tree)
            score += SHRINKAGE * _values(tree, features)
        return cls(tuple(trees), start)

    def scores(self, features: Floats) -> Floats:
        """The log-odds (n,) that the label is true."""
        total: Floats = self.start + SHRINKAGE * sum(_values(tree, features) for tree in self.trees)
        return total


@dataclass(frozen=True, eq=False)
class _Data:
    features: Floats
    slope: Floats
    bend: Floats
    edges: Floats
    columns: NDArray[np.int64]


def _grown(data: _Data, rows: NDArray[np.int64], depth: int) -> _Node | float:
    slope, bend = data.slope[rows], data.bend[rows]
    value = float(slope.sum() / (bend.sum() + PENALTY))
    if depth == 0 or len(rows) < 2 * FEWEST:
        return value
    below = data.features[rows][:, None, data.columns] <= data.edges[None, :, data.columns]
    slopes, bends = np.einsum("n,nef->ef", slope, below), np.einsum("n,nef->ef", bend, below)
    gain = slopes**2 / (bends + PENALTY) + (slope.sum() - slopes) ** 2 / (bend.sum() - bends + PENALTY)
    count = below.sum(axis=0)
    gain[(count < FEWEST) | (len(rows) - count < FEWEST)] = -np.inf
    edge, column = np.unravel_index(int(np.argmax(gain)), gain.shape)
    if not np.isfinite(gain[edge, column]):
        return value
    is_below = below[:, edge, column]
    feature = int(data.columns[column])
    parts = (_grown(data, rows[side], depth - 1) for side in (is_below, ~is_below))
    return _Node(feature, float(data.edges[edge, feature]), *parts)


def _values(tree: _Node | float, features: Floats) -> Floats:
    if not isinstance(tree, _Node):
        return np.full(len(features), tree)
    is_below = features[:, tree.feature] <= tree.edge
    found = np.empty(len(features))
    found[is_below] = _values(tree.below, features[is_below])
    found[~is_below] = _values(tree.above, features[~is_below])
    return found


def logistic_scores(features: Floats, label: NDArray[np.bool_], asked: Floats, penalty: float = 10.0) -> Floats:
    """The log-odds (m,) of `asked` (m, f) by ridge logistic regression on standardised features (Newton's method)."""
    mean, spread = features.mean(axis=0), features.std(axis=0) + 1e-9
    columns = np.column_stack([np.clip((features - mean) / spread, -4, 4), np.ones(len(features))])
    weights = np.zeros(columns.shape[1])
    ridge = penalty * np.eye(len(weights))
    ridge[-1, -1] = 1e-6
    for _ in range(12):
        chance = 1 / (1 + np.exp(-columns @ weights))
        slope = columns.T @ (chance - label) + ridge @ weights
        bend = (columns * (chance * (1 - chance))[:, None]).T @ columns + ridge
        weights -= np.linalg.solve(bend, slope)
    found: Floats = np.column_stack([np.clip((asked - mean) / spread, -4, 4), np.ones(len(asked))]) @ weights
    return found


def auc(scores: Floats, label: NDArray[np.bool_]) -> float:
    """The chance that a true one scores above a false one, ties half (Mann & Whitney 1947)."""
    true, false = scores[label], scores[~label]
    above = (true[:, None] > false).mean() + 0.5 * (true[:, None] == false).mean()
    return float(above)
