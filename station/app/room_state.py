"""What the window shows of the practice: a lesson's card, what was chosen, what surrounds the picture, a result."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import date
from enum import IntEnum
from pathlib import Path

import numpy as np

from station.drills.level_range import ANY_LEVEL, LevelRange
from station.practice.records.previous_session import NONE_KEPT, PreviousSession
from station.practice.session.cues.quiet_bars import QuietBars
from station.practice.session.rising_tempo import Rise
from station.render.report.result_facts import ResultFacts
from station.scenes.heat_map import HeatMap
from station.scenes.hit_table import DOT_DTYPE, EveryHit
from station.scenes.wrong_pads import WrongPad


@dataclass(frozen=True, slots=True)
class LessonCard:
    """A lesson as the list shows it; `bars` in its loop, `passes` as its author wants them.

    `level` 1–5 says how hard it is, `levels` how strictly it may be judged.
    `tempo_bpm` counts quarter notes, `beat_quarters` is how many make the beat that a teacher counts. `kind` is the
    folder that it ships in, empty for the user's own; `prerequisites` name the lessons that come before. Of
    a song (`is_song`) the tempo stays, for its sound has one.
    """

    name: str
    title: str
    level: int
    level_words: str
    about: str
    author: str
    tempo_bpm: float
    bars: int
    passes: int
    meter: str = "4/4"
    tags: tuple[str, ...] = ()
    beat_quarters: float = 1.0
    levels: LevelRange = ANY_LEVEL
    kind: str = ""
    prerequisites: tuple[str, ...] = ()
    is_song: bool = False

    @property
    def beats_a_minute(self) -> float:
        """The tempo in the lesson's own beat."""
        return self.tempo_bpm / self.beat_quarters


@dataclass(frozen=True, slots=True)
class SessionRequest:
    """What the user chose: a lesson by name, quarter notes a minute, passes, bars from 1 (None: the lesson's).

    With `adapt` the tempo follows the student from pass to pass, and `tempo_bpm` says nothing. Without
    `click` the score follows them within a pass; the two exclude each other. `gap` is where the click falls silent,
    None as the settings have it; with `rise` the tempo rises, which neither of the two allows.
    """

    lesson: str
    tempo_bpm: float
    loops: int
    bars: tuple[int, int] | None = None
    demonstrations: int | None = None
    adapt: bool = False
    click: bool = True
    gap: QuietBars | None = None
    rise: Rise | None = None


@dataclass(frozen=True, slots=True)
class FreeRequest:
    """Just play: beats a minute, and whether they click."""

    tempo_bpm: float
    click: bool = True


class Stage(IntEnum):
    """What the practice is doing."""

    IDLE = 0
    PLAYING = 1
    RESULT = 2


@dataclass(frozen=True, slots=True)
class PlaceNow:
    """Where a session is: `time_s` since its count-in began, `bar` and `beat` from 1, None where none is played."""

    time_s: float
    bar: int | None
    beat: int | None


@dataclass(frozen=True, slots=True)
class RoomState:
    """What surrounds the picture: `stage`, the kit and the sound in words, `progress` 0–1.

    `progress` None while nothing plays. `why` is the reason for the pass that is counted in, and `can_veto` whether the
    student may still refuse it. `question` is to be answered before the result is shown, empty where none is open.
    `take` is the capture of the last free take, None where there is none to be heard;
    `listening` while something sounds that was played or is written;
    `paused` while a session stands still, `can_pause` where it may. `clock` is where a session is, None outside;
    `free` where no lesson is chosen, to just play; `exam` while a piece is looked at or played for marks, or its result
    is shown; `battle` while one is chosen, runs, or its result is shown. `student` sent the result that is shown, empty
    for one's own. `lag_ms` is a lag of all strokes that the result leaves out until somebody says whose it is, None
    where there is none to be answered. `judged` is the level by
    which the lesson is judged, in words.
    """

    stage: Stage = Stage.IDLE
    kit: str = ""
    sound: str = ""
    progress: float | None = None
    why: str = ""
    can_veto: bool = False
    question: str = ""
    take: Path | None = None
    listening: bool = False
    clock: PlaceNow | None = None
    free: bool = False
    can_pause: bool = False
    paused: bool = False
    exam: bool = False
    battle: bool = False
    student: str = ""
    judged: str = ""
    lag_ms: float | None = None


@dataclass(frozen=True, eq=False)
class ShownResult:
    """The result of the last session: the page's `facts`, the JSON `document`, the `folder` of both.

    `heat` says how right each bar was, `hits` has every stroke, `before` is an earlier session of the lesson, or says
    why there is none to be compared with, `wrong_pads` says what was struck for what. `student` is who played, empty
    for whoever sits here; of a session of another day it is `day`.
    """

    facts: ResultFacts
    document: Mapping[str, object] = field(default_factory=dict)
    folder: str = ""
    heat: HeatMap = field(default_factory=lambda: HeatMap({}))
    hits: EveryHit = field(default_factory=lambda: EveryHit(np.empty(0, DOT_DTYPE)))
    before: PreviousSession | str = NONE_KEPT
    wrong_pads: tuple[WrongPad, ...] = ()
    student: str = ""
    day: date | None = None
