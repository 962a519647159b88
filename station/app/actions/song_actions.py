"""What the page of a song and its sound may be asked. Bars and beats count from 1, seconds are the sound's own."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class OpenSong:
    """Bring a part and a sound file together; `sound` is empty for a song file, or a folder that brings its own."""

    part: str
    sound: str = ""


@dataclass(frozen=True, slots=True)
class BringSound:
    """A sound file was dropped: the sound of the song that is made."""

    sound: str


@dataclass(frozen=True, slots=True)
class SetPoint:
    """The band plays `beat` of `bar` at `at_s`, in place of what was said of that beat."""

    bar: int
    beat: float
    at_s: float


@dataclass(frozen=True, slots=True)
class MovePoint:
    """Move the point at `index` by `by_s`."""

    index: int
    by_s: float


@dataclass(frozen=True, slots=True)
class SnapPoint:
    """Move the point at `index` to the onset that is meant: strong, and near."""

    index: int


@dataclass(frozen=True, slots=True)
class RemovePoint:
    """Forget the point at `index`."""

    index: int


@dataclass(frozen=True, slots=True)
class PlaySong:
    """Let the song sound from `from_s` on, with a click on its beats where `clicks`; None for silence."""

    from_s: float | None
    clicks: bool = True


@dataclass(frozen=True, slots=True)
class TapAlong:
    """Take strokes on pads and keys for taps while the song sounds: the first is beat 1 of `bar`, each other the next.

    None: strokes are strokes.
    """

    bar: int | None


@dataclass(frozen=True, slots=True)
class SaveSong:
    """Keep the song among the user's own lessons under this title, and choose it."""

    title: str


PinAction = OpenSong | BringSound | SetPoint | MovePoint | SnapPoint | RemovePoint | PlaySong | TapAlong
SongAction = PinAction | SaveSong
