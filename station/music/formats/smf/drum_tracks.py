"""The drums in a MIDI file: as a written score, or as hits that were played.

Our choices, for a MIDI file says what sounds and not what is meant:
* dynamics stay `NORMAL` and velocities are kept: 110 may be an accent in one file and the plain backbeat of another;
* strokes have no duration, for in most files a drum's note length is an accident of the editor; but where all strokes
  have one length and some of a drum are held, these are buzz rolls (`held_notes`);
* no flam or drag is inferred: its strokes stand where they are written;
* in a score, strokes of one tick that mean the same strike (a doubled number, 35 over 36) are one, the loudest.

The hi-hat pedal (controller 4) refines the openness that the note number says, unless the two contradict each other by
more than `CONTRADICTION`, as where a controller never moves. Controller 16 is where on the snare the stick lands.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from station.core.note_map import KitMap, strike_of
from station.core.pieces import CHOKEABLE, Articulation, Dynamic, Limb, Ornament, Piece
from station.core.units import NS_PER_US, PPQ
from station.music.formats.smf.contents import MidiFile, MidiSequence
from station.music.formats.smf.drum_channels import (
    PEDAL_CONTROLLER,
    SNARE_POSITION_CONTROLLER,
    Drums,
    drums_of,
    guess_kit_map,
)
from station.music.formats.smf.held_notes import held_notes
from station.music.performance import CHOKE_DTYPE, HIT_DTYPE, Performance
from station.music.score import NOTE_DTYPE, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap

CONTRADICTION = 0.75
"""Where pedal and number differ by more, the number is right (our choice; modules change it a third of the way)."""
_LEAST_SHUT = 32
"""What controller 4 says below this while closed numbers sound is not "shut": no pedal was sent (our choice)."""
_FULL = 127

_GRAB_DTYPE = np.dtype([("tick", np.int64), ("piece", np.uint8)])
_ALL_NUMBERS = range(128)
_SHORTEST_BUZZ_TICKS = PPQ // 4
"""A sixteenth: the shortest cell that our lessons hold (our choice)."""


# --- what they mean ---------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class _Meaning:
    """The kit map as look-up tables by note number, each of shape (128,)."""

    piece: NDArray[np.uint8]
    zone: NDArray[np.uint8]
    articulation: NDArray[np.uint8]
    openness: NDArray[np.float32]
    same_as: NDArray[np.uint8]

    @classmethod
    def of(cls, kit_map: KitMap) -> "_Meaning":
        strikes = [strike_of(number, kit_map) for number in _ALL_NUMBERS]
        return cls(
            np.array([s.piece for s in strikes], np.uint8),
            np.array([s.zone for s in strikes], np.uint8),
            np.array([s.articulation for s in strikes], np.uint8),
            np.array([np.nan if s.openness is None else s.openness for s in strikes], np.float32),
            np.array([n if s.piece is Piece.PERCUSSION else strikes.index(s) for n, s in enumerate(strikes)], np.uint8),
        )


def _openness(drums: Drums, meaning: _Meaning) -> NDArray[np.float32]:
    """The openness of each note, from its number and the pedal before it; NaN for what is no hi-hat."""
    numbers = drums.notes["number"]
    written = meaning.openness[numbers]
    value = _latest(drums, PEDAL_CONTROLLER)
    is_hat = (meaning.piece[numbers] == Piece.HIHAT) & ~np.isnan(value)
    shut = _FULL if drums.is_declared else _shut_value(value[is_hat & (written == 0)])
    pedal = np.clip(1 - value / shut, 0, 1).astype(np.float32)
    agrees = is_hat & ~(np.abs(pedal - written) > CONTRADICTION)
    return np.where(agrees, pedal, written)


def _shut_value(while_closed: NDArray[np.float64]) -> float:
    """What controller 4 says when this kit's pedal is shut, from its values before notes that are closed."""
    usual = float(np.median(while_closed)) if len(while_closed) else _FULL
    return usual if usual >= _LEAST_SHUT else _FULL


def _latest(drums: Drums, controller: int) -> NDArray[np.float64]:
    """The value of `controller` when each note sounds; NaN before its first."""
    moves = drums.controllers[drums.controllers["number"] == controller]
    tick, place = (np.concatenate([moves[name], drums.notes[name]]) for name in ("tick", "place"))
    order = np.lexsort((place, tick))
    latest = np.empty(len(order), np.int64)
    latest[order] = np.maximum.accumulate(np.where(order < len(moves), order, -1))
    return np.append(moves["value"], np.nan)[latest[len(moves) :]]


