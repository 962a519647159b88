"""The music of the journeys: what people play from, about a minute each. Seeded.

Three families: shipped lessons, played round and round; phrases of bars that repeat (AAAB, AABA) in grooves as any
method book prints them; and takes of the Groove MIDI Dataset, quantised bar by bar into a written score.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb, Piece
from station.core.units import NS_PER_S, PPQ
from station.drills.library import find_lesson, lesson_names
from station.music.formats.smf.standard_midi import read_midi, score_from_midi
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import TempoMap

GMD = Path(__file__).resolve().parents[4] / "tests/data/gmd"
"""The takes of the Groove MIDI Dataset that lie in a checkout; elsewhere that family is left out."""
LONG_S = 45.0
"""A piece lasts so long at its written tempo, at least: half of it still holds a start, a skip and a repeat."""
_LONGEST_S = 80.0
"""Takes of the dataset are cut here, or a quick look would be about three of them."""
_SHORTEST_S = 27.0
"""The shortest take of the dataset that is music rather than a single fill."""

_OFF_GRID_S, _MOST_OFF_GRID = 0.05, 0.05
"""A stroke further from its slot than the drummer leans was meant for none that is written (HUMANS: SD 26-28 ms); where
there are more such strokes, the page is not what was played, and the drummer's own timing proves nothing."""

_PIECES = MappingProxyType(
    {
        "hh": Piece.HIHAT,
        "rd": Piece.RIDE,
        "sn": Piece.SNARE,
        "ki": Piece.KICK,
        "ft": Piece.HIHAT_PEDAL,
        "cr": Piece.CRASH_1,
        "t1": Piece.TOM_1,
        "t2": Piece.TOM_2,
        "fl": Piece.FLOOR_TOM_1,
    }
)
_ALSO = MappingProxyType({Piece.CRASH_2: Piece.CRASH_1, Piece.RIDE_2: Piece.RIDE})
"""A second crash or ride is the first one's twin for whoever listens."""

Bar = Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Style:
    """Bars A (the groove), B (its fill) and C (its variation), their meter, and the tempi in quarters a minute."""

    beats: int
    unit: int
    tempi: tuple[int, int]
    bars: Mapping[str, Bar]


STYLES: Mapping[str, Style] = MappingProxyType(
    {
        "rock": Style(
            4,
            4,
            (80, 130),
            {
                "A": {"hh": "x.x.x.x.x.x.x.x.", "sn": "....o.......o...", "ki": "o.......o......."},
                "C": {"hh": "x.x.x.x.x.x.x.x.", "sn": "....o.......o...", "ki": "o.......o.o....."},
                "B": {
                    "hh": "x.x.x.x.........",
                    "sn": "....o...oooo....",
                    "t1": "............oo..",
                    "fl": "..............oo",
                    "ki": "o.......o...o...",
                },
            },
        ),
        "shuffle": Style(
            4,
            4,
            (84, 132),
            {
                "A": {"hh": "x.xx.xx.xx.x", "sn": "...o.....o..", "ki": "o.....o....."},
                "C": {"hh": "x.xx.xx.xx.x", "sn": "...o.....o..", "ki": "o....oo....."},
                "B": {"hh": "x.xx.x......", "sn": "...o..ooo...", "t1": ".........oo.", "ki": "o.....o....o"},
            },
        ),
        "funk": Style(
            4,
            4,
            (84, 112),
            {
                "A": {"hh": "xxxxxxxxxxxxxxxx", "sn": "....o..o.o..o..o", "ki": "o..o..o...o....."},
                "C": {"hh": "xxxxxxxxxxxxxxxx", "sn": "....o..o.o..o..o", "ki": "o.o.....o.o..o.."},
                "B": {
                    "hh": "xxxxxxxx........",
                    "sn": "....o..o.oo.o.oo",
                    "t1": "........o..o.o..",
                    "ki": "o..o..o.....o...",
                },
            },
        ),
        "jazz": Style(
            4,
            4,
            (110, 180),
            {
                "A": {"rd": "x..x.xx..x.x", "ft": "...x.....x..", "sn": "............"},
                "C": {"rd": "x..x.xx..x.x", "ft": "...x.....x..", "sn": "..o.....o..."},
                "B": {"rd": "x..x.x......", "ft": "...x.....x..", "sn": "......ooo..o", "ki": "..o......oo."},
            },
        ),
        "six_eight": Style(
            6,
            8,
            (60, 96),
            {
                "A": {"hh": "x.x.x.x.x.x.", "sn": "......o.....", "ki": "o..........."},
                "C": {"hh": "x.x.x.x.x.x.", "sn": "......o.....", "ki": "o...o.....o."},
                "B": {"hh": "x.x.x.......", "sn": "......oooo..", "fl": "..........oo", "ki": "o.....o....."},
            },
        ),
        "one_drop": Style(
            4,
            4,
            (66, 84),
            {
                "A": {"hh": "x.x.x.x.x.x.x.x.", "sn": "........o.......", "ki": "........o......."},
                "C": {"hh": "x.x.x.xxx.x.x.x.", "sn": "...o....o....o..", "ki": "........o......."},
                "B": {
                    "hh": "x.x.x.x.........",
                    "sn": "........o.oo....",
                    "t1": "............o.oo",
                    "ki": "........o.......",
                },
            },
        ),
    }
)
"""Grooves as method books print them; a character is a sixteenth, or in twelves a triplet eighth (a 16th in 6/8)."""
FORMS = ("AAAB", "AABA", "AAACAAAB", "ACACACAB")
"""How bars make phrases: the same bar thrice and a fill, and its kin."""


