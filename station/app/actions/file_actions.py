"""What is written as a file: exports and films."""

from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path


class ExportKind(StrEnum):
    """What the chosen bars are written as."""

    MIDI = "midi"
    LESSON = "lesson"
    SHEET = "sheet"
    FILM = "film"
    LOOP = "loop"


@dataclass(frozen=True, slots=True)
class Export:
    """Write the chosen bars to a file."""

    kind: ExportKind


@dataclass(frozen=True, slots=True)
class FilmTake:
    """Film a take beside its capture."""

    capture: Path


@dataclass(frozen=True, slots=True)
class CancelFilm:
    """Give the video up."""


FileAction = Export | FilmTake | CancelFilm
