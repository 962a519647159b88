"""What an expert might listen for in a phrase of four bars, as numbers.

Domain features, none of which knows the model: density by place and instrument, syncopation, how bars repeat each
other, chords and their order, what hands would have to do, dynamics by place, and timing as a process.
"""

from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from station.practice.battle.improvising.played_beats import Beats, Instrument

Floats = NDArray[np.float64]
GRID = 24
_GROUPS: dict[str, tuple[Instrument, ...]] = {
    "kick": (Instrument.KICK,),
    "snare": (Instrument.SNARE,),
    "time": (Instrument.CLOSED_HIHAT, Instrument.OPEN_HIHAT, Instrument.RIDE),
    "open": (Instrument.OPEN_HIHAT,),
    "toms": (Instrument.HIGH_TOM, Instrument.MID_TOM, Instrument.FLOOR_TOM),
    "crash": (Instrument.CRASH,),
}
_PLACES: dict[str, tuple[int, ...]] = {
    "beat": (0,),
    "half": (12,),
    "quarters": (6, 18),
    "thirds": (8, 16),
    "fine": (3, 4, 9, 15, 20, 21),
}
_HANDS = tuple(i for i in Instrument if i is not Instrument.KICK)
_WEIGHT = {0: 0.0, 12: -1.0, 6: -2.0, 18: -2.0, 8: -2.0, 16: -1.5}
"""Depth of a place in the beat; the finest have -3 (Longuet-Higgins & Lee 1984, triplets in between)."""


def phrase_features(beats: Beats, with_playing: bool) -> dict[str, float]:
    """All features of a phrase by name; those of velocity and timing only `with_playing`."""
    grid = _on_grid(beats, beats.struck.astype(np.float64))
    found = _densities(grid) | _syncopation(grid) | _repetition(grid, beats.bars) | _chords(beats) | _cut(beats)
    if with_playing:
        velocity, late = (_on_grid(beats, v.astype(np.float64)) for v in (beats.velocity, beats.late_ms))
        found |= _dynamics(grid, velocity, beats.bars) | _timing(grid, late, velocity, beats.bars)
        found["ornaments"] = float((beats.ornament > 0).sum())
    return {name: float(np.nan_to_num(value)) for name, value in found.items()}


def _on_grid(beats: Beats, values: Floats) -> Floats:
    """The values by time and instrument (n * 24, 9)."""
    grid = np.zeros((len(beats) * GRID, len(Instrument)))
    for beat, cell, instrument in np.argwhere(beats.struck).tolist():
        at = beat * GRID + cell * GRID // int(beats.division[beat])
        grid[at, instrument] = values[beat, cell, instrument]
    return grid


def _group(grid: Floats, name: str) -> Floats:
    return grid[:, [int(i) for i in _GROUPS[name]]].max(axis=1)


def _densities(grid: Floats) -> dict[str, float]:
    beats = len(grid) // GRID
    found = {}
    for name in _GROUPS:
        by_place = _group(grid, name).reshape(beats, GRID)
        for place, cells in _PLACES.items():
            found[f"{name} at {place}"] = by_place[:, list(cells)].sum() / beats
        by_beat = by_place.sum(axis=1).reshape(-1, 4) if beats % 4 == 0 else by_place.sum(axis=1)[None]
        found[f"{name} spread over beats"] = by_beat.mean(axis=0).std()
        found[f"{name} last bar"] = by_beat[-1].sum() - by_beat[:-1].sum(axis=1).mean()
        found[f"{name} spread over bars"] = by_beat.sum(axis=1).std()
    found["crash at the start"] = grid[0, Instrument.CRASH]
    found["backbeat"] = _group(grid, "snare").reshape(-1, GRID)[:, 0].reshape(-1, 4)[:, [1, 3]].mean()
    found["snare on one and three"] = _group(grid, "snare").reshape(-1, GRID)[:, 0].reshape(-1, 4)[:, [0, 2]].mean()
    found["kick on one"] = _group(grid, "kick").reshape(-1, 4 * GRID)[:, 0].mean()
    return found


