"""The drummer's improvised phrase: a plan, notes by the model that listens, and the touch of somebody of that manner.

What the plan takes up of what was heard, and what an opponent quotes of its lessons, is given to the model as bars that
stand; it plays the others after them and after all that it has heard. Then come velocities and timing, ornaments,
mistakes, and limbs that can play it. Metal has no takes in the dataset: its drummer quotes more, and is favoured what
it strikes (docs/battle-drummer.md).
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from station.core.pieces import DRUMS, Dynamic, Limb, Piece
from station.music.score import NOTE_DTYPE, Note, Score
from station.practice.battle.ground import Ground
from station.practice.battle.improvising.human_playing import human_playing
from station.practice.battle.improvising.phrase_notes import Scene, phrase_notes
from station.practice.battle.improvising.phrase_plan import PlannedBar, phrase_plan
from station.practice.battle.improvising.played_beats import Beats, beats_of, strokes_of
from station.practice.battle.improvising.played_touch import expressed
from station.practice.battle.opponents.opponent import Opponent
from station.practice.battle.phrase import Phrase, Turn
from station.practice.battle.vocabulary.limbed import limbed
from station.practice.battle.vocabulary.ornament_places import Touch, ornamented

_HEARD_BARS, _SAID_BARS = 8, 4
"""So many of the last bars of each are listened to: the longest turn, and half of it (our choice: about a millisecond a
bar)."""
_LANDS = 0.75
"""How often a phrase ends with a crash on the next downbeat (our choice)."""
_LANDING_VELOCITY = {Piece.CRASH_1: 108, Piece.KICK: 104}
_HUMAN_ORNAMENTS = 0.1
"""The `ornaments` of a manner at which the snare has as many of them as in the dataset."""


def improvised(
    opponent: Opponent, ground: Ground, bars: int, heard: Sequence[Turn], said: Sequence[Turn], rng: Generator
) -> Phrase:
    """So many bars that `opponent` improvises after the student's turns `heard` and its own `said`, each in order.

    The same for the same state of `rng`. Every stroke can be played, and its limb is written.
    """
    plan = phrase_plan(opponent.manner, bars, rng)
    scene = Scene(opponent, ground, plan, _last(heard, _HEARD_BARS), _last(said, _SAID_BARS))
    beats = expressed(phrase_notes(scene, rng), opponent, plan, ground, rng)
    score = _played(beats, scene, rng)
    lands = rng.random() < _LANDS * (1 - opponent.mistakes.lost_one)
    return Phrase(score, _landing(opponent) if lands else np.zeros(0, NOTE_DTYPE), _words(plan))


def _last(turns: Sequence[Turn], bars: int) -> tuple[Beats, ...]:
    """The beats of the last so many bars, turn by turn."""
    found: list[Beats] = []
    for turn in reversed(turns):
        if bars <= 0:
            break
        beats = _beats(turn)
        found.append(beats.of_bars(max(0, beats.bars - bars), beats.bars))
        bars -= beats.bars
    return tuple(reversed(found))


@lru_cache(maxsize=32)
def _beats(turn: Turn) -> Beats:
    """The beats of a turn, read once: a turn is heard again in later rounds."""
    return beats_of(turn)


def _played(beats: Beats, scene: Scene, rng: Generator) -> Score:
    """The score: strokes without what the opponent drops, with ornaments, with limbs."""
    opponent, ground = scene.opponent, scene.ground
    notes = sorted(strokes_of(beats, ground), key=lambda note: note.tick)
    kept = [_told(note) for note in notes if rng.random() >= opponent.mistakes.dropped]
    shares, more = human_playing().ornaments, opponent.manner.ornaments / _HUMAN_ORNAMENTS
    whole = sum(shares.values()) * more
    chosen = np.flatnonzero(rng.random(len(kept)) < whole)
    touch = Touch(
        shares["flam"] + shares["drag"],
        max(shares["diddle"], shares["drag"]),
        shares["roll"],
        60 / ground.beats_a_minute / ground.beat_ticks,
        ground.beat_ticks,
    )
    dressed = ornamented(kept, set(chosen.tolist()), touch, rng) if whole else kept
    return limbed(dressed, ground, len(scene.plan))


_GHOST, _ACCENT = 45, 105
"""Velocities up to and from which a stroke is written as a ghost or an accent (HUMANS, Velocity: 20–45, 105–127)."""


def _told(note: Note) -> Note:
    """The stroke with its dynamic as a word; only drums have ghosts."""
    if note.velocity >= _ACCENT:
        return replace(note, dynamic=Dynamic.ACCENT)
    is_ghost = note.velocity <= _GHOST and note.piece in DRUMS
    return replace(note, dynamic=Dynamic.GHOST if is_ghost else Dynamic.NORMAL)


def _landing(opponent: Opponent) -> NDArray[np.void]:
    """A crash and a kick, as loud as the opponent is."""
    limbs = {Piece.CRASH_1: Limb.RIGHT_HAND, Piece.KICK: Limb.RIGHT_FOOT}
    notes = [
        Note(
            0, piece, velocity=min(127, round(v * opponent.manner.loudness)), dynamic=Dynamic.ACCENT, limb=limbs[piece]
        )
        for piece, v in _LANDING_VELOCITY.items()
    ]
    return Score.from_notes(notes, Ground().tempo_map).notes


def _words(plan: Sequence[PlannedBar]) -> str:
    """What the phrase does, bar by bar."""
    return ", ".join(
        f"{one.part.value} ({one.turning.value})" if one.turning is not None else one.part.value for one in plan
    )
