"""Lesson files: TOML read into a `Lesson`, with every fault named by line and column.

The format is described for teachers in docs/lessons.md. Whatever a file leaves out has a default; a key that nobody
knows is a fault. Faults of all kinds are collected in one reading: syntax, values, letters of the grid, bars that do
not fit, stickings that do not match, and music that two hands and two feet cannot play.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

import numpy as np

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.core.toml_places import KeyPath
from station.core.units import PPQ
from station.core.utf8 import utf8_text
from station.drills.faults import Fault, Faults, raise_first
from station.drills.grid.cell_strokes import Origin, Velocities, WrittenCell, expand
from station.drills.grid.grid_reader import CellTiming, GridSection, note_length, read_grid, read_timing
from station.drills.grid.swing import MAX_RATIO, MIN_RATIO, STRAIGHT, Swing
from station.drills.grid.tab_symbols import LINE_PIECES
from station.drills.lesson import (
    DEFAULT_DEMONSTRATIONS,
    DEFAULT_MIN_ACCURACY,
    DEFAULT_PASSES,
    LEVELS,
    Goals,
    Lesson,
    Section,
)
from station.drills.playable import impossible
from station.drills.table import Table, number, text, texts, title, whole
from station.drills.toml_syntax import load
from station.music.score import Score
from station.music.tempo import MAX_BPM, MIN_BPM, MeterChange, TempoChange, TempoMap

KEYS = (
    *("title", "author", "level", "tags", "about", "kit", "tempo_bpm", "meter", "beat", "swing_ratio", "swing_unit"),
    *("loop", "passes", "count_in_bars", "demonstrations", "dynamics", "goals", "grid"),
)
"""Every key of the top table, in the order in which a message lists them."""
MAX_FILE_BYTES = 1_000_000
_MIDI = b"MThd"
"""How a MIDI file begins."""
MAX_PASSES = 1000
MAX_COUNT_IN_BARS = 8
MAX_DEMONSTRATIONS = 20
DEFAULT_TIMING = CellTiming(80.0, MeterChange(0, 4, 4), PPQ)
"""Where a file says no tempo: a slow walk, our choice."""


@dataclass(frozen=True, slots=True)
class Reading:
    """What came of reading a text: the lesson, or None and the faults that prevented it."""

    lesson: Lesson | None
    faults: list[Fault]


def read_lesson(path: Path) -> Lesson:
    """The lesson in the file at `path`; raises `BadInput` with the place of the first fault."""
    reading = parse_lesson(lesson_text(path), str(path), path.stem)
    raise_first(reading.faults, path)
    assert reading.lesson
    return reading.lesson


def lesson_text(path: Path) -> str:
    """The text of a lesson file; raises `BadInput` if it cannot be read, is too long or is not UTF-8."""
    try:
        with path.open("rb") as file:
            data = file.read(MAX_FILE_BYTES + 1)
    except (FileNotFoundError, ValueError):  # or a name that no file can have
        raise BadInput(path, "", "no such file") from None
    except OSError as fault:
        raise BadInput(path, "", f"cannot be read: {fault.strerror or fault}") from fault
    if data.startswith(_MIDI):
        way = f"`station lesson import {path} --out {path.stem}.toml`"
        raise BadInput(path, "", f"a MIDI file, not a lesson; {way} makes a lesson of it")
    if len(data) > MAX_FILE_BYTES:
        raise BadInput(path, "", f"longer than {MAX_FILE_BYTES} bytes; no lesson is")
    return utf8_text(data, path, "a lesson")


def parse_lesson(text: str, source: str, name: str) -> Reading:
    """Read a lesson's text; `source` names it in faults, `name` becomes the lesson's."""
    raw, syntax, text = load(text)
    faults = Faults()
    lesson = _Reader(raw, name, faults).lesson() if raw or not syntax else None
    found = faults.found(syntax, text, source)
    return Reading(None if found else lesson, found)


class _Reader:
    """Reads one file's top table and all below it."""

    def __init__(self, raw: dict[str, object], name: str, faults: Faults) -> None:
        self.name = name
        self.faults = faults
        self.top = Table(raw, (), faults)
        self.top.allow(KEYS)

    def lesson(self) -> Lesson:
        top = self.top
        timing = read_timing(top, DEFAULT_TIMING)
        swing = Swing(
            top.take("swing_ratio", number(MIN_RATIO, MAX_RATIO), STRAIGHT),
            top.take("swing_unit", note_length, PPQ // 2),
        )
        velocities = self._velocities()
        sections = self._sections(timing)
        self._check_swing(swing, timing, sections)
        score, origins = _score(sections, velocities, swing)
        lesson = Lesson(
            name=self.name,
            title=top.require("title", title, "", 'a name such as title = "Rock 1"'),
            score=score,
            author=top.take("author", text, ""),
            level=top.take("level", whole(min(LEVELS), max(LEVELS)), 1),
            about=top.take("about", text, ""),
            tags=top.take("tags", texts, ()),
            kit=top.take("kit", text, ""),
            loop=self._loop(score.bar_count),
            passes=top.take("passes", whole(1, MAX_PASSES), DEFAULT_PASSES),
            count_in_bars=top.take("count_in_bars", whole(0, MAX_COUNT_IN_BARS), 1),
            demonstrations=top.take("demonstrations", whole(0, MAX_DEMONSTRATIONS), DEFAULT_DEMONSTRATIONS),
            goals=self._goals(timing.beat_ticks),
            swing=swing,
            beat_ticks=timing.beat_ticks,
            sections=_spans(sections),
            velocities=velocities,
        )
        lesson = replace(lesson, score=replace(score, title=lesson.title))
        top.close()
        self._note_impossible(lesson, origins)
        return lesson

    def _sections(self, timing: CellTiming) -> list[GridSection]:
        """The grids of the file, one after the other; there may be one `[grid]` or several `[[grid]]`."""
        grids = self.top.require("grid", lambda raw: raw, None, "a table [grid] with the lines to play")
        if grids is None:
            return []
        several = isinstance(grids, list)
        if not grids and several:
            self.top.fault("grid", "no grid to play; expected a table [grid] with lines in it")
        sections: list[GridSection] = []
        for i, raw in enumerate(grids if isinstance(grids, list) else [grids]):
            path: KeyPath = ("grid", i) if several else ("grid",)
            sections.append(read_grid(raw, path, sections[-1] if sections else timing, self.faults))
        if sections and not any(s.strokes for s in sections) and not self.faults:
            self.faults.add(("grid",), "nothing to play: every cell is a rest", at_key=True)
        return sections

    def _check_swing(self, swing: Swing, timing: CellTiming, sections: Sequence[GridSection]) -> None:
        """Pairs of swung cells must fill every beat that is counted, else parentheses and swing would cross."""
        beats = {timing.beat_ticks, *(s.timing.beat_ticks for s in sections)}
        if swing.ratio != STRAIGHT and any(beat % (2 * swing.unit_ticks) for beat in beats):
            key = "swing_unit" if self.top.has("swing_unit") else "swing_ratio"
            self.top.fault(key, "the beat is no whole number of pairs to swing; expected a shorter swing_unit")

    def _velocities(self) -> Velocities:
        usual = Velocities().usual
        if not self.top.has("dynamics"):
            return Velocities()
        table = Table(self.top.raw["dynamics"], ("dynamics",), self.faults)
        usual = _three(table, usual)
        of_piece: dict[Piece, tuple[int, int, int]] = {}
        for key, piece in LINE_PIECES.items():
            if table.has(key):
                inner = Table(table.raw[key], ("dynamics", key), self.faults)
                of_piece[piece] = _three(inner, usual)
                inner.close()
        table.allow(LINE_PIECES)
        table.close()
        return Velocities(usual, MappingProxyType(of_piece))

    def _loop(self, bar_count: int) -> tuple[int, int]:
        """First and last bar from 0; the whole lesson where the file does not say."""
        whole_lesson = (0, bar_count - 1)
        if not self.top.has("loop"):
            return whole_lesson

        def read(value: object) -> tuple[int, int]:
            bar = whole(1, bar_count)
            if not isinstance(value, list) or len(value) != 2:
                raise ValueError("expected two bar numbers such as [1, 2]")
            first, last = bar(value[0]), bar(value[1])
            if last < first:
                raise ValueError(f"bar {last} comes before bar {first}; expected the first bar first")
            return first - 1, last - 1

        return self.top.take("loop", read, whole_lesson)

    def _goals(self, beat_ticks: int) -> Goals:
        if not self.top.has("goals"):
            return Goals()
        table = Table(self.top.raw["goals"], ("goals",), self.faults)

        def maybe(key: str, low: float, high: float) -> float | None:
            return table.take(key, number(low, high), 0.0) if table.has(key) else table.take(key, _nothing, None)

        target = maybe("target_tempo_bpm", MIN_BPM, MAX_BPM)
        goals = Goals(
            min_accuracy=table.take("min_accuracy", number(0, 1), DEFAULT_MIN_ACCURACY),
            max_sd_ms=maybe("max_sd_ms", 1, 1000),
            max_lean_ms=maybe("max_lean_ms", 0, 1000),
            max_swing_error=maybe("max_swing_error", 0, MAX_RATIO),
            target_tempo_bpm=None if target is None else target * beat_ticks / PPQ,
            min_score=maybe("min_score", 0, 100),
        )
        table.close()
        return goals

    def _note_impossible(self, lesson: Lesson, origins: Sequence[Origin]) -> None:
        """Note what cannot be played at the faster of written and target tempo, nor as the loop starts again."""
        if not len(lesson.score):
            return
        score = lesson.score.at_speed(max(1.0, lesson.target_tempo_bpm / lesson.tempo_bpm))
        first, last = lesson.loop
        in_loop = np.flatnonzero((score.bar >= first) & (score.bar <= last)).tolist()
        twice = impossible(score.bars(first, last).repeated(2)) if in_loop else []
        found = {(in_loop[i.note], i.text) for i in twice if i.note < len(in_loop)}
        if len(in_loop) < len(score):
            found |= {(i.note, i.text) for i in impossible(score)}
        again = {(in_loop[i.note - len(in_loop)], i.text) for i in twice if i.note >= len(in_loop)} - found
        again_told = {(note, f"{words} (as the loop starts again)") for note, words in again}
        for note, words in found | again_told:
            self.faults.add(origins[note].path, words, origins[note].char)


def _nothing(value: object) -> None:
    """Reads a key that is not there."""


def _three(table: Table, usual: tuple[int, int, int]) -> tuple[int, int, int]:
    """Ghost, normal and accent velocities, rising."""
    velocity = whole(1, 127)
    ghost, normal, accent = (
        table.take(key, velocity, before) for key, before in zip(("ghost", "normal", "accent"), usual, strict=True)
    )
    if table.is_table and not ghost <= normal <= accent:
        table.faults.add(table.path, f"ghost {ghost}, normal {normal}, accent {accent}: expected rising velocities")
    return ghost, normal, accent


def _score(sections: Sequence[GridSection], velocities: Velocities, swing: Swing) -> tuple[Score, list[Origin]]:
    """The score of all sections, and the letter that wrote each of its rows."""
    strokes: list[WrittenCell] = [stroke for section in sections for stroke in section.strokes]
    rows, origins = expand(strokes, velocities, swing)
    order = np.lexsort((rows["piece"], -rows["lead_ms"], rows["tick"]))
    tempos: list[TempoChange] = []
    meters: list[MeterChange] = []
    for before, section in zip([None, *sections], sections, strict=False):
        if before is None or before.timing.tempo_bpm != section.timing.tempo_bpm:
            tempos.append(TempoChange.from_bpm(section.start_tick, section.timing.tempo_bpm))
        if before is None or before.timing.meter != section.timing.meter:
            meters.append(replace(section.timing.meter, tick=section.start_tick))
    tempo_map = TempoMap.build(tempos, meters)
    end = sections[-1].end_tick if sections else tempo_map.bar_start(1)
    return Score.from_array(rows[order], tempo_map, end), [origins[i] for i in order]


def _spans(sections: Sequence[GridSection]) -> tuple[Section, ...]:
    spans: list[Section] = []
    for section in sections:
        first = spans[-1].last_bar + 1 if spans else 0
        spans.append(Section(section.name, first, first + section.bars - 1))
    return tuple(spans)
