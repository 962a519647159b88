"""The written music: an immutable table of strokes over a tempo map.

Every stroke that a player must make is a row, the grace strokes of flams and drags and the strokes of diddles and
open rolls included, so that sound, motion and alignment need no second notion of a note. A grace stroke stands on
the tick of its main stroke and sounds `lead_ms` before it, whatever the tempo: its spacing belongs to the hand, not
to the beat. A buzz roll is one row with a duration. How a groove was played stands beside how it is written: a stroke
sounds `late_ms` after its tick, before it where that is negative, and its grace strokes move with it.

Rows are ordered by tick, then grace strokes first, then piece; `Score.notes` is read-only.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from enum import IntEnum
from functools import cached_property
from math import isnan
from operator import attrgetter
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CHOKEABLE, Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import NS_PER_MS, NS_PER_S, PPQ
from station.music.loudness_marks import LoudnessMark, joined_marks, marks_within
from station.music.tempo import TempoMap

NOTE_DTYPE = np.dtype(
    [
        ("tick", np.int64),
        ("duration_ticks", np.int64),  # of rolls; 0 for a stroke
        ("lead_ms", np.float32),  # > 0 for grace strokes: how long before the tick they sound
        ("openness", np.float32),  # hi-hat 0 closed … 1 open; NaN where it is not said
        ("choke_ticks", np.int64),  # > 0: the cymbal is grabbed so long after the stroke
        ("piece", np.uint8),
        ("zone", np.uint8),
        ("articulation", np.uint8),
        ("velocity", np.uint8),  # 1–127
        ("dynamic", np.uint8),
        ("ornament", np.uint8),
        ("limb", np.int8),  # the written sticking; Limb.UNKNOWN where none is written
        ("midi_note", np.uint8),  # as in the file it came from; 0 where there was none
        ("swing_ticks", np.int64),  # > 0: swing has it so much later than notation writes it
        ("late_ms", np.float32),  # the stroke's own timing: how long after its tick it sounds, negative for before
    ]
)

MAX_LATE_MS = 60.0
"""The widest timing of a stroke's own: it holds 98 of 100 strokes of drummers who play to a click (HUMANS, Timing: a
spread of 26 ms), and what is a sixteenth at 250 beats a minute from its cell is meant for another (our choice)."""


@dataclass(frozen=True, slots=True)
class Note:
    """One written stroke; the fields are those of `NOTE_DTYPE`, `openness` None where it is not said."""

    tick: int
    piece: Piece
    zone: Zone = Zone.HEAD
    velocity: int = 80
    articulation: Articulation = Articulation.NORMAL
    dynamic: Dynamic = Dynamic.NORMAL
    limb: Limb = Limb.UNKNOWN
    openness: float | None = None
    ornament: Ornament = Ornament.NONE
    lead_ms: float = 0.0
    duration_ticks: int = 0
    choke_ticks: int = 0
    midi_note: int = 0
    swing_ticks: int = 0
    late_ms: float = 0.0


_FIELDS = tuple(field.name for field in fields(Note))
_ROW = attrgetter(*(NOTE_DTYPE.names or ()))
_OPENNESS = (NOTE_DTYPE.names or ()).index("openness")
_WORDS: Mapping[str, Mapping[int, IntEnum]] = MappingProxyType(
    {
        "piece": {int(p): p for p in Piece},
        "zone": {int(z): z for z in Zone},
        "articulation": {int(a): a for a in Articulation},
        "dynamic": {int(d): d for d in Dynamic},
        "limb": {int(limb): limb for limb in Limb},
        "ornament": {int(o): o for o in Ornament},
    }
)
"""By the names of the columns that hold them, the words that numbers stand for."""


def _row(note: Note) -> tuple[float | int, ...]:
    row: tuple[float | int, ...] = _ROW(note)
    return row if note.openness is not None else (*row[:_OPENNESS], np.nan, *row[_OPENNESS + 1 :])


def _notes(rows: NDArray[np.void]) -> Iterator[Note]:
    """The rows (n,) as notes, column by column: so it costs a tenth of asking each row for each field."""
    columns = {name: rows[name].tolist() for name in _FIELDS}
    columns |= {name: [words[number] for number in columns[name]] for name, words in _WORDS.items()}
    columns["openness"] = [None if isnan(openness) else openness for openness in columns["openness"]]
    return map(Note, *columns.values())


@dataclass(frozen=True, eq=False)
class Score:
    """Strokes (`notes`, shape (n,), dtype `NOTE_DTYPE`) over `tempo_map`; `end_tick` is where the last bar ends.

    `loudness` has the marks and hairpins of the part, by their ticks. `beyond` (m,) of `NOTE_DTYPE`, ordered as `notes`
    are, has strokes of the music that one player has no hand, foot or time for: written small, never asked.
    """

    notes: NDArray[np.void]
    tempo_map: TempoMap = field(default_factory=TempoMap)
    end_tick: int = 0
    title: str = ""
    loudness: tuple[LoudnessMark, ...] = ()
    beyond: NDArray[np.void] = field(default_factory=lambda: np.zeros(0, NOTE_DTYPE))

    @classmethod
    def from_array(
        cls,
        notes: NDArray[np.void],
        tempo_map: TempoMap,
        end_tick: int | None = None,
        title: str = "",
        loudness: tuple[LoudnessMark, ...] = (),
        beyond: NDArray[np.void] | None = None,
    ) -> "Score":
        """A score of rows in any order; without `end_tick` it ends with the bar of its last stroke."""
        rows = _ordered(notes)
        if end_tick is None:
            last = int(rows["tick"].max()) if len(rows) else 0
            end_tick = tempo_map.bar_start(int(tempo_map.bars_at(last)) + 1)
        more = np.zeros(0, NOTE_DTYPE) if beyond is None else beyond
        return cls(rows, tempo_map, end_tick, title, loudness, _ordered(more))

    @classmethod
    def from_notes(
        cls,
        notes: Iterable[Note],
        tempo_map: TempoMap,
        end_tick: int | None = None,
        title: str = "",
        beyond: Iterable[Note] = (),
    ) -> "Score":
        """A score of `notes` in any order."""
        rows, more = (np.array([_row(n) for n in some], NOTE_DTYPE) for some in (notes, beyond))
        return cls.from_array(rows, tempo_map, end_tick, title, beyond=more)

    def __len__(self) -> int:
        return len(self.notes)

    def __getitem__(self, index: int) -> Note:
        return self._as_notes[index]

    def __iter__(self) -> Iterator[Note]:
        return iter(self._as_notes)

    @cached_property
    def _as_notes(self) -> tuple[Note, ...]:
        return tuple(_notes(self.notes))

    @cached_property
    def onset_ns(self) -> NDArray[np.int64]:
        """When each stroke sounds, in ns from tick 0 (a grace stroke on tick 0 is negative)."""
        onsets: NDArray[np.int64] = self.tempo_map.ns_at(self.notes["tick"])
        after_ms = self.notes["late_ms"].astype(np.float64) - self.notes["lead_ms"]
        onsets = onsets + np.rint(after_ms * NS_PER_MS).astype(np.int64)
        onsets.setflags(write=False)
        return onsets

    @cached_property
    def onset_s(self) -> NDArray[np.float64]:
        """When each stroke sounds, in seconds from tick 0."""
        return self.onset_ns / NS_PER_S

    @cached_property
    def is_grace(self) -> NDArray[np.bool_]:
        """Which rows are the grace strokes of flams and drags."""
        return np.asarray(self.notes["lead_ms"] > 0)

    @cached_property
    def is_choked(self) -> NDArray[np.bool_]:
        """Which rows are cymbals that a hand grabs; a choke on anything else, as aftertouch may say, means nothing."""
        return np.asarray((self.notes["choke_ticks"] > 0) & np.isin(self.notes["piece"], sorted(CHOKEABLE)))

    @cached_property
    def bar(self) -> NDArray[np.int64]:
        """Index of the bar of each stroke, from 0."""
        return self.tempo_map.bars_at(self.notes["tick"])

    @property
    def bar_count(self) -> int:
        """How many bars there are, the last one whole."""
        return int(self.tempo_map.bars_at(max(self.end_tick - 1, 0))) + 1

    @property
    def closing_rest_bars(self) -> int:
        """How many bars follow the bar of the last stroke; all of them where there is no stroke."""
        return self.bar_count - 1 - (int(self.bar[-1]) if len(self) else -1)

    @property
    def length_ns(self) -> int:
        """Time from tick 0 to `end_tick`."""
        return int(self.tempo_map.ns_at(self.end_tick))

    @property
    def length_beats(self) -> float:
        """Quarter notes from tick 0 to `end_tick`."""
        return self.end_tick / PPQ

    @cached_property
    def whole(self) -> "tuple[Score, NDArray[np.bool_]]":
        """All strokes of the music in one score, and which of its rows are `beyond` the player, shape (n + m,).

        The player's own rows keep their order.
        """
        rows, is_beyond = (
            np.concatenate([self.notes, self.beyond]),
            np.arange(len(self) + len(self.beyond)) >= len(self),
        )
        if not len(self.beyond):
            return self, is_beyond
        order = _order(rows)
        whole = Score.from_array(rows, self.tempo_map, self.end_tick, self.title, self.loudness)
        return whole, is_beyond[order]

    def bars(self, first: int, last: int) -> "Score":
        """Bars `first` to `last` inclusive (from 0), moved to tick 0."""
        start, end = self.tempo_map.bar_start(first), self.tempo_map.bar_start(last + 1)
        rows, beyond = (_between(some, start, end) for some in (self.notes, self.beyond))
        loudness = marks_within(self.loudness, start, end)
        return Score.from_array(rows, self.tempo_map.section(start, end), end - start, self.title, loudness, beyond)

    def until_ns(self, stop_ns: int) -> "Score":
        """The strokes that sound before `stop_ns` from tick 0, over the same bars."""
        rows = self.notes[self.onset_ns < stop_ns].copy()
        rows.setflags(write=False)
        return replace(self, notes=rows)

    def repeated(self, times: int) -> "Score":
        """The score played `times` times without a gap, tempo and meter changes included."""
        return Score.joined([self] * times)

    def landing_on(self, landing: NDArray[np.void]) -> "Score":
        """The score, and in a bar more of its last meter and tempo `landing`, rows (m,) whose ticks are 0.

        Without rows it is the score itself.
        """
        if not len(landing):
            return self
        last = self.tempo_map.section(self.end_tick - 1, self.end_tick)
        whole = Score.joined([self, Score.from_array(landing, last, last.meters[0].bar_ticks)])
        return replace(whole, loudness=self.loudness)  # a landing has no mark of its own

    @staticmethod
    def joined(parts: Sequence["Score"]) -> "Score":
        """All `parts` one after the other, each from the end of the one before; at least one part."""
        assert parts, "nothing to join"
        starts = np.cumsum([0] + [p.end_tick for p in parts]).tolist()
        rows, beyond = (
            _one_after_another(some, starts) for some in zip(*((p.notes, p.beyond) for p in parts), strict=True)
        )
        tempos, meters = [], []
        for at, part in zip(starts, parts, strict=False):
            sounding = part.tempo_map.section(0, part.end_tick)  # what changes after its end is not for the next part
            tempos += [replace(t, tick=t.tick + at) for t in sounding.tempos]
            meters += [replace(m, tick=m.tick + at) for m in sounding.meters]
        loudness = joined_marks((at, part.loudness) for at, part in zip(starts, parts, strict=False) if len(part))
        tempo_map = TempoMap.build(tempos, meters, any(part.tempo_map.is_played for part in parts))
        return Score.from_array(rows, tempo_map, starts[-1], parts[0].title, loudness, beyond)

    @property
    def as_written(self) -> "Score":
        """The strokes where notation writes them: straight under the word swing."""
        rows, beyond = self.notes.copy(), self.beyond.copy()
        for some in (rows, beyond):
            some["tick"] -= some["swing_ticks"]
            some["swing_ticks"] = 0
        return Score.from_array(rows, self.tempo_map, self.end_tick, self.title, self.loudness, beyond)

    @property
    def on_the_grid(self) -> "Score":
        """The strokes without timing of their own: who can play them, and with which hand, does not depend on it."""
        if not self.notes["late_ms"].any():
            return self
        rows = self.notes.copy()
        rows["late_ms"] = 0
        rows.setflags(write=False)
        return replace(self, notes=rows)

    def at_speed(self, factor: float) -> "Score":
        """The same strokes played `factor` times as fast; grace leads and timing keep their milliseconds."""
        return replace(self, tempo_map=self.tempo_map.scaled(factor))

    def with_limbs(self, limbs: NDArray[np.int8]) -> "Score":
        """The same strokes with their limbs (shape (n,)) written."""
        rows = self.notes.copy()
        rows["limb"] = limbs
        rows.setflags(write=False)
        return replace(self, notes=rows)


def _order(rows: NDArray[np.void]) -> NDArray[np.intp]:
    """How rows are ordered: by tick, grace strokes first, then by piece."""
    return np.lexsort((rows["piece"], -rows["lead_ms"], rows["tick"]))


def _ordered(rows: NDArray[np.void]) -> NDArray[np.void]:
    found = rows[_order(rows)]
    found.setflags(write=False)
    return found


def _between(rows: NDArray[np.void], start: int, end: int) -> NDArray[np.void]:
    """Those from tick `start` up to `end`, moved to tick 0."""
    found = rows[(rows["tick"] >= start) & (rows["tick"] < end)].copy()
    found["tick"] -= start
    return found


def _one_after_another(parts: Sequence[NDArray[np.void]], starts: Sequence[int]) -> NDArray[np.void]:
    """The rows of all parts, each moved to where it starts."""
    rows = np.concatenate(parts)
    rows["tick"] += np.repeat(np.array(starts[: len(parts)], np.int64), [len(part) for part in parts])
    return rows
