"""The levels of what sounds, as a user asks for them: `click=0.8 demonstration=0.5@-1 student=1@1 crash_1=0.6@-0.4`.

A level is 0 (muted) to 1 (full), of a piece of the kit up to 2 (twice what the kit has); behind an @ stands the pan
from −1 (left) to 1 (right). `master` is the level of all that sounds, and has no side.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.pieces import Piece, word
from station.core.settings import CLICK_ALONE, EVERYTHING, NOTHING
from station.engine.messages import Bus, SetLevel, SetMaster, SetPiece

BUSES: Mapping[str, Bus] = MappingProxyType(
    {"click": Bus.CLICK, "demonstration": Bus.DEMONSTRATION, "student": Bus.STUDENT, "track": Bus.BACKING}
)
MASTER = "master"
PIECES: Mapping[str, Piece] = MappingProxyType({word(piece): piece for piece in Piece})
CHANNELS = (MASTER, *BUSES, *PIECES)
"""All that has a level, by its word."""
_LOUDEST_PIECE = 2.0
"""6 dB: more would bend every stroke in the limiter (our choice)."""
LEVELS_HELP = (
    f"level 0-1 and pan -1-1 of {', '.join(BUSES)}, 0-1 of {MASTER} (all), 0-2 of pieces of the kit, "
    "such as 'demonstration=0.5@-1 student=1@1 click=0 crash_1=0.6'"
)
SILENCED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {EVERYTHING: (), CLICK_ALONE: tuple(each for each in BUSES if each != "click"), NOTHING: (MASTER,)}
)
"""The channels that are silent by the setting `heard`, whatever their level."""
LevelCommand = SetLevel | SetPiece | SetMaster


@dataclass(frozen=True, slots=True)
class ChannelLevel:
    """How loud, and on which side (`pan` −1 left … 1 right)."""

    level: float = 1.0
    pan: float = 0.0


USUAL = ChannelLevel()
"""What a channel has that nobody has set."""


def most_of(channel: str) -> float:
    """The highest level of a channel."""
    return _LOUDEST_PIECE if channel in PIECES else 1.0


def read_levels(text: str, source: str = "levels") -> dict[str, ChannelLevel]:
    """The level of each channel in `text`, in its order; raises `BadInput` that names `source` and the word."""
    return dict(_level(word, source) for word in text.split())


def parse_levels(text: str, source: str = "levels") -> tuple[LevelCommand, ...]:
    """The commands that set the levels in `text`; raises `BadInput` as `read_levels`."""
    return tuple(command_of(channel, level) for channel, level in read_levels(text, source).items())


def levels_text(levels: Mapping[str, ChannelLevel]) -> str:
    """What `read_levels` reads as `levels`, to a hundredth; channels that are as usual are left out."""
    return " ".join(f"{channel}={_number_text(level)}" for channel, level in levels.items() if level != USUAL)


def command_of(channel: str, level: ChannelLevel) -> LevelCommand:
    """The command that sets a channel."""
    if channel == MASTER:
        return SetMaster(level.level)
    if channel in BUSES:
        return SetLevel(BUSES[channel], level.level, level.pan)
    return SetPiece(PIECES[channel], level.level, level.pan)


def _level(said: str, source: str) -> tuple[str, ChannelLevel]:
    name, _, value = said.partition("=")
    if name not in CHANNELS:
        raise BadInput(source, said, f"no such sound{did_you_mean(name, CHANNELS)}")
    most = most_of(name)
    level_word, at, pan_word = value.partition("@")
    level, pan = _number(level_word), _number(pan_word) if at else 0.0
    if not (0.0 <= level <= most and -1.0 <= pan <= 1.0):  # also refuses what is no number
        raise BadInput(source, said, f"expected a level from 0 to {most:g}, and if need be @ and a pan from -1 to 1")
    if name == MASTER and pan:
        raise BadInput(source, said, "all that sounds has no side of its own")
    return name, ChannelLevel(level, pan)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan


def _number_text(level: ChannelLevel) -> str:
    return f"{level.level:.4g}" + (f"@{level.pan:.4g}" if level.pan else "")
