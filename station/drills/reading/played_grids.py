"""A lesson as it is played: its grids in the order of the form, each repetition a run of ticks and bars.

What depends on where a grid is played is worked out here: ticks and bars, sections, meters, tempi, cues. A *turn* is
one entry of the form: all repetitions of a grid, with the endings between them.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import chain, groupby

from station.core.toml.toml_faults import wrong
from station.drills.grid.cell_strokes import WrittenCell
from station.drills.grid.grid_reader import GridSection
from station.drills.grid.line_group import MAX_BARS
from station.drills.lesson import BarCue, Section
from station.drills.reading.bar_cues import GridCue
from station.drills.reading.form import WrittenGrid, ending_word, repetitions
from station.drills.reading.form_order import Turn
from station.drills.reading.tempo_marks import STEPS_A_BEAT, Ramp, TempoMark, marked_tempos
from station.music.tempo import MeterChange, TempoChange

MAX_STROKES = 20_000
"""Half an hour at ten strokes a second; a session with more takes longer to prepare than anyone waits (our choice)."""
MAX_STEPS = 20_000
"""Steps of all ramps, 5000 beats: more than the longest lesson in quarters needs in half an hour (our choice)."""

MAX_CUES = 2 * MAX_BARS
"""Two for every bar of the longest lesson (our choice)."""


@dataclass(frozen=True, slots=True)
class ReadGrid:
    """One grid: as it is `written`, the `section` that was read of it, and what happens at its bars."""

    written: WrittenGrid
    section: GridSection
    cues: Sequence[GridCue] = ()

    @property
    def has_own_tempo(self) -> bool:
        """Whether it says a tempo: an ending that does not goes on with that of its grid."""
        raw = self.written.raw
        return isinstance(raw, dict) and not raw.keys().isdisjoint(("tempo_bpm", "tempo_to_bpm"))


@dataclass(frozen=True, slots=True)
class PlayedGrid:
    """One repetition (from 0) of a grid in the given `turn` of an `entry` of the form.

    It says where it begins, and the name that its section has.
    """

    grid: ReadGrid
    repetition: int
    turn: int
    entry: int
    start_tick: int
    first_bar: int
    name: str

    @property
    def end_tick(self) -> int:
        """Where the next one begins."""
        return self.start_tick + self.grid.section.length_ticks

    @property
    def last_bar(self) -> int:
        """Its last bar, from 0."""
        return self.first_bar + self.grid.section.bar_count - 1

    @property
    def strokes(self) -> list[WrittenCell]:
        """What is struck in it."""
        return self.grid.section.repetition(self.repetition, self.start_tick)


def check_size(bars: int, strokes: int, grid: WrittenGrid) -> None:
    """Raise `Wrong` at the grid where a lesson has more bars or strokes up to here than anyone practises."""
    if bars > MAX_BARS:
        raise wrong(f"{bars} bars up to here; a lesson has at most {MAX_BARS}", *grid.path)
    if strokes > MAX_STROKES:
        raise wrong(f"{strokes} strokes up to here; a lesson has at most {MAX_STROKES}", *grid.path)


def laid_out(order: Sequence[Turn], grids: Sequence[ReadGrid]) -> list[PlayedGrid]:
    """All that is played, turn by turn; raises `Wrong` where it is more than anyone practises."""
    played: list[PlayedGrid] = []
    tick = bars = strokes = 0
    for number, turn in enumerate(order):
        main = turn.grid
        name = grids[main].written.name
        for index, repetition in repetitions(main, [g.written for g in grids], [g.section.times for g in grids]):
            grid = grids[index]
            called = name if index == main else grid.written.name or (name and f"{name}, {ending_word(grid.written)}")
            played.append(PlayedGrid(grid, repetition, number, turn.entry, tick, bars, called))
            tick, bars = played[-1].end_tick, bars + grid.section.bar_count
            strokes += len(grid.section.parts[repetition])
            check_size(bars, strokes, grid.written)
    return played


def sections_of(played: Sequence[PlayedGrid]) -> tuple[Section, ...]:
    """The sections that the report speaks of: repetitions of a grid that follow each other in an entry are one."""
    runs = [list(run) for _, run in groupby(played, lambda s: (s.entry, id(s.grid)))]
    return tuple(_section(run[0], run[-1]) for run in runs)


def _section(first: PlayedGrid, last: PlayedGrid) -> Section:
    swing, written = first.grid.section.timing.swing, first.grid.written
    return Section(first.name, first.first_bar, last.last_bar, swing, written.number)


def cues_of(played: Sequence[PlayedGrid]) -> tuple[BarCue, ...]:
    """The words, cameras and styles of all bars in order; raises `Wrong` where they are more than anyone reads."""
    cues: list[BarCue] = []
    for each in played:
        here = (cue for cue in each.grid.cues if cue.is_in(each.repetition))
        cues += [cue.at_bar(each.first_bar) for cue in here if cue.say or cue.camera or cue.style]
        if len(cues) > MAX_CUES:
            text = f"{len(cues)} words, cameras and styles as played up to here; a lesson has at most {MAX_CUES}"
            raise wrong(text, *each.grid.written.path)
    return tuple(cues)


def meters_of(played: Sequence[PlayedGrid]) -> list[MeterChange]:
    """The meter of every bar."""
    return list(chain.from_iterable(s.grid.section.bars_at(s.start_tick) for s in played))


def tempos_of(played: Sequence[PlayedGrid]) -> list[TempoChange]:
    """Every change of tempo; raises `Wrong` where ramps have more steps than anyone hears."""
    tempos: list[TempoChange] = []
    for _, turn in groupby(played, lambda s: s.turn):
        for change in _turn_tempos(list(turn)):
            tempos.append(change)
            if len(tempos) > MAX_STEPS:
                text = f"the tempo changes {STEPS_A_BEAT} times a beat; a lesson has at most {MAX_STEPS} changes"
                raise wrong(text, *turn_path(played, change.tick))
    return tempos


def turn_path(played: Sequence[PlayedGrid], tick: int) -> tuple[str | int, ...]:
    """The path of the grid that is played at `tick`."""
    return next(s for s in reversed(played) if s.start_tick <= tick).grid.written.path


def _turn_tempos(turn: Sequence[PlayedGrid]) -> Iterator[TempoChange]:
    """The tempo over a turn: one line over all of them, but for endings with a tempo of their own."""
    main = turn[0]
    whole = _ramp(main, turn[-1].end_tick)
    for each in turn:
        is_own = each.grid is not main.grid and each.grid.has_own_tempo
        ramp, owner = (_ramp(each, each.end_tick), each) if is_own else (whole, main)
        marks = [
            TempoMark(each.start_tick + cue.tempo.tick, cue.tempo.tempo_bpm, cue.tempo.tempo_to_bpm)
            for cue in each.grid.cues
            if cue.tempo and cue.is_in(each.repetition)
        ]
        beat_ticks = owner.grid.section.timing.beat_ticks
        yield from marked_tempos(ramp, marks, each.start_tick, each.end_tick, beat_ticks)


def _ramp(each: PlayedGrid, end: int) -> Ramp:
    timing = each.grid.section.timing
    return Ramp(each.start_tick, end, timing.tempo_bpm, timing.tempo_to_bpm or timing.tempo_bpm)
