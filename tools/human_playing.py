"""How drummers time and weight their strokes, by instrument and place: writes `data/human_playing.json`.

    python -m tools.human_playing [--data ../shared/data/gmd]

Measured on the files of the Groove MIDI Dataset that are there (Gillick et al. 2019, CC BY 4.0), read as beats. Timing:
four bars at a time, their median set apart; of the normal scores of what is left, how much strokes of one moment have
in common (the clock), and strokes of neighbouring moments (its AR(1)). Loudness: the deciles of the velocities by
instrument and place, and of their normal scores how much is the take's, how much the take's own way with that
instrument and place, and how much of the rest a stroke has from the one before it on the same instrument.
"""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm, rankdata

from station.core.pieces import Ornament, word
from station.music.score import MAX_LATE_MS
from station.practice.battle.improvising.human_playing import HUMAN_PLAYING, QUANTILES
from station.practice.battle.improvising.played_beats import Beats, Instrument
from station.practice.battle.improvising.stroke_place import StrokePlace, moments_of, places_of, struck_cells
from tools.battle_training.takes import GrooveTake, groove_takes

Floats = NDArray[np.float64]
ENOUGH = 25
"""Fewer strokes of an instrument at a place are measured with those at all its places."""
LEAST_STROKES = 60
"""Takes with fewer tell nothing of a spread."""
WINDOW_BARS = 4
"""Within so many bars a clock's course is measured: as long as a phrase."""
DECILES = np.linspace(0, 1, 11)
SOURCE = "Groove MIDI Dataset v1.0.0, Gillick et al. 2019, CC BY 4.0"


def table(takes: Sequence[GrooveTake]) -> dict[str, object]:
    """The whole document."""
    beats = [take.beats for take in takes]
    return {
        "source": SOURCE,
        "made_by": "python -m tools.human_playing",
        "takes": len(beats),
        "strokes": sum(int(one.struck.sum()) for one in beats),
        "timing": timing(beats),
        "loudness": loudness(beats),
        "ornaments": ornaments(beats),
    }


# --- timing -----------------------------------------------------------------------------------------------------------


def timing(takes: Sequence[Beats]) -> dict[str, object]:
    """Quantiles of lateness in ms about a phrase's lean, how strokes go together, the places' own medians."""
    windows = [one for take in takes for one in _windows(take) if one.struck.sum() >= LEAST_STROKES // 2]
    struck = [struck_cells(window) for window in windows]
    leans = [float(np.median(_late(window))) for window in windows]
    late = np.concatenate([_late(window) - lean for window, lean in zip(windows, leans, strict=True)])
    place = np.concatenate([places_of(window, cells) for window, cells in zip(windows, struck, strict=True)])
    instrument = np.concatenate(struck)[:, 2]
    moment = np.concatenate(
        [moments_of(w, cells) + 10_000 * at for at, (w, cells) in enumerate(zip(windows, struck, strict=True))]
    )
    late = np.clip(late, -MAX_LATE_MS, MAX_LATE_MS)  # what is later belongs to another cell
    score = norm.ppf((rankdata(late) - 0.5) / len(late))
    return {
        "quantiles_ms": [round(float(ms), 1) for ms in np.quantile(late, QUANTILES)],
        "together": round(_correlation(score, moment, 0), 2),
        "from_last": round(_correlation(score, moment, 1), 2),
        "lean_sd_ms": round(float(np.std(leans)), 1),
        "place_ms": {p.name.lower(): round(float(np.median(late[place == p])), 1) for p in StrokePlace},
        "instrument_ms": {one.name.lower(): round(float(np.median(late[instrument == one])), 1) for one in Instrument},
    }


def _correlation(score: Floats, moment: NDArray[np.int64], apart: int) -> float:
    """Of normal scores of strokes that are so many moments apart."""
    pairs = [
        (i, j)
        for i in range(len(score))
        for j in range(i + 1, min(i + 9, len(score)))
        if moment[j] - moment[i] == apart
    ]
    before, after = np.array(pairs).T
    return float(np.corrcoef(score[before], score[after])[0, 1])


def _windows(take: Beats) -> list[Beats]:
    return [take.of_bars(bar, bar + WINDOW_BARS) for bar in range(0, take.bars - WINDOW_BARS + 1, WINDOW_BARS)]


def _late(beats: Beats) -> Floats:
    return beats.late_ms[beats.struck].astype(np.float64)


# --- loudness ---------------------------------------------------------------------------------------------------------


def loudness(takes: Sequence[Beats]) -> dict[str, object]:
    """Deciles of velocity by instrument and place, and where the variance of their normal scores comes from."""
    strokes = np.concatenate([_strokes(at, take) for at, take in enumerate(takes)])
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


def _strokes(at: int, take: Beats) -> NDArray[np.int64]:
    """Take, instrument, place, velocity of each stroke (n, 4)."""
    struck = struck_cells(take)
    velocity = take.velocity[take.struck].astype(np.int64)
    return np.column_stack([np.full(len(struck), at), struck[:, 2], places_of(take, struck), velocity])


def _deciles(strokes: NDArray[np.int64], instrument: Instrument, place: StrokePlace) -> list[int]:
    own = strokes[strokes[:, 1] == instrument]
    here = own[own[:, 2] == place]
    found = np.quantile((here if len(here) >= ENOUGH else own)[:, 3], DECILES)
    return [int(v) for v in np.rint(found)]


def _shares(strokes: NDArray[np.int64], score: Floats) -> dict[str, float]:
    """Shares of the variance: of the take, of its way with an instrument and place; what a stroke has of the last."""
    take = strokes[:, 0]
    cell = (take * 16 + strokes[:, 1]) * 16 + strokes[:, 2]
    take_mean, way_mean = _means(take, score), _means(cell, score)
    rest = score - way_mean
    order = np.lexsort((np.arange(len(take)), strokes[:, 1], take))  # the strokes of one instrument of a take, in turn
    same = (take[order][1:] == take[order][:-1]) & (strokes[order, 1][1:] == strokes[order, 1][:-1])
    before, after = rest[order][:-1][same], rest[order][1:][same]
    return {
        "of_take": round(float(take_mean.var() / score.var()), 2),
        "of_way": round(float((way_mean - take_mean).var() / score.var()), 2),
        "of_last": round(float(np.corrcoef(before, after)[0, 1]), 2),
    }


def _means(group: NDArray[np.int64], score: Floats) -> Floats:
    """Each stroke's group's mean (n,)."""
    inverse = np.unique(group, return_inverse=True)[1]
    means: Floats = (np.bincount(inverse, score) / np.bincount(inverse))[inverse]
    return means


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
