"""Vocabulary: how many figures of a beat's length the turn has, whether they are words, and whether they are new.

    news     = Σ_k (1 − again_k) / beats,      again_k: the best likeness of beat k to an earlier one, 0 at .5, 1 at .9
    rooted   = mean_k of beat k's best likeness to the same beat of another bar, in this turn or before
    rounds   = share of the beats that no earlier turn of the player has, copies taken out
    points   = 100·own·credit(news)·credit(rooted)·credit(rounds)

A word is what is said more than once: where no beat resembles another (notes at random) there is no vocabulary,
however many figures there are; where all do there is little. Types against tokens, as linguists count a vocabulary; the
credits are our choice by four drummers of the Groove MIDI Dataset (news .2–.7, rooted .4–.96).
"""

from collections.abc import Sequence
from types import MappingProxyType

import numpy as np

from station.practice.battle.judging.component_words import Cost, own_cost, words_of
from station.practice.battle.judging.heard_turn import Floats, HeardTurn
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks, Place
from station.practice.battle.judging.likeness import copied, likeness

AGAIN_FROM, AGAIN_AT = 0.5, 0.9
NEWS, NEWS_CREDIT = (0.08, 0.55), (0.0, 1.0)
ROOTED, ROOTED_CREDIT = (0.3, 0.75), (0.0, 1.0)
ROUNDS, ROUNDS_CREDIT = (0.0, 0.3), (0.2, 1.0)
"""A player may keep their words, if three beats of ten are new in each turn."""


def vocabulary_used(turn: HeardTurn, before: Sequence[HeardTurn], own: float) -> ComponentMarks:
    """The marks for vocabulary; `before` are the player's earlier turns."""
    sounds = turn.beat_sounds
    if not sounds.any():
        return ComponentMarks(Component.VOCABULARY, 0.0, "nothing played")
    new = new_beats(turn)
    news, rooted = float(new.sum()) / turn.beats, _rooted(turn, before)
    fresh = _fresh(turn, before)
    shares = (
        np.interp(news, NEWS, NEWS_CREDIT),
        np.interp(rooted, ROOTED, ROOTED_CREDIT),
        np.interp(fresh, ROUNDS, ROUNDS_CREDIT),
    )
    figures = MappingProxyType({"figures": float(new.sum()), "rooted": rooted, "rounds": fresh, "own": own})
    told = (
        f"{new.sum():.1f} figures in {turn.beats} beats (best: {NEWS[1] * turn.beats:.1f})",
        f"figures come again {100 * rooted:.0f} % alike (best: {100 * ROOTED[1]:.0f})",
        f"{100 * fresh:.0f} % new since the turns before (best: {100 * ROUNDS[1]:.0f})",
    )
    costs = [Cost(FULL_POINTS * (1.0 - float(share)), words) for share, words in zip(shares, told, strict=True)]
    return ComponentMarks(
        Component.VOCABULARY,
        FULL_POINTS * own * float(np.prod(shares)),
        words_of((*costs, own_cost(own)), f"{new.sum():.0f} figures, which come again"),
        figures,
        _newest(turn, new),
    )


def new_beats(turn: HeardTurn) -> Floats:
    """How new each beat (beats,) is within the turn, 0 … 1; 0 where it is silent."""
    alike = np.tril(likeness(turn.beat_shapes, turn.beat_shapes), -1)
    again = np.interp(alike.max(axis=1), (AGAIN_FROM, AGAIN_AT), (0.0, 1.0))
    return np.where(turn.beat_sounds, 1.0 - again, 0.0)


def _rooted(turn: HeardTurn, before: Sequence[HeardTurn]) -> float:
    """In a turn of one bar any other beat will do."""
    shapes = np.concatenate([turn.beat_shapes, *(earlier.beat_shapes for earlier in before)])
    place = np.arange(turn.beats) % turn.beats_a_bar
    there = (place[:, None] == np.arange(len(shapes)) % turn.beats_a_bar) | (turn.bars == 1)
    there[:, : turn.beats] &= ~np.eye(turn.beats, dtype=np.bool_)
    alike = np.where(there, likeness(turn.beat_shapes, shapes), 0.0)
    return float(alike.max(axis=1)[turn.beat_sounds].mean())


def _fresh(turn: HeardTurn, before: Sequence[HeardTurn]) -> float:
    shapes = [earlier.beat_shapes for earlier in before]
    if not shapes:
        return 1.0
    alike = likeness(turn.beat_shapes[turn.beat_sounds], np.concatenate(shapes))
    return float(1.0 - copied(alike.max(axis=1)).mean())


def _newest(turn: HeardTurn, new: Floats) -> tuple[Place, ...]:
    beat = turn.beats - 1 - int(np.argmax(new[::-1]))
    return (Place(*divmod(beat, turn.beats_a_bar), "a figure not heard before"),)
