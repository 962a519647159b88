"""What is practised: which lesson and bars, and what a session may be asked.

Bars count from 0 where nothing else is said.
"""

from dataclasses import dataclass

from station.app.selection import Selection
from station.core.events import Hit
from station.engine.messages import KeyHit
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.session.self_estimate import SelfEstimate
from station.scoring.matching.hit_windows import Level

Bars = tuple[int, int] | None
"""First and last bar, from 0; None for the lesson's own."""


@dataclass(frozen=True, slots=True)
class Select:
    """Another choice of lesson, tempo, passes, or what is listed."""

    selection: Selection


@dataclass(frozen=True, slots=True)
class JudgeAt:
    """Judge the lesson of this name at `level` from now on."""

    lesson: str
    level: Level


@dataclass(frozen=True, slots=True)
class ChooseBars:
    """Repeat these bars on the player, and practise them."""

    bars: Bars


@dataclass(frozen=True, slots=True)
class TapBeat:
    """A tap of the tempo at a monotonic time."""

    at_ns: int


ChoiceAction = Select | JudgeAt | ChooseBars | TapBeat


@dataclass(frozen=True, slots=True)
class Begin:
    """Begin what is chosen, ending what runs."""


@dataclass(frozen=True, slots=True)
class Drill:
    """Practise one bar (from 1) of the lesson alone."""

    bar: int


@dataclass(frozen=True, slots=True)
class TakeStep:
    """Begin one (from 0) of what comes next beside a result."""

    place: int


@dataclass(frozen=True, slots=True)
class EndSession:
    """End the session; what was played is judged and kept."""


@dataclass(frozen=True, slots=True)
class Pause:
    """Pause the session, or go on; `strokes` are those that asked for it, where some did."""

    strokes: tuple[Hit, ...] = ()


@dataclass(frozen=True, slots=True)
class Veto:
    """Refuse what the next pass would change: the last one once more."""


@dataclass(frozen=True, slots=True)
class Answer:
    """What the student believes, where a question is open."""

    guess: SelfEstimate


@dataclass(frozen=True, slots=True)
class Dismiss:
    """The result was read: back to the lessons."""


@dataclass(frozen=True, slots=True)
class Leave:
    """Out of what goes on: a pad is not learnt, a session ends, a result was read, the demonstration stops."""


@dataclass(frozen=True, slots=True)
class Listen:
    """Hear the last free take, or end what is heard."""


@dataclass(frozen=True, slots=True)
class HearBar:
    """Hear and see a bar of the result's score, as it was written or played."""

    bar: int
    whose: Whose


@dataclass(frozen=True, slots=True)
class StrikeKey:
    """A stroke on the computer's keyboard."""

    hit: KeyHit


SessionAction = EndSession | Veto | Answer | Dismiss | Listen | HearBar
PracticeAction = Begin | Drill | TakeStep | Pause | Leave | StrikeKey | SessionAction
