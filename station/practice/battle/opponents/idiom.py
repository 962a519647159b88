"""Which pieces an opponent plays for what, and how often: the plain figures that its phrases are made by."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

from station.core.pieces import Piece


@dataclass(frozen=True, slots=True)
class Idiom:
    """How a style is shared out over the kit; all shares 0–1, our choice, by what each style's teachers ask for.

    `time_on` is what the right hand keeps time on, `voices` what the hands talk on and how much of the talk each has,
    `kick_share` of the strokes is the feet's, `two_feet` whether both play the kick; `groove_share` how often a phrase
    is a groove rather than a solo; `pedal_on` the beats of the bar, from 0, on which the hi-hat foot falls; `ghosts`
    how many of the soft strokes are ghosts. `strength` scales what all this adds to what drummers play in general.
    """

    time_on: Piece = Piece.HIHAT
    voices: Mapping[Piece, float] = field(default_factory=lambda: MappingProxyType({Piece.SNARE: 1.0}))
    kick_share: float = 0.25
    two_feet: bool = False
    groove_share: float = 0.5
    pedal_on: tuple[int, ...] = (1, 3)
    ghosts: float = 0.5
    strength: float = 1.0


def _voices(snare: float, high: float, middle: float, floor: float) -> Mapping[Piece, float]:
    return MappingProxyType(
        {Piece.SNARE: snare, Piece.TOM_1: high, Piece.TOM_2: middle, Piece.FLOOR_TOM_1: floor},
    )


POCKET = Idiom(voices=_voices(0.8, 0.08, 0.04, 0.08), kick_share=0.3, groove_share=0.75, ghosts=0.8)
JAZZ = Idiom(Piece.RIDE, _voices(0.64, 0.14, 0.06, 0.16), 0.18, groove_share=0.45, ghosts=0.5)
METAL = Idiom(
    Piece.RIDE, _voices(0.4, 0.2, 0.18, 0.22), 0.45, two_feet=True, groove_share=0.55, pedal_on=(), ghosts=0.0
)
ROCK = Idiom(voices=_voices(0.55, 0.16, 0.12, 0.17), kick_share=0.28, groove_share=0.55, ghosts=0.3)
PLAIN = Idiom(voices=_voices(0.85, 0.05, 0.02, 0.08), kick_share=0.25, groove_share=0.8, ghosts=0.0)
STEADY = Idiom(voices=_voices(0.7, 0.1, 0.08, 0.12), kick_share=0.28, groove_share=0.7, ghosts=0.4)
ANYBODY = Idiom(voices=_voices(0.75, 0.1, 0.05, 0.1), strength=0.0)
