"""Loudness and touch of made bars: accents, ghosts, flams, drags and diddles, as far as a step asks them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from station.core.pieces import DRUMS, Dynamic, Piece
from station.music.score import Note
from station.music.stroke_velocities import USUAL_VELOCITIES
from station.practice.battle.ground import Ground
from station.practice.battle.opponents.idiom import Idiom
from station.practice.battle.repeating.demands import Demand
from station.practice.battle.vocabulary.asked_of_limbs import Dynamics
from station.practice.battle.vocabulary.ornament_places import Touch, ornamented

_ACCENTED = 0.3
"""Share of the strokes on drums that are accents where a step asks them: one in three or four (our choice)."""
_LEAST_GHOSTS = 0.35
"""Share of the other strokes on the snare that are ghosts where a step asks them, whoever plays (our choice)."""
_ORNAMENTED = 0.22
"""Share of the drums' strokes with an ornament at the last step; the first that asks them has a third (our choice)."""
_TOUCH = 0.7, 0.3, 0.0
"""How many ornaments are flams and drags, diddles, and buzzes, which nobody can judge by ear (our choice)."""


@dataclass(frozen=True, slots=True)
class _Dressing:
    """What is put on: shares of accents, of ghosts among the rest, of ornaments; and the ground's clock."""

    accents: float
    ghosts: float
    ornaments: float
    tick_s: float
    off_beat: float
    beat_ticks: int


def dressed(notes: Sequence[Note], demand: Demand, ground: Ground, idiom: Idiom, rng: Generator) -> list[Note]:
    """`notes` in order of time with velocities, dynamics and ornaments."""
    asks = demand.dynamics
    dressing = _Dressing(
        _ACCENTED if asks >= Dynamics.ACCENTS else 0.0,
        max(idiom.ghosts, _LEAST_GHOSTS) if asks >= Dynamics.GHOSTS else 0.0,
        _ORNAMENTED * (2 * demand.off_beat - 1) if asks >= Dynamics.ORNAMENTS else 0.0,
        60 / ground.beats_a_minute / ground.beat_ticks,
        demand.off_beat,
        ground.beat_ticks,
    )
    ordered = sorted(notes, key=lambda note: note.tick)
    loud = [_loud(note, dressing, rng) for note in ordered]
    chosen = np.flatnonzero(rng.random(len(loud)) < dressing.ornaments)
    touch = Touch(*_TOUCH, dressing.tick_s, dressing.beat_ticks)
    return ornamented(loud, set(chosen.tolist()), touch, rng)


def _loud(note: Note, dressing: _Dressing, rng: Generator) -> Note:
    on_beat = note.tick % dressing.beat_ticks == 0
    if note.piece is Piece.HIHAT_PEDAL:
        return _as(note, Dynamic.NORMAL)
    leans = 1 - dressing.off_beat if on_beat else dressing.off_beat  # early steps accent beats, late ones what is off
    if rng.random() < dressing.accents * 2 * leans * (0.4 if note.piece not in DRUMS else 1.0):
        return _as(note, Dynamic.ACCENT)
    if note.piece is Piece.SNARE and not on_beat and rng.random() < dressing.ghosts:
        return _as(note, Dynamic.GHOST)
    return _as(note, Dynamic.NORMAL)


def _as(note: Note, dynamic: Dynamic) -> Note:
    return replace(note, dynamic=dynamic, velocity=USUAL_VELOCITIES[dynamic])
