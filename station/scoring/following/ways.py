"""The ways that a performance may have gone through a score, and which of them is believed.

The tempo is followed hit by hit (`pursuit`), once for a player who plays on in time whatever happens and, where there
are silences, once for one who goes on where he stopped. Where hits fit less well than elsewhere, bars that were left
out or played again are looked for (`shifts`); with a click nothing else can be amiss. Hits alone cannot decide between
bars that are alike; but who plays a score plays its notes, so that way is believed which leaves few notes unanswered
and few hits astray. Times are seconds.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.scoring.following.evidence import SD_S, best_evidence, evidence
from station.scoring.following.locate import Hits, Notes
from station.scoring.following.pursuit import JUMP_COST, SURE_JUMP_COST, Pursuit, silences
from station.scoring.following.shifts import (
    SHIFTS_BEATS,
    Beats,
    best_shifts,
    fits_bars_away,
    fits_elsewhere,
    jumps,
    to_nearest,
    whole_beats,
)
from station.scoring.following.tempo_tracker import Place

Floats = NDArray[np.float64]

_DOUBT_HITS, _DOUBT_SHARE = 32, 0.4
"""So many hits in a row that bring less than so much of the usual share of the possible evidence are held against the
score moved by whole beats (our choice: about every 3000 hits by chance)."""


@dataclass(frozen=True, eq=False)
class Way:
    """Score time of each hit, `places` (m,), and from there to the nearest note of its class, `distances` (m,)."""

    places: Floats
    distances: Floats


def best_way(notes: Notes, hits: Hits, start: Place, beats: Beats) -> Way:
    """The likeliest way from `start`."""
    ways = _ways(notes, hits, start, beats, resumes=False)
    if len(silences(hits.at_s)):
        ways += _ways(notes, hits, start, beats, resumes=True)
    if start == Place(start.at_s, start.at_s, 1.0) and _keeps_to_a_click(hits, ways[0]):
        clicked = clicked_way(notes, hits, beats)
        ways.append(_way_of(notes, hits, hits.at_s if clicked is None else clicked))
    return ways[0] if len(ways) == 1 else max(ways, key=lambda way: _worth(notes, hits, way))


def _keeps_to_a_click(hits: Hits, way: Way) -> bool:
    """Whether what was recorded on the score's time base seems to have been played to a click: it never strays far."""
    off = way.places - hits.at_s
    stretches = np.split(off, jumps(hits.at_s, way.places))
    return all(float(np.abs(part - np.median(part)).max()) < _MOST_ASTRAY_S for part in stretches)


_MOST_ASTRAY_S = 0.1
"""Our choice: three times a steady player's slow sway."""


def _ways(notes: Notes, hits: Hits, start: Place, beats: Beats, resumes: bool) -> list[Way]:
    """What the pursuit found, and that with its shifts corrected where there is a doubt."""
    pursuit = Pursuit(notes, hits, resumes)
    pursuit.run(start)
    places, found = pursuit.places, [Way(pursuit.places, pursuit.distances)]
    jumped = len(jumps(hits.at_s, places)) > 0
    if jumped and not resumes:  # he may never have left his place, however ill some bars fit
        found.append(_way_of(notes, hits, np.array(notes.tracker.follow(*hits.lists(), start)[0])))
    if jumped or _is_doubtful(notes, hits, found[0], beats, SHIFTS_BEATS):
        found.append(_way_of(notes, hits, beats.moved(places, best_shifts(notes, hits, places, beats))))
    return found


def _way_of(notes: Notes, hits: Hits, places: Floats) -> Way:
    return Way(places, np.array(notes.tracker.distances(places.tolist(), hits.classes.tolist())))


def clicked_way(notes: Notes, hits: Hits, beats: Beats) -> Floats | None:
    """Score time of each hit (m,) of a player who keeps to a click and left bars out or played them again, else None.

    The hits' times are the click's.
    """
    way = _way_of(notes, hits, hits.at_s)
    doubtful = _doubtful(way.distances, notes.rates[hits.classes])
    restarts = np.array([*(part.start for part in doubtful), *silences(hits.at_s).tolist()], np.int64)
    tried = whole_beats(notes, hits, beats, restarts)
    if not _is_doubtful(notes, hits, way, beats, tried):
        return None
    shifts = best_shifts(notes, hits, hits.at_s, beats, tried)
    return beats.moved(hits.at_s, shifts) if shifts.any() else None


def _is_doubtful(notes: Notes, hits: Hits, way: Way, beats: Beats, tried: Floats) -> bool:
    """Whether some hits of `way` fit better elsewhere: those that fit worst by a shift of `tried`, or many by bars."""
    parts = _doubtful(way.distances, notes.rates[hits.classes])
    return any(
        fits_elsewhere(notes, hits.part(part.start, part.stop), way.places[part], beats, tried) for part in parts
    ) or fits_bars_away(notes, hits, way.places, beats)


def _worth(notes: Notes, hits: Hits, way: Way) -> float:
    """What the hits that answer a note and the notes that a hit answers say for a way, less what its jumps cost."""
    said = evidence(way.distances, notes.rates[hits.classes])
    jumped = jumps(hits.at_s, way.places)
    resumed = np.isin(jumped, silences(hits.at_s))
    total = float(said.sum()) - float(np.where(resumed, JUMP_COST, SURE_JUMP_COST).sum())
    weights = best_evidence(notes.rates)
    for c in np.unique(hits.classes).tolist():
        off = to_nearest(np.sort(way.places[hits.classes == c]), notes.at_s[notes.classes == c])
        total += float(weights[c]) * float(np.exp(-0.5 * np.square(off / SD_S)).sum())
    return total


def _doubtful(distances: Floats, rates: Floats) -> list[slice]:
    """Runs of `_DOUBT_HITS` hits that fit much less well than most, the worst of each neighbourhood."""
    if len(distances) < 2 * _DOUBT_HITS:
        return []
    said, possible = (np.concatenate(([0.0], np.cumsum(v))) for v in (evidence(distances, rates), best_evidence(rates)))
    share = (said[_DOUBT_HITS:] - said[:-_DOUBT_HITS]) / (possible[_DOUBT_HITS:] - possible[:-_DOUBT_HITS])
    low = np.flatnonzero(share < _DOUBT_SHARE * np.median(share))
    groups = np.split(low, np.flatnonzero(np.diff(low) > _DOUBT_HITS) + 1) if len(low) else []
    worst = [int(group[np.argmin(share[group])]) for group in groups]
    return [slice(start, start + _DOUBT_HITS) for start in worst]
