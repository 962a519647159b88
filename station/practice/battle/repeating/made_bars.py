"""Bars that are made to measure: rhythm by counts of strokes, shared out over the limbs in an opponent's idiom.

A line has so many strokes a beat; where in the beat they fall follows the metrical hierarchy (Longuet-Higgins & Lee
1984), which `off_beat` flattens: at 0 a beat is filled from its start and its halves, at 1 any cell is as likely as any
other. Bars come back (A B A C), as phrases do.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from math import floor
from types import MappingProxyType

import numpy as np
from numpy.random import Generator

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.score import Note
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.opponents.idiom import Idiom
from station.practice.battle.repeating.demands import Demand
from station.practice.battle.vocabulary.asked_of_limbs import Coordination

_FORM = "ABAC"
"""A statement, an answer, the statement again, another answer."""
_STEEPNESS = 2.4
"""How much rarer a stroke is a level deeper in the beat where nothing is off it: e^2.4, eleven times (our choice)."""
_SHORTEST_S = 0.085
"""The shortest cell that two hands fill: twelve single strokes a second, a good player's (HUMANS: a champion's 20)."""
_DIVISIONS: Mapping[bool, tuple[int, ...]] = MappingProxyType({False: (1, 2, 4, 8), True: (1, 3, 6, 12)})
"""Cells of a beat, by whether it is divided in threes."""
_TIME_SHARE = 0.5
"""What the right hand's timekeeping has of a groove's strokes: eighths over kicks and backbeats (our choice)."""
_STROKES_OF_TIME = (0.5, 1, 2, 3, 4)
"""Strokes a beat that a timekeeper keeps without thinking; a half is every second beat."""
_WALK = 0.4
"""How often the talking hands go to another drum within a beat rather than between two (our choice)."""

Line = list[int]
"""Ticks, in order."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The beats of one bar: start ticks and lengths, the counted beat's length in ticks and in seconds."""

    starts: tuple[int, ...]
    lengths: tuple[int, ...]
    beat_ticks: int
    beat_s: float
    in_threes: bool

    @classmethod
    def of(cls, ground: Ground) -> "Frame":
        """The beats of a bar of `ground`; a dotted quarter is divided in threes whatever the feel."""
        starts = tuple(range(0, ground.bar_ticks, ground.beat_ticks))
        lengths = tuple(min(ground.beat_ticks, ground.bar_ticks - at) for at in starts)
        in_threes = ground.feel is Feel.TRIPLET or ground.beat_ticks > PPQ
        return cls(starts, lengths, ground.beat_ticks, 60 / ground.beats_a_minute, in_threes)

    @property
    def divisions(self) -> tuple[int, ...]:
        """Into how many cells a beat is cut at this tempo, coarse to fine."""
        return tuple(d for d in _DIVISIONS[self.in_threes] if self.beat_s / d >= _SHORTEST_S)

    @property
    def backbeats(self) -> tuple[int, ...]:
        """The beats, from 0, that answer the first: every second one, the last two thirds of a waltz's bar alike."""
        beats = len(self.starts)
        return (1, 2) if beats == 3 else tuple(range(1, beats, 2))


def made_bars(demand: Demand, ground: Ground, idiom: Idiom, rng: Generator) -> list[Note]:
    """The strokes of a phrase as long and as dense as `demand` asks, all equally loud, no limb said."""
    frame = Frame.of(ground)
    a_beat = demand.strokes_per_s * frame.beat_s
    make = partial(_COORDINATED[demand.coordination], frame, a_beat, demand.off_beat, idiom)
    is_groove = bool(rng.random() < idiom.groove_share)
    bars: dict[str, list[Note]] = {}
    form = _FORM[: demand.bars]
    for letter in form:
        if letter not in bars:
            bars[letter] = make(is_groove, rng)
    return [
        Note(note.tick + at * ground.bar_ticks, note.piece) for at, letter in enumerate(form) for note in bars[letter]
    ]


# --- lines ------------------------------------------------------------------------------------------------------------


def rhythm(frame: Frame, a_beat: float, off_beat: float, rng: Generator) -> Line:
    """A line of `a_beat` strokes a beat over a bar."""
    most = frame.divisions[-1]
    start = rng.random() * off_beat + 1 - off_beat - 1e-9  # where little is off the beat, what there is comes early
    found: Line = []
    done = 0.0
    for at, length in zip(frame.starts, frame.lengths, strict=True):
        after = done + min(a_beat, most) * length / frame.beat_ticks
        count = floor(after + start) - floor(done + start)
        done = after
        found += [at + cell for cell in _places(frame, length, count, off_beat, rng)]
    return found


