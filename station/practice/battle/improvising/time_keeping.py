"""What the drummer plays softly under the student's turn: the feet, or a light groove in its own idiom."""

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.core.pieces import Piece
from station.core.units import PPQ
from station.music.score import Note
from station.practice.battle.ground import Feel, Ground
from station.practice.battle.opponents.opponent import Opponent
from station.practice.battle.phrase import Phrase
from station.practice.battle.vocabulary.limbed import limbed

_FOOT, _KICK, _TIME, _BACKBEAT = 52, 46, 42, 40
"""Velocities: a chick that is heard, a feathered kick, time and a cross-sticked backbeat under it (our choice: 10 to 15
dB below an accent, so that the student is in front)."""
_SPREAD_MS, _CORRELATION = 6.0, 0.5
"""An even clock: who accompanies is steadier than who solos (our choice; HUMANS: professionals 2–3 % of the beat)."""


def time_keeping(opponent: Opponent, ground: Ground, bars: int, rng: Generator, with_hands: bool = False) -> Phrase:
    """So many bars of time: the feet alone, or with the hands a light groove."""
    clock = ar1(bars * ground.beats_a_bar, _CORRELATION, rng) * _SPREAD_MS
    notes = [note for bar in range(bars) for note in _bar(opponent, ground, bar, with_hands)]
    beats = [min(note.tick // ground.beat_ticks, len(clock) - 1) for note in notes]
    late = [note.late_ms + float(clock[beat]) for note, beat in zip(notes, beats, strict=True)]
    timed = [_timed(note, ms) for note, ms in zip(notes, late, strict=True)]
    return Phrase(limbed(timed, ground, bars), words="time")


def ar1(count: int, correlation: float, rng: Generator) -> NDArray[np.float64]:
    """`count` numbers of mean 0 and variance 1, each correlated with the one before it."""
    noise = rng.normal(size=count)
    found = np.empty(count)
    last = noise[0] if count else 0.0
    for at in range(count):
        last = noise[0] if at == 0 else correlation * last + (1 - correlation**2) ** 0.5 * noise[at]
        found[at] = last
    return found


def _timed(note: Note, late_ms: float) -> Note:
    return Note(note.tick, note.piece, velocity=note.velocity, openness=note.openness, late_ms=late_ms)


def _bar(opponent: Opponent, ground: Ground, bar: int, with_hands: bool) -> list[Note]:
    start = bar * ground.bar_ticks
    starts = [start + at for at in range(0, ground.bar_ticks, ground.beat_ticks)]
    pedal = [at for beat, at in enumerate(starts) if beat % 2 == 1 or (len(starts) == 2 and beat == 1)]
    is_jazz = opponent.idiom.time_on is Piece.RIDE and not opponent.idiom.two_feet
    kick = starts if is_jazz else starts[::2]
    notes = [Note(at, Piece.HIHAT_PEDAL, velocity=_FOOT) for at in pedal]
    notes += [Note(at, Piece.KICK, velocity=_KICK - 12 * is_jazz) for at in kick]
    return notes + _hands(opponent, ground, starts, start + ground.bar_ticks) if with_hands else notes


def _hands(opponent: Opponent, ground: Ground, starts: list[int], end: int) -> list[Note]:
    """Time on the opponent's cymbal, and what answers the one."""
    piece = opponent.idiom.time_on
    in_threes = ground.feel is Feel.TRIPLET or ground.beat_ticks > PPQ
    between = ground.beat_ticks * 2 // 3 if in_threes else ground.beat_ticks // 2
    swings = in_threes and piece is Piece.RIDE  # ding, ding-a-ding
    offs = [at + between for beat, at in enumerate(starts) if (beat % 2 == 1 or not swings) and at + between < end]
    openness = 0.0 if piece is Piece.HIHAT else None
    time = [Note(at, piece, velocity=_TIME, openness=openness) for at in starts + offs]
    return time + [Note(at, Piece.SNARE, velocity=_BACKBEAT) for at in starts[1::2] if piece is not Piece.RIDE]
