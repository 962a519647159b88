"""Scores and performances as MIDI files that every program reads: channel 10, written whole or not at all.

A score keeps its ticks exactly where 480 or 26880 ticks a quarter note can (26880 = `PPQ`/4 holds triplets,
quintuplets, septuplets down to 1/1024), else to the nearest 1/26880; it keeps tempo, meter, title, velocities, chokes,
and the hi-hat's openness where it is neither shut nor open. A grace stroke stands `lead_ms` before its main stroke, and
a stroke with a timing of its own where it sounds; where the first would come before the file's start, one empty bar
goes before all. Limbs, dynamics and ornaments have no
place in a MIDI file: a lesson keeps those.

A performance is written in real time, one tick for `PERFORMANCE_TICK_NS`. It keeps the note numbers of the kit that
played it if they read back as the same strikes, else it has those of General MIDI; the instrument name says which.

Source: MIDI Association, RP-001 "Standard MIDI Files 1.0", RP-003 "General MIDI".
"""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.core.note_map import GENERAL_MIDI, V_DRUMS, KitMap, general_midi_note, strike_of
from station.core.pieces import Articulation, Piece, Zone
from station.core.units import PPQ
from station.music.formats.smf.contents import DRUM_CHANNEL
from station.music.formats.smf.drum_channels import KIT_MAP_NAMES, PEDAL_CONTROLLER, SNARE_POSITION_CONTROLLER
from station.music.formats.smf.track_bytes import MESSAGE_DTYPE, Messages, OutTrack, tracks_bytes
from station.music.performance import Performance
from station.music.score import Score
from station.music.tempo import MeterChange, TempoChange

