"""How drummers time and weight their strokes, by instrument and place: writes `data/human_playing.json`.

    python -m tools.human_playing [--data ../shared/data/gmd]

Measured on the files of the Groove MIDI Dataset that are there (Gillick et al. 2019, CC BY 4.0), read as beats, four
bars at a time. What strokes have in common is the mean product of normal scores of pairs of them: pairs of one moment,
of moments so far apart, of one instrument, of one spot (instrument and place in the bar) in different bars. Lateness
is taken about the phrase's median, at most `MAX_LATE_MS`, and in units of its spread.
"""

import argparse
import json
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, rankdata

from station.core.pieces import Ornament, word
from station.music.score import MAX_LATE_MS
from station.practice.battle.improvising.human_playing import HUMAN_PLAYING, QUANTILES
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.stroke_place import StrokePlace, moments_of, places_of, spots_of, struck_cells
from tools.battle_training.takes import GrooveTake, groove_takes

Floats = NDArray[np.float64]
PHRASE_BARS = 4
LEAST_STROKES = 30
"""Phrases with fewer tell nothing of a spread."""
LEAST_SPREAD_MS = 6.0
LAGS = (2, 4)
"""Moments apart between which the clock's course is measured: at one, hands alternate and undo each other's errors."""
ENOUGH = 25
"""Fewer strokes of an instrument at a place are measured with those at all its places."""
DECILES = np.linspace(0, 1, 11)
SOURCE = "Groove MIDI Dataset v1.0.0, Gillick et al. 2019, CC BY 4.0"


def table(takes: Sequence[GrooveTake]) -> dict[str, object]:
    """The whole document."""
    beats = [take.beats for take in takes]
    phrases = [phrase for one in beats for phrase in _phrases(one) if phrase.struck.sum() >= LEAST_STROKES]
    return {
        "source": SOURCE,
        "made_by": "python -m tools.human_playing",
        "takes": len(beats),
        "phrases": len(phrases),
        "strokes": sum(int(one.struck.sum()) for one in beats),
        "strokes_a_beat": round(sum(int(p.struck.sum()) for p in phrases) / sum(map(len, phrases)), 2),
        "timing": timing(phrases),
        "loudness": loudness(phrases),
        "ornaments": ornaments(beats),
    }


def _phrases(take: Beats) -> list[Beats]:
    return [take.of_bars(bar, bar + PHRASE_BARS) for bar in range(0, take.bars - PHRASE_BARS + 1, PHRASE_BARS)]


# --- timing -----------------------------------------------------------------------------------------------------------


def timing(phrases: Sequence[Beats]) -> dict[str, object]:
    """Leans and spreads in ms, quantiles in spreads, what strokes share, the places' and instruments' own medians."""
    lean, spread, late, place, instrument = [], [], [], [], []
    moment, spot = [], []
    for at, phrase in enumerate(phrases):
        struck = struck_cells(phrase)
        own = phrase.late_ms[phrase.struck].astype(np.float64)
        lean.append(float(np.median(own)))
        spread.append(max(float(own.std()), LEAST_SPREAD_MS))
        own = np.clip(own - lean[-1], -MAX_LATE_MS, MAX_LATE_MS)
        late.append(own / max(float(own.std()), LEAST_SPREAD_MS))
        place.append(places_of(phrase, struck))
        instrument.append(struck[:, 2])
        moment.append(moments_of(phrase, struck) + at * 10_000)
        spot.append(at * 10_000 + spots_of(phrase, struck))
    whole, where, who = np.concatenate(late), np.concatenate(place), np.concatenate(instrument)
    score = norm.ppf((rankdata(whole) - 0.5) / len(whole))
    moments = np.concatenate(moment)
    near, far = (_apart(score, moments, lag) for lag in LAGS)
    return {
        "lean_ms": [round(float(np.mean(lean)), 1), round(float(np.std(lean)), 1)],
        "spread_ms": round(float(np.median(spread)), 1),
        "spread_log_sd": round(float(np.std(np.log(spread))), 2),
        "quantiles": [round(float(v), 2) for v in np.quantile(whole, QUANTILES)],
        "of_clock": round(_together(score, moments), 2),
        "from_last": round(float((far / near) ** (1 / (LAGS[1] - LAGS[0]))), 2),
        "of_spot": round(_together(score, np.concatenate(spot)), 2),
        "place": {p.name.lower(): round(float(np.median(whole[where == p])), 2) for p in StrokePlace},
        "instrument": {one.name.lower(): round(float(np.median(whole[who == one])), 2) for one in Instrument},
    }


def _together(score: Floats, group: NDArray[np.int64]) -> float:
    """The mean product of all pairs within a group."""
    total, pairs = _pairs(score, group)
    return total / pairs


def _pairs(score: Floats, group: NDArray[np.int64]) -> tuple[float, float]:
    """The sum of the products of all pairs within a group, and how many there are."""
    inverse = np.unique(group, return_inverse=True)[1]
    count, whole, square = (np.bincount(inverse, w) for w in (np.ones(len(score)), score, score**2))
    return float((whole**2 - square).sum() / 2), float((count * (count - 1)).sum() / 2)


