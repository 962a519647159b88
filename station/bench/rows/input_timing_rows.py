"""Benchmarks of the way from wire to hit in real time: how exact stamps are, how soon plugs are seen, captures kept."""

import itertools
import os
import random
import statistics
import time
from collections.abc import Callable, Sequence
from functools import cache, partial
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from station.bench.harness.benchmark import Benchmark, Measurement
from station.bench.rigs.devices.engine_hearing import ListeningRig, Wire, read_barely, stage
from station.bench.rigs.devices.playing_kit import velocity_of
from station.core.clock import monotonic_ns
from station.core.disk_cache import cache_folder
from station.core.events import DeviceFound, DeviceLost
from station.core.units import NS_PER_MS, NS_PER_S
from station.devices.capture.capture import MAGIC, CaptureRecord, RecordKind, RecordWriter, start_record
from station.devices.capture.capture_writer import CaptureFile

_STROKES, _STEP_NS = 300, 21 * NS_PER_MS + 7_919
"""A stroke every 21 ms, out of step with every period and poll."""
_FLOOD_STEP_NS, _FLOOD_S = NS_PER_MS, 60
_PLUGS = 100
_RECORDS, _RECORDS_A_S = 400, 60
FOUND_WITHIN_S = 10.0
_BARE = "bare read"

Errors = NDArray[np.float64]


@cache
def _late_ms(wire: Wire) -> tuple[Errors, str]:
    """By how much each stamp is later than the median stamp, and the account of all."""
    with stage(wire) as at:
        sent_ns, hits = at.played("play", _STEP_NS, _STROKES)
    pairs = paired([velocity_of(index) for index in range(_STROKES)], [hit.velocity for hit in hits])
    late_ms = np.array([hits[heard].at_ns - sent_ns[sent] for sent, heard in pairs]) / NS_PER_MS
    median_ms = float(np.median(late_ms))
    account = f"{len(pairs)} of {_STROKES} strokes while drawing, {median_ms:.2f} ms after they were sent (median)"
    return late_ms - median_ms, account


def paired(sent: Sequence[int], heard: Sequence[int]) -> list[tuple[int, int]]:
    """Which entry of `sent` each of `heard` is, where some are missing: the first of its kind after the one before."""
    pairs, at = [], 0
    for index, velocity in enumerate(heard):
        while at < len(sent) and sent[at] != velocity:
            at += 1
        if at == len(sent):
            raise ValueError(f"what was heard at place {index} was not sent")
        pairs.append((at, index))
        at += 1
    return pairs


@cache
def _bare_ms(wire: Wire) -> Errors | None:
    """The same of the plainest reader of a serial line; there is none of JACK."""
    if wire.jack_frames:
        return None
    sent_ns, read_ns = read_barely(wire.baud, _STEP_NS, _STROKES)
    late_ms: Errors = (np.array(read_ns) - np.array(sent_ns)) / NS_PER_MS
    return late_ms - np.median(late_ms)


def _stamps(of: Callable[[Errors], float], wire: Wire) -> Measurement:
    late_ms, note = _late_ms(wire)
    bare_ms = _bare_ms(wire)
    return Measurement(of(late_ms), None if bare_ms is None else of(bare_ms), note)


def _sd(late_ms: Errors) -> float:
    return float(np.std(late_ms))


def _p99(late_ms: Errors) -> float:
    return float(np.percentile(np.abs(late_ms), 99))


def _on_disk() -> Path:
    """A folder for scratch files: the system's own may be in memory, and where one works nothing may be left."""
    folder = cache_folder("bench")
    folder.mkdir(parents=True, exist_ok=True)
    return folder


def _capture_ms() -> Measurement:
    """How long a record is not yet on the disk, at worst: from `append` to the end of the `fsync` that keeps it."""
    kept: list[tuple[int, int]] = []
    really = os.fsync

    def noted(file: int) -> None:
        size = os.fstat(file).st_size
        really(file)
        kept.append((size, monotonic_ns()))

    os.fsync = noted  # type: ignore[assignment] # to see when the disk has it; the work itself is done
    appended = []
    record, chance = CaptureRecord(RecordKind.BYTES, 1, 0, b"\x99\x26\x64"), random.Random(1)
    with TemporaryDirectory(dir=_on_disk()) as folder:
        capture = CaptureFile(Path(folder) / "take.cap", 0)
        for _ in range(_RECORDS):
            time.sleep(chance.expovariate(_RECORDS_A_S))
            appended.append(monotonic_ns())
            capture.append(record)
        capture.close(0)
    head = len(MAGIC) + len(RecordWriter().encode(start_record(0, 0)))
    ends = itertools.count(head, len(RecordWriter().encode(record)))
    waits_ms = [
        (next(at_ns for size, at_ns in kept if size >= end) - appended_ns) / NS_PER_MS
        for end, appended_ns in zip(itertools.islice(ends, 1, None), appended, strict=False)
    ]
    return Measurement(max(waits_ms), note=f"{_RECORDS} records, {statistics.median(waits_ms):.0f} ms each (median)")


