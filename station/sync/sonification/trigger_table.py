"""Tables of triggers: presets for footfalls, one for a drill, and what a user writes, PHASE=WHAT.

WHAT is a piece as files call it (`kick`, `hihat_pedal`), a sound of General MIDI's percussion by its number (`76`), or
either with a velocity, `snare@60`. PHASE is a share of the cycle, 0 ≤ PHASE < 1.
"""

from collections.abc import Mapping
from dataclasses import replace
from math import isfinite

from station.core.counts import is_count
from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.note_map import GENERAL_MIDI, NoteMeaning, general_midi_note, strike_of
from station.core.pieces import Articulation, Limb, Piece, Zone, word
from station.music.score import Score
from station.sync.sonification.triggers import USUAL_VELOCITY, Trigger

_KICK, _SNARE = NoteMeaning(Piece.KICK), NoteMeaning(Piece.SNARE)
PRESETS: Mapping[str, tuple[Trigger, ...]] = {
    "walk": (
        Trigger(0.25, _KICK, midi_note=36, limb=Limb.RIGHT_FOOT),
        Trigger(0.75, _SNARE, midi_note=38, limb=Limb.LEFT_FOOT),
    ),
    "run": (
        Trigger(0.44, _KICK, midi_note=36, limb=Limb.RIGHT_FOOT),
        Trigger(0.94, _SNARE, midi_note=38, limb=Limb.LEFT_FOOT),
    ),
}
"""Footfalls, the right one a kick and the left one a snare.

`walk`: the paper, § 4.1. `run`: measured against heel lows (benchmarks/paper_tables.py), for with the paper's reference
a runner's foot falls shortly before the thigh passes its middle; .25 and .75 would sound a fifth of a cycle early.
"""
_GREATEST_NOTE = _GREATEST_VELOCITY = 127
_BY_NAME = {word(piece): piece for piece in Piece}
_ZONES = {meaning.piece: meaning for _, meaning in sorted(GENERAL_MIDI.items(), reverse=True)}
"""How General MIDI strikes a piece, where it has several numbers by the lowest."""


def drill_triggers(loop: Score, repeats: int = 1) -> tuple[Trigger, ...]:
    """A trigger a stroke, grace strokes included, of a loop in which the model's φ runs `repeats` times from 0 to 2π.

    Of a loop that is told by its shortest repeat the first one's strokes are taken. Its beginning is φ = 0, hence the
    threshold 0.5.
    """
    cycle_ns = loop.length_ns / repeats
    inside = loop.onset_ns < cycle_ns
    return tuple(
        Trigger(
            (at_ns / cycle_ns + 0.5) % 1.0,
            NoteMeaning(Piece(note["piece"]), Zone(note["zone"]), Articulation(note["articulation"]), _known(note)),
            int(note["velocity"]),
            limb=Limb(note["limb"]),
        )
        for at_ns, note in zip(loop.onset_ns[inside].tolist(), loop.notes[inside], strict=True)
    )


def _known(note: Mapping[str, float]) -> float | None:
    openness = float(note["openness"])
    return openness if isfinite(openness) else None


def parse_trigger(text: str, source: str) -> Trigger:
    """The trigger that a user wrote as PHASE=WHAT; raises `BadInput` that names `source`."""
    phase, equals, what = text.partition("=")
    if not equals:
        raise BadInput(source, text, "expected PHASE=WHAT, such as 0.25=kick")
    try:
        threshold = float(phase)
    except ValueError:
        threshold = -1.0
    if not 0 <= threshold < 1:
        raise BadInput(source, text, f"expected a phase from 0 up to, but not 1, found {phase or 'nothing'}")
    name, _, velocity = what.partition("@")
    trigger = _struck(name, text, source)
    return replace(trigger, threshold=threshold, velocity=_velocity(velocity, text, source))


def _struck(name: str, text: str, source: str) -> Trigger:
    if name.isdecimal():
        if not is_count(name) or int(name) > _GREATEST_NOTE:
            raise BadInput(source, text, f"expected a MIDI note from 0 to {_GREATEST_NOTE}, found {name}")
        return Trigger(0.0, strike_of(int(name), GENERAL_MIDI), midi_note=int(name))
    if name not in _BY_NAME:
        raise BadInput(source, text, f"no such piece: {name or 'none'}{did_you_mean(name, _BY_NAME)}")
    sound = _ZONES.get(_BY_NAME[name], NoteMeaning(_BY_NAME[name]))
    return Trigger(0.0, sound, midi_note=general_midi_note(sound.piece, sound.zone, sound.articulation, sound.openness))


def _velocity(word_: str, text: str, source: str) -> int:
    if not word_:
        return USUAL_VELOCITY
    if not is_count(word_) or not 1 <= int(word_) <= _GREATEST_VELOCITY:
        raise BadInput(source, text, f"expected a velocity from 1 to {_GREATEST_VELOCITY}, found {word_}")
    return int(word_)
