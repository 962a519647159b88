"""Human four-bar phrases of the Groove MIDI Dataset, and versions of them that a judge should like less.

It shares no definition with the judge: a stroke's cell is the nearest 1/16 or 1/24 (at fast tempi 1/12) of a whole note
on the click, much as in `gmd_cross`, whatever the judge takes it for. Groove MIDI Dataset v1.0.0, CC BY 4.0 (Gillick et
al. 2019).

| version | what becomes of the phrase |
|---|---|
| shuffled | the strokes' cells change places within the phrase; how strong and how late each is stays with it |
| beats | the phrase's beats change places, each as it was played |
| bar's beats | the beats of each bar change places within it |
| randomised | as many strokes on random cells, its pieces, velocities 20–127, late by a human spread |
| scattered | the same at any time at all |
| flat | every stroke on its cell at one velocity |
| repeated | one of the bars four times |
| glued | a bar of its own and three of three other takes of its meter and tempo class, by other drummers if there are |

Every version keeps the strokes on the next downbeat. Where two strokes of one piece meet, the kit would sound both.
"""

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.formats.smf.standard_midi import performance_from_midi, read_midi
from station.music.performance import Performance
from station.practice.battle.ground import Ground
from station.practice.battle.phrase import Turn

Rows = NDArray[np.void]
Rng = np.random.Generator

BARS = 4
_SIXTEENTH, _SEXTUPLET, _TRIPLET = PPQ // 4, PPQ // 6, PPQ // 3
_FAST_BPM = 150.0
"""From here on nobody plays sextuplets, and a sextuplet is as short as a drummer's lean."""
_HUMAN_SD_MS = 20.0
_FLAT = 90
_CLASS_BPM = (90.0, 110.0, 130.0)
"""Tempo classes: under 90, to 110, to 130 and beyond, so that bars are stretched by little."""
_NAME = re.compile(r"_(\d+)_(beat|fill)_(\d+)-(\d+)\.mid$")


@dataclass(frozen=True, eq=False)
class HumanPhrase:
    """Four bars of a take; `turn` holds the next downbeat too. `bar` is where in the take they begin."""

    drummer: str
    take: str
    bar: int
    turn: Turn


def human_phrases(folder: Path) -> list[HumanPhrase]:
    """Every four bars, none twice, of every take that has as many."""
    return [phrase for path in sorted(folder.rglob("*.mid")) for phrase in _of_take(path, folder)]


