"""A phrase as somebody has played it: the drummer plays what is written, so that it is judged by what anybody is."""

import numpy as np

from station.music.performance import HIT_DTYPE, Performance
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Phrase, Turn

_SAME = ("openness", "piece", "zone", "articulation", "velocity", "limb", "midi_note")


def phrase_as_turn(phrase: Phrase, ground: Ground) -> Turn:
    """The turn that playing `phrase` is, its landing included."""
    score = phrase.with_landing
    hits = np.zeros(len(score), HIT_DTYPE)
    for name in _SAME:
        hits[name] = score.notes[name]
    hits["at_ns"], hits["position"] = score.onset_ns, np.nan
    return Turn(ground, phrase.bars, Performance.from_array(hits))
