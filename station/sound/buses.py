"""The mixer's channels and the click's voices: the words that the engine's messages share with the sound."""

from enum import IntEnum


class Bus(IntEnum):
    """The mixer's channels: each has a level and a pan."""

    CLICK = 0
    DEMONSTRATION = 1
    STUDENT = 2


class ClickVoice(IntEnum):
    """Which click sounds; a cue of `Bus.CLICK` bears it in place of a piece."""

    ACCENT = 0
    BEAT = 1
    SUBDIVISION = 2
