"""A lesson: a score to practise, and how to practise it. An immutable value; files are `lesson_file`'s business.

Bars count from 0 here and from 1 in files and on the screen. `tempo_bpm` counts quarter notes, as the whole station
does; `beat_ticks` is the beat that a teacher counts (a dotted quarter in 6/8).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Limb
from station.core.units import PPQ
from station.drills.band_sound import BandSound
from station.drills.grid.stroke_settings import Velocities
from station.drills.level_range import OF_DIFFICULTY, LevelRange
from station.music.score import NOTE_DTYPE, Score
from station.music.swing import STRAIGHT, Swing
from station.scoring.analysis.fault_table import Asked
from station.scoring.matching.hit_windows import Level

LEVELS: Mapping[int, str] = MappingProxyType(
    {1: "first steps", 2: "beginner", 3: "intermediate", 4: "advanced", 5: "expert"}
)

DEFAULT_PASSES = 8
"""Our choice: with loops of 2–4 bars about a minute of playing."""
DEFAULT_DEMONSTRATIONS = 2
"""TEACHING, Defaults: demonstrate twice."""


@dataclass(frozen=True, slots=True)
class PartGoals:
    """What is asked of one limb, or of some bars; None asks nothing beyond the lesson's own goals.

    `min_accuracy` share of the notes right, 0–1; `max_sd_ms` spread of the asynchronies about each piece's lean;
    `max_lean_ms` how far their mean may lie from the written time; `max_loudness_error_db` the mean distance from the
    written loudness; `max_tempo_error_pct` how far the tempo played may lie from the click's.
    """

    min_accuracy: float | None = None
    max_sd_ms: float | None = None
    max_lean_ms: float | None = None
    max_loudness_error_db: float | None = None
    max_tempo_error_pct: float | None = None


@dataclass(frozen=True, slots=True)
class BarGoals:
    """What is asked of bars `first_bar` to `last_bar`, from 0, inclusive."""

    first_bar: int
    last_bar: int
    goals: PartGoals


@dataclass(frozen=True, slots=True)
class Goals:
    """When the lesson is mastered; None leaves a goal to the level and the station's own policy.

    `min_accuracy` share of the notes right, 0–1; `max_sd_ms` spread of the asynchronies; `max_lean_ms` how far their
    mean may lie from the written time (feel is free unless this asks); `max_loudness_error_db` the mean distance from
    the written loudness; `max_swing_error` how far the swing ratio may lie from the lesson's; `target_tempo_bpm`
    quarter notes a minute, the written tempo if None; `min_score` 0–100. `level` how strictly a student is judged who
    begins, `strictest_level` how strictly anybody is; `faults` the sizes from which the teacher minds faults, where
    they are not the usual ones; `limbs` and `bars` what is asked of them besides.
    """

    min_accuracy: float | None = None
    max_sd_ms: float | None = None
    max_lean_ms: float | None = None
    max_swing_error: float | None = None
    target_tempo_bpm: float | None = None
    min_score: float | None = None
    level: Level | None = None
    strictest_level: Level = Level.STUDIO
    faults: Asked = field(default_factory=Asked)
    limbs: Mapping[Limb, PartGoals] = field(default_factory=lambda: MappingProxyType({}))
    bars: tuple[BarGoals, ...] = ()
    max_loudness_error_db: float | None = None


@dataclass(frozen=True, slots=True)
class Section:
    """A run of bars as it is played, such as "groove" or "fill": bars `first_bar` to `last_bar` inclusive, from 0.

    A section that the form plays twice stands here twice; `name` may be empty. `grid` is the grid of the file, from 0,
    whose bars it repeats.
    """

    name: str
    first_bar: int
    last_bar: int
    swing: Swing = field(default_factory=Swing)
    grid: int = 0


@dataclass(frozen=True, slots=True)
class BarCue:
    """What happens from the start of `bar` (from 0, as played) on: words of the teacher, a camera, a style.

    `say` stands until the next words, or as long as `SAY_BARS`; `camera` names a view and `style` a style of the
    drummer, each until another cue changes it; empty changes nothing.
    """

    bar: int
    say: str = ""
    camera: str = ""
    style: str = ""


SAY_BARS = 2
"""Bars for which a teacher's words stand unless others follow: time to read a sentence at any tempo (our choice)."""


