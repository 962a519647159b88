"""Reading what the user names: a SCORE (lesson or music file), a PERFORMANCE (MIDI file or capture)."""

from pathlib import Path

from station.core.errors import BadInput
from station.music.score import Score

MIDI_ENDINGS = (".mid", ".midi", ".smf", ".kar")


def is_midi(name: str) -> bool:
    """Whether `name` ends as MIDI files do."""
    return Path(name).suffix.lower() in MIDI_ENDINGS


def load_score(name: str) -> Score:
    """The score that `name` means: a MIDI file by its ending, else a lesson by name or path."""
    if is_midi(name):
        from station.music.formats.smf import read_midi, score_from_midi

        return score_from_midi(read_midi(existing(name)))
    from station.drills.library import find_lesson

    return find_lesson(name).score


def existing(name: str) -> Path:
    """The path `name`; raises `BadInput` when there is no such file."""
    path = Path(name)
    if not path.is_file():
        raise BadInput(name, "", "is a folder, not a file" if path.is_dir() else "no such file")
    return path
