"""Few causes for many deviations: a linear mixed model whose free effects are chosen by an information criterion.

    y = X·b + S·β + ε,   b_j ~ N(0, τ_j²),   β of the suspects that were chosen, 0 of all others

y are deviations of strokes, in ms from the click or in dB from what is written. The columns of X say what differs in
any player: where they stand, which piece leans by some ms. Those effects are drawn towards 0 by τ. The columns of S are
suspects, causes that a teacher would name. Nothing is compared with "the others": a player whose hi-hat alone is early
is explained by one cause, and all else on time costs nothing; "the snare and the kick are late and all is early" costs
three. A suspect is taken in if it lowers

    D(M) = (y − Xb̂ − Sβ̂)ᵀV⁻¹(y − Xb̂ − Sβ̂) + b̂ᵀT⁻¹b̂ + Σ cost_j,   cost_j = ln m + 2·ln k + own_j

for m slots and k suspects: the extended BIC (Chen & Chen 2008), so that among many suspects chance finds no more than
among few. The search goes forward by the best suspect and exchanges one for another while that helps. Suspects that in
another's place would do within `ALIKE` are its *rivals*: the data cannot tell.

V: strokes of one slot share the player's clock, one slot's error lives on in the next. Errors within a slot correlate
by `shared`, and the slots' means are a first-order autoregression; both are estimated from what is left over, and
both sides of the model are whitened by them. Strokes far off, slips and wrong pairs, are drawn in to `_HUBER_SDS`
(Huber 1981).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.student_t import t_quantile_95
from station.scoring.matching.slow_drift import robust_sd

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

CONSTANT = "all"
"""The name of what all strokes have in common."""

ALIKE = 6.0
"""D apart by less does not tell two explanations apart (Kass & Raftery 1995: strong evidence begins at 6)."""

_FEWEST = 8
_MOST_CAUSES = 5
"""More at once nobody hears, and nobody could say (our choice)."""
_HUBER_SDS = 3.5
_ROUNDS = 3
_MOST_RHO = 0.8
_FOUND_WITHIN = 1e-6
"""Share of a column that others must leave unexplained for its effect to be known."""


@dataclass(frozen=True, slots=True)
class Effect:
    """An estimate with its standard error, and the number of slots that bear it."""

    value: float
    error: float
    slots: int

    @property
    def ci(self) -> tuple[float, float]:
        """The 95 % interval, by Student's t over the slots."""
        half = t_quantile_95(max(self.slots - 1.0, 1.0)) * self.error
        return self.value - half, self.value + half


@dataclass(frozen=True, eq=False)
class Column:
    """One column (n,); `tau` the SD of the effect in any player, in the unit of y (None: free).

    `cost` of a suspect is what it has to explain beyond others, in units of D: of two that are the same strokes the
    one that drummers name first is cheaper.
    """

    name: str
    values: Floats
    tau: float | None = None
    cost: float = 0.0


@dataclass(frozen=True, eq=False)
class Explained:
    """`chosen` causes, the surest first; the `effects` of all suspects beside them, and of the constant.

    `rivals` of each chosen cause: what could as well stand in its place, with the effect that it would have. `rest`
    (n,) is what is left over, `sd` its spread, both in the unit of y.
    """

    chosen: tuple[str, ...]
    effects: dict[str, Effect]
    rivals: dict[str, dict[str, Effect]]
    rest: Floats
    sd: float


