"""Everything that one picture shows, as an immutable value.

The practice session fills snapshots; the window and the off-screen picture draw the same one. Score time is seconds
from the score's tick 0; asynchronies are played − written, negative is early.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.core.pieces import Limb, Piece
from station.core.units import PPQ
from station.motion.kinematics.figure import Figure
from station.motion.kinematics.pose import Pose
from station.motion.kit.kit import Kit
from station.music.judgement import OF_LONE_HITS, Judgement
from station.music.performance import Performance
from station.music.score import Score
from station.render.camera import Camera

PENDING = -1
"""The label of a note that is not judged yet."""

MARK_DTYPE = np.dtype([("label", np.int8), ("asynchrony_ms", np.float32), ("velocity_error", np.float32)])
"""A note's judgement: `Label` or `PENDING`; played − written, NaN where nothing was played."""


ON_TIME_MS = 25.0
"""Within this a stroke is on time where no level says otherwise (HUMANS: mild to 25 ms)."""


class TimingCue(IntEnum):
    """The one coarse live cue: what the last strokes were like."""

    NONE = 0
    ON_TIME = 1
    EARLY = 2
    LATE = 3
    MISSED = 4
    WRONG_PIECE = 5


@dataclass(frozen=True, slots=True)
class SeenStrike:
    """A stroke that somebody played `age_s` ago; `student` tells the student's from the demonstrator's."""

    piece: Piece
    velocity: int
    age_s: float
    student: bool = True


@dataclass(frozen=True, slots=True)
class LimbParting:
    """How a limb of the student parted from the demonstrator's; `strength` falls from 1 to 0 as it fades."""

    cue: TimingCue
    strength: float


@dataclass(frozen=True, eq=False)
class StudentShown:
    """The student as a second, translucent drummer, and the limbs that glow for they part from the demonstrator's.

    `is_compared` where the picture is there for them: it shows them whatever the options say of the double.
    """

    pose: Pose
    partings: Mapping[Limb, LimbParting] = field(default_factory=dict)
    is_compared: bool = False


@dataclass(frozen=True, slots=True)
class ExtraHit:
    """A hit that answers no note: at `time_s` of the score on `piece`."""

    time_s: float
    piece: Piece


@dataclass(frozen=True, eq=False)
class OnStage:
    """Who plays beside the drummer of a snapshot: kit, body and pose in their own axes, and what they struck.

    They stand in so much `light`, 1 in the spotlight … 0 where it is on the other.
    """

    kit: Kit
    figure: Figure
    pose: Pose | None = None
    strikes: tuple[SeenStrike, ...] = ()
    light: float = 1.0


@dataclass(frozen=True, slots=True)
class SideLine:
    """What the score line says of one of two drummers: who it is, points in words, lives and rounds won.

    `lives` left of `most_lives`, which is 0 where nobody has any; `is_playing` while it is their turn.
    """

    name: str
    points: str = ""
    lives: int = 0
    most_lives: int = 0
    won: int = 0
    is_playing: bool = False


@dataclass(frozen=True, slots=True)
class ScoreLine:
    """Two drummers' standings, the first on the left, and between them `words` such as "Round 2 of 5"."""

    sides: tuple[SideLine, SideLine]
    words: str = ""


@dataclass(frozen=True, slots=True)
class Hud:
    """What is written over the picture.

    `phase` in words such as "Demonstration" or "Pass 2 of 4"; `bar` and `beat` from 1, None while nothing runs; `beats`
    a bar; `count_in` the number to show large, None outside a count-in; `right`, `judged` this pass's counts; `message`
    a sentence for the user; `cue` with `cue_age_s` since it came; `say` the words of the lesson's teacher.
    `tempo_words` explain the tempo, `reason` why the pass is as it is. While nothing moves `halt` is the word to show
    large, such as "Paused", and `way_on` how to go on. Where there are `standings` they take the place of title, phase
    and tempo.
    """

    title: str = ""
    phase: str = ""
    bar: int | None = None
    beat: int | None = None
    beats: int = 4
    bar_count: int = 0
    beats_a_minute: float | None = None
    count_in: int | None = None
    right: int = 0
    judged: int = 0
    message: str = ""
    cue: TimingCue = TimingCue.NONE
    cue_age_s: float = 0.0
    say: str = ""
    tempo_words: str = ""
    reason: str = ""
    halt: str = ""
    way_on: str = ""
    standings: ScoreLine | None = None


