"""What the window shows and asks for: a pure view over whoever practises behind it.

The window calls `PracticeModel` once a frame and whenever the user does something; it keeps no state of the practice
and starts no thread. Faults of the user's or the world's come as `StationError` and are shown in one line.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol

import numpy as np

from station.app.calibration_desk import CalibrationDesk
from station.app.deck import Deck
from station.app.demonstrator import Demonstrator
from station.app.every_hit import DOT_DTYPE, EveryHit
from station.app.graphed import Graphed
from station.app.habits import HabitDesk
from station.app.heat_map import HeatMap
from station.app.kit_desk import KitDesk
from station.app.welcome import Answers
from station.app.wrong_pads import WrongPad
from station.engine.messages import KeyHit
from station.motion.hand_notes import Hands
from station.motion.style import Style
from station.music.score import Score
from station.practice.by_ear import Whose
from station.practice.earlier import NONE_KEPT, Earlier
from station.practice.own_ear import Guess
from station.render.results import ResultFacts
from station.render.snapshot import Snapshot


@dataclass(frozen=True, slots=True)
class LessonCard:
    """A lesson as the list shows it; `level` 1–5, `bars` in its loop, `passes` as its author wants them.

    `tempo_bpm` counts quarter notes, `beat_quarters` is how many make the beat that a teacher counts.
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

    @property
    def beats_a_minute(self) -> float:
        """The tempo in the lesson's own beat."""
        return self.tempo_bpm / self.beat_quarters


@dataclass(frozen=True, slots=True)
class Start:
    """What the user chose: a lesson by name, quarter notes a minute, passes, bars from 1 (None: the lesson's).

    With `adapt` the tempo follows the student from pass to pass, and `tempo_bpm` says nothing. Without
    `click` the score follows him within a pass; the two exclude each other.
    """

    lesson: str
    tempo_bpm: float
    loops: int
    bars: tuple[int, int] | None = None
    demonstrations: int | None = None
    adapt: bool = False
    click: bool = True


@dataclass(frozen=True, slots=True)
class FreeWish:
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
    """What surrounds the picture: `stage`, the kit and the sound in words, `notices` newest last, `progress` 0–1.

    `progress` None while nothing plays. `why` is the reason for the pass that is counted in, and `can_veto` whether the
    student may still refuse it. `question` is to be answered before the result is shown, empty where none is open.
    `has_take` where the last free take can be heard, `listening` while something sounds that was played or is written;
    `paused` while a session stands still, `can_pause` where it may. `clock` is where a session is, None outside;
    `free` where no lesson is chosen, to just play.
    """

    stage: Stage = Stage.IDLE
    kit: str = ""
    sound: str = ""
    notices: tuple[str, ...] = ()
    progress: float | None = None
    why: str = ""
    can_veto: bool = False
    question: str = ""
    has_take: bool = False
    listening: bool = False
    clock: PlaceNow | None = None
    free: bool = False
    can_pause: bool = False
    paused: bool = False


@dataclass(frozen=True, eq=False)
class Report:
    """The result of the last session: the page's `facts`, the JSON `document`, the `folder` of both.

    `heat` says how right each bar was, `hits` has every stroke, `before` is an earlier session of the lesson, or says
    why there is none to be compared with, `wrong_pads` says what was struck for what.
    """

    facts: ResultFacts
    document: Mapping[str, object] = field(default_factory=dict)
    folder: str = ""
    heat: HeatMap = field(default_factory=lambda: HeatMap({}))
    hits: EveryHit = field(default_factory=lambda: EveryHit(np.empty(0, DOT_DTYPE)))
    before: Earlier | str = NONE_KEPT
    wrong_pads: tuple[WrongPad, ...] = ()


class PracticeModel(Protocol):
    """What practises behind the window; `deck` plays the chosen lesson's demonstration between sessions."""

    deck: Deck

    def snapshot(self, now_ns: int) -> Snapshot:
        """What is to be seen at monotonic time `now_ns`."""
        ...

    def room(self) -> RoomState:
        """What is going on."""
        ...

    def first_card(self) -> LessonCard:
        """The lesson that is chosen when the window opens, which is there sooner than all others."""
        ...

    def lessons(self) -> Sequence[LessonCard]:
        """Every lesson that can be chosen, in the order in which they are shown; the first call takes a moment."""
        ...

    def first(self) -> Start | None:
        """What is chosen when the window opens; None leaves it to the list."""
        ...

    def preview(self, wish: Start | None) -> None:
        """Show what is chosen, before it begins, None the kit alone for just playing; raises `StationError`."""
        ...

    def start(self, wish: Start) -> None:
        """Begin a session; raises `StationError`."""
        ...

    def just_play(self, wish: FreeWish) -> None:
        """Begin a free take; raises `StationError`."""
        ...

    def listen(self) -> None:
        """Hear the last free take, or end what is heard; raises `StationError`."""
        ...

    def hear_bar(self, bar: int, whose: Whose) -> None:
        """Hear and see a bar (from 0) of the result's score, as it was written or played; raises `StationError`."""
        ...

    def pause(self) -> None:
        """Pause the session, or go on."""
        ...

    def wants_start(self) -> bool:
        """Whether the kit has asked for what Enter starts; said once."""
        ...

    def measure(self, by: str, distance_m: float) -> None:
        """Begin to measure how late the devices are, one of `measuring`'s ways; raises `StationError`."""
        ...

    def trust_measured(self) -> None:
        """Subtract what is stored of the devices from now on; raises `StationError`."""
        ...

    def veto(self) -> None:
        """Refuse what the next pass would change: it is as the last one was."""
        ...

    def stop(self) -> None:
        """End the session early; its result is kept."""
        ...

    def key(self, hit: KeyHit) -> None:
        """A stroke on the computer's keyboard."""
        ...

    def report(self) -> Report | None:
        """The result of the session that ended last, None before the first and while a question is open."""
        ...

    def graphed(self) -> Graphed | None:
        """What the graph shows, None for nothing."""
        ...

    def answer(self, guess: Guess) -> None:
        """What the student believes, where a question is open."""
        ...

    def score(self) -> Score:
        """The whole score of the lesson that is shown, at its own tempo."""
        ...

    def demonstrator(self) -> Demonstrator:
        """Who demonstrates."""
        ...

    def move_as(self, style: Style) -> None:
        """Let the demonstrator move in another style at once; hands hold as before while a pass is played."""
        ...

    def embody(self, figure: str) -> None:
        """Let another body demonstrate from the next preview or session on: a name or file; raises `BadInput`."""
        ...

    def hands(self) -> Hands:
        """Whose hand leads."""
        ...

    def lead_with(self, hands: Hands) -> None:
        """Let another hand lead from the next preview or session on."""
        ...

    def meet(self, answers: Answers) -> None:
        """Who plays, what is heard and whose hand leads, from now on; raises `StationError`."""
        ...

    @property
    def desk(self) -> KitDesk:
        """The kits that are here, as the devices page shows and sets them."""
        ...

    @property
    def calibration(self) -> CalibrationDesk:
        """What measures how late the devices are."""
        ...

    @property
    def habits(self) -> HabitDesk:
        """How the student likes sessions to go."""
        ...

    def dismiss(self) -> None:
        """The result was read: back to the lessons."""
        ...