def explain(y: Floats, base: list[Column], suspects: list[Column], slots: Indices) -> Explained | None:
    """Explain `y` (n,) by few of `suspects`; a constant belongs to `base`. `slots` (n,) rise with time.

    Columns without variation are left out, but for the constant. None of fewer strokes than `_FEWEST`.
    """
    if len(y) < _FEWEST:
        return None
    base = [c for c in base if c.name == CONSTANT or np.ptp(c.values) > 0]
    suspects = [c for c in suspects if c.name == CONSTANT or np.ptp(c.values) > 0]
    slot = np.unique(slots, return_inverse=True)[1].reshape(-1)
    x = np.column_stack([*(c.values for c in (*base, *suspects))])
    noise, drawn_in = _Noise(max(robust_sd(y) or float(y.std()), 1e-6), 0.3, 0.3), y
    for _ in range(_ROUNDS):
        model = _Model(base, suspects, noise.gram(np.column_stack([x, drawn_in]), slot), int(slot.max()) + 1)
        chosen = _search(model)
        fitted = x @ model.coefficients(chosen)
        rest = y - fitted
        sd = max(robust_sd(rest) or float(rest.std()), 1e-6)
        clipped = np.clip(rest, -_HUBER_SDS * sd, _HUBER_SDS * sd)
        drawn_in, noise = fitted + clipped, _noise_of(clipped, slot)
    return _explained(model, chosen, suspects, slot, rest, noise.sd)


# --- noise ------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class _Noise:
    """SD of one stroke; correlation of two strokes of a slot; of the means of two slots that follow each other."""

    sd: float
    shared: float
    lag_1: float

    def gram(self, columns: Floats, slot: Indices) -> Floats:
        """`columns`ᵀ V⁻¹ `columns`: within slots and between their means, each by its own variance."""
        counts = np.bincount(slot).astype(np.float64)
        starts = np.concatenate([[0], np.cumsum(counts[:-1])]).astype(np.int64)
        sums = np.add.reduceat(columns, starts, axis=0)
        means = sums / counts[:, None]
        own = self.sd**2 * (1 - self.shared)
        inside = (columns.T @ columns - sums.T @ means) / own
        between = self.sd**2 * self.shared + own / counts
        steps = means[1:] - self.lag_1 * means[:-1]
        first = means[:1] / between[0] ** 0.5
        later = steps / np.sqrt(between[1:] * (1 - self.lag_1**2))[:, None]
        return np.asarray(inside + first.T @ first + later.T @ later)


def _noise_of(rest: Floats, slot: Indices) -> _Noise:
    """The noise of residuals (n,): moments of pairs within slots, and of means that follow each other."""
    variance = max(float(rest @ rest) / len(rest), 1e-12)
    counts = np.bincount(slot)
    sums = np.bincount(slot, weights=rest)
    pairs = float((counts * (counts - 1)).sum())
    inside = float((sums * sums - np.bincount(slot, weights=rest * rest)).sum())
    shared = inside / pairs / variance if pairs else 0.0
    means = sums / counts
    after = float(means[1:] @ means[:-1]) / max(float(means @ means), 1e-12)
    return _Noise(variance**0.5, min(max(shared, 0.0), _MOST_RHO), min(max(after, 0.0), _MOST_RHO))


# --- the search -------------------------------------------------------------------------------------------------------


