"""What the demonstration's player may be asked. Slots count from 0."""

from dataclasses import dataclass

from station.practice.demonstration.song_player import SongStep


@dataclass(frozen=True, slots=True)
class PlayOrStop:
    """Play where it stands, stand where it plays."""


@dataclass(frozen=True, slots=True)
class Seek:
    """Go to a time of the song."""

    at_ns: int


@dataclass(frozen=True, slots=True)
class GoToFlag:
    """Go to a flag, if it is kept."""

    slot: int


@dataclass(frozen=True, slots=True)
class KeepFlag:
    """Keep this place as a flag."""

    slot: int


@dataclass(frozen=True, slots=True)
class StepOnce:
    """A step on (1) or back (−1)."""

    way: int


@dataclass(frozen=True, slots=True)
class Wind:
    """Wind forward (1), backward (−1), or no longer (0)."""

    way: int


@dataclass(frozen=True, slots=True)
class SetSpeed:
    """How fast it goes, in percent; while the slider is `held` nothing sounds."""

    percent: int
    held: bool = False


@dataclass(frozen=True, slots=True)
class SetReverse:
    """Play backwards, or not."""

    reverse: bool


@dataclass(frozen=True, slots=True)
class SetStep:
    """How far a step goes."""

    step: SongStep


@dataclass(frozen=True, slots=True)
class SetDemoClick:
    """Let the click sound with the strokes, or the strokes alone."""

    click: bool


@dataclass(frozen=True, slots=True)
class SetCountIn:
    """Let a bar be counted before it plays, or not."""

    counts_in: bool


PlayerAction = (
    PlayOrStop
    | Seek
    | GoToFlag
    | KeepFlag
    | StepOnce
    | Wind
    | SetSpeed
    | SetReverse
    | SetStep
    | SetDemoClick
    | SetCountIn
)
