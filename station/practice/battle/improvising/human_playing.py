"""How drummers time and weight their strokes: the table that `tools.human_playing` measured, and draws from it.

Both are drawn by a Gaussian copula. How late a stroke is: a normal score that is part a clock that all limbs share (an
AR(1) from moment to moment) and part its limb's own (Wing & Kristofferson 1973 in its simplest form), read off the
quantiles of human lateness, whose tails are heavy; place and instrument add their own. A velocity: a normal score that
is part the phrase's, part the phrase's way with an instrument and place, and part the stroke's, in which it follows the
last on its instrument, read off the deciles of that instrument and place.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from statistics import NormalDist

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.music.score import MAX_LATE_MS
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.stroke_place import StrokePlace, Struck, moments_of, places_of, struck_cells

HUMAN_PLAYING = Path(__file__).parents[1] / "data" / "human_playing.json"
"""Measured on the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0)."""
QUANTILES = (0.0, 0.005, 0.02, 0.05, *np.linspace(0.1, 0.9, 17).tolist(), 0.95, 0.98, 0.995, 1.0)
"""Where the distribution of lateness is kept: its tails closer than its middle."""
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HumanPlaying:
    """The table: `late_ms` (25,) at `QUANTILES`, what `place_ms` (6,) and `instrument_ms` (9,) add, the leans' spread.

    `together` and `from_last` are correlations of strokes of one moment and of the next; velocity `deciles` are
    (9, 6, 11); `of_take`, `of_way` and `of_last` the shares 0–1 of a phrase, of its way with an instrument and place,
    and of the stroke before. `ornaments` are shares of the snare's strokes, by the words of `Ornament`.
    """

    late_ms: Floats
    together: float
    from_last: float
    lean_sd_ms: float
    place_ms: Floats
    instrument_ms: Floats
    deciles: Floats
    of_take: float
    of_way: float
    of_last: float
    ornaments: Mapping[str, float]


@cache
def human_playing() -> HumanPlaying:
    """The table that ships."""
    document = json.loads(HUMAN_PLAYING.read_text(encoding="utf-8"))
    timing, loudness = document["timing"], document["loudness"]
    deciles = loudness["deciles"]
    return HumanPlaying(
        np.array(timing["quantiles_ms"]),
        timing["together"],
        timing["from_last"],
        timing["lean_sd_ms"],
        np.array([timing["place_ms"][place.name.lower()] for place in StrokePlace]),
        np.array([timing["instrument_ms"][one.name.lower()] for one in Instrument]),
        np.array([[deciles[one.name.lower()][place.name.lower()] for place in StrokePlace] for one in Instrument]),
        loudness["of_take"],
        loudness["of_way"],
        loudness["of_last"],
        document["ornaments"],
    )


def human_late_ms(beats: Beats, spread: float, rng: Generator) -> Floats:
    """How late each stroke of `struck_cells` (n,) is; `spread` scales a human's, the lean apart."""
    table, struck = human_playing(), struck_cells(beats)
    if not len(struck):
        return np.zeros(0)
    moment = moments_of(beats, struck)
    clock = ar1(int(moment.max()) + 1, table.from_last / table.together, rng)
    own = rng.normal(size=len(struck))
    rank = _ranks(table.together**0.5 * clock[moment] + (1 - table.together) ** 0.5 * own)
    late = np.interp(rank, QUANTILES, table.late_ms)
    late += table.place_ms[places_of(beats, struck)] + table.instrument_ms[struck[:, 2]]
    return np.asarray(np.clip(spread * late, -MAX_LATE_MS, MAX_LATE_MS))


def human_velocity(beats: Beats, rng: Generator) -> Floats:
    """A velocity, 1–127, for each stroke of `struck_cells` (n,)."""
    table, struck = human_playing(), struck_cells(beats)
    place = places_of(beats, struck)
    ways = rng.normal(size=(len(Instrument), len(StrokePlace)))
    rest = _in_turn(struck, table.of_last, rng)
    own = max(0.0, 1 - table.of_take - table.of_way)
    score = table.of_take**0.5 * rng.normal() + table.of_way**0.5 * ways[struck[:, 2], place] + own**0.5 * rest
    return velocity_at(struck[:, 2], place, _ranks(score))


def velocity_at(instrument: NDArray[np.int64], place: NDArray[np.int64], rank: Floats) -> Floats:
    """The velocities (n,) of which a share `rank` (n,) of a human's strokes there are softer."""
    deciles = human_playing().deciles[instrument, place]
    steps = np.clip(rank * (deciles.shape[-1] - 1), 0, deciles.shape[-1] - 1 - 1e-9)
    low = steps.astype(np.int64)
    rows = np.arange(len(deciles))
    below, above = deciles[rows, low], deciles[rows, low + 1]
    return np.asarray(below + (above - below) * (steps - low))


def ar1(count: int, correlation: float, rng: Generator) -> Floats:
    """`count` numbers of mean 0 and variance 1, each correlated with the one before it."""
    noise = rng.normal(size=count)
    found = np.empty(count)
    last = noise[0] if count else 0.0
    for at in range(count):
        last = noise[0] if at == 0 else correlation * last + (1 - correlation**2) ** 0.5 * noise[at]
        found[at] = last
    return found


def _ranks(scores: Floats) -> Floats:
    """The share of a standard normal distribution below each score (n,)."""
    below = NormalDist().cdf
    return np.array([below(score) for score in scores.tolist()])


def _in_turn(struck: Struck, correlation: float, rng: Generator) -> Floats:
    """Normal scores (n,) in which each stroke follows the last on its instrument."""
    found = np.zeros(len(struck))
    for instrument in np.unique(struck[:, 2]).tolist():
        rows = struck[:, 2] == instrument
        found[rows] = ar1(int(rows.sum()), correlation, rng)
    return found