class _Model:
    """The sums of squares of all columns: base first, then suspects, then y; sets of suspects are compared by them."""

    def __init__(self, base: list[Column], suspects: list[Column], gram: Floats, slots: int) -> None:
        self._own = len(base)
        self._names = [c.name for c in base]
        self.suspects = [c.name for c in suspects]
        self._gram, self._along = gram[:-1, :-1], gram[:-1, -1]
        self._pull = np.array([0.0 if c.tau is None else c.tau**-2 for c in base])
        usual = np.log(slots) + 2 * np.log(max(len(suspects), 1))
        self.costs = np.array([usual + c.cost for c in suspects])

    def gains(self, chosen: list[int]) -> Floats:
        """By how much each suspect would lower D, beyond its cost, beside those that are `chosen`; −∞ for these."""
        rows, pull = self._rows(chosen)
        others = np.arange(len(self.suspects)) + self._own
        inverse = np.linalg.pinv(self._gram[np.ix_(rows, rows)] + np.diag(pull), hermitian=True)
        across = self._gram[np.ix_(rows, others)]
        size = self._gram[others, others]
        left = size - np.einsum("ij,ij->j", across, inverse @ across)
        moved = self._along[others] - across.T @ (inverse @ self._along[rows])
        known = left > _FOUND_WITHIN * np.maximum(size, 1e-300)
        gains = np.where(known, moved**2 / np.where(known, left, 1.0), 0.0) - self.costs
        gains[chosen] = -np.inf
        return np.asarray(gains)

    def coefficients(self, chosen: list[int]) -> Floats:
        """Of all columns, 0 for suspects that are not `chosen`."""
        rows, pull = self._rows(chosen)
        found = np.zeros(len(self._along))
        found[rows] = np.linalg.pinv(self._gram[np.ix_(rows, rows)] + np.diag(pull), hermitian=True) @ self._along[rows]
        return found

    def effect(self, which: int, chosen: list[int]) -> tuple[float, float]:
        """Estimate and error of suspect `which` beside the others: what it does in all, its usual lean included."""
        beside = [k for k in chosen if k != which]
        rows, pull = self._rows([*beside, which])
        kept = [k for k, row in enumerate(rows) if row >= self._own or self._names[row] != self.suspects[which]]
        rows, pull = rows[kept], pull[kept]
        inverse = np.linalg.pinv(self._gram[np.ix_(rows, rows)] + np.diag(pull), hermitian=True)
        return float(inverse[-1] @ self._along[rows]), float(max(inverse[-1, -1], 0.0) ** 0.5)

    def _rows(self, chosen: list[int]) -> tuple[Indices, Floats]:
        rows = np.array([*range(self._own), *(self._own + k for k in chosen)], np.int64)
        return rows, np.concatenate([self._pull, np.zeros(len(chosen))])


def _search(model: _Model) -> list[int]:
    """The suspects that lower D most, in the order in which they were found."""
    chosen: list[int] = []
    tried: set[frozenset[int]] = set()  # an exchange may drop what was just found: no set is gone from twice
    while model.suspects and len(chosen) < _MOST_CAUSES and frozenset(chosen) not in tried:
        tried.add(frozenset(chosen))
        gains = model.gains(chosen)
        best = int(np.argmax(gains))
        if gains[best] <= 0:
            break
        chosen = _exchanged(model, [*chosen, best])
    return chosen


def _exchanged(model: _Model, chosen: list[int]) -> list[int]:
    """`chosen` after every exchange of one for another that lowers D, and without those that no longer do."""
    for _ in range(len(chosen) + 1):
        before = list(chosen)
        for k in before:
            others = [c for c in chosen if c != k]
            gains = model.gains(others)
            best = int(np.argmax(gains))
            if gains[best] <= 0:
                chosen = others
            elif gains[best] > gains[k] + 1e-6:
                chosen = [best if c == k else c for c in chosen]
        if chosen == before:
            break
    return chosen


def _explained(
    model: _Model, chosen: list[int], suspects: list[Column], slot: Indices, rest: Floats, sd: float
) -> Explained:
    def effect(k: int, beside: list[int]) -> Effect:
        return Effect(*model.effect(k, beside), _slots_of(suspects[k].values, slot))

    gains = {k: model.gains([c for c in chosen if c != k]) for k in chosen}
    order = sorted(chosen, key=lambda k: -float(gains[k][k] + model.costs[k]))
    rivals = {}
    for k in order:
        beside = [c for c in chosen if c != k]
        near = [j for j in np.argsort(-gains[k]).tolist() if j != k and gains[k][j] > gains[k][k] - ALIKE]
        rivals[model.suspects[k]] = {model.suspects[j]: effect(j, beside) for j in near}
    effects = {name: effect(k, chosen) for k, name in enumerate(model.suspects)}
    known = {name: e for name, e in effects.items() if np.isfinite(e.value) and e.error > 0}
    return Explained(tuple(model.suspects[k] for k in order), known, rivals, rest, sd)


def _slots_of(values: Floats, slot: Indices) -> int:
    """Slots on the rarer side of a column, for a flag: those that bear the contrast."""
    on = len(np.unique(slot[values != 0]))
    off = len(np.unique(slot[values == 0]))
    return min(on, off) if off else on
