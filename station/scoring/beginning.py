"""Where in the score and how fast a performance begins.

A recording may start anywhere, its first stroke may be a count-in, and the student may play at another tempo. What the
first hits match is found by voting; the likeliest beginnings are then followed for a while, for bars that are alike
part ways sooner or later. Times are seconds.
"""

from dataclasses import replace

import numpy as np

from station.scoring.evidence import best_evidence
from station.scoring.locate import Candidate, Hits, Notes, Search, candidates, nats_for
from station.scoring.tracker import Place

RATES = np.exp(np.arange(-35, 36) * 0.02)
"""Tempi that are tried, a half to twice as fast, in steps of 2 %."""

_TEMPO_PRIOR = 0.3
"""SD of log tempo: a student practises at 70 % more readily than at half the tempo (TEACHING)."""

_EARLY_S = 15.0
"""Most performances begin within so much of the score's beginning: there is looked first."""

_COST_PER_S, _MOST_COST, _COST_PER_S_MORE = 2.0, 15.0, 0.02
"""Nats a second against a first hit that is neither the first note nor at its own time in the score, up to a jump's
cost, for it is one; a little beyond."""

_ENOUGH = 0.5
"""Share of all possible evidence with which a beginning is believed without looking elsewhere."""

_SURELY = 0.6
"""As `_ENOUGH`, of the long look, for a performance on the score's own time base: a player of SD 20 ms, with one stroke
in ten astray, brings so much."""

_CLEARLY = 0.2
"""The score's own time base is left only for so much more of the possible evidence: another drummer's groove, with its
fills and ghosts, may fit a bar off by a tenth better; a recording that is truly elsewhere fits by half."""

_LOOKED_AT, _LONG_LOOK = 12, 256
"""So many of the likeliest beginnings are followed over so many hits."""


def find_beginning(notes: Notes, hits: Hits) -> Place:
    """Where and how fast the performance begins."""
    longer = hits.part(0, _LONG_LOOK)
    same = Place(float(hits.at_s[0]), float(hits.at_s[0]), 1.0)  # recorded on the score's own time base
    possible = _possible(notes, longer)
    nats_same = nats_for(notes, longer, same)
    if nats_same > _SURELY * possible:
        return same
    window = hits.window(0)
    early = slice(0, int(np.searchsorted(notes.at_s, notes.at_s[0] + _EARLY_S)))
    search = Search(early, RATES, float(notes.at_s[0]))
    tried = [Candidate(same, nats_for(notes, window, same)), *candidates(notes, search, window)]
    if max(candidate.nats for candidate in tried) < _ENOUGH * _possible(notes, window):
        tried += candidates(notes, replace(search, among=slice(None)), window)
    tried.sort(key=lambda candidate: -candidate.nats - _prior(candidate.place, notes))
    best = max((c.place for c in tried[:_LOOKED_AT]), key=lambda p: nats_for(notes, longer, p) + _prior(p, notes))
    return best if nats_for(notes, longer, best) - nats_same > _CLEARLY * possible else same


def _possible(notes: Notes, hits: Hits) -> float:
    return float(best_evidence(notes.rates[hits.classes]).sum())


def _prior(place: Place, notes: Notes) -> float:
    from_start_s = min(abs(place.score_s - float(notes.at_s[0])), abs(place.score_s - place.at_s))
    elsewhere = min(_COST_PER_S * from_start_s, _MOST_COST) + _COST_PER_S_MORE * from_start_s
    return -0.5 * float(np.log(place.rate) / _TEMPO_PRIOR) ** 2 - elsewhere
