"""What the wizard asks for, in order: a table. A pad that the kit lacks is skipped."""

from dataclasses import dataclass
from enum import Enum

from station.core.pieces import Articulation, Piece, Zone


class WizardQuestion(Enum):
    """What kind of answer a step expects."""

    STRIKE = "strike"
    """Firm strokes, then soft ones where `soft` says so."""
    SWEEP = "sweep"
    """The pedal, slowly from open to shut."""
    GRAB = "grab"
    """A stroke on a cymbal that is then grabbed."""


@dataclass(frozen=True, slots=True)
class WizardStep:
    """One question: what to do with which zone of which piece, how often firmly and how often softly.

    `openness` is how the student holds the hi-hat meanwhile, None for what is no hi-hat.
    """

    text: str
    piece: Piece
    zone: Zone = Zone.HEAD
    articulation: Articulation = Articulation.NORMAL
    openness: float | None = None
    ask: WizardQuestion = WizardQuestion.STRIKE
    firm: int = 3
    soft: int = 0


SOFT = 3
"""Soft strokes on each pad's main zone: three tell its least velocity well enough (our choice)."""


def _drum(name: str, piece: Piece) -> tuple[WizardStep, WizardStep]:
    return WizardStep(f"{name}, on the head", piece, soft=SOFT), WizardStep(f"{name}, on the rim", piece, Zone.RIM)


def _cymbal(name: str, piece: Piece) -> tuple[WizardStep, WizardStep, WizardStep]:
    return (
        WizardStep(f"{name}, on the bow", piece, Zone.BOW, soft=SOFT),
        WizardStep(f"{name}, on the edge", piece, Zone.EDGE),
        WizardStep(f"{name}: strike it, let it ring, then grab it", piece, Zone.EDGE, ask=WizardQuestion.GRAB),
    )


_HAT, _FOOT = Piece.HIHAT, Piece.HIHAT_PEDAL
_RIDE = _cymbal("ride", Piece.RIDE)

PEDAL_SWEEP = WizardStep(
    "hi-hat pedal: take your foot off, then press it slowly all the way down and hold (skip if nothing happens)",
    _FOOT,
    Zone.PEDAL,
    ask=WizardQuestion.SWEEP,
)
OPEN_BOW = WizardStep("open hi-hat (foot off), on the bow", _HAT, Zone.BOW, openness=1.0, soft=SOFT)
OPEN_EDGE = WizardStep("open hi-hat (foot off), on the edge", _HAT, Zone.EDGE, openness=1.0)
SHUT_BOW = WizardStep("closed hi-hat (foot down), on the bow", _HAT, Zone.BOW, openness=0.0)
SHUT_EDGE = WizardStep("closed hi-hat (foot down), on the edge", _HAT, Zone.EDGE, openness=0.0)
HALF_BOW = WizardStep("half-open hi-hat, on the bow, loud", _HAT, Zone.BOW, openness=0.5)
STOMP = WizardStep("hi-hat pedal: foot off, then stamp it shut and hold", _FOOT, Zone.PEDAL, Articulation.CHICK, 0.0)
SPLASH = WizardStep("hi-hat pedal: stamp and let go at once (splash)", _FOOT, Zone.PEDAL, Articulation.SPLASH, 1.0)

STEPS: tuple[WizardStep, ...] = (
    WizardStep("kick", Piece.KICK, soft=SOFT),
    *_drum("snare", Piece.SNARE)[:1],
    WizardStep("snare, rim shot", Piece.SNARE, Zone.RIM, Articulation.RIM_SHOT),
    WizardStep("snare, cross-stick", Piece.SNARE, Zone.RIM, Articulation.CROSS_STICK),
    PEDAL_SWEEP,
    OPEN_BOW,
    OPEN_EDGE,
    SHUT_BOW,
    SHUT_EDGE,
    HALF_BOW,
    STOMP,
    SPLASH,
    *_drum("highest tom", Piece.TOM_1),
    *_drum("second tom", Piece.TOM_2),
    *_drum("floor tom", Piece.FLOOR_TOM_1),
    *_drum("second floor tom", Piece.FLOOR_TOM_2),
    *_cymbal("crash", Piece.CRASH_1),
    *_cymbal("second crash", Piece.CRASH_2),
    *_RIDE[:2],
    WizardStep("ride, on the bell", Piece.RIDE, Zone.BELL),
    _RIDE[2],
)
