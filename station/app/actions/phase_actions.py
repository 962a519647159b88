"""What the page of a motion and its phase may be asked."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class OpenMotion:
    """Track the motion by a model: a file of `station sync fit`, or a motion whose first cycle makes one."""

    model: Path
    motion: Path


@dataclass(frozen=True, slots=True)
class ChooseTriggers:
    """Let the phase trigger the sounds of this preset."""

    preset: str


@dataclass(frozen=True, slots=True)
class PlayMotion:
    """Let the motion go on, and sound, or stand."""

    on: bool


@dataclass(frozen=True, slots=True)
class SeekMotion:
    """Go to a time of the motion."""

    to_s: float


PhaseAction = OpenMotion | ChooseTriggers | PlayMotion | SeekMotion