def _chokes(drums: Drums, meaning: _Meaning) -> NDArray[np.void]:
    """Tick and cymbal of every grab: key pressure above 0 on one of its numbers while none is held.

    A new stroke on the cymbal lets it go, for some modules never send the release.
    """
    presses = drums.aftertouch[np.isin(meaning.piece[drums.aftertouch["number"]], sorted(CHOKEABLE))]
    pieces = meaning.piece[presses["number"]]
    strokes = _strokes_before(presses["tick"], pieces, drums.notes["tick"], meaning.piece[drums.notes["number"]])
    held: dict[int, set[int]] = {int(piece): set() for piece in CHOKEABLE}
    strokes_seen = dict.fromkeys(held, 0)
    chokes: list[tuple[int, int]] = []
    columns = (presses["tick"], pieces, presses["number"], presses["value"], strokes)
    for tick, piece, number, value, stroke_count in zip(*(c.tolist() for c in columns), strict=True):
        if stroke_count != strokes_seen[piece]:
            held[piece].clear()
            strokes_seen[piece] = stroke_count
        if not value:
            held[piece].discard(number)
            continue
        if not held[piece]:
            chokes.append((tick, piece))
        held[piece].add(number)
    return np.array(chokes, _GRAB_DTYPE)


def _strokes_before(
    ticks: NDArray[np.int64], pieces: NDArray[np.uint8], note_ticks: NDArray[np.int64], note_pieces: NDArray[np.uint8]
) -> NDArray[np.int64]:
    """How many strokes each piece had up to each of its ticks, that tick included."""
    counts = np.zeros(len(ticks), np.int64)
    for piece in np.unique(pieces):
        of_piece = pieces == piece
        counts[of_piece] = np.searchsorted(note_ticks[note_pieces == piece], ticks[of_piece], side="right")
    return counts


# --- a performance ----------------------------------------------------------------------------------------------------


def performance_from_midi(midi: MidiFile, kit_map: KitMap | None = None) -> Performance:
    """The drums of `midi` as hits, time 0 at the file's start; sequences of format 2 follow one another.

    Without `kit_map` it is guessed by `guess_kit_map`. Raises `BadInput` for a file with notes but no drums.
    """
    meaning = _Meaning.of(guess_kit_map(midi) if kit_map is None else kit_map)
    hits, chokes, start_ns = [np.empty(0, HIT_DTYPE)], [np.empty(0, CHOKE_DTYPE)], 0
    for drums in drums_of(midi):
        hits.append(_hit_rows(drums, meaning, start_ns))
        chokes.append(_choke_rows(drums, meaning, start_ns))
        start_ns += int(drums.sequence.ns_at(drums.sequence.end_tick))
    return Performance.from_array(np.concatenate(hits), np.concatenate(chokes))


def _choke_rows(drums: Drums, meaning: _Meaning, start_ns: int) -> NDArray[np.void]:
    grabs = _chokes(drums, meaning)
    rows = np.empty(len(grabs), CHOKE_DTYPE)
    rows["at_ns"], rows["piece"] = drums.sequence.ns_at(grabs["tick"]) + start_ns, grabs["piece"]
    return rows


def _hit_rows(drums: Drums, meaning: _Meaning, start_ns: int) -> NDArray[np.void]:
    notes = drums.notes
    numbers = notes["number"]
    rows = np.zeros(len(notes), HIT_DTYPE)
    rows["at_ns"] = drums.sequence.ns_at(notes["tick"]) + start_ns
    rows["openness"] = _openness(drums, meaning)
    position = _latest(drums, SNARE_POSITION_CONTROLLER) / _FULL
    rows["position"] = np.where(meaning.piece[numbers] == Piece.SNARE, position, np.nan)
    rows["piece"], rows["zone"] = meaning.piece[numbers], meaning.zone[numbers]
    rows["articulation"] = meaning.articulation[numbers]
    rows["velocity"], rows["midi_note"], rows["limb"] = notes["velocity"], numbers, Limb.UNKNOWN
    return rows


# --- a score ----------------------------------------------------------------------------------------------------------


def score_from_midi(midi: MidiFile, kit_map: KitMap | None = None) -> Score:
    """The drums of `midi` as a score with its tempo and meter; it ends with the bar of its last stroke.

    File ticks become `PPQ`, exactly where the file's division divides it, else to the nearest. SMPTE files keep their
    times under the tempo they state (120 bpm if none). The patterns of a format 2 file follow one another. Without
    `kit_map` it is guessed by `guess_kit_map`. Raises `BadInput` for a file with notes but no drums.
    """
    meaning = _Meaning.of(guess_kit_map(midi) if kit_map is None else kit_map)
    parts = [_part(drums, meaning) for drums in drums_of(midi)]
    if not parts:
        return Score.from_array(np.empty(0, NOTE_DTYPE), TempoMap(), title=midi.title)
    whole = parts[0] if len(parts) == 1 else Score.joined(parts)
    return Score.from_array(whole.notes, whole.tempo_map, title=midi.title)


def _part(drums: Drums, meaning: _Meaning) -> Score:
    """One sequence as a score that ends where the sequence does."""
    sequence = drums.sequence
    tempo_map = _tempo_map(sequence)
    rows = _note_rows(drums, meaning, score_ticks(sequence, tempo_map, drums.notes["tick"]))
    lasts = np.maximum(drums.notes["duration_ticks"], 0)
    _write_buzzes(rows, score_ticks(sequence, tempo_map, drums.notes["tick"] + lasts))
    rows = rows[_loudest_of_layers(rows, meaning)]
    chokes = _chokes(drums, meaning)
    chokes["tick"] = score_ticks(sequence, tempo_map, chokes["tick"])
    _write_chokes(rows, chokes)
    return Score.from_array(rows, tempo_map, int(score_ticks(sequence, tempo_map, sequence.end_tick)))