def _apart(score: Floats, moment: NDArray[np.int64], lag: int) -> float:
    """The mean product of pairs that are so many moments apart, within a phrase."""
    numbers, inverse = np.unique(moment, return_inverse=True)
    whole, count = np.bincount(inverse, score), np.bincount(inverse)
    same = numbers[lag:] - numbers[:-lag] == lag
    products, pairs = whole[lag:] * whole[:-lag], count[lag:] * count[:-lag]
    return float(products[same].sum() / pairs[same].sum())


# --- loudness ---------------------------------------------------------------------------------------------------------


def loudness(phrases: Sequence[Beats]) -> dict[str, object]:
    """Deciles of velocity by instrument and place, and what strokes of a phrase share of their normal scores."""
    strokes = np.concatenate([_strokes(at, phrase) for at, phrase in enumerate(phrases)])
    deciles = {
        instrument.name.lower(): {place.name.lower(): _deciles(strokes, instrument, place) for place in StrokePlace}
        for instrument in Instrument
    }
    score = np.zeros(len(strokes))
    for instrument in Instrument:
        for place in StrokePlace:
            rows = (strokes[:, 1] == instrument) & (strokes[:, 2] == place)
            if rows.any():
                score[rows] = norm.ppf((rankdata(strokes[rows, 3]) - 0.5) / rows.sum())
    return {"deciles": deciles, **_shares(strokes, score)}


def _strokes(at: int, phrase: Beats) -> NDArray[np.int64]:
    """Phrase, instrument, place, velocity and spot of each stroke (n, 5)."""
    struck = struck_cells(phrase)
    velocity = phrase.velocity[phrase.struck].astype(np.int64)
    columns = np.full(len(struck), at), struck[:, 2], places_of(phrase, struck), velocity, spots_of(phrase, struck)
    return np.column_stack(columns)


def _deciles(strokes: NDArray[np.int64], instrument: Instrument, place: StrokePlace) -> list[int]:
    own = strokes[strokes[:, 1] == instrument]
    here = own[own[:, 2] == place]
    found = np.quantile((here if len(here) >= ENOUGH else own)[:, 3], DECILES)
    return [int(v) for v in np.rint(found)]


def _shares(strokes: NDArray[np.int64], score: Floats) -> dict[str, object]:
    """What all strokes of a phrase share; by instrument what its strokes do, those of a place, and of a spot.

    Every phrase counts once: a solo has a hundred times the pairs of a groove.
    """
    phrase = strokes[:, 0]
    groups = [phrase * 16 + strokes[:, 1]]
    groups += [groups[0] * 16 + strokes[:, 2], phrase * 10_000 + strokes[:, 4]]
    found: dict[str, list[float]] = {name: [] for name in ("of_instrument", "of_place", "of_spot")}
    for instrument in Instrument:
        rows = strokes[:, 1] == instrument
        inside = [_phrase_pairs(score[rows], group[rows], phrase[rows]) for group in groups]
        outer = [(a[0] - b[0], a[1] - b[1]) for a, b in pairwise(inside)]  # pairs that no finer group has
        levels = [*(_mean_of_phrases(*level) for level in outer), _of_spot(score[rows], groups[-1][rows])]
        for name, level in zip(found, levels, strict=True):
            found[name].append(round(level, 2))
    whole, own = _phrase_pairs(score, phrase, phrase), _phrase_pairs(score, groups[0], phrase)
    return {"of_phrase": round(_mean_of_phrases(whole[0] - own[0], whole[1] - own[1]), 2), **found}


def _of_spot(score: Floats, spot: NDArray[np.int64]) -> float:
    """What strokes of one spot share in a usual phrase: by the median of their change from one to the next."""
    order = np.argsort(spot, kind="stable")
    same = spot[order][1:] == spot[order][:-1]
    change = np.abs(np.diff(score[order])[same])
    own = (float(np.median(change)) / (0.6745 * 2**0.5)) ** 2  # of a normal number, whose median size is 0.6745
    return 1 - own


def _phrase_pairs(score: Floats, group: NDArray[np.int64], phrase: NDArray[np.int64]) -> tuple[Floats, Floats]:
    """By phrase the sum of the products of all pairs within its groups, and how many there are."""
    _, first, inverse = np.unique(group, return_index=True, return_inverse=True)
    count, whole, square = (np.bincount(inverse, w) for w in (np.ones(len(score)), score, score**2))
    of_phrase, longest = phrase[first], int(phrase.max()) + 1
    products, pairs = (whole**2 - square) / 2, count * (count - 1) / 2
    return _sums(of_phrase, products, longest), _sums(of_phrase, pairs, longest)


def _sums(group: NDArray[np.int64], values: Floats, groups: int) -> Floats:
    return np.bincount(group, values, groups).astype(np.float64)


def _mean_of_phrases(products: Floats, pairs: Floats) -> float:
    has = pairs > 0
    return float((products[has] / pairs[has]).mean()) if has.any() else 0.0


# --- ornaments --------------------------------------------------------------------------------------------------------


def ornaments(takes: Sequence[Beats]) -> dict[str, float]:
    """Share of the snare's strokes that have each ornament."""
    found = np.concatenate(
        [take.ornament[:, :, Instrument.SNARE][take.struck[:, :, Instrument.SNARE]] for take in takes]
    )
    return {word(one): round(float((found == one).mean()), 4) for one in Ornament if one is not Ornament.NONE}


def main() -> None:
    """Write the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", type=Path, default=Path("../shared/data/gmd"))
    document = table(groove_takes(parser.parse_args().data))
    HUMAN_PLAYING.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
