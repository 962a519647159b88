"""The levels of what sounds, as a user asks for them: `click=0.8 demonstration=0.5@-1 student=1@1 track=0.7`.

A level is 0 (muted) to 1 (full), behind an @ the pan from −1 (left) to 1 (right).
"""

import math
from collections.abc import Mapping
from types import MappingProxyType

from station.core.errors import BadInput
from station.engine.messages import Bus, SetLevel

BUSES: Mapping[str, Bus] = MappingProxyType(
    {"click": Bus.CLICK, "demonstration": Bus.DEMONSTRATION, "student": Bus.STUDENT, "track": Bus.BACKING}
)
LEVELS_HELP = f"level 0-1 and pan -1-1 of {', '.join(BUSES)}, such as 'demonstration=0.5@-1 student=1@1 click=0'"


def parse_levels(text: str, source: str = "levels") -> tuple[SetLevel, ...]:
    """The commands that set the levels in `text`; raises `BadInput` that names `source` and the word at fault."""
    return tuple(_level(word, source) for word in text.split())


def _level(word: str, source: str) -> SetLevel:
    name, _, value = word.partition("=")
    if name not in BUSES:
        raise BadInput(source, word, f"no such sound; there are {', '.join(BUSES)}")
    level, at, pan = value.partition("@")
    wish = SetLevel(BUSES[name], _number(level), _number(pan) if at else 0.0)
    if not (0.0 <= wish.level <= 1.0 and -1.0 <= wish.pan <= 1.0):  # also refuses what is no number
        raise BadInput(source, word, "expected a level from 0 to 1, and if need be @ and a pan from -1 to 1")
    return wish


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan
