"""Benchmarks of the engine's own work: a stroke from bytes to event, a block of sound with strokes in it."""

import mido

from station.bench.harness.benchmark import Benchmark, Measurement, median_s
from station.core.units import NS_PER_S
from station.devices.mapping.presets import preset_named
from station.devices.midi.midi_decoder import MidiDecoder
from station.engine.engine import Engine
from station.sound.click_sounds import click_sounds
from station.sound.mixer import Mixer
from station.sound.synth.synth_kits import synth_kit

_STROKES = 5_000
_TIMES = 9
_RATE_HZ, _FRAMES = 48_000, 64
_BLOCKS = 2_000
_BLOCKS_A_STROKE = 20
"""A stroke every 27 ms: two hands at the fastest that drummers play."""
_SNARE = bytes((0x99, 38, 100))
_PEDAL_AND_HAT = (bytes((0xB9, 4, 64)), bytes((0x99, 46, 90)))
_US = 1e6


def _decode() -> Measurement:
    messages = [_SNARE, *_PEDAL_AND_HAT] * (_STROKES // 2)
    decoder, parser = MidiDecoder(preset_named("roland-td-17"), "TD-17"), mido.Parser()

    def ours() -> None:
        for message in messages:
            decoder.feed(message, 0)

    def theirs() -> None:
        for message in messages:
            parser.feed(message)
            parser.get_message()

    scale = _US / len(messages)
    return Measurement(scale * median_s(ours, _TIMES), scale * median_s(theirs, _TIMES))


def _block() -> Measurement:
    engine = Engine(Mixer(synth_kit(_RATE_HZ), click_sounds(_RATE_HZ)))
    count = 0

    def blocks() -> None:
        nonlocal count
        for _ in range(_BLOCKS):
            if count % _BLOCKS_A_STROKE == 0:
                engine.feed("TD-17", _SNARE, count)
                for message in _PEDAL_AND_HAT:
                    engine.feed("TD-17", message, count)
            engine.render(_FRAMES, count * _FRAMES * NS_PER_S // _RATE_HZ)
            count += 1
        engine.advance(count)

    return Measurement(_US * median_s(blocks, _TIMES) / _BLOCKS)


BENCHMARKS = (
    Benchmark("midi_message_to_event", "µs", None, "lower", "mido", _decode),
    Benchmark("engine_block_of_64_with_strokes", "µs", None, "lower", None, _block),
)
