"""Which pads were struck for which, and how often: "tom 2 for floor tom, 4×", and a bar in which it can be seen."""

from collections import Counter
from dataclasses import dataclass

import numpy as np

from station.core.labels import piece_name
from station.core.pieces import Piece
from station.music.judgement import Label
from station.practice.session.lesson_places import places_of
from station.practice.session.session import SessionResult


@dataclass(frozen=True, slots=True)
class WrongPad:
    """`struck` for `written`, so many `times`; most of them in the lesson's `bar`, the last there in `pass_number`."""

    struck: Piece
    written: Piece
    times: int
    bar: int
    pass_number: int

    @property
    def words(self) -> str:
        """As a teacher would say it."""
        return f"{piece_name(self.struck)} for {piece_name(self.written)}, {self.times}×"


def wrong_pads(result: SessionResult) -> tuple[WrongPad, ...]:
    """Every confusion of a session's result, the most frequent first."""
    rows = np.flatnonzero(result.alignment.note_label == Label.WRONG_PIECE)
    places = places_of(result, result.score.notes["tick"][rows])
    struck = result.performance.hits["piece"][result.alignment.hit_of_note[rows]]
    pairs = list(zip(struck.tolist(), result.score.notes["piece"][rows].tolist(), strict=True))
    found = []
    for pair, times in Counter(pairs).most_common():
        mine = places[[one == pair for one in pairs]]
        bar = Counter(mine["bar"].tolist()).most_common(1)[0][0]
        last = int(mine["pass"][mine["bar"] == bar].max())
        found.append(WrongPad(Piece(pair[0]), Piece(pair[1]), times, bar, last))
    return tuple(found)