def no_marks(score: Score) -> NDArray[np.void]:
    """Marks of a score of which no note is judged yet, shape (n,), dtype `MARK_DTYPE`."""
    marks = np.zeros(len(score), MARK_DTYPE)
    marks["label"] = PENDING
    marks["asynchrony_ms"] = marks["velocity_error"] = np.nan
    return marks


def mark(marks: NDArray[np.void], judgement: Judgement, loudness: bool = True) -> None:
    """Write one judgement of a note into `marks`; hits that answer no note change nothing.

    Without `loudness` nothing is said of how hard the hit was.
    """
    if judgement.note_index is None or judgement.label in OF_LONE_HITS:
        return
    row = marks[judgement.note_index : judgement.note_index + 1]
    row["label"] = judgement.label
    row["asynchrony_ms"] = np.nan if judgement.asynchrony_ns is None else judgement.asynchrony_ns / 1e6
    row["velocity_error"] = np.nan if judgement.velocity_error is None or not loudness else judgement.velocity_error


@dataclass(frozen=True, slots=True)
class BarNumbers:
    """How a score's bars are numbered: from `first` (from 0), anew after every `per_pass` bars, `passes` times.

    0 bars: never; without `passes`: always. What follows the last pass is numbered on from there. `sections` are names
    by the bar of a pass, from 0, where they begin.
    """

    first: int = 0
    per_pass: int = 0
    passes: int | None = None
    sections: tuple[tuple[int, str], ...] = ()

    def of(self, bar: int) -> int:
        """The number, from 1, of the score's `bar`, from 0."""
        before = bar // self.per_pass if self.per_pass else 0
        if self.passes is not None:
            before = min(before, self.passes - 1)
        return self.first + bar - before * self.per_pass + 1

    def section_of(self, bar: int) -> str:
        """The name of what begins with the score's `bar`, from 0; empty where nothing does."""
        number, within = divmod(bar, self.per_pass) if self.per_pass else (0, bar)
        is_played = self.passes is None or number < self.passes
        return next((name for at, name in self.sections if at == within and is_played), "")


@dataclass(frozen=True, eq=False)
class Strip:
    """Strokes that nobody has written or judges: what was `played`, in the snapshot's time, and how long a beat lasts.

    `beat_s` None where there is no click; a bar has `beats`.
    """

    played: Performance
    beat_s: float | None = None
    beats: int = 4


@dataclass(frozen=True, slots=True, eq=False)
class TakeSpelling:
    """How a score that is shown as it was played is written: where each stroke stands, `tick` of shape (n,), straight.

    `meant` is the music on the grid, which says how it swings.
    """

    tick: NDArray[np.int64]
    meant: Score


@dataclass(frozen=True, eq=False)
class Snapshot:
    """One instant of the practice room.

    `position_s` is the score's time at the play line, negative in a count-in. `marks` (n,) of `MARK_DTYPE` belongs to
    the rows of `score`; nobody writes to it after it was put here. `limbs` (n,) of `Limb` shows the sticking, None what
    the score says. Written tempi count beats of `beat_ticks`; `spelling` is how a take is written. `pose` None draws
    the kit alone. Where there is a `strip`, it stands in place of the score. `double` is the student beside the
    demonstrator, for those who want to see it. `comes_again`: after the score's end its first bars come once more, in
    this picture's score or in the next one's; `before` is the score that was played before this one, None where none
    was. `is_replay`: what was played is heard again, to be studied. So far from its note a stroke is shown as on time
    as `on_time_ms` says, the student's level. `view` is from where the lesson's teacher wants it to be seen, None where
    they leave it to whoever looks.

    `rival` is who plays beside the drummer in the same room; either stands in so much `light`, and behind both a crowd
    moves with the beat, which is at `crowd_beat`, None for no crowd. Such a scene is seen from its `camera`, unless
    whoever looks has one of their own.
    """

    score: Score
    position_s: float
    kit: Kit
    figure: Figure
    pose: Pose | None = None
    limbs: NDArray[np.int8] | None = None
    marks: NDArray[np.void] | None = None
    extras: tuple[ExtraHit, ...] = ()
    strikes: tuple[SeenStrike, ...] = ()
    hud: Hud = field(default_factory=Hud)
    bar_numbers: BarNumbers = BarNumbers()
    beat_ticks: int = PPQ
    spelling: TakeSpelling | None = None
    strip: Strip | None = None
    double: StudentShown | None = None
    comes_again: bool = False
    before: Score | None = None
    is_replay: bool = False
    on_time_ms: float = ON_TIME_MS
    view: NamedView | None = None
    rival: OnStage | None = None
    light: float = 1.0
    crowd_beat: float | None = None
    camera: Camera | None = None
