"""Short scores for tests: each shows one thing and is small enough to count by hand."""

from station.core.pieces import Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import TempoMap

R, L = Limb.RIGHT_HAND, Limb.LEFT_HAND


def rock_beat(bars: int, tempo_bpm: float = 120.0) -> Score:
    """Eighths on the hat, kick on 1 and 3, accented snare on 2 and 4, a ghost before 3: 13 strokes a bar."""
    eighth = PPQ // 2
    notes = [Note(i * eighth, Piece.HIHAT, Zone.BOW, 80, openness=0.0) for i in range(8)]
    notes += [Note(beat * PPQ, Piece.KICK, velocity=90) for beat in (0, 2)]
    notes += [Note(beat * PPQ, Piece.SNARE, velocity=110, dynamic=Dynamic.ACCENT) for beat in (1, 3)]
    notes += [Note(7 * PPQ // 4, Piece.SNARE, velocity=32, dynamic=Dynamic.GHOST)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def even_snare(strokes: int, interval_ms: int) -> Score:
    """Quarters on the snare by the right hand, `interval_ms` apart."""
    notes = [Note(i * PPQ, Piece.SNARE, velocity=80, limb=R) for i in range(strokes)]
    return Score.from_notes(notes, TempoMap.constant(60_000 / interval_ms), strokes * PPQ)


def double_strokes(bars: int, tempo_bpm: float = 60.0) -> Score:
    """Sixteenths on the snare, RRLL: 16 strokes and 8 doubles a bar."""
    notes = [Note(i * PPQ // 4, Piece.SNARE, limb=(R, R, L, L)[i % 4]) for i in range(16)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def flams(bars: int) -> Score:
    """Quarters on the snare, each with a grace stroke 30 ms before it: 8 strokes a bar, at 120 bpm."""
    notes = [
        Note(beat * PPQ, Piece.SNARE, limb=limb, velocity=velocity, lead_ms=lead, ornament=Ornament.FLAM)
        for beat in range(4)
        for limb, velocity, lead in ((L, 35, 30.0), (R, 100, 0.0))
    ]
    return Score.from_notes(notes, TempoMap.constant(120)).repeated(bars)


def swing_ride(bars: int, offbeat_ticks: int = 2 * PPQ // 3, tempo_bpm: float = 120.0) -> Score:
    """Ride on every beat and on the swung offbeats of 2 and 4, hi-hat foot on 2 and 4: 8 strokes a bar, 2 swung."""
    notes = [Note(beat * PPQ, Piece.RIDE, Zone.BOW) for beat in range(4)]
    notes += [Note(beat * PPQ + offbeat_ticks, Piece.RIDE, Zone.BOW) for beat in (1, 3)]
    notes += [Note(beat * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL) for beat in (1, 3)]
    return Score.from_notes(notes, TempoMap.constant(tempo_bpm)).repeated(bars)


def beat_and_fill(times: int, tempo_bpm: float = 100.0) -> Score:
    """Three bars of `rock_beat`, then one whose last two beats are sixteenths down the toms: 8 strokes of fill."""
    groove = rock_beat(3, tempo_bpm)
    half = rock_beat(1, tempo_bpm)
    toms = (Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_1)
    fill = [Note(2 * PPQ + i * PPQ // 4, toms[i // 2]) for i in range(8)]
    kept = [note for note in half if note.tick < 2 * PPQ and note.dynamic is not Dynamic.GHOST]
    last = Score.from_notes([*kept, *fill], half.tempo_map, half.end_tick)
    return Score.joined([groove, last]).repeated(times)
