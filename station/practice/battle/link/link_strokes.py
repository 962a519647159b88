"""Turns and phrases as the rows of messages, and back: exactly, so that both stations judge the same numbers."""

from collections.abc import Iterable
from math import isnan

import numpy as np
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.music.performance import CHOKE_DTYPE, HIT_DTYPE, Performance
from station.music.score import NOTE_DTYPE, Score
from station.practice.battle.ground import Ground
from station.practice.battle.link.link_messages import Called, PlayedChoke, PlayedStroke, WrittenStroke
from station.practice.battle.phrase import Phrase

_ENUMS = {
    "piece": Piece,
    "zone": Zone,
    "articulation": Articulation,
    "limb": Limb,
    "dynamic": Dynamic,
    "ornament": Ornament,
}
_UNTOLD = frozenset({"openness", "position"})
"""Columns that hold NaN where nobody could tell."""


def _columns(rows: NDArray[np.void], names: Iterable[str]) -> Iterable[list[object]]:
    for name in names:
        values = rows[name].tolist()
        if name in _UNTOLD:
            values = [None if isnan(value) else value for value in values]
        yield [_ENUMS[name](value) for value in values] if name in _ENUMS else values


def _table(
    rows: Iterable[PlayedStroke | WrittenStroke | PlayedChoke], names: tuple[str, ...], dtype: np.dtype[np.void]
) -> NDArray[np.void]:
    """The rows (n,) as an array of `dtype`, whose `names` they have."""
    listed = list(rows)
    table = np.zeros(len(listed), dtype)
    for name in names:
        values = [getattr(row, name) for row in listed]
        table[name] = [np.nan if value is None else value for value in values]
    return table


def played_strokes(played: Performance) -> tuple[PlayedStroke, ...]:
    """The hits as rows, in order of time."""
    return tuple(map(PlayedStroke, *_columns(played.hits, PlayedStroke.__struct_fields__)))


def played_chokes(played: Performance) -> tuple[PlayedChoke, ...]:
    """The chokes as rows, in order of time."""
    return tuple(map(PlayedChoke, *_columns(played.chokes, PlayedChoke.__struct_fields__)))


def performance_of(strokes: Iterable[PlayedStroke], chokes: Iterable[PlayedChoke]) -> Performance:
    """What was played, to the last bit as the other station has it."""
    hits = _table(strokes, PlayedStroke.__struct_fields__, HIT_DTYPE)
    return Performance.from_array(hits, _table(chokes, PlayedChoke.__struct_fields__, CHOKE_DTYPE))


def written_strokes(notes: NDArray[np.void]) -> tuple[WrittenStroke, ...]:
    """Rows (n,) of `NOTE_DTYPE` as rows of a message."""
    return tuple(map(WrittenStroke, *_columns(notes, WrittenStroke.__struct_fields__)))


def called(phrase: Phrase, number: int, step: int) -> Called:
    """The message that says `phrase`."""
    strokes, landing = written_strokes(phrase.score.notes), written_strokes(phrase.landing)
    return Called(number, step, phrase.bars, strokes, landing, phrase.words)


def phrase_of(said: Called, ground: Ground, source: str) -> Phrase:
    """The phrase that the host calls; raises `BadInput` of `source` for a stroke outside its bars."""
    end_tick = said.bars * ground.bar_ticks
    if any(stroke.tick >= end_tick for stroke in said.strokes) or any(stroke.tick for stroke in said.landing):
        raise BadInput(source, f"phrase of round {said.round}", "has a stroke outside its bars")
    longest = (
        max(stroke.duration_ticks, stroke.choke_ticks, stroke.swing_ticks) for stroke in said.strokes + said.landing
    )
    if max(longest, default=0) > end_tick:
        raise BadInput(source, f"phrase of round {said.round}", "has a stroke that outlasts its bars")
    names = WrittenStroke.__struct_fields__
    score = Score.from_array(_table(said.strokes, names, NOTE_DTYPE), ground.tempo_map, end_tick)
    return Phrase(score, _table(said.landing, names, NOTE_DTYPE), said.words)
