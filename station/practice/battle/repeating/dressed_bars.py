"""Loudness and touch of made bars: accents, ghosts, flams, drags and diddles, as far as a step asks them."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

from numpy.random import Generator

from station.core.pieces import DRUMS, Dynamic, Ornament, Piece
from station.music.score import Note
from station.music.stroke_velocities import USUAL_VELOCITIES
from station.practice.battle.ground import Ground
from station.practice.battle.opponents.idiom import Idiom
from station.practice.battle.repeating.demands import Demand
from station.practice.battle.vocabulary.asked_of_limbs import Dynamics

_ACCENTED = 0.3
"""Share of the strokes on drums that are accents where a step asks them: one in three or four (our choice)."""
_LEAST_GHOSTS = 0.35
"""Share of the other strokes on the snare that are ghosts where a step asks them, whoever plays (our choice)."""
_ORNAMENTED = 0.22
"""Share of the drums' strokes with an ornament at the last step; the first that asks them has a third (our choice)."""
_GRACED = 0.7
"""How many ornaments are flams and drags where there is room for them; the others are diddles (our choice)."""
_DIDDLE_S = 0.045
"""A hand's rebound comes 50–90 ms after its stroke (HUMANS, Timing); the stroke after it needs as long."""
_GRACE_ROOM_S: Mapping[Ornament, float] = MappingProxyType({Ornament.FLAM: 0.09, Ornament.DRAG: 0.18})
"""So long before a flam or a drag no hand strikes: grace strokes come 30 or 110 ms early, and a hand needs 60 (HUMANS,
Timing: a rebound comes after 50–90 ms)."""


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
    return [one for at, note in enumerate(loud) for one in _ornamented(loud, at, note, dressing, rng)]


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


def _ornamented(notes: Sequence[Note], at: int, note: Note, dressing: _Dressing, rng: Generator) -> list[Note]:
    """The stroke, or with an ornament that there is time for: a flam or drag before it, a diddle's second after it."""
    if note.piece not in DRUMS or rng.random() >= dressing.ornaments:
        return [note]
    hands = [n.tick for n in notes if n.piece not in (Piece.KICK, Piece.HIHAT_PEDAL)]
    before = max((t for t in hands if t < note.tick), default=-(10**9))
    after = min((t for t in hands if t > note.tick), default=10**9)
    together = hands.count(note.tick) > 1
    graced = Ornament.FLAM if note.dynamic is Dynamic.ACCENT or rng.random() < 0.6 else Ornament.DRAG
    has_room = bool(note.tick) and (note.tick - before) * dressing.tick_s >= _GRACE_ROOM_S[graced]
    if not together and has_room and rng.random() < _GRACED:
        return [replace(note, ornament=graced)]
    half = min((after - note.tick) // 2, dressing.beat_ticks // 8)
    if not together and half * dressing.tick_s >= _DIDDLE_S:
        pair = replace(note, ornament=Ornament.DIDDLE)
        return [pair, replace(pair, tick=note.tick + half)]
    return [note]
