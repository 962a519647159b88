"""The optimiser: both hands' parts in, the same parts out, led so that little is wrong with them.

Both hands are looked at `RATE_HZ` times a second and at every event. Moments that cost something, on one stretch of
each hand, are a trouble; all moves of both hands are tried on it, and the one that takes most off its cost is made.
What it does elsewhere is seen in the next round. Nothing is left to chance, and what is found for a figure of the score
serves where the figure comes again.
"""

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.motion.avoidance.cost import WRONG_M, Array, Hands, Moments, Stage, near, stick_cost
from station.motion.avoidance.moves import Move, done, moves
from station.motion.kinematics.arm import Contact
from station.motion.kinematics.body_solids import points_of
from station.motion.strokes.hand import HandPart
from station.motion.strokes.hand_events import LONG_AGO_S

RATE_HZ = 100.0
ROUNDS = 8
"""A move may need another: so often the whole is looked at (our choice)."""
_LIKELY, _TRIED, _FIRST_LOOKS = 100, 20, 4
"""All moves are looked at in the worst moment, so many of the best of them in so many others too, and of those again so
many in all (our choice)."""
_NO_WORSE = 1.2
"""What is no more than so much worse than something like it that no move helped is not tried: who plays a figure again
comes not at quite the same times (our choice)."""
_WAY, _TURN, _LOW = 0.05, 0.01, 0.02
"""A metre of way round, a radian of turning and a stroke that is not made at all are taken for so many metres less near
(our choice: natural ways are left for what is worth it)."""
_LEAST_GAIN = 0.002
"""What takes less off is not worth a move (our choice)."""


def looks(*event_s: Array) -> Array:
    """The times at which hands with events at `event_s` are looked at; an event long ago is no event."""
    times = np.concatenate(event_s)
    times = times[times > LONG_AGO_S]
    return np.union1d(np.arange(times.min() - 1.0, times.max() + 1.0, 1 / RATE_HZ), times)


def optimised(
    parts: tuple[HandPart, HandPart], stage: Stage, searches: int | None = None
) -> tuple[tuple[HandPart, HandPart], Array]:
    """Both parts with the least wrong that was found, and what still is at each moment of the stage, (n,).

    After so many `searches`, of which each takes about 40 ms, no more moves are looked for; None: as many as it takes.
    """
    known: dict[tuple[object, ...], Found | None] = {}
    hopeless: set[tuple[int, int]] = set()
    tries: Counter[tuple[int, int]] = Counter()
    hands = Hands(stage, parts)
    cost = hands.cost(np.arange(len(stage.grid)))
    for _ in range(ROUNDS):
        alike: dict[tuple[object, ...], float] = {}
        new, changed = list(hands.parts), [set[int](), set[int]()]
        for pair, moments in _troubles(hands, cost, tries):
            if pair in hopeless or _near(pair, changed):
                continue  # what helped its neighbour may have helped it too; if not, its turn is next
            key, kind, worst = _figure_of(hands, pair), _kind_of(hands, pair), float(cost[moments].max())
            if key not in known and (worst <= _NO_WORSE * alike.get(kind, 0.0) or searches == 0):
                known[key] = None
            if key not in known:
                searches = None if searches is None else searches - 1
                known[key] = _found(hands, pair, best_move(hands, pair, moments, cost))
            found = known[key]
            tries[pair] += 1
            if found is None:
                hopeless.add(pair)
                alike[kind] = max(alike.get(kind, 0.0), worst)
                continue
            move, chosen = found.at(hands, pair)
            new[move.side] = done(new[move.side], move, chosen)
            changed[move.side].add(pair[move.side])
        if not any(changed):
            break
        hopeless -= {pair for pair in hopeless if _near(pair, changed)}
        before, hands = hands, Hands(stage, (new[0], new[1]))
        on = np.flatnonzero(_differ(before, hands))
        cost[on] = hands.cost(on)
    return hands.parts, cost


