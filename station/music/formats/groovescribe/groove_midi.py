"""The MIDI files that GrooveScribe saves, whose numbers and times are its own.

It writes note 22 for an accented snare, 21 for a ghost, and flams, drags and buzzes as one note each. There is no
meter, but a mark where each bar ends. A cell is 16 ticks (10.666 in triplets), swing makes it longer and shorter, and
the time between two events is cut to whole ticks, so that triplets fall behind by up to a tick a stroke: the grid that
gives just these ticks is found, and the strokes are put where that grid has them. Source: js/midiFile.js.
"""

import re
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, cycle, islice

from station.core.errors import BadInput
from station.music.drum_part import DrumPart
from station.music.formats.groovescribe.groove_letters import (
    LETTERS,
    LOUD_LETTERS,
    METRONOME_NOTES,
    MIDI_LETTERS,
    NORMAL_VELOCITY,
)
from station.music.formats.groovescribe.groove_query import MOST_SWING, Groove
from station.music.formats.groovescribe.groove_reader import part_of_groove
from station.music.formats.smf.chunk_reader import parse_midi
from station.music.formats.smf.track_events import parse_events
from station.music.tempo import MeterChange

_HEAD = re.compile(rb"MThd\0\0\0\x06\0\0\0\x01\0\x80MTrk.{4}\0\xff\x51\x03...\0\xc0\x13\x01\x89\x3c", re.DOTALL)
"""One track of 128 ticks a quarter: tempo, a church organ on channel 1, and a note off a tick later."""
_TRACK_AT = 22
_BAR_MARK = b"\x80\x3c"
_NOTE_ON, _NOTE_OFF, _MARK_NUMBER = 0x99, 0x80, 60
_STRAIGHT, _TRIPLETS = 16_000, 10_666
"""Thousandths of a tick in a 32nd and in a 48th of a whole note, as GrooveScribe counts them."""
_TICK = 1000
_SWUNG_CELLS = (1, 2, 4)
"""32nds in a cell of the divisions that it swings."""
_PERCENTS = sorted(range(1, MOST_SWING + 1), key=lambda percent: (percent % 10 > 0, percent % 5 > 0, percent))
"""Several give the same whole ticks: round numbers are likelier (our choice)."""
_LONGEST_BAR = 16 * 4 * 128
"""Ticks of GrooveScribe's longest bar, 32/2."""
_MOST_BARS, _MOST_NOTES = 100, 20_000
"""GrooveScribe makes ten bars (our choice, which bounds the search)."""
_REST = "-"


@dataclass(frozen=True, slots=True)
class _Grid:
    """The cells of a bar: `division` of them in a whole note when straight, their `lengths` in turn, over and over."""

    division: int
    lengths: tuple[int, ...]
    swing: int = 0

    def starts(self) -> list[int]:
        """Where the cells of the longest bar begin, in thousandths of a tick."""
        count = 2 + len(self.lengths) * _LONGEST_BAR * _TICK // sum(self.lengths)
        return list(accumulate(islice(cycle(self.lengths), count), initial=0))


@dataclass(frozen=True, slots=True)
class _Bar:
    """From where to where a bar goes in the file, and its notes: tick, number and velocity."""

    start: int
    end: int
    notes: tuple[tuple[int, int, int], ...]


@dataclass(frozen=True, slots=True)
class _Cells:
    """The cell of each note of a bar, and how many cells the bar has."""

    of_notes: tuple[int, ...]
    count: int


def is_groove_midi(data: bytes) -> bool:
    """Whether GrooveScribe wrote this file."""
    return bool(_HEAD.match(data)) and _BAR_MARK in data


def read_groove_midi(data: bytes, source: str) -> DrumPart:
    """The part in a MIDI file of GrooveScribe's; raises `BadInput` of `source`."""
    midi = parse_midi(data, source)
    if not is_groove_midi(data):
        raise BadInput(source, "", "GrooveScribe did not write this MIDI file")
    bars = _bars(data, source)
    grid, cells, lost = _on_a_grid(bars)
    meter = _meter(max(bar.count for bar in cells), grid.division)
    size = meter.beats * grid.division // meter.unit
    lines, unread = _lines(bars, cells, size)
    tempo = midi.tracks[0].tempos[0].us_per_quarter if midi.tracks[0].tempos else 500_000
    groove = Groove(
        *(meter, grid.division, len(bars), max(round(60_000_000 / max(tempo, 1)), 1), grid.swing),
        lines=lines,
        lost=(*lost, *unread),
    )
    return part_of_groove(groove, all_toms=True)


