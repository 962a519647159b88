"""How a virtual student's strokes are struck: piece, zone, loudness, bounces, and the cymbals that are grabbed.

Velocities scatter about the written ones, changed by planted habits, and are clipped to 1–127, so that the mean of
accents near the top comes out a little lower than written.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import CYMBALS, Articulation, Dynamic, Limb, Piece, Zone
from station.core.units import NS_PER_MS
from station.music.judgement import Label
from station.music.performance import CHOKE_DTYPE, HIT_DTYPE
from station.music.score import Score
from station.simulation.student_faults import PlantedHabits, louder
from station.simulation.student_form import Form
from station.simulation.student_reading import StudentReading
from station.simulation.student_slips import PLAIN_VELOCITY, Slips

Floats = NDArray[np.float64]

GREATEST_VELOCITY = 127
_BOWS = np.array(sorted(CYMBALS | {Piece.HIHAT}), np.uint8)
_WRITTEN = ("openness", "piece", "zone", "articulation", "velocity", "limb", "midi_note")


@dataclass(frozen=True, slots=True)
class PlayedStrokes:
    """Strikes the strokes of one student; `written` and `extra` are where their loudness draws its chances from."""

    written: np.random.Generator
    extra: np.random.Generator

    def of_notes(self, reading: StudentReading, form: Form, habits: PlantedHabits, slips: Slips) -> NDArray[np.void]:
        """A hit for every row, missed or not, at time 0: shape (n,) of `HIT_DTYPE`."""
        hits = _as_written(reading.score.notes)
        hits["limb"], hits["piece"] = reading.limbs, slips.piece
        _make_plain(hits, slips.label == Label.WRONG_PIECE)
        mean = louder(reading.score.notes["velocity"].astype(np.float64), habits.level_db)
        hits["velocity"] = _velocities(mean, form.velocity_sd, self.written)
        opened = (habits.openness > 0.0) & (hits["piece"] == Piece.HIHAT)
        hits["openness"][opened] = np.minimum(hits["openness"][opened] + habits.openness[opened], 1.0)
        return hits

    def of_extras(self, reading: StudentReading, form: Form, slips: Slips) -> NDArray[np.void]:
        """A hit for every extra at time 0, struck as the score's plain strokes of its piece are, and never softly."""
        usual = {piece: _usual_row(reading.score, piece) for piece in np.unique(slips.extra_piece).tolist()}
        rows = [usual[piece] for piece in slips.extra_piece.tolist()]
        hits = _as_written(reading.score.notes[rows])
        not_in_score = hits["piece"] != slips.extra_piece
        hits["piece"], hits["limb"], hits["midi_note"] = slips.extra_piece, Limb.UNKNOWN, 0
        _make_plain(hits, not_in_score)
        mean = np.maximum(hits["velocity"], PLAIN_VELOCITY).astype(np.float64)
        drawn = _velocities(mean, form.velocity_sd[rows], self.extra)
        hits["velocity"] = np.maximum(drawn, PLAIN_VELOCITY)
        return hits


def _velocities(mean: Floats, sd: Floats, rng: np.random.Generator) -> NDArray[np.uint8]:
    drawn = np.rint(mean + sd * rng.standard_normal(len(mean)))
    return np.clip(drawn, 1, GREATEST_VELOCITY).astype(np.uint8)


def bounces_of(score: Score, habits: PlantedHabits, slips: Slips, notes: NDArray[np.void]) -> NDArray[np.void]:
    """The bounces (`HIT_DTYPE`) after the presses of buzz rolls that are played bounce by bounce, softer than these."""
    rows = np.flatnonzero((habits.short_ms > 0.0) & (slips.label == Label.MATCH))
    bounces = [np.empty(0, HIT_DTYPE)]
    for row in rows.tolist():
        tick = score.notes["tick"][row]
        start_ns, end_ns = score.tempo_map.ns_at([tick, tick + score.notes["duration_ticks"][row]]).tolist()
        length_ns = end_ns - start_ns - round(habits.short_ms[row] * NS_PER_MS)
        press = notes[row : row + 1]
        own = np.repeat(press, max(length_ns // BOUNCE_NS, 1) - 1)  # the next bounce would be the end
        own["at_ns"] += BOUNCE_NS * np.arange(1, len(own) + 1)
        own["velocity"] = np.maximum(BOUNCE_SOFTER * own["velocity"], 1)
        bounces.append(own)
    return np.concatenate(bounces)


BOUNCE_NS, BOUNCE_SOFTER = 30 * NS_PER_MS, 0.7
"""Our choice: a pressed stick bounces some 30 times a second, each bounce a few dB softer than the press."""


def chokes_of(score: Score, habits: PlantedHabits, slips: Slips, onset_ns: NDArray[np.int64]) -> NDArray[np.void]:
    """The grabs (`CHOKE_DTYPE`) of cymbals that were struck, after their `onset_ns` (n,) as written and as is habit."""
    notes = score.notes
    rows = (notes["choke_ticks"] > 0) & (slips.label == Label.MATCH)
    ticks = notes["tick"][rows]
    rings_ns = score.tempo_map.ns_at(ticks + notes["choke_ticks"][rows]) - score.tempo_map.ns_at(ticks)
    chokes = np.zeros(int(rows.sum()), CHOKE_DTYPE)
    longer_ns = np.rint(habits.ring_ms[rows] * NS_PER_MS).astype(np.int64)
    chokes["at_ns"], chokes["piece"] = onset_ns[rows] + rings_ns + longer_ns, notes["piece"][rows]
    return chokes


def _as_written(notes: NDArray[np.void]) -> NDArray[np.void]:
    hits = np.zeros(len(notes), HIT_DTYPE)
    for name in _WRITTEN:
        hits[name] = notes[name]
    hits["position"] = np.nan
    return hits


def _make_plain(hits: NDArray[np.void], rows: NDArray[np.bool_]) -> None:
    """Strike `rows` in the plainest way of their piece, for which nothing was written."""
    hits["zone"][rows] = np.where(np.isin(hits["piece"][rows], _BOWS), Zone.BOW, Zone.HEAD)
    hits["articulation"][rows] = Articulation.NORMAL
    hits["midi_note"][rows] = 0
    hits["openness"][rows] = np.nan


def _usual_row(score: Score, piece: int) -> int:
    """A row of `piece` that is plainly struck, as far as there is one; else row 0."""
    notes = score.notes
    oddity = score.is_grace.astype(int) + (notes["dynamic"] != Dynamic.NORMAL) + (notes["articulation"] != 0)
    rows = np.flatnonzero(notes["piece"] == piece)
    return int(rows[np.argmin(oddity[rows])]) if len(rows) else 0
