"""How a note head shows what became of it: a colour, and a sign for those who tell no colours apart.

Units are staff spaces from the head's middle. On time is a plain head; an arrow points left when early and right when
late, a barred ring stands round what was missed, a square round what another piece answered, a question mark over what
nobody could hear. They are the signs of the running score (`screen.judgement_marks`), small enough for engraved bars.
"""

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.render.palette import EARLY, GOOD, INK, INK_SOFT, LATE, MISSED, WRONG
from station.render.report.page.session_page import NoteState
from station.render.text.atlas import Atlas
from station.render.text.draw_list import Colour, DrawList, TypeStyle
from station.render.text.fonts import Face

STATE_COLOURS: Mapping[NoteState, Colour] = MappingProxyType(
    {
        NoteState.MATCH: GOOD,
        NoteState.EARLY: EARLY,
        NoteState.LATE: LATE,
        NoteState.MISS: MISSED,
        NoteState.WRONG_PIECE: WRONG,
        NoteState.UNKNOWN: INK_SOFT,
        NoteState.UNPLAYED: INK,
    }
)
STATE_WORDS: Mapping[NoteState, str] = MappingProxyType(
    {
        NoteState.MATCH: "on time",
        NoteState.EARLY: "early",
        NoteState.LATE: "late",
        NoteState.MISS: "missed",
        NoteState.WRONG_PIECE: "another piece",
        NoteState.UNKNOWN: "not heard",
        NoteState.UNPLAYED: "not reached",
    }
)
_ARROW_AWAY, _ARROW = 1.12, (0.34, 0.5)
_RING, _LINE = 0.95, 0.2
_HALF = 0.95


def sign_of(state: NoteState, atlas: Atlas) -> NDArray[np.void]:
    """The shapes of a state's sign; none where a plain head says it."""
    draw_list, colour = DrawList(atlas), STATE_COLOURS[state]
    match state:
        case NoteState.EARLY:
            draw_list.triangle((-_ARROW_AWAY, 0.0), _ARROW, colour, np.pi)
        case NoteState.LATE:
            draw_list.triangle((_ARROW_AWAY, 0.0), _ARROW, colour)
        case NoteState.MISS:
            draw_list.ellipse((0.0, 0.0), (_RING, _RING), colour, 0.0, (0.0, _LINE, 0.0))
            draw_list.line((-0.7 * _RING, 0.7 * _RING), (0.7 * _RING, -0.7 * _RING), _LINE, colour)
        case NoteState.WRONG_PIECE:
            for way in (-1.0, 1.0):
                draw_list.line((-_HALF, way * _HALF), (_HALF, way * _HALF), _LINE, colour)
                draw_list.line((way * _HALF, -_HALF), (way * _HALF, _HALF), _LINE, colour)
        case NoteState.UNKNOWN:
            draw_list.text("?", (0.0, -0.7), TypeStyle(1.7, colour, Face.BOLD, 0.5))
        case _:
            pass
    return draw_list.shapes()


def note_words(state: NoteState, played: int, passes: int) -> str:
    """A state, and in how many passes the note was played where there are several."""
    return STATE_WORDS[state] if passes == 1 else f"{STATE_WORDS[state]}, played {played} of {passes} times"
