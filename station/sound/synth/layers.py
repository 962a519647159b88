"""From a recipe to the layers of a sound: every layer in `TAKES` takes that differ as two strokes of one hand do.

Each row is made once a take, as two halves that go to the two ears in different shares; the layers weigh the rows. Only
tones that glide depend on the hardness otherwise and are made for every layer. All layers and takes are brought to one
loudness, so that the level of a velocity is the kit's law alone.
"""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from station.sound.drum_kit import MAX_VELOCITY, Frames, Layer, Sound
from station.sound.limiter import soft_clip
from station.sound.synth.recipe import PIVOT_HZ, Recipe, Row, Tone
from station.sound.synth.room_reverb import LENGTH_S as ROOM_S
from station.sound.synth.room_reverb import in_room
from station.sound.synth.sound_parts import amplitude_of, halves, stretched_times, tones

TAKES = 2
LOUD_S = 0.03
"""Loudness is the greatest mean square over so long, about the time in which the ear sums a stroke's attack."""
_ROW_SPREAD_DB = 1.2
"""How far a row's level varies from take to take (our choice: strokes of one player on one spot)."""
_PITCH_SPREAD = 0.002
"""A few cents from take to take: a head is not stretched alike everywhere."""
_FLOOR_DB = 66.0
"""What lies so far below a take's peak is cut off."""
_ROW_FADE = 6
"""The last sixth of a row fades out, so that a band's end is not heard."""
_FADE_S = 0.02
_BLOCK = 256
_HOPS = 6
"""Loudness is measured in steps of a sixth of its window."""
_LOUDEST_S = 0.3
"""Whatever is struck is loudest within so long."""

Halves = NDArray[np.float32]
"""float32 (layers, 2, n): each layer in two halves, or left and right."""


def make_sound(recipe: Recipe, rate_hz: int, seed: int) -> Sound:
    """The recipe as a playable sound at `rate_hz`; the same seed gives the same sound."""
    takes = [_take(recipe, rate_hz, np.random.default_rng([seed, take])) for take in range(TAKES)]
    layers = zip(recipe.layers, *takes, strict=True)
    return Sound(tuple(Layer(reach, tuple(frames)) for reach, *frames in layers))


def hardnesses(layers: tuple[int, ...]) -> list[float]:
    """The hardness that each layer sounds with: that of the middle of its velocities, and 1 for the last."""
    lows = (0, *layers[:-1])
    middles = [(low + reach) / 2.0 / MAX_VELOCITY for low, reach in zip(lows, layers, strict=True)]
    return [*middles[:-1], 1.0]


def weight(row: Row, recipe: Recipe, hardness: float) -> float:
    """The factor on a row's amplitude for a stroke of this hardness."""
    octaves = max(0.0, float(np.log2(row.pitch_hz / PIVOT_HZ)))
    loss_db = (1.0 - hardness) * (recipe.tilt_db * octaves - row.soft_db)
    return float(10.0 ** (-loss_db / 20.0))


def row_lengths(recipe: Recipe, rate_hz: int) -> list[int]:
    """How many frames each row is heard: until it lies `_FLOOR_DB` below where the loudest row began."""
    begins_db = [20.0 * np.log10(amplitude_of(row.level_db, row.t60_s)) for row in recipe.rows]
    heard_db = [max(6.0, _FLOOR_DB + begin - max(begins_db)) for begin in begins_db]
    return [round(row.t60_s * db / 60.0 * rate_hz) for row, db in zip(recipe.rows, heard_db, strict=True)]


def _take(recipe: Recipe, rate_hz: int, rng: np.random.Generator) -> list[Frames]:
    sums = _sum_rows(recipe, rate_hz, rng)
    bounced = sums.copy() if recipe.echoes else sums
    for delay_s, amplitude in recipe.echoes:
        delay = round(delay_s * rate_hz)
        bounced[..., delay:] += np.float32(amplitude) * sums[..., :-delay]
    ears = _placed(bounced, recipe)
    if recipe.room_db is not None:
        _add_room(ears, recipe.room_db, rate_hz)
    return [_levelled(_ended(layer, rate_hz), recipe, rate_hz) for layer in ears]


