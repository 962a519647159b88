"""The levels of what sounds, as a user asks for them: `click=0.8 demonstration=0.5@-1 student=1@1 crash_1=0.6@-0.4`.

A level is 0 (muted) to 1 (full), of a piece of the kit up to 2 (twice what the kit has); behind an @ stands the pan
from −1 (left) to 1 (right).
"""

import math
from collections.abc import Mapping
from types import MappingProxyType

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.pieces import Piece, word
from station.engine.messages import Bus, SetLevel, SetPiece

BUSES: Mapping[str, Bus] = MappingProxyType(
    {"click": Bus.CLICK, "demonstration": Bus.DEMONSTRATION, "student": Bus.STUDENT, "track": Bus.BACKING}
)
_PIECES = {word(piece): piece for piece in Piece}
_LOUDEST_PIECE = 2.0
"""6 dB: more would bend every stroke in the limiter (our choice)."""
LEVELS_HELP = (
    f"level 0-1 and pan -1-1 of {', '.join(BUSES)}, 0-2 of pieces of the kit, "
    "such as 'demonstration=0.5@-1 student=1@1 click=0 crash_1=0.6'"
)


def parse_levels(text: str, source: str = "levels") -> tuple[SetLevel | SetPiece, ...]:
    """The commands that set the levels in `text`; raises `BadInput` that names `source` and the word at fault."""
    return tuple(_level(word, source) for word in text.split())


def _level(said: str, source: str) -> SetLevel | SetPiece:
    name, _, value = said.partition("=")
    if name not in BUSES and name not in _PIECES:
        raise BadInput(source, said, f"no such sound{did_you_mean(name, [*BUSES, *_PIECES])}")
    most = 1.0 if name in BUSES else _LOUDEST_PIECE
    level_word, at, pan_word = value.partition("@")
    level, pan = _number(level_word), _number(pan_word) if at else 0.0
    if not (0.0 <= level <= most and -1.0 <= pan <= 1.0):  # also refuses what is no number
        raise BadInput(source, said, f"expected a level from 0 to {most:g}, and if need be @ and a pan from -1 to 1")
    return SetLevel(BUSES[name], level, pan) if name in BUSES else SetPiece(_PIECES[name], level, pan)


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return math.nan
