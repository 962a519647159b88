"""What the pages of kits, latency and sticks may be asked.

The editor of kits takes `MappingAction`, the measuring of latency `CalibrationAction`, the editor of sticks
`StickAction`.
"""

from dataclasses import dataclass

from station.core.note_map import NoteMeaning
from station.core.pieces import Limb, Piece
from station.devices.mapping.device_map import Sent
from station.devices.mapping.suspect_hits import Suspicion
from station.devices.mapping.velocity_curve import VelocityCurve


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


@dataclass(frozen=True, slots=True)
class AnswerLag:
    """Whether the lag that the result leaves out is taken out for good, or counts as the student's."""

    take_out: bool


CalibrationAction = Measure | CancelMeasuring | KeepMeasured | ForgetMeasured | AnswerLag


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
