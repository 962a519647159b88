"""Everything that can be asked of the controller, by mouse, keys or kit: a closed set of plain values.

`Controller.dispatch` takes them all. The parts that own what is changed take theirs: `PlayerAction` the demonstration's
player, `MappingAction` the editor of kits, `StickAction` that of sticks, `CalibrationAction` the measuring of latency,
`StyleAction` the editor of the demonstrator's style. Bars and slots count from 0 where nothing else is said.
"""

from dataclasses import dataclass
from pathlib import Path

from station.app.first_start import FirstAnswers
from station.app.preferences import PracticePreferences
from station.app.selection import Selection
from station.app.style.style_options import StyleOptions
from station.app.view_settings import ViewSettings
from station.core.events import Hit
from station.core.note_map import NoteMeaning
from station.core.pieces import Limb, Piece
from station.devices.mapping.device_map import Sent
from station.devices.mapping.suspect_hits import Suspicion
from station.devices.mapping.velocity_curve import VelocityCurve
from station.engine.messages import KeyHit
from station.motion.sticking.hand_notes import Hands
from station.practice.demonstration.compare_by_ear import Whose
from station.practice.demonstration.song_player import SongStep
from station.practice.session.self_estimate import SelfEstimate
from station.render.camera import Camera
from station.scoring.matching.hit_windows import Level

Bars = tuple[int, int] | None
"""First and last bar, from 0; None for the lesson's own."""

# --- what is on the screen --------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Show:
    """What the window shows from now on: nothing else is computed, and a page that nobody sees does not listen.

    `catalog` is every lesson there is, beside the one that the window was opened on.
    """

    picture: bool = True
    catalog: bool = False
    devices: bool = False
    sticks: bool = False
    practice: bool = False
    curves: bool = False
    phase: bool = False


@dataclass(frozen=True, slots=True)
class Notify:
    """Show the user a line."""

    line: str


# --- what is practised ------------------------------------------------------------------------------------------------


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
PracticeAction = Begin | Drill | Pause | Leave | StrikeKey | SessionAction

# --- the demonstration's player ---------------------------------------------------------------------------------------


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

# --- the demonstrator -------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class EditStyle:
    """The style's controls as they are now; while one is `held` nothing is written."""

    options: StyleOptions
    held: bool = False


@dataclass(frozen=True, slots=True)
class LoadStyle:
    """Take a style from its source: a shipped name, or a file."""

    source: str


@dataclass(frozen=True, slots=True)
class ProposeStyle:
    """Take the style that the lesson's tempo, density and dynamics ask for."""


@dataclass(frozen=True, slots=True)
class SaveStyle:
    """Save what is set as a style of the user's own."""

    name: str


@dataclass(frozen=True, slots=True)
class KeepSlot:
    """Keep what is set in a slot, under `name`, or as it is called where that is empty."""

    slot: int
    name: str = ""


@dataclass(frozen=True, slots=True)
class ListStyles:
    """See anew which styles there are."""


StyleAction = EditStyle | LoadStyle | ProposeStyle | SaveStyle | KeepSlot | ListStyles


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


# --- settings ---------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class FinishFirstStart:
    """What a newcomer has answered, None where the questions were put aside."""

    answers: FirstAnswers | None


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


SettingsAction = FinishFirstStart | SetView | KeepViewpoint | SetPreferences | LearnPause | Embody | PutUp | LeadWith

# --- kits -------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class ShowKit:
    """Show another kit on the devices page."""

    device: str


@dataclass(frozen=True, slots=True)
class LearnPad:
    """The next hit is on this pad."""

    pad: NoteMeaning


@dataclass(frozen=True, slots=True)
class LearnVelocity:
    """The next strokes are five ghosts and five accents on this piece."""

    piece: Piece


@dataclass(frozen=True, slots=True)
class GiveUp:
    """Learn no longer."""


@dataclass(frozen=True, slots=True)
class NameNote:
    """The note that was `sent` is this pad."""

    sent: Sent
    pad: NoteMeaning


@dataclass(frozen=True, slots=True)
class UndoLearning:
    """What was learnt last is as it was before."""


@dataclass(frozen=True, slots=True)
class SetThreshold:
    """Softer than this velocity is no stroke."""

    piece: Piece
    velocity: int


@dataclass(frozen=True, slots=True)
class SetMask:
    """For so long after a stroke there is no other."""

    piece: Piece
    milliseconds: int


@dataclass(frozen=True, slots=True)
class SetShare:
    """A stroke on `source` makes `victim` send hits up to so loud; 0 for no longer."""

    source: Piece
    victim: Piece
    share: float


@dataclass(frozen=True, slots=True)
class SetCurve:
    """How loud strokes count."""

    piece: Piece
    curve: VelocityCurve


@dataclass(frozen=True, slots=True)
class HoldBack:
    """Take hits such as this one for what they are suspected to be."""

    suspicion: Suspicion


@dataclass(frozen=True, slots=True)
class RevertRules:
    """The rules as they are kept."""


@dataclass(frozen=True, slots=True)
class SaveRules:
    """Keep the rules for this kit."""


RuleAction = SetThreshold | SetMask | SetShare | SetCurve | HoldBack | RevertRules | SaveRules
MappingAction = ShowKit | LearnPad | LearnVelocity | GiveUp | NameNote | UndoLearning | RuleAction


@dataclass(frozen=True, slots=True)
class Measure:
    """Measure how late the devices are, `by` one of the ways of `latency_methods`."""

    by: str
    distance_m: float = 0.0


@dataclass(frozen=True, slots=True)
class CancelMeasuring:
    """End the measurement that runs."""


@dataclass(frozen=True, slots=True)
class KeepMeasured:
    """Subtract what was measured from now on."""


@dataclass(frozen=True, slots=True)
class ForgetMeasured:
    """Forget what was measured."""


CalibrationAction = Measure | CancelMeasuring | KeepMeasured | ForgetMeasured

# --- sticks -----------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class LookForSticks:
    """Listen to the sensors at these ports from now on (`devices.stick_ports`); the engine starts anew."""

    ports: str


@dataclass(frozen=True, slots=True)
class SetHand:
    """The stick of the sensor `device` is in this hand."""

    device: str
    limb: Limb


@dataclass(frozen=True, slots=True)
class LearnMounting:
    """The gesture begins that shows how each sensor sits on its stick, and in which hand."""


@dataclass(frozen=True, slots=True)
class LearnAir:
    """The next strokes in the air say where each piece of the air kit is."""


@dataclass(frozen=True, slots=True)
class GiveUpSticks:
    """Learn no longer of the sticks."""


@dataclass(frozen=True, slots=True)
class PlayInAir:
    """Let strokes in the air be hits of the air kit, or no longer."""

    on: bool


@dataclass(frozen=True, slots=True)
class FollowPhase:
    """Let the drummer follow the student's phase, or the clock."""

    on: bool


@dataclass(frozen=True, slots=True)
class SoundPhase:
    """Let the phase that is followed sound the drill's strokes, from the next session on, or no longer."""

    on: bool


StickAction = LookForSticks | SetHand | LearnMounting | LearnAir | GiveUpSticks | PlayInAir | FollowPhase | SoundPhase
EquipmentAction = MappingAction | CalibrationAction | StickAction

# --- files ------------------------------------------------------------------------------------------------------------


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

# --- a motion and its phase -------------------------------------------------------------------------------------------


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

Action = (
    Show
    | Notify
    | ChoiceAction
    | PracticeAction
    | PlayerAction
    | StyleAction
    | SettingsAction
    | EquipmentAction
    | FileAction
    | ImportAction
    | PhaseAction
)
