"""A phrase that the drummer plays and the student repeats, as hard as a step says.

Candidates come from three sources, in the order that chance shuffles: bars of the shipped lessons, bars of the lessons
that the opponent knows (its vocabulary), and bars made to measure. Of those that ask what the step asks, the one whose
strokes a second and measured difficulty (`drills/difficulty`) are nearest to the step's is played.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.random import Generator

from station.drills.difficulty import measured
from station.music.score import Score
from station.practice.battle.ground import Ground
from station.practice.battle.opponents.opponent import Opponent
from station.practice.battle.phrase import Phrase
from station.practice.battle.repeating.demands import Demand, demand_at
from station.practice.battle.repeating.dressed_bars import dressed
from station.practice.battle.repeating.made_bars import made_bars
from station.practice.battle.vocabulary.asked_of_limbs import coordination_of, dynamics_of
from station.practice.battle.vocabulary.lesson_bars import LessonBars, known_bars, lesson_bars
from station.practice.battle.vocabulary.limbed import limbed, playable

_NEAR_RATE, _NEAR_POINTS = 0.2, 5.0
"""A lesson's bars are taken where their strokes a second are within that share of the step's, and their difficulty
within so many points; else the next source is asked. A step is 0.3 strokes a second and 1.5 points, so that a lesson
is at most three steps off (our choice: the issue's staircase may be two off, and lessons are few)."""
_LOOKED_AT, _MADE = 6, 6
"""Lessons' bars and made ones that are measured: some 5 ms each, and a phrase is due within a beat."""
_ENOUGH = 6
"""So many bars of lessons must fit for them to be asked whenever it is their turn; fewer would come back too often."""
_POINTS_A_RATE = 20.0
"""Points of difficulty that a rate twice or none of the step's is worth when candidates are compared (our choice)."""
_MISSING = 3.0
"""Points that each kind of dynamics or coordination is worth that the step asks and a candidate lacks (our choice)."""


@dataclass(frozen=True, slots=True)
class _Asked:
    """Who asks what, on which ground."""

    opponent: Opponent
    ground: Ground
    demand: Demand


def phrase_to_repeat(opponent: Opponent, ground: Ground, step: int, rng: Generator) -> Phrase:
    """The phrase of `step`, 0 to `MOST_STEP`; the same for the same state of `rng`."""
    asked = _Asked(opponent, ground, demand_at(step))
    sources = (_of_lessons, _of_vocabulary, _made)
    for at in rng.permutation(len(sources)).tolist():
        if (phrase := sources[at](asked, rng)) is not None:
            return phrase
    raise AssertionError("bars are made for every step")


def strokes_per_s(score: Score) -> float:
    """Strokes a second over its bars, grace strokes apart."""
    return float(np.count_nonzero(~score.is_grace)) / (score.length_ns / 1e9)


def _of_lessons(asked: _Asked, rng: Generator) -> Phrase | None:
    ground = asked.ground
    return _from_bars(lesson_bars(ground.beats, ground.unit, ground.feel), asked, rng)


def _of_vocabulary(asked: _Asked, rng: Generator) -> Phrase | None:
    return _from_bars(known_bars(asked.ground, asked.opponent.vocabulary), asked, rng)


def _from_bars(bars: Sequence[LessonBars], asked: _Asked, rng: Generator) -> Phrase | None:
    demand, bar_s = asked.demand, asked.ground.ns_of_bars(1) / 1e9
    fitting = [
        one
        for one in bars
        if one.bars == demand.bars
        and one.coordination <= demand.coordination
        and one.dynamics <= demand.dynamics
        and abs(one.strokes / (one.bars * bar_s) / demand.strokes_per_s - 1) <= _NEAR_RATE
    ]
    if rng.random() >= len(fitting) / _ENOUGH:
        return None
    chosen = [fitting[at] for at in rng.permutation(len(fitting))[:_LOOKED_AT].tolist()]
    scores = [(one, playable(one.on(asked.ground))) for one in chosen]
    whole = [(one.lesson, score) for one, score in scores if len(score) == len(one.rows)]
    found = _nearest(whole, asked)
    return found if found is not None and _off(found.score, asked) <= _NEAR_POINTS else None


def _made(asked: _Asked, rng: Generator) -> Phrase | None:
    demand, ground, idiom = asked.demand, asked.ground, asked.opponent.idiom
    scores = [
        limbed(dressed(made_bars(demand, ground, idiom, rng), demand, ground, idiom, rng), ground, demand.bars)
        for _ in range(_MADE)
    ]
    return _nearest([("", score) for score in scores if len(score)], asked)


def _nearest(candidates: Sequence[tuple[str, Score]], asked: _Asked) -> Phrase | None:
    """The candidate, with what it is called, that is nearest to what is asked."""
    if not candidates:
        return None
    words, score = min(candidates, key=lambda one: _off(one[1], asked))
    return Phrase(score, words=words)


def _off(score: Score, asked: _Asked) -> float:
    """How far a score is from the demand, in points of difficulty."""
    rate = abs(strokes_per_s(score) / asked.demand.strokes_per_s - 1)
    points = measured(score, asked.ground.beat_ticks).total
    missing = asked.demand.dynamics - dynamics_of(score.notes)
    missing += asked.demand.coordination - coordination_of(score.notes)
    return abs(points - asked.demand.difficulty) + _POINTS_A_RATE * max(0.0, rate - _NEAR_RATE) + _MISSING * missing
