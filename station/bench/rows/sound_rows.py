"""Benchmarks of the sound: a block with every voice ringing, what a stroke or a track adds, how soon a kit is there."""

import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.core.note_map import NoteMeaning
from station.core.pieces import Piece, Zone
from station.sound.buses import Bus
from station.sound.click_sounds import click_sounds
from station.sound.drum_kit import DrumKit
from station.sound.mixer import MAX_VOICES, Mixer
from station.sound.synth.synth_cache import cached_kit
from station.sound.synth.synth_kits import KIT_NAME, synth_kit
from station.sound.track import TRACK_SLACK, Track
from station.sound.track_file import stretched

RATE_HZ = 48_000
BLOCK_FRAMES = 64
_BLOCKS = 600
"""0.8 s: every stroke of `_LONG` still rings at the end."""
_READS = 3
_LONG = (
    *(
        NoteMeaning(piece, Zone.EDGE)
        for piece in (Piece.RIDE, Piece.CRASH_1, Piece.CRASH_2, Piece.CHINA)
        for _ in range(6)
    ),
    *(NoteMeaning(piece) for piece in (Piece.FLOOR_TOM_1, Piece.FLOOR_TOM_2) for _ in range(4)),
)


def _ringing() -> Mixer:
    """A mixer with all its voices ringing."""
    mixer = Mixer(synth_kit(RATE_HZ), click_sounds(RATE_HZ))
    for strike in _LONG:
        mixer.trigger(Bus.STUDENT, strike, 100)
    mixer.render(BLOCK_FRAMES)
    assert mixer.ringing == MAX_VOICES, "every voice rings"
    return mixer


def _block() -> Measurement:
    mixer = _ringing()
    ours_s = median_s(lambda: mixer.render(BLOCK_FRAMES), _BLOCKS)
    assert mixer.ringing == MAX_VOICES, "every voice still rings"
    return Measurement(1e6 * ours_s, 1e6 * _voice_by_voice_s())


def _voice_by_voice_s() -> float:
    """The same block as most would write it: each voice scaled and added in turn, no bus, no fade, no limiter."""
    kit = synth_kit(RATE_HZ)
    voices = [kit.choose(strike)[1].frames_for(100, 0).reshape(-1) for strike in _LONG]
    size = 2 * BLOCK_FRAMES
    out, scaled = np.empty(size, np.float32), np.empty(size, np.float32)
    at = 0

    def block() -> None:
        nonlocal at
        out[:] = 0.0
        for voice in voices:
            np.multiply(voice[at : at + size], 0.62, out=scaled)
            np.add(out, scaled, out=out)
        np.clip(out, -1.0, 1.0, out=out)
        at += size

    return median_s(block, _BLOCKS)


def _stroke() -> Measurement:
    """A stroke where every voice rings: it is chosen, another voice is stolen, and the block is mixed in one piece."""
    mixer = _ringing()

    def stroke() -> None:
        mixer.trigger(Bus.STUDENT, NoteMeaning(Piece.SNARE), 100)
        mixer.render(BLOCK_FRAMES)

    return Measurement(1e6 * median_s(stroke, _BLOCKS))


def _track() -> Measurement:
    """The block of `_block` with a looped track that is moved by a frame each time, as under the worst drift."""
    mixer = _ringing()
    pcm = np.random.default_rng(1).integers(-8000, 8000, (RATE_HZ, 2), np.int16)
    mixer.play_track(Track(pcm, RATE_HZ, loop=(0, RATE_HZ)))
    blocks = 0

    def block() -> None:
        nonlocal blocks
        mixer.keep_track_at(blocks * (BLOCK_FRAMES + 1) + TRACK_SLACK)
        mixer.render(BLOCK_FRAMES)
        blocks += 1

    return Measurement(1e6 * median_s(block, _BLOCKS))


def _stretching() -> Measurement:
    """Ten seconds of noise to three quarters of its speed, in seconds a second of it."""
    seconds = 10
    noise = np.random.default_rng(1).normal(0.0, 0.1, (seconds * RATE_HZ, 2)).astype(np.float32)
    start = time.perf_counter()
    stretched(noise, RATE_HZ, 0.75)
    return Measurement((time.perf_counter() - start) / seconds)


def _kit() -> Measurement:
    """The kit as every start but the first finds it: on disk."""
    with TemporaryDirectory() as folder:
        made_s, kit = _ready(Path(folder))
        held = f"{len(kit.sounds)} sounds in {kit.bytes_held / 1e6:.0f} MB; {made_s:.1f} s to make it the first time"
        return Measurement(min(_ready(Path(folder))[0] for _ in range(_READS)), note=held)


def _ready(folder: Path) -> tuple[float, DrumKit]:
    start = time.perf_counter()
    kit = cached_kit(KIT_NAME, RATE_HZ, folder)
    return time.perf_counter() - start, kit


BENCHMARKS = (
    Benchmark("mixer_block_64_frames_32_voices", "µs", 50, "lower", "numpy, voice by voice", _block),
    Benchmark("mixer_block_with_a_stroke_all_voices_taken", "µs", 200, "lower", None, _stroke),
    Benchmark("mixer_block_32_voices_and_a_track", "µs", 100, "lower", None, _track),
    Benchmark("track_stretched_a_second_of_it", "s", 0.1, "lower", None, _stretching),
    Benchmark("drum_kit_ready", "s", 0.5, "lower", None, _kit),
)