def _near(pair: tuple[int, int], changed: list[set[int]]) -> bool:
    """Whether a stretch of the pair or one beside it has changed."""
    return any(not c.isdisjoint(range(k - 1, k + 2)) for k, c in zip(pair, changed, strict=True))


def _troubles(hands: Hands, cost: Array, tries: Counter[tuple[int, int]]) -> list[tuple[tuple[int, int], Moments]]:
    """Both hands' stretches and the moments where something is wrong, the least tried and worst first."""
    wrong = np.flatnonzero(cost > WRONG_M)
    k = np.stack([part.way.humps(hands.stage.grid[wrong])[0] for part in hands.parts], 1)
    pairs, which = np.unique(k, axis=0, return_inverse=True)
    found = [((int(r), int(s)), wrong[which.reshape(-1) == i]) for i, (r, s) in enumerate(pairs.tolist())]
    return sorted(found, key=lambda trouble: (tries[trouble[0]], -float(cost[trouble[1]].max())))


def best_move(hands: Hands, pair: tuple[int, int], moments: Moments, cost: Array) -> tuple[Move, int] | None:
    """What takes most off the cost of a trouble; None where nothing does."""
    spread = moments[:: max(len(moments) // _FIRST_LOOKS, 1)]
    gravest = moments[[int(np.argmax(cost[moments]))]]
    worst = np.union1d(spread, gravest)
    table = moves(hands, list(pair), moments, worst)
    likely = [trial for move in table for trial in _trials(move, gravest)]
    if len(worst) > 1:
        likely = [trial for move in table if not len(_trials(move, gravest)) for trial in _trials(move, worst)] + [
            replace(trial, at=np.isin(trial.move.on, worst)) for trial, _ in tried(hands, likely)[:_LIKELY]
        ]
    first = tried(hands, likely)
    few = [replace(trial, at=np.ones(len(trial.move.on), bool)) for trial, _ in first[:_TRIED]]
    best, gain = None, _LEAST_GAIN
    for trial, after in tried(hands, few):
        before, rest = cost[trial.move.on], float(cost[worst[~np.isin(worst, trial.move.on)]].max(initial=0.0))
        wrong = max(int((before > WRONG_M).sum()), 1)
        most = max(float(before.max()), rest) - max(float(after.max()), rest)
        won = 0.5 * most + 0.5 * float((before - after).sum()) / wrong - trial.price
        if won > gain:
            best, gain = (trial.move, trial.row), won
    return best


@dataclass(frozen=True, eq=False)
class Trial:
    """A row of a move that is looked `at` some of its moments (n,)."""

    move: Move
    row: int
    at: NDArray[np.bool_]

    @property
    def price(self) -> float:
        """What leaving the natural way costs."""
        way, turn = self.move.lengths[self.row]
        return _WAY * way + _TURN * turn + _LOW * (1.0 - self.move.low)


def _trials(move: Move, moments: Moments) -> list[Trial]:
    """All rows of a move looked at those of the `moments` that it has a part in; none where it has none."""
    at = np.isin(move.on, moments)
    return [Trial(move, k, at) for k in range(len(move.amounts))] if at.any() else []


def tried(hands: Hands, trials: list[Trial]) -> list[tuple[Trial, Array]]:
    """The trials with the cost after each at its moments; what leaves least of it, its price counted, first."""
    found: list[tuple[Trial, Array]] = []
    for side in (0, 1):
        own = [trial for trial in trials if trial.move.side == side]
        if not own:
            continue
        on = [trial.move.on[trial.at] for trial in own]
        added = [trial.move.made[trial.at][:, None] * trial.move.amounts[trial.row] for trial in own]
        low = [np.full(len(k), trial.move.low) for k, trial in zip(on, own, strict=True)]
        cost = _after(hands, side, np.concatenate(on), np.concatenate(added), np.concatenate(low))
        found += zip(own, np.split(cost, np.cumsum([len(k) for k in on[:-1]])), strict=True)
    return sorted(found, key=lambda pair: _left(pair[1]) + pair[0].price)


def _left(cost: Array) -> float:
    """The middle between the worst of a trial's cost and its mean; asked so often that numpy's short way counts."""
    return 0.5 * float(np.maximum.reduce(cost) + np.add.reduce(cost) / len(cost))


def _after(hands: Hands, side: int, on: Moments, added: Array, low: Array) -> Array:
    """What is wrong at moments (n,), any of them more than once, with `added` (n, fields) on one hand's way.

    Its strokes are as `low` (n,) as that.
    """
    stage = hands.stage
    contact = hands.parts[side].way.many(stage.grid[on])
    led = Contact(*(c + a for c, a in zip(contact, added.T, strict=True)))
    once, which = np.unique(on, return_inverse=True)
    whole = np.zeros(len(on))
    for arm, other in zip(hands.arms(side, on, led, low), hands.arms(1 - side, once), strict=True):
        own, theirs = points_of(arm), points_of(other)
        again = type(theirs)(*(getattr(theirs, name)[which] for name in theirs.__slots__))
        each = np.maximum(near(stage, own, again), 0.0) + hands.alone(arm, own, on) + stick_cost(stage, own, on)
        whole = np.maximum(whole, each + (hands.alone(other, theirs, once) + stick_cost(stage, theirs, once))[which])
    return whole


def _figure_of(hands: Hands, pair: tuple[int, int]) -> tuple[object, ...]:
    """What a trouble is like: the kinds and relative times of both hands' events about it, and the ways there."""
    start = hands.parts[0].events.time_s[pair[0]]
    words: list[object] = []
    for part, k in zip(hands.parts, pair, strict=True):
        about = slice(max(k - 1, 0), k + 3)
        words += [tuple(part.which[about].tolist()), tuple(np.round(part.events.time_s[about] - start, 3).tolist())]
        for rows in (part.bump[k : k + 1], part.strokes.most[about], part.contacts[about], part.gives[k, 2:]):
            words.append(tuple(np.round(rows.ravel(), 3).tolist()))
    return tuple(words)


def _kind_of(hands: Hands, pair: tuple[int, int]) -> tuple[object, ...]:
    """What hopeless troubles are alike by: from what to what both hands are on their way, and whether one gives way."""
    words: list[object] = []
    for part, k in zip(hands.parts, pair, strict=True):
        words += [*part.which[k : k + 2].tolist(), bool(part.gives[k].any())]
    return tuple(words)


@dataclass(frozen=True, eq=False)
class Found:
    """A move and its chosen row, found on the stretch `k` of its hand, whose event is at `event_s`."""

    move: Move
    chosen: int
    k: int
    event_s: float

    def at(self, hands: Hands, pair: tuple[int, int]) -> tuple[Move, int]:
        """The same for a like trouble on the stretches `pair`."""
        move, k = self.move, pair[self.move.side]
        later_s = float(hands.parts[move.side].events.time_s[k]) - self.event_s
        off, back, pace = move.window
        return replace(move, index=move.index + k - self.k, window=(off + later_s, back + later_s, pace)), self.chosen


def _found(hands: Hands, pair: tuple[int, int], best: tuple[Move, int] | None) -> Found | None:
    if best is None:
        return None
    move, chosen = best
    k = pair[move.side]
    return Found(move, chosen, k, float(hands.parts[move.side].events.time_s[k]))


def _differ(before: Hands, after: Hands) -> NDArray[np.bool_]:
    """Where a hand is not as it was, (n,)."""
    found = np.zeros(len(after.stage.grid), bool)
    for side in (0, 1):
        old, new = before.parts[side], after.parts[side]
        if old is not new:
            way = (old.way.rows != new.way.rows).any(1) | after.strokes[side].differ(before.strokes[side])
            found |= way[after.parts[side].way.humps(after.stage.grid)[0]]
    return found
