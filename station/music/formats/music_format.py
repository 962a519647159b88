"""What a file format of music is to the station: its endings, a function each way, and what it keeps.

The table of what a format keeps is law: what it names comes back from the station's own files unchanged, unless the
writer said of this very part that something was lost (`WrittenFile.lost`). The tests ask just that, and the page about
formats is made of it.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from enum import StrEnum

from station.music.drum_part import DrumPart


class Feature(StrEnum):
    """What a part may have, and a format may keep."""

    TIMES = "times"
    PIECES = "pieces"
    TEMPO = "tempo and its changes"
    METERS = "meters"
    METER_GROUPS = "groups of meters"
    BEAT = "counted beat"
    SWING = "swing"
    VELOCITIES = "velocities"
    DYNAMICS = "ghosts and accents"
    ZONES = "rims, bells and edges"
    CROSS_STICKS = "cross-sticks"
    RIM_SHOTS = "rim shots"
    OPENNESS = "how open the hi-hat is"
    FOOT_SPLASHES = "splashes of the hi-hat foot"
    FLAMS = "flams"
    DRAGS = "drags"
    GRACE_SPACING = "spacing and loudness of grace strokes"
    DIDDLES = "diddles and open rolls"
    BUZZES = "buzz rolls and how long they last"
    CHOKES = "chokes"
    STICKING = "sticking of the hands"
    FEET = "which foot plays"
    LOUDNESS = "loudness marks and hairpins"
    TITLE = "title"
    AUTHOR = "author"
    ABOUT = "what it says of itself"
    SECTIONS = "names of sections"
    TIMING = "each stroke's own timing"


@dataclass(frozen=True, slots=True)
class Loss:
    """What a part has and the file that was written of it has not: `text` says it in a sentence, with its bar."""

    feature: Feature
    text: str


@dataclass(frozen=True, slots=True)
class WrittenFile:
    """The bytes of a file, and what of the part is not in them."""

    data: bytes
    lost: tuple[Loss, ...] = ()


@dataclass(frozen=True, slots=True)
class MusicFormat:
    """One format.

    `read` takes a file's bytes and its name, raises `BadInput` with the name and the place of a fault, and nothing
    else, whatever the bytes are. `recognises` says of bytes under one of `endings` whether they are of this format: of
    several with the same ending the first that does reads it. `write` is None where nothing is written in it; it
    raises `BadInput` where the format has no place for the part at all. `keeps` has the features that a written file
    keeps, each with what limits it ("" where nothing does); what it does not have is lost.
    """

    name: str
    endings: tuple[str, ...]
    read: Callable[[bytes, str], DrumPart]
    recognises: Callable[[bytes], bool]
    most_bytes: int
    write: Callable[[DrumPart], WrittenFile] | None = None
    keeps: Mapping[Feature, str] | None = None
