"""Playing a lesson in: bars of the draft go round over the click, and each pass that was played is written.

What is recorded how says `TakeOptions`; the passes come from `LoopRecording`, and what they write is one edit each.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

from station.core.events import Hit
from station.drills.editing.grid_cursor import BarRange, Cursor, Place
from station.drills.editing.grid_page import PageGrid
from station.drills.editing.lesson_edits import LineAt, PlayedStroke, PlayIn
from station.drills.editing.played_hits import played_strokes
from station.drills.editing.take_options import TakeOptions
from station.drills.grid.stroke_settings import Velocities
from station.engine.messages import Command, EngineEvent
from station.music.score import Score
from station.practice.session.cues.click_pattern import PLAIN, ClickPattern
from station.practice.session.device_latency import Latency
from station.practice.session.loop_recording import LoopRecording, RecordedPass


@dataclass(frozen=True, slots=True)
class TakenStroke:
    """A stroke of the pass that sounds: where it was struck, between cells as it may be, and the letter it makes."""

    at: Cursor
    letter: str


@dataclass(frozen=True, slots=True)
class TakeView:
    """A recording that runs: which pass sounds, from 0, −1 in the count-in; where; what was struck in it so far."""

    pass_index: int
    place: Place | None = None
    strokes: tuple[TakenStroke, ...] = ()


@dataclass(frozen=True, eq=False)
class TakeSetting:
    """What is recorded over: `bars` of a `grid` and the `loop` that they are, at its tempo, and who hears it how late.

    `velocities` tell soft strokes from loud ones.
    """

    grid: PageGrid
    bars: BarRange
    loop: Score
    count_in_bars: int = 1
    velocities: Velocities = field(default_factory=Velocities)
    click: ClickPattern = PLAIN
    latency: Latency = field(default_factory=Latency)
    options: TakeOptions = field(default_factory=TakeOptions)


class TakeRecorder:
    """One recording, which begins at once; commands for the engine go through `send`, which may raise `DeviceError`."""

    def __init__(self, setting: TakeSetting, send: Callable[[Command], None]) -> None:
        self._setting, self._send = setting, send
        guide, bars = setting.options.guide, max(setting.count_in_bars, 1)
        self._recording = LoopRecording(setting.loop, setting.click, setting.latency, bars, guide)
        for command in self._recording.start():
            send(command)

    @property
    def is_over(self) -> bool:
        """Whether no more fits in."""
        return self._recording.over

    def handle(self, event: EngineEvent) -> None:
        """Take one event of the engine."""
        self._recording.handle(event)

    @property
    def bars(self) -> BarRange:
        """What is recorded over."""
        return self._setting.bars

    def hear(self, loop: Score) -> None:
        """Let what stands in the bars now sound from here on; may raise `DeviceError`."""
        for command in self._recording.with_loop(loop):
            self._send(command)

    def advance(self, now_ns: int) -> list[PlayIn]:
        """Move on; returns what is to be written of the passes that have ended."""
        self._recording.advance(now_ns)
        return [self._written(played) for played in self._recording.finished()]

    def stop(self) -> list[PlayIn]:
        """End it; returns what is to be written of the rest."""
        for command in self._recording.stop():
            self._send(command)
        return [self._written(played) for played in self._recording.rest()]

    def view(self) -> TakeView:
        """What is shown."""
        tick = self._recording.at_tick
        place = None if tick is None else self._place(tick)
        struck = self._strokes(self._recording.struck)
        return TakeView(self._recording.pass_index, place, tuple(self._taken(stroke) for stroke in struck))

    def _taken(self, stroke: PlayedStroke) -> TakenStroke:
        """Where a stroke is seen; one just before the first beat, which it is for, on that."""
        place = self._place(max(round(stroke.at_ticks), 0))
        return TakenStroke(Cursor(place.grid, place.bar, place.tick, stroke.line), stroke.letter)

    def _place(self, tick: int) -> Place:
        tempo_map = self._recording.loop.tempo_map
        bar = int(tempo_map.bars_at(tick))
        return Place(self._setting.bars.grid, self._setting.bars.first + bar, tick - tempo_map.bar_start(bar))

    def _strokes(self, hits: Sequence[Hit]) -> tuple[PlayedStroke, ...]:
        setting = self._setting
        lines = [line.at for line in setting.grid.lines if isinstance(line.at, LineAt)]
        return played_strokes(hits, setting.bars.grid, lines, setting.loop.tempo_map, setting.velocities)

    def _written(self, played: RecordedPass) -> PlayIn:
        """A pass that was cut off takes no bar's place: what was not reached stays as it stood."""
        bars, options = self._setting.bars, self._setting.options
        over = options.over or not played.is_whole
        return PlayIn(bars.grid, bars.first, bars.last, self._strokes(played.hits), options.quantise, over)