def _note_rows(drums: Drums, meaning: _Meaning, ticks: NDArray[np.int64]) -> NDArray[np.void]:
    numbers = drums.notes["number"]
    rows = np.zeros(len(numbers), NOTE_DTYPE)
    rows["tick"], rows["openness"] = ticks, _openness(drums, meaning)
    rows["piece"], rows["zone"] = meaning.piece[numbers], meaning.zone[numbers]
    rows["articulation"] = meaning.articulation[numbers]
    rows["velocity"], rows["midi_note"] = drums.notes["velocity"], numbers
    rows["dynamic"], rows["ornament"], rows["limb"] = Dynamic.NORMAL, Ornament.NONE, Limb.UNKNOWN
    return rows


def _write_buzzes(rows: NDArray[np.void], ends: NDArray[np.int64]) -> None:
    """Make buzz rolls of the drums' notes that are held until `ends` (n,)."""
    lasts = ends - rows["tick"]
    held = held_notes(rows["tick"], lasts, rows["piece"], rows["articulation"], _SHORTEST_BUZZ_TICKS)
    rows["articulation"][held], rows["ornament"][held] = Articulation.BUZZ, Ornament.ROLL
    rows["duration_ticks"][held] = lasts[held]


def _write_chokes(rows: NDArray[np.void], chokes: NDArray[np.void]) -> None:
    """Give each grab to the last stroke of its cymbal before it; of two grabs of one stroke the first counts."""
    for piece in np.unique(chokes["piece"]):
        struck = np.flatnonzero(rows["piece"] == piece)
        grabbed_at = chokes["tick"][chokes["piece"] == piece][::-1]  # the first grab is assigned last, and stays
        stroke = np.searchsorted(rows["tick"][struck], grabbed_at, side="left") - 1
        of_one = stroke >= 0
        rows["choke_ticks"][struck[stroke[of_one]]] = grabbed_at[of_one] - rows["tick"][struck[stroke[of_one]]]


def _loudest_of_layers(rows: NDArray[np.void], meaning: _Meaning) -> NDArray[np.int64]:
    """Indices of the strokes to keep: of those on one tick that mean the same strike, the loudest."""
    same = meaning.same_as[rows["midi_note"]]
    order = np.lexsort((-rows["velocity"].astype(np.int64), same, rows["tick"]))
    tick, strike = rows["tick"][order], same[order]
    first = np.ones(len(order), np.bool_)
    first[1:] = (tick[1:] != tick[:-1]) | (strike[1:] != strike[:-1])
    return np.sort(order[first])


# --- ticks ------------------------------------------------------------------------------------------------------------


def _tempo_map(sequence: MidiSequence) -> TempoMap:
    if sequence.division.us is None:
        tempos = [TempoChange(_at_ppq(t.tick, sequence), t.us_per_quarter) for t in sequence.tempos]
        meters = [MeterChange(_at_ppq(m.tick, sequence), m.beats, m.unit) for m in sequence.meters]
        return TempoMap.build(tempos, meters)
    tempo_map = TempoMap.build(_tempos_of_smpte(sequence))
    meter_ticks = tempo_map.ticks_at_ns(sequence.ns_at([m.tick for m in sequence.meters])).tolist()
    meters = [MeterChange(at, m.beats, m.unit) for at, m in zip(meter_ticks, sequence.meters, strict=True)]
    return TempoMap.build(tempo_map.tempos, meters)


def _tempos_of_smpte(sequence: MidiSequence) -> list[TempoChange]:
    """The tempo changes of a file in SMPTE time, each on the score tick nearest to its time."""
    changes = [TempoChange(0, sequence.tempos[0].us_per_quarter)]
    reached = 0  # time of the last change in units of 1/PPQ µs, as the tempo map counts it
    times_ns = sequence.ns_at([t.tick for t in sequence.tempos]).tolist()
    for change, at_ns in zip(sequence.tempos[1:], times_ns[1:], strict=True):
        rate = changes[-1].us_per_quarter
        ticks = round((at_ns * PPQ - reached * NS_PER_US) / (rate * NS_PER_US))
        reached += ticks * rate
        changes.append(TempoChange(changes[-1].tick + ticks, change.us_per_quarter))
    return changes


def _at_ppq(tick: int, sequence: MidiSequence) -> int:
    return (2 * tick * PPQ + sequence.division.ticks) // (2 * sequence.division.ticks)


def score_ticks(sequence: MidiSequence, tempo_map: TempoMap, ticks: ArrayLike) -> NDArray[np.int64]:
    """File ticks as score ticks, to the nearest."""
    if sequence.division.us is not None:
        return tempo_map.ticks_at_ns(sequence.ns_at(ticks))
    division = sequence.division.ticks
    quarters, rest = np.divmod(np.asarray(ticks, np.int64), division)
    scaled: NDArray[np.int64] = quarters * PPQ + (2 * rest * PPQ + division) // (2 * division)
    return scaled
