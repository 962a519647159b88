"""What is written as a file and read from one: exports, films, imports."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Export:
    """Write the chosen bars to a file that ends in `ending` (".mid", ".pdf", ".mp4" …), which says what it is."""

    ending: str


@dataclass(frozen=True, slots=True)
class ExportTake:
    """Write what was played as MIDI beside its capture."""

    capture: Path


@dataclass(frozen=True, slots=True)
class FilmTake:
    """Film a take beside its capture."""

    capture: Path


@dataclass(frozen=True, slots=True)
class CancelFilm:
    """Give the video up."""


FileAction = Export | ExportTake | FilmTake | CancelFilm


@dataclass(frozen=True, slots=True)
class Import:
    """Make a lesson of a music file, a take, a song's folder or a link, or keep a lesson file, and choose it."""

    source: str


@dataclass(frozen=True, slots=True)
class CancelImport:
    """Import nothing of what is being read and waits."""


ImportAction = Import | CancelImport