# --- soaks ------------------------------------------------------------------------------------------------------------


def _flood_lost(wire: Wire) -> Measurement:
    with stage(wire) as at:
        sent, hits = at.played("flood", _FLOOD_STEP_NS, _FLOOD_S * NS_PER_S // _FLOOD_STEP_NS)
    strokes = [velocity_of(index) for index in range(0, len(sent), 4)]
    heard = paired(strokes, [hit.velocity for hit in hits])
    return Measurement(len(strokes) - len(heard), note=f"{len(sent)} messages, {len(strokes)} of them strokes")


def _plug_cycles(wire: Wire) -> tuple[list[float], list[float], int]:
    """Seconds until the kit is found and until it is missed, cycle by cycle; what the engine then holds too much."""
    found_s, lost_s = [], []
    with stage(wire, draws=False) as at:
        _unplug(at)
        held = _held(at)
        for _ in range(_PLUGS):
            plugged_ns = at.player.plug()
            events = at.until(lambda event: isinstance(event, DeviceFound), FOUND_WITHIN_S)
            found_s += [(event.at_ns - plugged_ns) / NS_PER_S for event in events if isinstance(event, DeviceFound)]
            lost_s.append(_unplug(at))
        return found_s, lost_s, _held(at) - held


def _unplug(at: ListeningRig) -> float:
    unplugged_ns = at.player.unplug()
    events = at.until(lambda event: isinstance(event, DeviceLost), FOUND_WITHIN_S)
    return max(event.at_ns - unplugged_ns for event in events if isinstance(event, DeviceLost)) / NS_PER_S


def _held(at: ListeningRig) -> int:
    """Files and threads of the engine's process (Linux)."""
    return sum(len(list(Path(f"/proc/{at.engine.pid}/{what}").iterdir())) for what in ("fd", "task"))


def _plugs_seen(wire: Wire) -> Measurement:
    found_s, lost_s, _ = _plug_cycles(wire)
    return Measurement(
        max(found_s + lost_s), note=f"{_PLUGS} cycles, found after {statistics.median(found_s):.2f} s (median)"
    )


def _plugs_leaked(wire: Wire) -> Measurement:
    return Measurement(_plug_cycles(wire)[2], note=f"{_PLUGS} cycles")


_SERIAL, _JACK_16, _JACK_32, _JACK_128 = Wire(), Wire(16), Wire(32), Wire(128, patient=True)
_FAST_SERIAL = Wire(baud=115_200)

BENCHMARKS = (
    Benchmark("stamps_serial_sd", "ms", 0.3, "lower", _BARE, partial(_stamps, _sd, _SERIAL), group="serial"),
    Benchmark("stamps_serial_p99", "ms", 1.0, "lower", _BARE, partial(_stamps, _p99, _SERIAL), group="serial"),
    Benchmark("stamps_jack_16_frames_sd", "ms", 0.3, "lower", None, partial(_stamps, _sd, _JACK_16), group="jack 16"),
    Benchmark("stamps_jack_16_frames_p99", "ms", 1.0, "lower", None, partial(_stamps, _p99, _JACK_16), group="jack 16"),
    Benchmark("stamps_jack_32_frames_sd", "ms", 0.3, "lower", None, partial(_stamps, _sd, _JACK_32), group="jack 32"),
    Benchmark("stamps_jack_32_frames_p99", "ms", 1.0, "lower", None, partial(_stamps, _p99, _JACK_32), group="jack 32"),
    Benchmark("capture_on_the_disk_worst", "ms", 100.0, "lower", None, _capture_ms),
    Benchmark("flood_serial_hits_lost", "hits", 0.0, "lower", None, partial(_flood_lost, _FAST_SERIAL), True, 180.0),
    Benchmark("flood_jack_hits_lost", "hits", 0.0, "lower", None, partial(_flood_lost, _JACK_128), True, 180.0),
    Benchmark("plugs_serial_seen_worst", "s", 1.0, "lower", None, partial(_plugs_seen, _SERIAL), True, 400.0),
    Benchmark(
        "plugs_serial_leaked", "files and threads", 0.0, "lower", None, partial(_plugs_leaked, _SERIAL), True, 400.0
    ),
    Benchmark("plugs_jack_seen_worst", "s", 1.0, "lower", None, partial(_plugs_seen, _JACK_128), True, 400.0),
    Benchmark(
        "plugs_jack_leaked", "files and threads", 0.0, "lower", None, partial(_plugs_leaked, _JACK_128), True, 400.0
    ),
)
