"""How drummers time and weight their strokes: the table that `tools.human_playing` measured, and draws from it.

Both are drawn by a Gaussian copula, a normal score that is a sum of parts, read off human quantiles, whose tails are
heavy. How late a stroke is, in units of the phrase's own spread and about its lean: a clock that all limbs share, an
AR(1) from moment to moment (Wing & Kristofferson 1973 in its simplest form), what this instrument does at this place of
the bar every time, and the stroke's own. A velocity: what the phrase, the instrument in it, its place, and its spot in
the bar have of their own, and the stroke, off the deciles of that instrument and place.
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
from station.practice.battle.improvising.stroke_place import StrokePlace, moments_of, places_of, spots_of, struck_cells

HUMAN_PLAYING = Path(__file__).parents[1] / "data" / "human_playing.json"
"""Measured on the Groove MIDI Dataset (Gillick et al. 2019, CC BY 4.0)."""
QUANTILES = (0.0, 0.005, 0.02, 0.05, *np.linspace(0.1, 0.9, 17).tolist(), 0.95, 0.98, 0.995, 1.0)
"""Where the distribution of lateness is kept: its tails closer than its middle."""
_ENOUGH = 12
"""So many strokes have a spread of their own (our choice)."""
Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class HumanPlaying:
    """The table; shares are of a variance of 1, those of loudness (9,) what an instrument's strokes have in common.

    `of_phrase` is what all strokes of a phrase do, `of_instrument` those of one instrument, `of_place` those at one
    place, `of_spot` those at one spot of the bar: each includes the one before.

    `lean_ms` mean and spread of phrases' leans, `spread_ms` the middle of their spreads and `spread_log_sd` how these
    vary; `late` (25,) at `QUANTILES`, `place` (6,) and `instrument` (9,) are in units of the spread. `from_last` is the
    clock's correlation from a moment to the next. Velocity `deciles` are (9, 6, 11). `ornaments` are shares of the
    snare's strokes, by the words of `Ornament`; `strokes_a_beat` is how dense drummers play.
    """

    lean_ms: tuple[float, float]
    spread_ms: float
    spread_log_sd: float
    late: Floats
    place: Floats
    instrument: Floats
    of_clock: float
    from_last: float
    late_of_spot: float
    deciles: Floats
    of_phrase: float
    of_instrument: Floats
    of_place: Floats
    of_spot: Floats
    ornaments: Mapping[str, float]
    strokes_a_beat: float


@cache
def human_playing() -> HumanPlaying:
    """The table that ships."""
    document = json.loads(HUMAN_PLAYING.read_text(encoding="utf-8"))
    timing, loudness = document["timing"], document["loudness"]
    deciles = loudness["deciles"]
    return HumanPlaying(
        lean_ms=tuple(timing["lean_ms"]),
        spread_ms=timing["spread_ms"],
        spread_log_sd=timing["spread_log_sd"],
        late=np.array(timing["quantiles"]),
        place=np.array([timing["place"][place.name.lower()] for place in StrokePlace]),
        instrument=np.array([timing["instrument"][one.name.lower()] for one in Instrument]),
        of_clock=timing["of_clock"],
        from_last=timing["from_last"],
        late_of_spot=timing["of_spot"],
        deciles=np.array([[deciles[i.name.lower()][p.name.lower()] for p in StrokePlace] for i in Instrument]),
        of_phrase=loudness["of_phrase"],
        of_instrument=np.array(loudness["of_instrument"]),
        of_place=np.array(loudness["of_place"]),
        of_spot=np.array(loudness["of_spot"]),
        ornaments=document["ornaments"],
        strokes_a_beat=document["strokes_a_beat"],
    )


def human_late_ms(beats: Beats, spread: float, rng: Generator) -> Floats:
    """How late each stroke of `struck_cells` (n,) is about the phrase's lean; `spread` scales a human's."""
    table, struck = human_playing(), struck_cells(beats)
    if not len(struck):
        return np.zeros(0)
    moment = moments_of(beats, struck)
    clock = ar1(int(moment.max()) + 1, table.from_last, rng)[moment]
    spot = each(spots_of(beats, struck), rng)
    own = rng.normal(size=len(struck))
    rest = 1 - table.of_clock - table.late_of_spot
    score = table.of_clock**0.5 * clock + table.late_of_spot**0.5 * spot + rest**0.5 * own
    late = np.interp(_ranks(score), QUANTILES, table.late)
    late += table.place[places_of(beats, struck)] + table.instrument[struck[:, 2]]
    wide = table.spread_ms * float(np.exp(table.spread_log_sd * np.clip(rng.normal(), -2, 2)))
    if len(struck) >= _ENOUGH:
        late /= late.std()  # the table's unit is the spread of the phrase itself
    return np.asarray(np.clip(spread * wide * late, -MAX_LATE_MS, MAX_LATE_MS))


def human_velocity(beats: Beats, evenness: float, rng: Generator) -> Floats:
    """A velocity, 1–127, for each stroke of `struck_cells` (n,).

    `evenness` 0–1 takes away what a phrase as a whole is softer or louder than others.
    """
    table, struck = human_playing(), struck_cells(beats)
    place = places_of(beats, struck)
    spots = spots_of(beats, struck)
    levels = np.array([table.of_instrument, table.of_place, table.of_spot, np.ones(len(Instrument))])[:, struck[:, 2]]
    levels = np.maximum.accumulate(np.clip(levels, table.of_phrase, 1.0), axis=0)
    shares = np.diff(levels, axis=0, prepend=table.of_phrase)
    groups = struck[:, 2], struck[:, 2] * len(StrokePlace) + place, spots, np.arange(len(struck))
    score = (1 - evenness) * table.of_phrase**0.5 * rng.normal()
    score = score + sum(share**0.5 * each(group, rng) for share, group in zip(shares, groups, strict=True))
    return velocity_at(struck[:, 2], place, _ranks(score))


def each(group: NDArray[np.int64], rng: Generator) -> Floats:
    """A normal number for each group, given to all its members (n,)."""
    numbers, inverse = np.unique(group, return_inverse=True)
    return np.asarray(rng.normal(size=len(numbers))[inverse])


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
