"""Random music that people could play: grooves with fills, ghosts, flams, double kick, left-hand ride.

Each is made from a seed alone. Bars are written on a grid as a drummer thinks them: an ostinato, backbeats, kicks, and
every few bars a fill.
"""

import numpy as np

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.core.units import PPQ
from station.music.score import Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

KINDS = ("rock", "ghosts", "shuffle", "double kick", "left ride", "fills", "flams", "sixteenths", "blast", "odd")
_TOMS = (Piece.SNARE, Piece.TOM_1, Piece.TOM_2, Piece.FLOOR_TOM_1)
_EIGHTH = PPQ // 2


def random_score(seed: int, bars: int = 8) -> Score:
    """The score of `seed`: its kind goes round `KINDS`, its tempo lies in 50–240 a minute, as that kind allows."""
    random = np.random.default_rng(seed)
    kind = KINDS[seed % len(KINDS)]
    most = {"sixteenths": 125, "double kick": 190, "blast": 240, "ghosts": 130}.get(kind, 200)
    bpm = float(np.round(random.uniform(50, most), 1))
    beats = int(random.choice([5, 7, 3])) if kind == "odd" else 4
    notes: list[Note] = []
    for bar in range(bars):
        start = bar * beats * PPQ
        fills = bar % 4 == 3 or (kind == "fills" and bar % 2 == 1)
        notes += _fill(random, start, beats, bpm) if fills else _groove(random, kind, start, beats)
        if bar and (bar % 4 == 0 or random.random() < 0.1):
            notes = [n for n in notes if n.tick != start or n.piece not in (Piece.HIHAT, Piece.RIDE)]
            notes.append(Note(start, Piece(random.choice([Piece.CRASH_1, Piece.CRASH_2])), Zone.EDGE, 115))
    tempos = [TempoChange.from_bpm(0, bpm)]
    if random.random() < 0.3:
        tempos.append(TempoChange.from_bpm(bars // 2 * beats * PPQ, bpm * random.uniform(0.85, 1.1)))
    tempo = TempoMap.build(tempos, [MeterChange(0, beats, 4)])
    return Score.from_notes(notes, tempo, title=f"random {seed}: {kind} at {bpm:g}")


def _loud(random: np.random.Generator, mean: float) -> int:
    return int(np.clip(random.normal(mean, 8), 8, 127))


def _groove(random: np.random.Generator, kind: str, start: int, beats: int) -> list[Note]:
    if kind == "blast":
        return _blast(random, start, beats)
    hat = Piece.RIDE if kind == "left ride" or random.random() < 0.3 else Piece.HIHAT
    limb = Limb.LEFT_HAND if kind == "left ride" else Limb.UNKNOWN
    step = PPQ // 4 if kind == "sixteenths" else _EIGHTH
    opened = random.random() < 0.3
    notes = []
    for k in range(beats * PPQ // step):
        tick = start + k * step
        if kind == "shuffle" and k % 2:
            tick += PPQ // 6
        last = opened and k == beats * PPQ // step - 1
        zone = Zone.BELL if hat == Piece.RIDE and random.random() < 0.1 else Zone.BOW
        openness = (1.0 if last else 0.0) if hat == Piece.HIHAT else None
        notes.append(Note(tick, hat, zone, _loud(random, 85 if k % 2 == 0 else 62), openness=openness, limb=limb))
    cross = kind == "odd" and random.random() < 0.4
    for beat in range(1, beats, 2):
        tick = start + beat * PPQ
        how = Articulation.CROSS_STICK if cross else Articulation.NORMAL
        other = Limb.RIGHT_HAND if kind == "left ride" else Limb.UNKNOWN
        notes.append(Note(tick, Piece.SNARE, Zone.HEAD, _loud(random, 105), how, Dynamic.ACCENT, other))
        if kind == "flams":
            notes.append(Note(tick, Piece.SNARE, Zone.HEAD, 40, ornament=Ornament.FLAM, lead_ms=28.0))
    if kind == "ghosts":
        taken = {n.tick for n in notes}
        for k in range(beats * 4):
            tick = start + k * PPQ // 4
            if tick not in taken and random.random() < 0.35:
                notes.append(Note(tick, Piece.SNARE, Zone.HEAD, _loud(random, 30), dynamic=Dynamic.GHOST))
    return notes + _kicks(random, kind, start, beats, hat == Piece.RIDE)


def _kicks(random: np.random.Generator, kind: str, start: int, beats: int, free: bool) -> list[Note]:
    """Kicks, and chicks where the hi-hat is `free`: one that is held shut cannot be shut."""
    if kind == "double kick":
        feet = (Limb.RIGHT_FOOT, Limb.LEFT_FOOT)
        return [Note(start + k * PPQ // 4, Piece.KICK, Zone.HEAD, 95, limb=feet[k % 2]) for k in range(beats * 4)]
    notes = [Note(start, Piece.KICK, Zone.HEAD, _loud(random, 100))]
    ticks = [k for k in range(1, beats * 2) if random.random() < 0.3]
    notes += [Note(start + k * _EIGHTH, Piece.KICK, Zone.HEAD, _loud(random, 95)) for k in ticks]
    if free and random.random() < 0.5:
        notes += [
            Note(start + b * PPQ, Piece.HIHAT_PEDAL, Zone.PEDAL, 70, Articulation.CHICK) for b in range(1, beats, 2)
        ]
    return notes


def _blast(random: np.random.Generator, start: int, beats: int) -> list[Note]:
    """Hat and kick in eighths, the snare between them."""
    notes = []
    for k in range(beats * 2):
        tick = start + k * _EIGHTH
        notes += [Note(tick, Piece.HIHAT, Zone.BOW, 80, openness=0.0), Note(tick, Piece.KICK, Zone.HEAD, 95)]
        if k % 2:
            notes.append(Note(tick, Piece.SNARE, Zone.HEAD, _loud(random, 90)))
    return notes


def _fill(random: np.random.Generator, start: int, beats: int, bpm: float) -> list[Note]:
    """Singles around the toms, now and then across; sixteenths up to 150 a minute, triplets or eighths beyond."""
    per_beat = 4 if bpm <= 150 else (3 if bpm <= 200 and random.random() < 0.5 else 2)
    notes, at = [], int(random.integers(0, 3))
    for k in range(beats * per_beat):
        if random.random() < 0.25:
            at = int(np.clip(at + random.choice([-1, 1, 2]), 0, len(_TOMS) - 1))
        if random.random() < 0.9:
            accent = k % per_beat == 0
            notes.append(Note(start + k * PPQ // per_beat, _TOMS[at], Zone.HEAD, _loud(random, 105 if accent else 80)))
    kicks = [Note(start + b * PPQ, Piece.KICK, Zone.HEAD, 90) for b in range(beats) if random.random() < 0.6]
    return notes + kicks