def _places(frame: Frame, length: int, count: int, off_beat: float, rng: Generator) -> list[int]:
    """Ticks in a beat of `length` ticks of `count` strokes."""
    fits = [d for d in frame.divisions if d * length // frame.beat_ticks >= count]
    if not count or not fits:
        return list(range(0, length, frame.beat_ticks // frame.divisions[-1])) if count else []
    division = fits[1] if len(fits) > 1 and rng.random() < off_beat else fits[0]
    cells = np.arange(division * length // frame.beat_ticks)
    weights = -_STEEPNESS * (1 - off_beat) * np.array([_depth(int(c), division) for c in cells])
    chosen = np.sort(cells[np.argsort(-(weights + rng.gumbel(size=len(cells))))[:count]])
    return [int(c) * frame.beat_ticks // division for c in chosen]


def _depth(cell: int, division: int) -> float:
    """How deep in the beat's hierarchy a cell lies: 0 the beat itself."""
    if not cell:
        return 0.0
    thirds = 3 if division % 3 == 0 else 1
    coarse = thirds if thirds == 3 else 2
    depth = 1.0
    while cell * coarse % division:
        coarse, depth = coarse * 2, depth + 1
    return depth


def _steady(frame: Frame, a_beat: float) -> Line:
    """A timekeeper's line, the same on each beat."""
    allowed = [s for s in _STROKES_OF_TIME if s <= 1 or s in frame.divisions]
    strokes = min(allowed, key=lambda s: abs(s - a_beat))
    if strokes < 1:
        return list(frame.starts[::2])
    step = frame.beat_ticks // int(strokes)
    return [
        at + inside for at, length in zip(frame.starts, frame.lengths, strict=True) for inside in range(0, length, step)
    ]


def _on(piece: Piece, line: Line) -> list[Note]:
    return [Note(tick, piece) for tick in line]


# --- who plays --------------------------------------------------------------------------------------------------------


def _hands(frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, is_groove: bool, rng: Generator) -> list[Note]:
    return _on(Piece.SNARE, rhythm(frame, a_beat, off_beat, rng))


def _with_kick(
    frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, is_groove: bool, rng: Generator
) -> list[Note]:
    kick = rhythm(frame, a_beat * idiom.kick_share, off_beat, rng)
    missing = a_beat - len(kick) / _beats(frame)
    return _on(Piece.SNARE, rhythm(frame, missing, off_beat, rng)) + _on(Piece.KICK, kick)


def _on_the_kit(
    frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, is_groove: bool, rng: Generator
) -> list[Note]:
    return (_groove if is_groove else _solo)(frame, a_beat, off_beat, idiom, rng)


def _four_limbs(
    frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, is_groove: bool, rng: Generator
) -> list[Note]:
    on = [frame.starts[b] for b in (idiom.pedal_on or frame.backbeats) if b < len(frame.starts)]
    half = frame.beat_ticks // (3 if frame.in_threes else 2) * (2 if frame.in_threes else 1)
    late = [at + half for at, length in zip(frame.starts, frame.lengths, strict=True) if half < length]
    pedal = late if rng.random() < off_beat / 2 else on
    rest = a_beat - len(pedal) / _beats(frame)
    ride = Idiom(Piece.RIDE, idiom.voices, idiom.kick_share, idiom.two_feet, ghosts=idiom.ghosts)
    return _on(Piece.HIHAT_PEDAL, pedal) + (_groove if is_groove else _solo)(frame, rest, off_beat, ride, rng)


def _groove(frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, rng: Generator) -> list[Note]:
    """Time on a cymbal, the backbeat, the kick, and what is left on the snare between."""
    time = _steady(frame, a_beat * _TIME_SHARE)
    backbeats = [frame.starts[b] for b in frame.backbeats]
    left = a_beat - (len(time) + len(backbeats)) / _beats(frame)
    kick_share = min(1.0, idiom.kick_share / (1 - _TIME_SHARE))
    kick = [t for t in rhythm(frame, max(0.0, left) * kick_share, off_beat, rng) if t not in backbeats]
    left = max(0.0, left - len(kick) / _beats(frame))
    talk = set(rhythm(frame, left, max(off_beat, 0.5), rng)) | set(backbeats)
    return _on(idiom.time_on, time) + _on(Piece.SNARE, sorted(talk)) + _on(Piece.KICK, kick)


def _solo(frame: Frame, a_beat: float, off_beat: float, idiom: Idiom, rng: Generator) -> list[Note]:
    """The hands talk over the drums in runs, the kick under them and between."""
    kick = rhythm(frame, a_beat * idiom.kick_share, off_beat, rng)
    talk = rhythm(frame, a_beat - len(kick) / _beats(frame), off_beat, rng)
    pieces, shares = list(idiom.voices), np.array(list(idiom.voices.values()))
    voice, beat = Piece.SNARE, -1
    hands = []
    for tick in talk:
        moves = rng.random() < _WALK * off_beat
        if tick // frame.beat_ticks != beat or moves:
            voice = pieces[int(rng.choice(len(pieces), p=shares / shares.sum()))]
        beat = tick // frame.beat_ticks
        hands.append(Note(tick, voice))
    return hands + _on(Piece.KICK, kick)


def _beats(frame: Frame) -> float:
    return sum(frame.lengths) / frame.beat_ticks


_COORDINATED = MappingProxyType(
    {
        Coordination.HANDS: _hands,
        Coordination.WITH_KICK: _with_kick,
        Coordination.KIT: _on_the_kit,
        Coordination.FOUR_LIMBS: _four_limbs,
    }
)