@dataclass(frozen=True, eq=False)
class Music:
    """A score, and where a drummer played it their own played − written of each note in s (n,), else None."""

    name: str
    score: Score
    own_s: NDArray[np.float64] | None = None

    @classmethod
    def long(cls, name: str, score: Score, own_s: NDArray[np.float64] | None = None) -> "Music":
        """The score as often as makes it `LONG_S` long."""
        times = max(1, int(np.ceil(LONG_S * NS_PER_S / score.length_ns)))
        return cls(name, score.repeated(times), None if own_s is None else np.tile(own_s, times))


def music(family: str, seed: Sequence[int]) -> Music:
    """Something of `family` ("lesson", "phrase" or "gmd"), at least `LONG_S` long."""
    rng = np.random.default_rng([_FAMILIES.index(family), *seed])
    if family == "lesson":
        name = str(rng.choice(lesson_names()))
        return Music.long(name, _plain(find_lesson(name).score))
    if family == "gmd":
        path = gmd_takes()[int(rng.integers(len(gmd_takes())))]
        return Music.long(f"{path.parent.parent.name}/{path.stem}", *quantised(path))
    style, form = str(rng.choice(list(STYLES))), str(rng.choice(FORMS))
    return Music.long(f"{style} {form}", phrase(style, form, int(rng.integers(*STYLES[style].tempi))))


_FAMILIES = ("lesson", "phrase", "gmd")


def families() -> tuple[str, ...]:
    """The families that there are here."""
    return _FAMILIES if gmd_takes() else _FAMILIES[:2]


def phrase(style: str, form: str, tempo_bpm: float) -> Score:
    """One phrase: the bars of `style` in the order of `form`."""
    like = STYLES[style]
    bar_ticks = like.beats * 4 * PPQ // like.unit
    strokes = [
        (bar * bar_ticks + step * bar_ticks // len(line), _PIECES[voice])
        for bar, letter in enumerate(form)
        for voice, line in like.bars[letter].items()
        for step, sign in enumerate(line)
        if sign != "."
    ]
    table = _rows(np.array(strokes, np.int64))
    return Score.from_array(
        table, TempoMap.constant(tempo_bpm, like.beats, like.unit), bar_ticks * len(form), f"{style} {form}"
    )


def _rows(strokes: NDArray[np.int64]) -> NDArray[np.void]:
    """Plain rows of ticks and pieces (k, 2)."""
    table = np.zeros(len(strokes), NOTE_DTYPE)
    table["tick"], table["piece"] = strokes.T
    table["velocity"], table["dynamic"], table["limb"], table["openness"] = 80, 1, Limb.UNKNOWN, np.nan
    return table


def _plain(score: Score) -> Score:
    """The same score with a piece's twin written as the piece."""
    rows = score.notes.copy()
    for piece, twin in _ALSO.items():
        rows["piece"][rows["piece"] == piece] = twin
    return Score.from_array(rows, score.tempo_map, score.end_tick, score.title)


@cache
def gmd_takes() -> tuple[Path, ...]:
    """The takes of the dataset that are long enough; empty where it is not there."""
    paths = sorted(GMD.rglob("*.mid")) if GMD.is_dir() else []
    return tuple(path for path in paths if score_from_midi(read_midi(path)).length_ns >= _SHORTEST_S * NS_PER_S)


@cache
def quantised(path: Path) -> tuple[Score, NDArray[np.float64] | None]:
    """A take as it would be written, and by how many s each note was played late (n,), None where that fits badly.

    Every beat stands on sixteenths, or on triplets where they fit its strokes better.
    """
    score = _plain(score_from_midi(read_midi(path)))
    longest = int(score.tempo_map.ticks_at_ns(int(_LONGEST_S * NS_PER_S)))
    end = min(score.end_tick, score.tempo_map.bar_start(int(score.tempo_map.bars_at(longest))))
    written = written_ticks(score.notes["tick"])
    inside = np.flatnonzero((written < end) & (score.notes["velocity"] > 0))
    keys = written[inside] * len(Piece) + score.notes["piece"][inside]
    once = inside[np.unique(keys, return_index=True)[1]]
    rows = score.notes[once].copy()
    rows["tick"] = written[once]
    late_s = score.onset_s[once] - score.tempo_map.seconds_at(written[once])
    lean_s = np.median(late_s)
    near = np.clip(late_s, lean_s - _OFF_GRID_S, lean_s + _OFF_GRID_S)
    fits = (near != late_s).mean() <= _MOST_OFF_GRID
    return Score.from_array(rows, score.tempo_map, end, path.stem), near if fits else None


def written_ticks(ticks: NDArray[np.int64]) -> NDArray[np.int64]:
    """The grid places of played ticks (n,): by beat whichever of sixteenths and triplet eighths lies nearer in all."""
    sixteenths, triplets = (np.rint(ticks / step).astype(np.int64) * step for step in (PPQ // 4, PPQ // 3))
    beat = (ticks + PPQ // 8) // PPQ
    off = [np.bincount(beat, (ticks - grid).astype(np.float64) ** 2) for grid in (sixteenths, triplets)]
    return np.where((off[0] <= off[1])[beat], sixteenths, triplets)
