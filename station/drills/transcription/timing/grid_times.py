"""When each stroke of a take is meant: meter, beat, swing, and the cells that its beats are cut into.

`quantised_times` is the only door. Times and ticks are those of `Score`; leans are positive where strokes come late.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.drills.transcription.timing.beat_spans import BeatSpans, Ints, spans_of
from station.drills.transcription.timing.drift import steadied
from station.drills.transcription.timing.exact_grid import exact_meant
from station.drills.transcription.timing.meant import Meant, recut
from station.drills.transcription.timing.rhythm_words import MAX_WORDS, cells_of
from station.drills.transcription.timing.take_feel import Take, feel_of, take_of
from station.drills.transcription.timing.tempo_finder import at_heard_tempo
from station.drills.transcription.timing.triplet_swing import triplet_swing
from station.drills.transcription.timing.whole_bars import at_bar_starts
from station.music.score import Score
from station.music.swing import STRAIGHT, TRIPLETS, Swing
from station.music.tempo import TempoMap

STEADY_S = 0.010
"""A take with no wider spread, a professional's, keeps to the file's beat, and no drift is looked for (our choice)."""
_MS_PER_S = NS_PER_S // NS_PER_MS


@dataclass(frozen=True, slots=True)
class BeatCells:
    """The beat from `tick`, `length_ticks` long, is cut into `cells` equal cells."""

    tick: int
    length_ticks: int
    cells: int


@dataclass(frozen=True, slots=True, eq=False)
class GridTimes:
    """A score on the grid, and how it came there.

    `score` has the rows that were given, their ticks on cells, whole bars alone, `swing_ticks` where swing is written
    as a word; row `i` of it was row `origin[i]` (shape (n,)). `swing` is that of the whole piece. `beats` are the
    beats with strokes in order. `lean_ms` is how late the take is as a whole, and `spread_ms` the standard deviation
    about that; both 0 where the score was on the grid already.
    """

    score: Score
    origin: NDArray[np.int64]
    swing: Swing
    beats: tuple[BeatCells, ...]
    lean_ms: float = 0.0
    spread_ms: float = 0.0

    def bars(self, first: int, last: int) -> "GridTimes":
        """Bars `first` to `last` inclusive, outside which there is no stroke."""
        start = self.score.tempo_map.bar_start(first)
        beats = tuple(replace(beat, tick=beat.tick - start) for beat in self.beats)
        return replace(self, score=self.score.bars(first, last), beats=beats)


def quantised_times(score: Score, is_played: bool) -> GridTimes:
    """`score` with every row on a cell of the grid.

    Rows are main strokes at their played ticks, grace rows (`lead_ms` > 0) on the tick of their main stroke, and
    buzzes, one row each with its duration. With `is_played` the times are known to be somebody's playing; without it
    they are taken so only if they lie on no grid. Raises `BadInput` where a change of meter cuts a bar at a place that
    no meter can name.

    Of a take that says no tempo but MIDI's 120, and was played at another, the score has that other tempo.
    """
    music = _Music.of(score)
    meant = None if is_played and len(music.mains) else exact_meant(music.take, music.ticks)
    if meant is None:
        music = _Music.of(at_heard_tempo(score))
        meant = played_meant(music.take)
    return _written(music, meant)


@dataclass(frozen=True, eq=False)
class _Music:
    """A score over whole bars; `mains` are the indices of its main strokes, `take` their times."""

    score: Score
    tempo_map: TempoMap
    mains: Ints
    take: Take

    @classmethod
    def of(cls, score: Score) -> "_Music":
        """The score, its bars made whole."""
        tempo_map = at_bar_starts(score)
        mains = np.nonzero(~score.is_grace)[0]
        onset_ns = tempo_map.ns_at(score.notes["tick"][mains])
        return cls(
            score,
            tempo_map,
            mains,
            take_of(onset_ns, score.notes["piece"][mains], spans_of(tempo_map, score.end_tick)),
        )

    @property
    def ticks(self) -> Ints:
        """The ticks of the main strokes."""
        ticks: Ints = self.score.notes["tick"][self.mains]
        return ticks


def _written(music: _Music, meant: Meant) -> GridTimes:
    """The rows of the score where they are meant."""
    spans, score = music.take.spans, music.score
    meant = _named(music.take, meant)
    moved = score.notes.copy()
    moved["tick"][music.mains] = meant.ticks(spans)
    moved["swing_ticks"][music.mains] = meant.ticks(spans) - meant.straight_ticks(spans)
    for name in ("duration_ticks", "choke_ticks"):
        moved[name][music.mains] = _lengths(music.take, meant, moved[name][music.mains])
    _bring_graces(score.notes, moved)
    origin = np.lexsort((moved["piece"], -moved["lead_ms"], moved["tick"]))
    end = _end(moved["tick"], music.tempo_map, score)
    return GridTimes(
        Score.from_array(moved[origin], music.tempo_map, end, score.title, score.loudness),
        origin,
        meant.swing,
        _beats(spans, meant),
        meant.lean_s * _MS_PER_S,
        meant.spread_s * _MS_PER_S,
    )


def played_meant(take: Take) -> Meant:
    """What a take is meant as."""
    feel = feel_of(take)
    late_s = 0.0
    if feel.spread_s > STEADY_S and (steady := steadied(take, feel)):
        late_s = float(np.mean(take.times_s - steady.times_s))
        take, feel = steady, feel_of(steady)
    reading = take.read(feel, MAX_WORDS)
    span, _ = take.spans.places(take.times_s - feel.lean_s)
    cell = cells_of(take.spans, span, reading, feel.swing)
    return Meant(span, cell, reading.cells, feel.swing, late_s + feel.lean_s, feel.spread_s)


def _named(take: Take, meant: Meant) -> Meant:
    """The strokes under the swing that a teacher names; triplets may be one though none was needed to read them.

    A swing by triplets stays where straight cells would have to be finer than thirty-seconds.
    """
    if meant.swing.ratio not in (STRAIGHT, TRIPLETS):
        return meant
    swing = triplet_swing(take.spans, meant.span, meant.places(take.spans), take.piece)
    named = recut(meant, take.spans, swing)
    is_finer = bool(np.any((named.cells > meant.cells) & (take.spans.lengths < named.cells * PPQ // 8)))
    return meant if is_finer else named


def _lengths(take: Take, meant: Meant, lengths: Ints) -> Ints:
    """The lengths (n,) of buzzes and chokes, each to the nearest cell of the beat in which it ends, at least one."""
    found = lengths.copy()
    starts = meant.ticks(take.spans)
    for i in np.nonzero(lengths)[0].tolist():
        end = starts[i] + lengths[i]
        span = int(np.searchsorted(take.spans.starts, end, side="right")) - 1
        length = int(take.spans.lengths[span])
        cells = int(meant.cells[span])
        cell = length / (cells if cells > 1 else 6 if take.spans.is_ternary[span] else 4)
        start = int(take.spans.starts[span])
        found[i] = max(round(start + round((end - start) / cell) * cell - starts[i]), round(cell))
    return found


def _bring_graces(rows: NDArray[np.void], moved: NDArray[np.void]) -> None:
    """Put each grace stroke where its main stroke is."""
    mains = {(int(r["tick"]), int(r["piece"])): i for i, r in enumerate(rows) if not r["lead_ms"]}
    for i in np.nonzero(rows["lead_ms"])[0].tolist():
        main = mains.get((int(rows["tick"][i]), int(rows["piece"][i])))
        if main is not None:
            moved["tick"][i], moved["swing_ticks"][i] = moved["tick"][main], moved["swing_ticks"][main]


def _end(ticks: Ints, tempo_map: TempoMap, score: Score) -> int:
    """Where the score ends, a bar later if a stroke that came early belongs to the next bar."""
    last = int(ticks.max()) if len(ticks) else 0
    return score.end_tick if last < score.end_tick else tempo_map.bar_start(int(tempo_map.bars_at(last)) + 1)


def _beats(spans: BeatSpans, meant: Meant) -> tuple[BeatCells, ...]:
    struck = np.unique(meant.span)
    columns = (spans.starts[struck], spans.lengths[struck], meant.cells[struck])
    return tuple(BeatCells(*row) for row in np.stack(columns, axis=1).tolist())
