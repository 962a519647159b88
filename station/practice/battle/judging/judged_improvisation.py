"""The judge of an improvised turn: six components side by side, and their weighted sum."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from station.practice.battle.judging import dynamics_used, kit_used, motif_development, time_kept, vocabulary_used
from station.practice.battle.judging.heard_turn import Floats, HeardTurn, heard
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ImprovisationMarks
from station.practice.battle.judging.motif_development import BarLikeness
from station.practice.battle.judging.space_used import space_used
from station.practice.battle.phrase import Turn

WEIGHTS: Mapping[Component, float] = MappingProxyType(
    {
        Component.TIME: 22.0,
        Component.DYNAMICS: 24.0,
        Component.VOCABULARY: 13.0,
        Component.DEVELOPMENT: 26.0,
        Component.KIT: 8.0,
        Component.SPACE: 7.0,
    }
)
"""What each component counts of 100 (our choice: `docs/battle-judging.md` says why, and what it was tried on)."""

OWN, OWN_CREDIT = (0.0, 0.4), (0.0, 1.0)
"""Where less than two bars of five are one's own, what they show counts by that share: dynamics, words, kit and space
that were said before are nobody's twice."""


def judged_improvisation(turn: Turn, before: Sequence[Turn], call: Turn | None) -> ImprovisationMarks:
    """The marks of a turn.

    `before` are the same player's earlier turns in order, `call` the turn that this one answers, both on grounds of
    the same meter; what stands on another meter is not compared.
    """
    earlier = [heard(other) for other in before if other.ground.meter == turn.ground.meter]
    called = heard(call) if call is not None and call.ground.meter == turn.ground.meter else None
    return judged(heard(turn), earlier, called)


def judged(played: HeardTurn, earlier: Sequence[HeardTurn], called: HeardTurn | None) -> ImprovisationMarks:
    """The marks of a turn that is heard already."""
    bars = motif_development.bar_likeness(played, earlier, called)
    own = float(np.interp(bars.own, OWN, OWN_CREDIT))
    components = (
        time_kept.time_kept(played),
        dynamics_used.dynamics_used(played, own),
        vocabulary_used.vocabulary_used(played, earlier, own),
        motif_development.motif_development(played, bars),
        kit_used.kit_used(played, own),
        space_used(played, own),
    )
    return ImprovisationMarks(components, WEIGHTS, tuple(_bar_points(played, bars).tolist()))


def _bar_points(turn: HeardTurn, bars: BarLikeness) -> Floats:
    """What each bar (bars,) shows by itself, by the same weights, 0–100."""
    news = vocabulary_used.new_beats(turn).reshape(turn.bars, turn.beats_a_bar).mean(axis=1)
    shown = {
        Component.TIME: time_kept.bar_credit(turn),
        Component.DYNAMICS: dynamics_used.bar_credit(turn),
        Component.VOCABULARY: np.interp(news, vocabulary_used.NEWS, vocabulary_used.NEWS_CREDIT),
        Component.DEVELOPMENT: motif_development.bar_credit(bars),
        Component.KIT: kit_used.bar_credit(turn),
    }
    whole = sum(WEIGHTS[component] for component in shown)
    return np.asarray(sum(FULL_POINTS * WEIGHTS[c] / whole * credit for c, credit in shown.items()))
