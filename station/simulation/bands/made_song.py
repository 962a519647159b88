"""A whole song of the virtual band: the score that a student gets, the sound, and the truth about every beat."""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from station.core.units import PPQ
from station.music.score import Score
from station.simulation.bands.band_part import BAR_BEATS, SECTION_BARS, band_part
from station.simulation.bands.band_sound import RATE_HZ, TAKES, BandMix, Mono, add, in_a_room, pluck, stroke, swell
from station.simulation.bands.band_timing import BandDrift, drifting_beats

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class SongSpec:
    """What is asked: its seed, its length, its tempo, the written tempo, and how well the part fits the band.

    `left_out` is the share of the written strokes that the band's drummer leaves out, `own` the share that they play
    otherwise than written; `stroke_s` is the SD of single strokes, `strum_s` how late chords are at the most.
    """

    seed: int
    length_s: float = 240.0
    bpm: float = 120.0
    written_bpm: float = 120.0
    drift: BandDrift = field(default_factory=BandDrift)
    mix: BandMix = field(default_factory=BandMix)
    lead_in_s: float = 1.5
    left_out: float = 0.03
    own: float = 0.03
    stroke_s: float = 0.006
    strum_s: float = 0.012


@dataclass(frozen=True, eq=False)
class MadeSong:
    """`score`, `mono` (n,) at `RATE_HZ`, its `drums` (n,) alone; beat i, a quarter, is played at `beat_s[i]`."""

    score: Score
    mono: Mono
    drums: Mono
    beat_ticks: NDArray[np.int64]
    beat_s: Floats

    def seconds_at(self, ticks: NDArray[np.int64]) -> Floats:
        """When the band plays `ticks`: even within each beat."""
        return np.interp(ticks, self.beat_ticks, self.beat_s)


def made_song(spec: SongSpec, part: Score | None = None) -> MadeSong:
    """The song that `spec` asks for, of `part` where there is one; the same spec gives the same song."""
    rng = np.random.default_rng(spec.seed)
    bars = max(2, round(spec.length_s * spec.bpm / 60 / BAR_BEATS))
    score = band_part(bars, spec.written_bpm, rng) if part is None else part
    beats = -(-score.end_tick // PPQ) + 1
    chorus = (np.arange(beats) // (SECTION_BARS * BAR_BEATS)) % 2
    pushed = np.convolve(np.pad(chorus, 4, "edge"), np.full(9, 1 / 9), "valid")
    beat_s = spec.lead_in_s + drifting_beats(beats, 60 / spec.bpm, spec.drift, rng, pushed)
    song = MadeSong(score, np.zeros(0, np.float32), np.zeros(0, np.float32), np.arange(beats) * PPQ, beat_s)
    drums, rest = _drums(song, spec, rng), _band(song, spec, rng)
    played = in_a_room(drums, spec.mix.room, rng)
    mono = played + in_a_room(rest, spec.mix.room, rng) + rng.normal(0, spec.mix.noise, len(drums)).astype(np.float32)
    gain = np.float32(0.7 / max(float(np.abs(mono).max()), 1e-6))
    return replace(song, mono=(mono * gain).astype(np.float32), drums=(played * gain).astype(np.float32))


def _silence(song: MadeSong) -> Mono:
    return np.zeros(round((song.beat_s[-1] + 2.0) * RATE_HZ), np.float32)


def _drums(song: MadeSong, spec: SongSpec, rng: np.random.Generator) -> Mono:
    mix = _silence(song)
    sixteenth = PPQ // 4
    for note in song.score:
        fate = rng.random()
        if fate < spec.left_out or not spec.mix.drums:
            continue
        tick = note.tick + (sixteenth if fate < spec.left_out + spec.own else 0)
        at_s = float(song.seconds_at(np.array(tick))) + rng.normal(0, spec.stroke_s)
        add(mix, at_s, stroke(note.piece, note.velocity, int(rng.integers(TAKES))), spec.mix.drums)
    return mix


ROOTS_HZ = (55.0, 73.42, 49.0, 65.41)
"""A, D, G and C of a bass."""


def _band(song: MadeSong, spec: SongSpec, rng: np.random.Generator) -> Mono:
    mix = _silence(song)
    for beat in range(len(song.beat_ticks) - 1):
        root_hz = ROOTS_HZ[(beat // BAR_BEATS) % len(ROOTS_HZ)]
        at_s, period_s = float(song.beat_s[beat]), float(song.beat_s[beat + 1] - song.beat_s[beat])
        for half in (0.0, 0.5):
            played = _Played(at_s + half * period_s, _rounded(0.5 * period_s), root_hz, half == 0.0)
            _strings(mix, played, spec, rng)
        if spec.mix.pad and beat % BAR_BEATS == 0:
            add(mix, at_s - 0.1, swell(root_hz * 4, _rounded(4.2 * period_s), 0.3, 0.0), spec.mix.pad)
        if spec.mix.voice and rng.random() < 0.5:
            freq_hz = root_hz * 4 * float(rng.choice([1.0, 1.125, 1.5]))
            sung = swell(freq_hz, _rounded(rng.uniform(0.2, 0.9)), 0.06, 0.3)
            add(mix, at_s + rng.uniform(-0.15, 0.3), sung, 1.5 * spec.mix.voice)
    return mix


class _Played(NamedTuple):
    at_s: float
    length_s: float
    root_hz: float
    is_beat: bool


def _strings(mix: Mono, played: _Played, spec: SongSpec, rng: np.random.Generator) -> None:
    """The bass and the chord of half a beat, some left out."""
    at_s, length_s, root_hz, is_beat = played
    if spec.mix.bass and (is_beat or rng.random() < 0.6):
        add(mix, at_s + rng.normal(0.002, spec.stroke_s), pluck(root_hz, length_s, 0.6), spec.mix.bass)
    if spec.mix.chords and rng.random() < 0.7:
        strum_s = rng.uniform(0.0, spec.strum_s) / len(CHORD)
        for i, ratio in enumerate(CHORD):
            add(mix, at_s + (i + 1) * strum_s, pluck(root_hz * ratio, length_s, 0.75), 0.3 * spec.mix.chords)


CHORD = (2.0, 3.0, 4.0, 5.0)
"""Partials of the root that a strummed chord sounds."""


def _rounded(length_s: float) -> float:
    """In steps of 50 ms: so the same note is made once."""
    return round(20 * length_s) / 20