def _of_take(path: Path, folder: Path) -> list[HumanPhrase]:
    ground, take = ground_of(path), str(path.relative_to(folder))
    hits = performance_from_midi(read_midi(path)).hits
    bar_ns = ground.ns_of_bars(1)
    bars = round((int(hits["at_ns"].max()) + bar_ns // 8) / bar_ns + 0.5 - 1e-9)
    starts = range(0, bars - BARS + 1, BARS)
    return [HumanPhrase(take.split("/", maxsplit=1)[0], take, bar, _cut(hits, ground, bar)) for bar in starts]


def ground_of(path: Path) -> Ground:
    """Tempo and meter by the file's name."""
    named = _NAME.search(path.name)
    assert named is not None
    return Ground(float(named[1]), int(named[3]), int(named[4]))


def _cut(hits: Rows, ground: Ground, bar: int) -> Turn:
    """Four bars by the strokes' cells, and half a beat behind them."""
    cells, start = _ticks(ground, hits), bar * ground.bar_ticks
    rows = hits[(cells >= start) & (cells < start + BARS * ground.bar_ticks + ground.beat_ticks // 2)].copy()
    rows["at_ns"] -= ground.ns_of_bars(bar)
    return Turn(ground, BARS, Performance.from_array(rows))


# --- versions ---------------------------------------------------------------------------------------------------------


def _ticks(ground: Ground, rows: Rows) -> NDArray[np.int64]:
    """The cell of each stroke in ticks: the nearer of both grids'."""
    ticks = ground.tempo_map.ticks_at_ns(rows["at_ns"])
    steps = (_SIXTEENTH, _SEXTUPLET if ground.tempo_bpm < _FAST_BPM else _TRIPLET)
    near = [np.rint(ticks / step).astype(np.int64) * step for step in steps]
    return np.where(np.abs(ticks - near[0]) <= np.abs(ticks - near[1]), *near)


def _inside(turn: Turn) -> tuple[Rows, Rows]:
    """The phrase's own strokes, and those of the next downbeat, which every version keeps."""
    rows = turn.played.hits
    own = _ticks(turn.ground, rows) < turn.bars * turn.ground.bar_ticks
    return rows[own].copy(), rows[~own]


def _made(turn: Turn, own: Rows, landing: Rows) -> Turn:
    return Turn(turn.ground, turn.bars, Performance.from_array(np.concatenate([own, landing])))


def _ns(turn: Turn, ticks: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.asarray(turn.ground.tempo_map.ns_at(ticks), np.int64)


def shuffled(phrase: HumanPhrase, rng: Rng) -> Turn:
    """The strokes' cells change places."""
    turn = phrase.turn
    own, landing = _inside(turn)
    cells = _ticks(turn.ground, own)
    late = own["at_ns"] - _ns(turn, cells)
    own["at_ns"] = _ns(turn, rng.permutation(cells)) + late
    return _made(turn, own, landing)


def beats_shuffled(phrase: HumanPhrase, rng: Rng) -> Turn:
    """The beats change places."""
    return _beats_moved(phrase.turn, rng.permutation(phrase.turn.bars * phrase.turn.ground.beats_a_bar))


def bars_beats_shuffled(phrase: HumanPhrase, rng: Rng) -> Turn:
    """The beats of each bar change places within it."""
    bar = phrase.turn.ground.beats_a_bar
    return _beats_moved(phrase.turn, np.concatenate([k * bar + rng.permutation(bar) for k in range(BARS)]))


def _beats_moved(turn: Turn, to: NDArray[np.int64]) -> Turn:
    """Each beat goes where `to` (beats,) says."""
    own, landing = _inside(turn)
    cells, beat = _ticks(turn.ground, own), turn.ground.beat_ticks
    place = np.clip(cells // beat, 0, len(to) - 1)
    own["at_ns"] += _ns(turn, cells + (to[place] - place) * beat) - _ns(turn, cells)
    return _made(turn, own, landing)


def randomised(phrase: HumanPhrase, rng: Rng) -> Turn:
    """As many strokes on cells of 1/16."""
    turn = phrase.turn
    own, landing = _inside(turn)
    cells = rng.integers(0, turn.bars * turn.ground.bar_ticks // _SIXTEENTH, len(own)) * _SIXTEENTH
    late = rng.normal(0.0, _HUMAN_SD_MS * 1e6, len(own)).astype(np.int64)
    return _made(turn, _drawn(own, _ns(turn, cells) + late, rng), landing)


def scattered(phrase: HumanPhrase, rng: Rng) -> Turn:
    """As many strokes at any time."""
    turn = phrase.turn
    own, landing = _inside(turn)
    return _made(turn, _drawn(own, rng.integers(0, turn.length_ns, len(own)), rng), landing)


def _drawn(own: Rows, at_ns: NDArray[np.int64], rng: Rng) -> Rows:
    drawn = own[rng.integers(0, len(own), len(own))] if len(own) else own.copy()
    drawn["at_ns"], drawn["velocity"] = at_ns, rng.integers(20, 128, len(own))
    return drawn


def flat(phrase: HumanPhrase, rng: Rng) -> Turn:
    """On the grid at one velocity."""
    turn = phrase.turn
    rows = turn.played.hits.copy()
    rows["at_ns"], rows["velocity"] = _ns(turn, _ticks(turn.ground, rows)), _FLAT
    return Turn(turn.ground, turn.bars, Performance.from_array(rows))


def repeated(phrase: HumanPhrase, rng: Rng) -> Turn:
    """One bar four times."""
    turn = phrase.turn
    own, landing = _inside(turn)
    bar = _bar(turn, own, int(rng.integers(turn.bars)))
    return _made(turn, np.concatenate([_moved(bar, k * turn.ground.ns_of_bars(1)) for k in range(turn.bars)]), landing)


def glued(phrase: HumanPhrase, others: Sequence[HumanPhrase], rng: Rng) -> Turn:
    """A bar of the phrase's own, and of each other phrase one, stretched to its tempo."""
    turn = phrase.turn
    landing = _inside(turn)[1]
    keep = int(rng.integers(turn.bars))
    bars, queue = [], iter(others)
    for place in range(turn.bars):
        source = phrase if place == keep else next(queue)
        rows = _inside(source.turn)[0]
        bar = _bar(source.turn, rows, keep if source is phrase else int(rng.integers(BARS)))
        stretch = turn.ground.ns_of_bars(1) / source.turn.ground.ns_of_bars(1)
        bar["at_ns"] = np.rint(bar["at_ns"] * stretch).astype(np.int64)
        bars.append(_moved(bar, place * turn.ground.ns_of_bars(1)))
    return _made(turn, np.concatenate(bars), landing)


def _bar(turn: Turn, rows: Rows, number: int) -> Rows:
    """The strokes of a bar, in time of its own downbeat."""
    bar = rows[_ticks(turn.ground, rows) // turn.ground.bar_ticks == number]
    return _moved(bar, -turn.ground.ns_of_bars(number))


def _moved(rows: Rows, by_ns: int) -> Rows:
    moved = rows.copy()
    moved["at_ns"] += by_ns
    return moved


def partners(phrase: HumanPhrase, phrases: Sequence[HumanPhrase], rng: Rng) -> list[HumanPhrase] | None:
    """Three phrases of three other takes, of its meter and tempo class, by drummers as different as there are."""
    ground = phrase.turn.ground
    fit = [p for p in phrases if p.take != phrase.take and _class(p.turn.ground) == _class(ground)]
    chosen: list[HumanPhrase] = []
    for other in (fit[i] for i in rng.permutation(len(fit))):
        if other.drummer not in {phrase.drummer, *(c.drummer for c in chosen)}:
            chosen.append(other)
    for other in (fit[i] for i in rng.permutation(len(fit))):
        if len(chosen) < BARS - 1 and other.take not in {c.take for c in chosen}:
            chosen.append(other)
    return chosen[: BARS - 1] if len(chosen) >= BARS - 1 else None


def _class(ground: Ground) -> tuple[int, int, int]:
    return int(np.searchsorted(_CLASS_BPM, ground.tempo_bpm)), ground.beats, ground.unit


VERSIONS: Mapping[str, Callable[[HumanPhrase, Rng], Turn]] = {
    "shuffled": shuffled,
    "beats": beats_shuffled,
    "bar's beats": bars_beats_shuffled,
    "randomised": randomised,
    "scattered": scattered,
    "flat": flat,
    "repeated": repeated,
}
"""All but the glued one, which needs the other phrases."""


# --- how much of a phrase is changed ----------------------------------------------------------------------------------

_HEARD_DB = 3.0
"""A step in level that anybody hears (HUMANS: just noticeable 2–3 dB)."""


def changed_strokes(one: Turn, other: Turn, levels: bool = False) -> float:
    """Share of the strokes of both that the other has not: same piece, same cell, and with `levels` within 3 dB."""
    kept = total = 0
    a, b = _places(one), _places(other)
    for place in a.keys() | b.keys():
        mine, theirs = a.get(place, []), b.get(place, [])
        total += len(mine) + len(theirs)
        pairs = zip(sorted(mine), sorted(theirs), strict=False)
        kept += 2 * sum(not levels or abs(40 * np.log10(m / t)) <= _HEARD_DB for m, t in pairs)
    return 1.0 - kept / total if total else 0.0


def _places(turn: Turn) -> dict[tuple[int, int], list[int]]:
    own, _ = _inside(turn)
    places: dict[tuple[int, int], list[int]] = {}
    columns = (_ticks(turn.ground, own).tolist(), own["piece"].tolist(), own["velocity"].tolist())
    for tick, piece, velocity in zip(*columns, strict=True):
        places.setdefault((tick, piece), []).append(velocity)
    return places
