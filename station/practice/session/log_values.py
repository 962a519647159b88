"""What a log in a capture is made of: scores, strokes and latencies as plain JSON, and read with suspicion.

Whatever is damaged raises `ValueError`, `TypeError`, `KeyError` or `AttributeError`; who reads a log makes one
complaint of them all.
"""

import math
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from station.core.pieces import Articulation, Dynamic, Limb, Ornament, Piece, Zone
from station.music.score import NOTE_DTYPE, Note, Score
from station.music.tempo import MeterChange, TempoChange, TempoMap
from station.practice.session.device_latency import KitLatency, Latency

MOST_TICKS = 2**32
"""So long may what is judged be (our choice: five hours at 120 bpm); what is longer is damage."""
_MOST_LEAD_MS = 10_000.0
"""No grace stroke lies so far from its note."""
_NEWER_COLUMNS = 2
"""The last columns of `NOTE_DTYPE`, swing and timing, are not in older captures, and 0 there."""


def score_fields(section: Score) -> dict[str, object]:
    """A score's strokes, tempi, meters and end, as `score_of` reads them."""
    tempo_map = section.tempo_map
    return {
        "notes": note_rows(section.notes),
        "tempos": [[change.tick, change.us_per_quarter] for change in tempo_map.tempos],
        "meters": [[change.tick, change.beats, change.unit, *change.groups] for change in tempo_map.meters],
        **({"tempo_is_played": True} if tempo_map.is_played else {}),
        "end_tick": section.end_tick,
    }


def note_rows(notes: NDArray[np.void]) -> list[list[float | int | None]]:
    """Rows (n,) of `NOTE_DTYPE` as plain numbers; what is not said is None."""
    return [_without_nan(row) for row in notes.tolist()]


def _without_nan(row: tuple[float | int, ...]) -> list[float | int | None]:
    return [None if isinstance(value, float) and math.isnan(value) else value for value in row]


def latency_fields(latency: Latency) -> dict[str, object]:
    """A latency, as `latency_from` reads it."""
    kits = {
        name: {"kit_ns": kit.kit_ns, "pads_ns": {str(int(piece)): ns for piece, ns in kit.pads_ns.items()}}
        for name, kit in latency.kits.items()
    }
    return {
        "input_ns": latency.input_ns,
        "output_ns": latency.output_ns,
        "kits": kits,
        "outputs_ns": dict(latency.outputs_ns),
    }


def landing_of(fields: dict[str, object]) -> NDArray[np.void]:
    """The `landing` among `fields`, rows (m,) of `NOTE_DTYPE`, none in old captures."""
    notes = [_note(rows_in(row)) for row in rows_in(fields.get("landing", []))]
    if any(note.tick for note in notes):
        raise ValueError
    return Score.from_notes(notes, TempoMap()).notes


def score_of(fields: dict[str, object]) -> Score:
    """The score whose `score_fields` these are."""
    rows, tempos, meters = (rows_in(fields[key]) for key in ("notes", "tempos", "meters"))
    tempo_map = TempoMap.build(
        [TempoChange(*map(whole, rows_in(change))) for change in tempos],
        [_meter(*map(whole, rows_in(change))) for change in meters],
        fields.get("tempo_is_played") is True,
    )
    end_tick, notes = whole(fields["end_tick"]), [_note(rows_in(row)) for row in rows]
    if not 0 < end_tick <= MOST_TICKS or any(not 0 <= note.tick < end_tick for note in notes):
        raise ValueError
    if any(meter.beats > MOST_TICKS for meter in tempo_map.meters):
        raise ValueError
    return Score.from_notes(notes, tempo_map, end_tick)


def _meter(tick: int, beats: int, unit: int, *groups: int) -> MeterChange:
    if groups and sum(groups) != beats:
        raise ValueError
    return MeterChange(tick, beats, unit, groups)


def _note(row: list[object]) -> Note:
    names = NOTE_DTYPE.names or ()
    newer = [0] * min(len(names) - len(row), _NEWER_COLUMNS)
    value = dict(zip(names, [*row, *newer], strict=True))
    openness, lead_ms, late_ms = value["openness"], value["lead_ms"], value["late_ms"]
    if not isinstance(openness, float | int | None):
        raise TypeError
    if not isinstance(lead_ms, float | int) or not isinstance(late_ms, float | int):
        raise TypeError
    if not (abs(lead_ms) <= _MOST_LEAD_MS and abs(late_ms) <= _MOST_LEAD_MS):
        raise ValueError
    if openness is not None and not 0 <= openness <= 1:
        raise ValueError
    if not 0 <= whole(value["swing_ticks"]) <= whole(value["tick"]):
        raise ValueError
    return Note(
        tick=whole(value["tick"]),
        piece=Piece(whole(value["piece"])),
        zone=Zone(whole(value["zone"])),
        velocity=whole(value["velocity"]),
        articulation=Articulation(whole(value["articulation"])),
        dynamic=Dynamic(whole(value["dynamic"])),
        limb=Limb(whole(value["limb"])),
        openness=openness,
        ornament=Ornament(whole(value["ornament"])),
        lead_ms=lead_ms,
        duration_ticks=whole(value["duration_ticks"]),
        choke_ticks=whole(value["choke_ticks"]),
        midi_note=whole(value["midi_note"]),
        swing_ticks=whole(value["swing_ticks"]),
        late_ms=late_ms,
    )


def latency_from(fields: dict[str, object]) -> Latency:
    """The latency whose `latency_fields` these are."""
    kits, outputs = (table_in(fields[key]) for key in ("kits", "outputs_ns"))
    return Latency(
        whole(fields["input_ns"]),
        whole(fields["output_ns"]),
        MappingProxyType({name: _kit_latency(table_in(kit)) for name, kit in kits.items()}),
        MappingProxyType({name: whole(ns) for name, ns in outputs.items()}),
    )


def _kit_latency(fields: dict[str, object]) -> KitLatency:
    pads = {Piece(int(piece)): whole(ns) for piece, ns in table_in(fields["pads_ns"]).items()}
    return KitLatency(whole(fields["kit_ns"]), MappingProxyType(pads))


def whole(value: object) -> int:
    """`value`, which is a whole number."""
    if not isinstance(value, int) or isinstance(value, bool) or abs(value) >= 2**62:
        raise TypeError
    return value


def rows_in(value: object) -> list[object]:
    """`value`, which is a list."""
    if not isinstance(value, list):
        raise TypeError
    return value


def table_in(value: object) -> dict[str, object]:
    """`value`, which is a table."""
    if not isinstance(value, dict):
        raise TypeError
    return value
