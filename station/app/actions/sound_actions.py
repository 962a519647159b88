"""What the page of sounds may be asked: the click, levels, drums, the output, a track, and what is heard of it all."""

from dataclasses import dataclass

from station.engine.levels_option import ChannelLevel
from station.practice.session.cues.click_pattern import ClickPattern


@dataclass(frozen=True, slots=True)
class SetClickPattern:
    """What clicks, from the next session on; a bar of it is heard now unless somebody plays."""

    pattern: ClickPattern


@dataclass(frozen=True, slots=True)
class ChooseClick:
    """Let the click of this name sound from now on."""

    click: str


@dataclass(frozen=True, slots=True)
class HearClick:
    """Hear a bar in the click of this name, empty for the one that is chosen; nothing is changed."""

    click: str = ""


@dataclass(frozen=True, slots=True)
class ChooseDrums:
    """Let the drum kit of this name or path sound from now on."""

    drums: str


@dataclass(frozen=True, slots=True)
class HearDrums:
    """Hear a drum kit for a groove, and under the student's own strokes; nothing is changed."""

    drums: str


@dataclass(frozen=True, slots=True)
class StopHearing:
    """Whatever was heard to try it is heard no longer: what is chosen sounds again."""


@dataclass(frozen=True, slots=True)
class SetChannel:
    """The level and the pan of a channel (`engine.levels_option.CHANNELS`), at once."""

    channel: str
    level: ChannelLevel


@dataclass(frozen=True, slots=True)
class MuteChannel:
    """Let a channel be silent, or as loud as it was before."""

    channel: str


@dataclass(frozen=True, slots=True)
class SoloChannel:
    """Hear a channel alone, or with one more, or no longer; never kept."""

    channel: str


@dataclass(frozen=True, slots=True)
class SoundOwnStrokes:
    """Whether the station sounds the student's strokes."""

    on: bool


@dataclass(frozen=True, slots=True)
class SetHeard:
    """How much is heard, by the words of the setting `heard`."""

    heard: str


@dataclass(frozen=True, slots=True)
class LookForSounds:
    """Look anew which drum kits and outputs there are."""


@dataclass(frozen=True, slots=True)
class OutputChoice:
    """An output (part of its name, empty for the system's default), its block and its rate; 0 frames: the driver's."""

    output: str
    block_frames: int
    rate_hz: int


@dataclass(frozen=True, slots=True)
class UseOutput:
    """Let the sound go there from now on; where that fails, back to where it went."""

    choice: OutputChoice


@dataclass(frozen=True, slots=True)
class BringTrack:
    """Play along to this sound file in the sessions to come; empty for none."""

    path: str


@dataclass(frozen=True, slots=True)
class SetTrack:
    """How sessions play along to the track: whether, its tempo (0: the lesson's), its start, stretched or not."""

    plays: bool
    bpm: float
    start_s: float
    stretched: bool


@dataclass(frozen=True, slots=True)
class HearTrack:
    """Hear the track from its start on with a click at its tempo, or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class StartTrackHere:
    """What is heard of the track now is where bar 1 begins."""


@dataclass(frozen=True, slots=True)
class TapTrack:
    """A beat of the track was tapped."""

    at_ns: int


@dataclass(frozen=True, slots=True)
class EstimateTrack:
    """Find the track's tempo and its first beat by its onsets."""


TrackAction = BringTrack | SetTrack | HearTrack | StartTrackHere | TapTrack | EstimateTrack
SoundAction = (
    SetClickPattern
    | ChooseClick
    | HearClick
    | ChooseDrums
    | HearDrums
    | StopHearing
    | SetChannel
    | MuteChannel
    | SoloChannel
    | SoundOwnStrokes
    | SetHeard
    | LookForSounds
    | UseOutput
    | TrackAction
)