_DIVISIONS = (480, PPQ // 4)
"""Ticks a quarter note: what most programs use, and the finest that ours is a multiple of and 15 bits hold."""
_STROKE_TICKS = PPQ // 8
"""A stroke's length in a score file: a 32nd, long enough to be seen in an editor (our choice)."""

PERFORMANCE_TICK_NS = 16_000
_PERFORMANCE_DIVISION = 31_250
_PERFORMANCE_TEMPO = TempoChange(0, 500_000)
_PERFORMANCE_STROKE_TICKS = 3_125
"""120 bpm in 31250 ticks of 16 µs, near the finest that 15 bits hold; strokes last 50 ms (our choice)."""

_MAX_US_PER_QUARTER = (1 << 24) - 1
_MAX_BEATS = 255
_FULL = 127

_NOTE_OFF, _NOTE_ON, _AFTERTOUCH, _CONTROL = 0x80, 0x90, 0xA0, 0xB0
_ENDS, _DESCRIBES, _BEGINS = range(3)
"""The order of messages on one tick: what ends, what describes the next note, what begins."""

# --- a score ----------------------------------------------------------------------------------------------------------


def write_score(score: Score, path: str | Path) -> None:
    """Write `score_bytes` at `path`; raises `DeviceError` if the disk refuses."""
    write_whole(Path(path), score_bytes(score, str(path)))


def score_bytes(score: Score, name: str, markers: Sequence[tuple[int, str]] = ()) -> bytes:
    """`score` as a MIDI file of format 1: title, tempo, meter and `markers`; drums by General MIDI numbers.

    Raises `BadInput` of `name` for a tempo or meter that MIDI cannot write.
    """
    onsets = _onset_ticks(score)
    pickup = bars_before(score)
    division = _division(score, onsets)
    step = PPQ // division
    starts = _divided(onsets + pickup, step)
    conductor = _conductor(score, markers, pickup, step, name)
    drums = OutTrack("Drums", _score_messages(score, starts, step), _instrument(GENERAL_MIDI))
    return tracks_bytes([conductor, drums], division, int(_divided(score.end_tick + pickup, step)))


def bars_before(score: Score) -> int:
    """The ticks of the empty bars that stand before the music so that no grace stroke comes before the file."""
    bar = score.tempo_map.meters[0].bar_ticks
    return -(int(_onset_ticks(score).min(initial=0)) // bar) * bar


def _onset_ticks(score: Score) -> NDArray[np.int64]:
    is_elsewhere = score.is_grace | (score.notes["late_ms"] != 0)
    return np.where(is_elsewhere, score.tempo_map.ticks_at_ns(score.onset_ns), score.notes["tick"])


def _division(score: Score, onsets: NDArray[np.int64]) -> int:
    """The first of `_DIVISIONS` that holds every tick exactly, else the finest."""
    changes = [t.tick for t in score.tempo_map.tempos] + [m.tick for m in score.tempo_map.meters]
    chokes = score.notes["choke_ticks"]  # as distances: they are exact if their strokes are
    ticks = np.concatenate([onsets, chokes, np.array([*changes, score.end_tick], np.int64)])
    return next((d for d in _DIVISIONS if not (ticks % (PPQ // d)).any()), _DIVISIONS[-1])


def _divided(ticks: NDArray[np.int64] | int, step: int) -> NDArray[np.int64]:
    """Score ticks as file ticks of `step` score ticks, to the nearest."""
    return (np.asarray(ticks, np.int64) + step // 2) // step


def _conductor(score: Score, markers: Sequence[tuple[int, str]], pickup: int, step: int, source: str) -> OutTrack:
    def moved(tick: int) -> int:
        return int(_divided(tick + pickup, step)) if tick else 0

    for tempo in score.tempo_map.tempos:
        if tempo.us_per_quarter > _MAX_US_PER_QUARTER:
            raise BadInput(source, f"tick {tempo.tick}", "MIDI has no tempo below 3.58 quarter notes a minute")
    for meter in score.tempo_map.meters:
        if meter.beats > _MAX_BEATS or meter.unit.bit_count() != 1:
            raise BadInput(source, f"tick {meter.tick}", f"MIDI cannot write a meter of {meter.beats}/{meter.unit}")
    tempos = [TempoChange(moved(t.tick), t.us_per_quarter) for t in score.tempo_map.tempos]
    meters = [MeterChange(moved(m.tick), m.beats, m.unit) for m in score.tempo_map.meters]
    return OutTrack(
        score.title, np.empty(0, MESSAGE_DTYPE), "", tempos, meters, [(moved(tick), text) for tick, text in markers]
    )


def _score_messages(score: Score, starts: NDArray[np.int64], step: int) -> Messages:
    notes = score.notes
    numbers = np.array([_number(row) for row in notes], np.uint8)
    lengths = _divided(np.maximum(notes["duration_ticks"], _STROKE_TICKS), step)
    choked = notes["choke_ticks"] > 0
    grabbed_at = _divided(notes["choke_ticks"][choked], step) + starts[choked]
    is_hat = notes["piece"] == Piece.HIHAT
    openness = np.nan_to_num(notes["openness"][is_hat], nan=0.0)
    half_open = bool(np.any((openness > 0) & (openness < 1)))
    pedal = _described(starts[is_hat], PEDAL_CONTROLLER, 1 - openness) if half_open else _NO_MESSAGES
    return np.concatenate(
        [_strokes(starts, numbers, notes["velocity"], lengths), _grabs(grabbed_at, numbers[choked]), pedal]
    )


def _number(row: np.void) -> int:
    """The General MIDI number of a note or hit; percussion of no kit keeps its own."""
    own = int(row["midi_note"])
    if row["piece"] == Piece.PERCUSSION and own and own not in GENERAL_MIDI:
        return own
    openness = None if np.isnan(row["openness"]) else float(row["openness"])
    return general_midi_note(Piece(row["piece"]), Zone(row["zone"]), Articulation(row["articulation"]), openness)


# --- a performance ----------------------------------------------------------------------------------------------------


class ControlMove(NamedTuple):
    """A controller takes a value, 0 … 127."""

    at_ns: int
    controller: int
    value: int


def write_performance(performance: Performance, path: str | Path, moves: Sequence[ControlMove] = ()) -> None:
    """Write `performance` as a MIDI file of format 0 in real time; the file starts at time 0, or at an earlier hit.

    Times are kept to half of `PERFORMANCE_TICK_NS`. `moves`, from time 0 on, are written beside the hits. Raises
    `DeviceError` if the disk refuses.
    """
    hits, chokes = performance.hits, performance.chokes
    start_ns = min(int(hits["at_ns"].min(initial=0)), int(chokes["at_ns"].min(initial=0)))
    kit_map = _kept_map(hits)
    numbers = hits["midi_note"] if kit_map else np.array([_number(row) for row in hits], np.uint8)
    starts = _divided(hits["at_ns"] - start_ns, PERFORMANCE_TICK_NS)
    lengths = np.full(len(hits), _PERFORMANCE_STROKE_TICKS, np.int64)
    choke_numbers = [_choke_number(piece, hits["piece"], numbers) for piece in chokes["piece"].tolist()]
    parts = [
        _strokes(starts, numbers, hits["velocity"], lengths),
        _grabs(_divided(chokes["at_ns"] - start_ns, PERFORMANCE_TICK_NS), np.array(choke_numbers, np.uint8)),
        _known(starts, hits, Piece.HIHAT, PEDAL_CONTROLLER),
        _known(starts, hits, Piece.SNARE, SNARE_POSITION_CONTROLLER),
        _moved(moves, start_ns),
    ]
    messages = np.concatenate(parts)
    track = OutTrack("Drums", messages, _instrument(kit_map or GENERAL_MIDI), [_PERFORMANCE_TEMPO])
    data = tracks_bytes([track], _PERFORMANCE_DIVISION, int(messages["tick"].max(initial=0)))
    write_whole(Path(path), data)


def _kept_map(hits: NDArray[np.void]) -> KitMap | None:
    """The map by which every hit's own number reads back as the same piece, zone and articulation, if there is one."""
    kinds = np.unique(hits[["midi_note", "piece", "zone", "articulation"]])
    for kit_map in (GENERAL_MIDI, V_DRUMS):
        strikes = [strike_of(int(k["midi_note"]), kit_map) for k in kinds]
        if all(
            k["midi_note"] and (s.piece, s.zone, s.articulation) == (k["piece"], k["zone"], k["articulation"])
            for k, s in zip(kinds, strikes, strict=True)
        ):
            return kit_map
    return None


def _choke_number(piece: int, pieces: NDArray[np.uint8], numbers: NDArray[np.uint8]) -> int:
    """A number that means `piece` in this file: one that was hit, else General MIDI's."""
    struck = numbers[pieces == piece]
    return int(struck[0]) if len(struck) else general_midi_note(Piece(piece), Zone.EDGE, Articulation.NORMAL)


def _moved(moves: Sequence[ControlMove], start_ns: int) -> Messages:
    rows = _messages(len(moves), _DESCRIBES, _CONTROL)
    at_ns, controllers, values = np.array(moves, np.int64).reshape(-1, 3).T
    rows["tick"] = _divided(at_ns - start_ns, PERFORMANCE_TICK_NS)
    rows["first"], rows["second"] = controllers, values
    return rows


def _known(starts: NDArray[np.int64], hits: NDArray[np.void], piece: Piece, controller: int) -> Messages:
    """What a controller said before the hits on `piece`: the hi-hat's openness, or the position on the snare."""
    values = 1 - hits["openness"] if controller == PEDAL_CONTROLLER else hits["position"]
    known = (hits["piece"] == piece) & ~np.isnan(values)
    return _described(starts[known], controller, values[known])


# --- messages ---------------------------------------------------------------------------------------------------------


def _messages(count: int, rank: int, status: int) -> Messages:
    rows = np.zeros(count, MESSAGE_DTYPE)
    rows["rank"], rows["status"] = rank, status | DRUM_CHANNEL
    return rows


_NO_MESSAGES = _messages(0, _DESCRIBES, _CONTROL)


def _strokes(
    starts: NDArray[np.int64], numbers: NDArray[np.uint8], velocities: NDArray[np.uint8], lengths: NDArray[np.int64]
) -> Messages:
    """Note ons and offs; a stroke ends where the next of its number begins, and is never without length."""
    on, off = _messages(len(starts), _BEGINS, _NOTE_ON), _messages(len(starts), _ENDS, _NOTE_OFF)
    on["tick"], on["first"], on["second"] = starts, numbers, np.clip(velocities, 1, _FULL)
    ends = starts + lengths
    order = np.lexsort((starts, numbers))
    this, following = order[:-1], order[1:]
    same = numbers[this] == numbers[following]
    ends[this[same]] = np.minimum(ends[this[same]], starts[following[same]])
    off["tick"], off["first"] = np.maximum(ends, starts + 1), numbers
    return np.concatenate([on, off])


def _grabs(ticks: NDArray[np.int64], numbers: NDArray[np.uint8]) -> Messages:
    """Key pressure, full and gone, for every grabbed cymbal."""
    pressed, released = (_messages(len(ticks), _ENDS, _AFTERTOUCH) for _ in range(2))
    for rows, value in ((pressed, _FULL), (released, 0)):
        rows["tick"], rows["first"], rows["second"] = ticks, numbers, value
    return np.stack([pressed, released], axis=1).ravel()


def _described(ticks: NDArray[np.int64], controller: int, shares: NDArray[np.float32]) -> Messages:
    """A controller of value `shares` 0…1 before the notes at `ticks`, wherever it changes."""
    order = np.argsort(ticks, kind="stable")
    values = np.rint(np.clip(shares[order], 0, 1) * _FULL).astype(np.uint8)
    changes = np.flatnonzero(np.diff(values.astype(np.int64), prepend=-1))
    rows = _messages(len(changes), _DESCRIBES, _CONTROL)
    rows["tick"], rows["first"], rows["second"] = ticks[order][changes], controller, values[changes]
    return rows


def _instrument(kit_map: KitMap) -> str:
    return next(name for name, known in KIT_MAP_NAMES.items() if known is kit_map)