def _bars(data: bytes, source: str) -> list[_Bar]:
    events = parse_events(data, _TRACK_AT, _TRACK_AT + int.from_bytes(data[18:22], "big"), source)
    columns = events.columns
    bars: list[_Bar] = []
    start, notes = int(columns.tick[0]) if len(columns.tick) else 0, list[tuple[int, int, int]]()
    rows = zip(*(c.tolist() for c in (columns.tick, columns.status, columns.first, columns.second)), strict=True)
    for tick, status, number, velocity in rows:
        if status == _NOTE_ON and velocity:
            notes.append((tick, number, velocity))
        elif (status, number) == (_NOTE_OFF, _MARK_NUMBER):
            bars.append(_Bar(start, tick, tuple(notes)))
            start, notes = tick, []
    too_many = sum(len(bar.notes) for bar in bars) > _MOST_NOTES
    if (
        not bars
        or notes
        or len(bars) > _MOST_BARS
        or too_many
        or any(bar.end - bar.start > _LONGEST_BAR for bar in bars)
    ):
        raise BadInput(source, "", "its bars are none of GrooveScribe's")
    return bars


# --- times ------------------------------------------------------------------------------------------------------------


def _on_a_grid(bars: Sequence[_Bar]) -> tuple[_Grid, list[_Cells], tuple[str, ...]]:
    """The first grid that gives just these ticks, and the cells of all notes; else the nearest 32nds, and told."""
    for grid in _grids():
        cells = _all_cells(bars, grid)
        if cells is not None and len({bar.count for bar in cells}) == 1:
            return grid, cells, ()
    return _Grid(32, (_STRAIGHT,)), [_nearest(bar) for bar in bars], ("times that no groove has, moved to 32nds",)


def _grids() -> Iterator[_Grid]:
    yield _Grid(32, (_STRAIGHT,))
    yield _Grid(48, (_TRIPLETS,))
    for cells in _SWUNG_CELLS:
        for percent in _PERCENTS:
            change = cells * _STRAIGHT * percent // 100
            yield _Grid(32 // cells, (cells * _STRAIGHT + change, cells * _STRAIGHT - change), percent)


def _all_cells(bars: Sequence[_Bar], grid: _Grid) -> list[_Cells] | None:
    """The cells of all notes; None where the grid gives other ticks."""
    starts, found = grid.starts(), []
    for bar in bars:
        cells = _cells(bar, starts, grid.swing > 0)
        if cells is None:
            return None
        found.append(cells)
    return found


def _cells(bar: _Bar, starts: Sequence[int], swings: bool) -> _Cells | None:
    """The cells of a bar's notes; None where cells that begin at `starts` give other ticks.

    GrooveScribe adds up the cells from one event to the next, and cuts the sum; from the last one to the bar's end it
    takes a tick off before. Its sums of swung cells are fractions of two, and may fall short of a whole tick.
    """
    at, cell, found = bar.start, 0, []
    for tick, *_ in bar.notes:
        reached = _reached(starts, cell, (tick - at) * _TICK, swings)
        if reached is None:
            return None
        at, cell = tick, reached
        found.append(cell)
    end = _reached(starts, cell, (bar.end - at + 1) * _TICK, swings)
    return None if end is None else _Cells(tuple(found), end)


def _reached(starts: Sequence[int], cell: int, length: int, swings: bool) -> int | None:
    """The cell that begins `length` after `cell`, or less than a tick later; None if there is none."""
    wanted = starts[cell] + length
    found = bisect_left(starts, wanted, cell)
    last = wanted + _TICK if swings else wanted + _TICK - 1
    return found if found < len(starts) and starts[found] <= last else None


def _nearest(bar: _Bar) -> _Cells:
    cells = tuple(round((tick - bar.start) * _TICK / _STRAIGHT) for tick, *_ in bar.notes)
    return _Cells(cells, max(round((bar.end + 1 - bar.start) * _TICK / _STRAIGHT), 1))


def _meter(cells: int, division: int) -> MeterChange:
    """The meter of a bar of so many cells: quarters where they fill it, else eighths or sixteenths."""
    for unit in (4, 8, 16):
        beats, rest = divmod(cells * unit, division)
        if not rest:
            return MeterChange(0, beats, unit)
    return MeterChange(0, -(-cells * 16 // division), 16)


# --- letters ----------------------------------------------------------------------------------------------------------


def _lines(bars: Sequence[_Bar], cells: Sequence[_Cells], size: int) -> tuple[dict[str, str], tuple[str, ...]]:
    """The letters of all lines, `size` a bar, and what of the notes is not in them."""
    lines = {name: [_REST] * size * len(bars) for name in LETTERS}
    clicks = unknown = 0
    for index, (bar, places) in enumerate(zip(bars, cells, strict=True)):
        for (_, number, velocity), cell in zip(bar.notes, places.of_notes, strict=True):
            if number in METRONOME_NOTES and velocity != NORMAL_VELOCITY:
                clicks += 1
                continue
            name, letter = LOUD_LETTERS.get((number, velocity)) or MIDI_LETTERS.get(number, ("", ""))
            if not name or cell >= size:
                unknown += 1
                continue
            line, place = lines[name], index * size + cell
            line[place] = "X" if name == "K" and line[place] not in (_REST, letter) else letter
    told = ((clicks, "clicks of the metronome, left out"), (unknown, "notes that GrooveScribe has not, left out"))
    return {name: "".join(line) for name, line in lines.items()}, tuple(
        f"{text}: {count}" for count, text in told if count
    )