def _syncopation(grid: Floats) -> dict[str, float]:
    """Strokes that no later stroke on a stronger place answers before that place has gone by, weighted by the jump."""
    found = {}
    depth = np.array([_WEIGHT.get(at % GRID, -3.0) for at in range(len(grid))])
    for name in ("kick", "snare", "toms"):
        struck = np.nonzero(_group(grid, name) > 0)[0]
        total = 0.0
        for at, after in pairwise([*struck.tolist(), len(grid)]):
            rest = depth[at + 1 : after]
            total += max(0.0, float(rest.max() - depth[at])) if len(rest) else 0.0
        found[f"{name} syncopation"] = total / (len(grid) // GRID)
    return found


def _repetition(grid: Floats, bars: int) -> dict[str, float]:
    """How alike pairs of bars are, by group: the share of strokes that both have (Jaccard)."""
    found = {}
    for name in ("kick", "snare", "time"):
        rows = _group(grid, name).reshape(bars, -1) > 0
        alike = {
            pair: (rows[list(pair)].all(axis=0).sum() + 1) / (rows[list(pair)].any(axis=0).sum() + 1)
            for pair in combinations(range(bars), 2)
        }
        for gap in (1, 2):
            values = [value for (a, b), value in alike.items() if b - a == gap]
            found[f"{name} alike {gap} bars apart"] = float(np.mean(values))
        found[f"{name} most alike"] = max(alike.values())
        found[f"{name} least alike"] = min(alike.values())
        half = rows.reshape(bars * 2, -1)
        found[f"{name} halves alike"] = float(
            np.mean([(a == b).mean() for a, b in zip(half[::2], half[1::2], strict=True)])
        )
        beats = rows.reshape(bars * 4, -1) if rows.shape[1] % 4 == 0 else rows
        found[f"{name} different beats"] = len({beat.tobytes() for beat in beats}) / len(beats)
    return found


def _chords(beats: Beats) -> dict[str, float]:
    """Which chords there are, in what order, and what hands would need."""
    beat, cell = np.nonzero(np.arange(8) < beats.division[:, None])
    struck = beats.struck[beat, cell]
    chords = (struck * (1 << np.arange(9))).sum(axis=1)
    sounding = chords[chords > 0]
    hands = struck[:, [int(i) for i in _HANDS]].sum(axis=1)
    pairs = list(zip(chords[:-1].tolist(), chords[1:].tolist(), strict=True))
    snare, kick = struck[:, Instrument.SNARE], struck[:, Instrument.KICK]
    time = struck[:, [int(i) for i in _GROUPS["time"]]].any(axis=1)
    toms = struck[:, [int(i) for i in _GROUPS["toms"]]].any(axis=1)
    return {
        "strokes": struck.sum() / len(beats),
        "silent steps": (chords == 0).mean(),
        "chords": len(set(sounding.tolist())),
        "entropy of chords": _entropy(chords.tolist()),
        "entropy of the next chord": _entropy(pairs) - _entropy(chords[:-1].tolist()),
        "chords once": sum(1 for c in set(sounding.tolist()) if (sounding == c).sum() == 1),
        "three hands": (hands > 2).mean(),
        "two hands": (hands == 2).mean(),
        "kick with snare": (kick & snare).sum() / max(snare.sum(), 1),
        "kick with time": (kick & time).sum() / max(kick.sum(), 1),
        "snare with time": (snare & time).sum() / max(snare.sum(), 1),
        "two cymbals": (struck[:, [2, 3]].any(axis=1) & struck[:, [7, 8]].any(axis=1)).mean(),
        "ride and hi-hat": (struck[:, 8] & struck[:, [2, 3]].any(axis=1)).mean(),
        "ride to hi-hat": float(min(struck[:, 8].sum(), struck[:, [2, 3]].sum())) / max(struck[:, [2, 3, 8]].sum(), 1),
        "kick after kick": (kick[1:] & kick[:-1]).mean(),
        "snare after snare": (snare[1:] & snare[:-1]).mean(),
        "tom after tom": (toms[1:] & toms[:-1]).sum() / max(toms.sum(), 1),
        "toms descend": float(np.diff(struck[:, 4:7].argmax(axis=1)[toms]).mean()) if toms.sum() > 1 else 0.0,
        "longest silence": _longest(chords == 0),
        "longest alike": _longest(chords[1:] == chords[:-1]),
    }


def _entropy(symbols: list[object]) -> float:
    _, counts = np.unique([str(s) for s in symbols], return_counts=True)
    share = counts / counts.sum()
    return float(-(share * np.log2(share)).sum())


def _longest(flags: NDArray[np.bool_]) -> float:
    best = run = 0
    for flag in flags.tolist():
        run = run + 1 if flag else 0
        best = max(best, run)
    return float(best)


def _cut(beats: Beats) -> dict[str, float]:
    changes = (beats.division[1:] != beats.division[:-1]).mean()
    return {"changes of division": changes} | {f"beats of {d}": (beats.division == d).mean() for d in (3, 4, 6, 8)}


def _dynamics(grid: Floats, velocity: Floats, bars: int) -> dict[str, float]:
    found = {}
    place = np.arange(len(grid)) % GRID
    for name in ("kick", "snare", "time", "toms"):
        loud = _group(velocity, name)
        is_on = loud > 0
        values = loud[is_on]
        if len(values) < 2:
            values = np.array([0.0, 0.0])
        found[f"{name} velocity"] = values.mean()
        found[f"{name} velocity spread"] = values.std()
        found[f"{name} velocity lag 1"] = _correlation(values[1:], values[:-1])
        beat, off = loud[is_on & (place == 0)], loud[is_on & (place != 0)]
        found[f"{name} louder on the beat"] = beat.mean() - off.mean() if len(beat) and len(off) else 0.0
        rows = loud.reshape(bars, -1)
        both = (rows[1:] > 0) & (rows[:-1] > 0)
        found[f"{name} velocity by bars"] = _correlation(rows[1:][both], rows[:-1][both])
        found[f"{name} velocity change by bars"] = (
            float(np.abs(rows[1:][both] - rows[:-1][both]).mean()) if both.any() else 0
        )
    snare = velocity[:, Instrument.SNARE]
    snare = snare[snare > 0]
    found["ghosts"] = float((snare < 45).mean()) if len(snare) else 0.0
    found["accents"] = float((snare > 105).mean()) if len(snare) else 0.0
    found["at most"] = float((velocity[velocity > 0] >= 126).mean()) if (velocity > 0).any() else 0.0
    two = _group(velocity, "kick"), _group(velocity, "time")
    both = (two[0] > 0) & (two[1] > 0)
    found["kick and time velocity"] = _correlation(two[0][both], two[1][both])
    return found


def _timing(grid: Floats, late: Floats, velocity: Floats, bars: int) -> dict[str, float]:
    struck = grid > 0
    all_late = late[struck]
    centre = all_late.mean() if len(all_late) else 0.0
    by_step = np.array([row[on].mean() - centre for row, on in zip(late, struck, strict=True) if on.any()])
    within = [row[on].std() for row, on in zip(late, struck, strict=True) if on.sum() > 1]
    found = {
        "lean": centre,
        "timing spread": all_late.std(),
        "timing lag 1": _correlation(by_step[1:], by_step[:-1]),
        "timing lag 2": _correlation(by_step[2:], by_step[:-2]),
        "timing between hands": float(np.mean(within)) if within else 0.0,
        "timing tails": float(np.mean(np.abs(by_step) > 2 * by_step.std())) if len(by_step) else 0.0,
        "timing and velocity": _correlation(all_late, velocity[struck]),
    }
    for name in ("kick", "snare", "time"):
        on = struck[:, [int(i) for i in _GROUPS[name]]]
        own = late[:, [int(i) for i in _GROUPS[name]]]
        found[f"{name} lean"] = own[on].mean() - centre if on.any() else 0.0
        found[f"{name} timing spread"] = own[on].std() if on.any() else 0.0
    place = np.arange(len(grid)) % GRID
    for name, cells in _PLACES.items():
        chosen = struck & np.isin(place, cells)[:, None]
        found[f"lean at {name}"] = late[chosen].mean() - centre if chosen.any() else 0.0
    rows, on = late.reshape(bars, -1), struck.reshape(bars, -1)
    both = on[1:] & on[:-1]
    found["timing by bars"] = _correlation(rows[1:][both], rows[:-1][both])
    return found


def _correlation(a: Floats, b: Floats) -> float:
    if len(a) < 3 or a.std() < 1e-9 or b.std() < 1e-9:
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])
