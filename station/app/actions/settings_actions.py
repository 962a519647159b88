"""What is set once and kept: how it looks, how sessions go, who demonstrates on which kit. Slots count from 0."""

from dataclasses import dataclass

from station.app.settings.first_start import FirstAnswers
from station.app.settings.preferences import PracticePreferences
from station.app.settings.view_settings import ViewSettings
from station.motion.sticking.hand_notes import Hands
from station.render.camera import Camera


@dataclass(frozen=True, slots=True)
class FinishFirstStart:
    """What a newcomer has answered, None where the questions were put aside; `battles`: they battle first."""

    answers: FirstAnswers | None
    battles: bool = False


@dataclass(frozen=True, slots=True)
class SetView:
    """How the picture and the panels look."""

    view_settings: ViewSettings


@dataclass(frozen=True, slots=True)
class KeepViewpoint:
    """Keep a viewpoint of the user's own."""

    slot: int
    camera: Camera


@dataclass(frozen=True, slots=True)
class SetPreferences:
    """How sessions go."""

    preferences: PracticePreferences


@dataclass(frozen=True, slots=True)
class LearnPause:
    """Let the kit say what pauses, or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class PlayAs:
    """Let the student of that name play, a new one where nobody is called so."""

    name: str


@dataclass(frozen=True, slots=True)
class AskWhoPlays:
    """Show the list of students, or put it away."""

    on: bool


@dataclass(frozen=True, slots=True)
class Embody:
    """Let another drummer demonstrate: a name or a file, empty for the style's own."""

    figure: str


@dataclass(frozen=True, slots=True)
class PutUp:
    """Put another kit before the demonstrator: a name or a file, empty for the lesson's."""

    stands: str


@dataclass(frozen=True, slots=True)
class LeadWith:
    """Let another hand lead."""

    hands: Hands


KeptSetting = FinishFirstStart | SetView | KeepViewpoint | SetPreferences | LearnPause | PutUp | LeadWith
SettingsAction = Embody | PlayAs | AskWhoPlays | KeptSetting
