"""Use of the kit: how many voicings the turn speaks in, and whether two hands can play them.

    voicings = e^H of what is struck together at each moment       H: Shannon's entropy, so the effective number
    crowded  = share of the moments at which more than two hands would be needed
    points   = 100·own·credit(voicings)·(1 − crowded)²

One pad for ever has one voicing, and so have all pads at once: how instruments combine tells more of a drummer than
how many there are. Effective numbers by entropy: Hill 1973. Human phrases have 3 to 9 (four drummers of the Groove MIDI
Dataset).
"""

from types import MappingProxyType

import numpy as np

from station.practice.battle.improvising.played_beats import Instrument
from station.practice.battle.judging.component_words import Cost, own_cost, words_of
from station.practice.battle.judging.heard_turn import Floats, HeardTurn, Ints
from station.practice.battle.judging.improvisation_marks import FULL_POINTS, Component, ComponentMarks

VOICINGS, VOICINGS_CREDIT = (1.0, 6.0), (0.0, 1.0)
"""The middle human phrase has 5.6: hat alone, with kick, with snare, a ghost, an open hat or a crash (our choice)."""
HANDS = 2
FEET = (Instrument.KICK, Instrument.CLOSED_HIHAT)
"""Feet can play these, the hi-hat by its pedal."""


def kit_used(turn: HeardTurn, own: float) -> ComponentMarks:
    """The marks for the kit."""
    if not len(turn):
        return ComponentMarks(Component.KIT, 0.0, "nothing played")
    voicings, hands = _voicings(turn)
    number, crowded = _effective(voicings), float((hands > HANDS).mean())
    instruments = len(np.unique(turn.instrument))
    spoken, playable = float(np.interp(number, VOICINGS, VOICINGS_CREDIT)), (1.0 - crowded) ** 2
    figures = {"voicings": number, "crowded": crowded, "instruments": float(instruments), "own": own}
    on = "one instrument" if instruments == 1 else f"{instruments} instruments"
    costs = (
        Cost(FULL_POINTS * (1.0 - spoken), f"{number:.1f} voicings on {on} (best: {VOICINGS[1]:.0f})"),
        Cost(FULL_POINTS * (1.0 - playable), f"{100 * crowded:.0f} % of the moments ask for a third hand"),
        own_cost(own),
    )
    words, points = words_of(costs, f"{number:.0f} voicings on {on}"), FULL_POINTS * own * spoken * playable
    return ComponentMarks(Component.KIT, points, words, MappingProxyType(figures))


def bar_credit(turn: HeardTurn) -> Floats:
    """Share of full marks (bars,) for the voicings of each bar."""
    numbers = [_effective(_voicings(turn, bar)[0]) if turn.bar_sounds[bar] else 1.0 for bar in range(turn.bars)]
    return np.interp(numbers, VOICINGS, VOICINGS_CREDIT)


def _voicings(turn: HeardTurn, bar: int | None = None) -> tuple[Ints, Ints]:
    """Of each moment (m,) what is struck, as a number, and how many hands that takes."""
    inside = np.ones(len(turn), np.bool_) if bar is None else turn.bar == bar
    _, moment = np.unique(turn.moment[inside], return_inverse=True)
    instrument = turn.instrument[inside]
    code = np.bincount(moment, 2.0**instrument).astype(np.int64)
    return code, np.bincount(moment, ~np.isin(instrument, FEET)).astype(np.int64)


def _effective(voicings: Ints) -> float:
    counts = np.unique(voicings, return_counts=True)[1]
    share = counts / counts.sum()
    return float(np.exp(-(share * np.log(share)).sum()))
