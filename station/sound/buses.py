"""The mixer's channels and the click's voices: the words that the engine's messages share with the sound."""

from collections.abc import Mapping
from enum import IntEnum
from types import MappingProxyType


class Bus(IntEnum):
    """The mixer's channels: each has a level and a pan."""

    CLICK = 0
    DEMONSTRATION = 1
    STUDENT = 2
    BACKING = 3


class ClickVoice(IntEnum):
    """Which click sounds; a cue of `Bus.CLICK` bears it in place of a piece. From `ONE` on they are counted words."""

    ACCENT = 0
    BEAT = 1
    SUBDIVISION = 2
    ONE = 3
    TWO = 4
    THREE = 5
    FOUR = 6
    FIVE = 7
    SIX = 8
    SEVEN = 9
    EIGHT = 10
    NINE = 11
    TEN = 12
    ELEVEN = 13
    TWELVE = 14
    E = 15
    AND = 16
    A = 17


PART_LABELS: Mapping[int, tuple[ClickVoice, ...]] = MappingProxyType(
    {
        2: (ClickVoice.AND,),
        3: (ClickVoice.AND, ClickVoice.A),
        4: (ClickVoice.E, ClickVoice.AND, ClickVoice.A),
    }
)
"""What is counted between two beats, by the number of parts of a beat: "one e and a two"."""

SPOKEN_LEAD_S = 0.07
"""A word's vowel, which is where the ear hears its beat, begins so long after its first frame."""


def word_of_beat(index: int, otherwise: ClickVoice) -> ClickVoice:
    """The number that is counted on the beat `index` (from 0) of a bar; `otherwise` beyond twelve."""
    voice = ClickVoice.ONE + index
    return ClickVoice(voice) if voice <= ClickVoice.TWELVE else otherwise
