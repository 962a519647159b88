"""Where in the score and how fast a performance begins.

A recording may start anywhere, its first stroke may be a count-in, and the student may play at another tempo. What the
first hits match is found by voting; the likeliest beginnings are then followed for a while, for bars that are alike
part ways sooner or later. Times are seconds.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import best_evidence
from station.scoring.following.locate import (
    MISS_COST,
    WINDOW_HITS,
    Candidate,
    Hits,
    Notes,
    Search,
    candidates,
    nats_for,
)
from station.scoring.following.pursuit import silences
from station.scoring.following.tempo_tracker import GATE_S, Place

Floats = NDArray[np.float64]

RATES = np.exp(np.arange(-35, 36) * 0.02)
"""Tempi that are tried, a half to twice as fast, in steps of 2 %."""

_TEMPO_PRIOR = 0.3
"""SD of log tempo: a student practises at 70 % more readily than at half the tempo (TEACHING)."""

_EARLY_S = 15.0
"""Most performances begin within so much of the score's beginning: there is looked first."""

_COST_PER_S, _MOST_COST, _COST_PER_S_MORE = 2.0, 15.0, 0.02
"""Nats a second against a first hit that is not the first note, nor at its own time in the score with what stands
before left out, up to a jump's cost, for it is one; a little beyond."""

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
    longer = hits.part(0, _look_end(hits))
    same = Place(float(hits.at_s[0]), float(hits.at_s[0]), 1.0)  # recorded on the score's own time base
    possible = _possible(notes, longer)
    nats_same = nats_for(notes, longer, same)
    if nats_same > _SURELY * possible and _begins_with_score(same, notes):
        return same
    window = hits.window(0)
    early = slice(0, int(np.searchsorted(notes.at_s, notes.at_s[0] + _EARLY_S)))
    search = Search(early, RATES, float(notes.at_s[0]))
    tried = [Candidate(same, nats_for(notes, window, same)), *candidates(notes, search, window)]
    if max(candidate.nats for candidate in tried) < _ENOUGH * _possible(notes, window):
        tried += candidates(notes, replace(search, among=slice(None)), window)
    tried.sort(key=lambda candidate: -candidate.nats - _prior(candidate.place, notes))
    best = max((c.place for c in tried[:_LOOKED_AT]), key=lambda p: nats_for(notes, longer, p) + _prior(p, notes))
    more = nats_for(notes, longer, best) - nats_same
    return best if more > _CLEARLY * possible or not _begins_with_score(same, notes) else same


def _look_end(hits: Hits) -> int:
    """The end of the long look: a silence ends it, for after it the player may be anywhere."""
    after: list[int] = silences(hits.at_s).tolist()
    return min(_LONG_LOOK, len(hits.at_s), *(hit for hit in after if hit >= WINDOW_HITS))


def _begins_with_score(place: Place, notes: Notes) -> bool:
    """Whether no more than the first stroke stands before the first hit."""
    before = _unheard_before(place, notes)
    return not len(before) or float(np.ptp(before)) < GATE_S


def _unheard_before(place: Place, notes: Notes) -> Floats:
    return notes.at_s[: int(np.searchsorted(notes.at_s, place.score_s - GATE_S))]


def _possible(notes: Notes, hits: Hits) -> float:
    return float(best_evidence(notes.rates[hits.classes]).sum())


def _prior(place: Place, notes: Notes) -> float:
    """Nats for a beginning: at the score's first note, or later on the score's own time base, notes left out."""
    from_start_s, off_base_s = abs(place.score_s - float(notes.at_s[0])), abs(place.score_s - place.at_s)
    late = _COST_PER_S * off_base_s + MISS_COST * len(_unheard_before(place, notes))
    elsewhere = min(_COST_PER_S * from_start_s, late, _MOST_COST) + _COST_PER_S_MORE * min(from_start_s, off_base_s)
    return -0.5 * float(np.log(place.rate) / _TEMPO_PRIOR) ** 2 - elsewhere