@dataclass(frozen=True, slots=True, eq=False)
class Lesson:
    """One lesson.

    `name` is the file's stem; `level` 1–5 (`LEVELS`) how hard it is; `loop` the first and last bar that are practised,
    from 0, inclusive; `passes` how often the loop is played; `demonstrations` how often the drummer plays it first;
    `kit` a kit file's name, empty for the player's own; `sections` cover all bars in order, as the form plays them.
    `swing` is the first section's. `cues` are in the order of their bars. `prerequisites` name the lessons that come
    before; `hints` say by a fault's word what helps against it; `landing` (n,) of `NOTE_DTYPE`, its ticks 0, is struck
    where the last loop ends, empty where nothing is. `text` is what its file says, empty where it comes from none.
    A song has a `band`, which it is played along to, and whose tempo moves with every beat: `mean_bpm`, quarter notes a
    minute, stands for it, where None the tempo of the first bar.
    """

    name: str
    title: str
    score: Score
    author: str = ""
    level: int = 1
    about: str = ""
    tags: tuple[str, ...] = ()
    kit: str = ""
    loop: tuple[int, int] = (0, 0)
    passes: int = DEFAULT_PASSES
    count_in_bars: int = 1
    demonstrations: int = DEFAULT_DEMONSTRATIONS
    goals: Goals = field(default_factory=Goals)
    swing: Swing = field(default_factory=Swing)
    beat_ticks: int = PPQ
    sections: tuple[Section, ...] = ()
    velocities: Velocities = field(default_factory=Velocities)
    cues: tuple[BarCue, ...] = ()
    prerequisites: tuple[str, ...] = ()
    hints: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    landing: NDArray[np.void] = field(default_factory=lambda: np.zeros(0, NOTE_DTYPE))
    text: str = field(default="", repr=False)
    band: BandSound | None = None
    mean_bpm: float | None = None

    @property
    def tempo_bpm(self) -> float:
        """Tempo of the first bar in quarter notes a minute, as it was written; of a song its mean."""
        return self.mean_bpm or self.score.tempo_map.tempos[0].short_bpm()

    @property
    def beats_a_minute(self) -> float:
        """The same in the lesson's own beat."""
        if self.mean_bpm is not None:
            return self.mean_bpm * PPQ / self.beat_ticks
        return self.score.tempo_map.tempos[0].short_bpm(self.beat_ticks / PPQ)

    @property
    def target_tempo_bpm(self) -> float:
        """The tempo to reach, in quarter notes a minute."""
        return self.goals.target_tempo_bpm or self.tempo_bpm

    @property
    def levels(self) -> LevelRange:
        """The levels at which it may be judged."""
        return LevelRange(self.goals.level or OF_DIFFICULTY[self.level], self.goals.strictest_level)

    @property
    def swing_ratio(self) -> float:
        """Long to short, 1 where nothing swings."""
        return self.swing.ratio

    @property
    def is_swung(self) -> bool:
        """Whether offbeats come late."""
        return self.swing.ratio != STRAIGHT

    @property
    def beyond(self) -> NDArray[np.void]:
        """The strokes of the music that this player cannot make besides, written `*`: shown, never asked."""
        return self.score.beyond

    def passes_of(self, bars: tuple[int, int]) -> int:
        """How often `bars` (first, last, from 0) are played: some bars of a song that is played once come again."""
        return DEFAULT_PASSES if self.band is not None and bars != self.loop else self.passes

    @property
    def loop_score(self) -> Score:
        """The bars of the loop, moved to tick 0."""
        return self.score.bars(*self.loop)

    def landing_after(self, bar: int) -> NDArray[np.void]:
        """What is struck where `bar`, from 0, was the last that was played: the landing where the loop ends with it."""
        return self.landing if bar == self.loop[1] else self.landing[:0]

    @property
    def played_once(self) -> Score:
        """All bars as they are written, and the landing after them where the loop ends with the last one."""
        return self.score.landing_on(self.landing_after(self.score.bar_count - 1))

    @property
    def meter(self) -> str:
        """Meter of the first bar, such as 4/4."""
        return str(self.score.tempo_map.meter_at(0))

    @property
    def part_of_bar(self) -> Mapping[int, str]:
        """The name of the section of each bar, from 0, as far as it has one; empty where all bars are of one name."""
        if len({section.name for section in self.sections}) < 2:
            return {}
        return {bar: s.name for s in self.sections if s.name for bar in range(s.first_bar, s.last_bar + 1)}