def _sum_rows(recipe: Recipe, rate_hz: int, rng: np.random.Generator) -> Halves:
    hard = hardnesses(recipe.layers)
    lengths = row_lengths(recipe, rate_hz)
    tail_s = max((delay for delay, _ in recipe.echoes), default=0.0) + (ROOM_S if recipe.room_db is not None else 0.0)
    sums = np.zeros((len(hard), 2, max(lengths) + round(tail_s * rate_hz)), np.float32)
    times_s = stretched_times(recipe.glide, hard, max(lengths), rate_hz)
    for row, length in zip(recipe.rows, lengths, strict=True):
        spread = 10.0 ** (rng.normal(0.0, _ROW_SPREAD_DB, 2) / 20.0)
        weights = np.outer([weight(row, recipe, hardness) for hardness in hard], spread).astype(np.float32)
        if isinstance(row, Tone):
            detuned = replace(row, freq_hz=row.freq_hz * (1.0 + rng.normal(0.0, _PITCH_SPREAD)))
            made = tones(detuned, times_s[:, :length], rate_hz)[:, None]
        else:
            made = halves(row, length, rate_hz, rng)
        made[..., -length // _ROW_FADE :] *= np.linspace(1.0, 0.0, -(-length // _ROW_FADE), dtype=np.float32)
        sums[:, :, :length] += weights[:, :, None] * made
    return sums


def _placed(sums: Halves, recipe: Recipe) -> Halves:
    """Left and right from the two halves, by the recipe's width and pan (equal power)."""
    spread = (1.0 + recipe.width) * np.pi / 4.0
    aside = (1.0 + recipe.pan) * np.pi / 4.0
    near, far = np.sin(spread), np.cos(spread)
    mix = np.array([[near, far], [far, near]]) * np.sqrt(2.0) * np.array([[np.cos(aside)], [np.sin(aside)]])
    ears: Halves = np.einsum("eh,lhn->len", mix.astype(np.float32), sums)
    return ears


def _add_room(ears: Halves, room_db: float, rate_hz: int) -> None:
    """Add the room's answer to the middle layer to every layer, as loud as the layer's own energy asks."""
    middle = ears[len(ears) // 2].mean(axis=0)
    room = in_room(middle, rate_hz).T * np.float32(10.0 ** (room_db / 20.0))
    energies = np.mean(np.sum(ears**2, axis=2), axis=1)
    factors = np.sqrt(energies / np.sum(middle**2))
    ears += factors[:, None, None] * room


def _ended(ears: Halves, rate_hz: int) -> Frames:
    """One layer (2, n) as frames (n, 2) without DC, cut where it has died away, the end faded to exactly zero."""
    blocks = -(-ears.shape[1] // _BLOCK)
    peaks = np.maximum.reduceat(np.abs(ears), np.arange(blocks) * _BLOCK, axis=1).max(axis=0)
    heard = np.flatnonzero(peaks > peaks.max() * 10.0 ** (-_FLOOR_DB / 20.0))[-1] + 1
    kept = ears[:, : heard * _BLOCK].copy()
    length = kept.shape[1]
    fade = min(length, round(_FADE_S * rate_hz))
    kept[:, -fade:] *= np.linspace(1.0, 0.0, fade, dtype=np.float32)
    along = np.linspace(0.0, 1.0, length, dtype=np.float32)
    hump = along * (1.0 - along)
    kept -= hump * (kept.sum(axis=1, keepdims=True) / hump.sum())
    return np.ascontiguousarray(kept.T)


def loudness(frames: Frames, rate_hz: int) -> float:
    """The greatest RMS over `LOUD_S` in the first `_LOUDEST_S`, both channels together."""
    hop = round(LOUD_S * rate_hz / _HOPS)
    begin = frames[: max(_HOPS, round(_LOUDEST_S * rate_hz) // hop) * hop]
    sums = np.add.reduceat(np.square(begin).reshape(-1), np.arange(0, begin.size, 2 * hop))
    windows = np.convolve(sums, np.ones(_HOPS))
    return float(np.sqrt(windows.max() / (2 * hop * _HOPS)))


def _levelled(frames: Frames, recipe: Recipe, rate_hz: int) -> Frames:
    """`frames` as loud as the recipe says; the rare peak that would come near full scale is bent."""
    wanted = 10.0 ** (recipe.loudness_db / 20.0)
    return soft_clip(frames * np.float32(wanted / loudness(frames, rate_hz)))
