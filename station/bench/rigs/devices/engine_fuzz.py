"""A fuzzer of the engine's ear: bytes that no sane module sends, through the engine, and damaged captures.

A fault is an error that is raised, a hit that the bytes do not hold, a value out of its range, or an input that takes
longer than a stroke may wait.
"""

import random
import time
from collections.abc import Iterable
from dataclasses import dataclass

from station.bench.rigs.devices.midi_fuzz import cut_anywhere, hostile_bytes, invented, notes_in
from station.core.errors import BadInput
from station.core.events import DeviceEvent, Hit, PedalMoved
from station.core.pieces import Piece, Zone
from station.core.units import NS_PER_MS
from station.devices.capture.capture import (
    MAGIC,
    CaptureRecord,
    RecordKind,
    RecordWriter,
    device_record,
    parse_capture,
    stroke_record,
)
from station.devices.capture.replay import replay
from station.devices.mapping.presets import PRESETS
from station.engine.engine import Engine

SLOW_S = 1.0
"""An input that takes so long hangs the engine (our choice: a thousand times what one takes)."""
MOST_TOLD = 3


@dataclass(slots=True)
class Fuzzed:
    """What came of it: how many inputs were tried, and what was wrong with the first few that failed."""

    inputs: int = 0
    faults: int = 0
    told: tuple[str, ...] = ()

    def blame(self, what: str, data: bytes) -> None:
        """Count a fault; the first few are kept with the bytes that brought them about."""
        self.faults += 1
        self.told = (*self.told, f"{what}: {data.hex(' ')}")[:MOST_TOLD]


def fuzz_engine(inputs: int, seed: int) -> Fuzzed:
    """Feed `inputs` hostile inputs to one engine, each to the kit of one preset or another as if freshly plugged in."""
    chance, result, engine = random.Random(seed), Fuzzed(), Engine()
    names = list(PRESETS)
    for name in names:
        engine.use_preset(name, PRESETS[name])
    for result.inputs in range(1, inputs + 1):
        data, device = hostile_bytes(chance), chance.choice(names)
        at_ns = result.inputs * NS_PER_MS
        begun_s = time.perf_counter()
        try:
            engine.device_found(device, at_ns)
            for piece in cut_anywhere(data, chance):
                engine.feed(device, piece, at_ns)
            engine.device_lost(device, at_ns)  # which settles what was still in doubt
            events = [event for event in engine.advance(at_ns) if isinstance(event, DeviceEvent)]
        except Exception as fault:
            result.blame(repr(fault), data)
            continue
        if (what := _wrong(events, data, at_ns)) is not None:
            result.blame(what, data)
        if time.perf_counter() - begun_s > SLOW_S:
            result.blame("slow", data)
    return result


def _wrong(events: Iterable[DeviceEvent], data: bytes, at_ns: int) -> str | None:
    """What is wrong with `events` as an account of `data`, if anything is."""
    hits = [event for event in events if isinstance(event, Hit)]
    if hits and invented([(hit.midi_note, hit.velocity) for hit in hits], notes_in(data)):
        return "invented"
    if any(hit.at_ns != at_ns for hit in hits):
        return "another time"
    opennesses = [event.openness for event in events if isinstance(event, Hit | PedalMoved)]
    if any(openness is not None and not 0.0 <= openness <= 1.0 for openness in opennesses):
        return "openness out of range"
    return None


def fuzz_captures(inputs: int, seed: int) -> Fuzzed:
    """Replay `inputs` damaged captures: each is read up to its damage or refused, and the part before it is kept."""
    chance, result = random.Random(seed), Fuzzed()
    whole, ends = _capture(chance)
    for result.inputs in range(1, inputs + 1):
        data = bytearray(whole)
        at = chance.randrange(len(data))
        if chance.random() < 0.5:
            data[at] ^= chance.randrange(1, 256)
        else:
            data[at:] = chance.randbytes(chance.randrange(40))
        sound = sum(end <= at for end in ends)
        try:
            capture = parse_capture(bytes(data))
            list(replay(capture))
            if len(capture.records) < sound:
                result.blame(f"kept {len(capture.records)} of {sound} records", bytes(data[at : at + 8]))
        except BadInput:
            if at >= len(MAGIC):
                result.blame("refused", bytes(data[at : at + 8]))
        except Exception as fault:
            result.blame(repr(fault), bytes(data[at : at + 8]))
    return result


def _capture(chance: random.Random) -> tuple[bytes, list[int]]:
    """A capture with every kind of record, and where each of its records ends."""
    stroke = stroke_record(1, Hit(3, Piece.SNARE, Zone.HEAD, 9))
    records = [device_record(1, 0, "kit", "general-midi"), CaptureRecord(RecordKind.FOUND, 1, 1), stroke]
    records += [CaptureRecord(RecordKind.BYTES, 1, at_ns, hostile_bytes(chance)) for at_ns in range(2, 40)]
    records += [
        CaptureRecord(RecordKind.ZERO, 0, 40),
        CaptureRecord(RecordKind.LOST, 1, 41),
        CaptureRecord(99, 1, 42, b"later"),
        CaptureRecord(RecordKind.END, 0, 43),
    ]
    writer, data, ends = RecordWriter(), MAGIC, []
    for record in records:
        data += writer.encode(record)
        ends.append(len(data))
    return data, ends
