"""How well the beats of a band without a click are found: prints the table of docs/song-sync.md.

    python benchmarks/band_songs.py [--songs N] [--length S] [--first SEED] [--minutes M]

Every song is the virtual band's (`station.simulation.bands`): its own tempo (75–175), drift (1–3.5 %), choruses that
push, on some a slow end; a part that differs from what is played in 6 of 100 strokes; a room; coded as OGG, MP3 or WAV
and read back. Five (or two) points lie evenly on bars of the song. Everything has a seed. About ten seconds a song.
"""

import argparse
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import soundfile
from numpy.typing import NDArray

from station.drills.songs.band_following import follow_band
from station.drills.songs.band_tempo import BandPoint
from station.drills.songs.point_setting import points_of_taps, snapped
from station.music.sound_onsets import SoundOnsets
from station.simulation.bands.band_sound import RATE_HZ, BandMix
from station.simulation.bands.band_timing import BandDrift
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from station.sound.songs.song_onsets import song_onsets

Floats = NDArray[np.float64]
MIXES: Mapping[str, BandMix] = {
    "whole band": BandMix(),
    "soft drums, large room": BandMix(drums=0.5, room=0.4),
    "no drums in the file": BandMix(drums=0.0),
}
CODES = ("ogg", "mp3", "wav")
TAP_SD_S, TAP_EARLY_S = 0.025, 0.03
"""People who tap scatter by 20–30 ms and are early by as much."""


def main(arguments: Sequence[str]) -> None:
    """Make the songs, follow them, print what was missed."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else None)
    parser.add_argument("--songs", type=int, default=51)
    parser.add_argument("--length", type=float, default=240.0, help="seconds")
    parser.add_argument("--first", type=int, default=100, help="seed of the first song")
    parser.add_argument("--minutes", type=float, default=60.0, help="begin no song after so long")
    options = parser.parse_args(arguments)
    last_s = time.monotonic() + 60.0 * options.minutes
    misses: dict[tuple[str, str], list[Floats]] = defaultdict(list)
    for seed in range(options.first, options.first + options.songs):
        if time.monotonic() > last_s:
            break
        mix = list(MIXES)[seed % len(MIXES)]
        song, onsets = _heard(_spec(seed, options.length, mix), seed)
        for kind, points in _points(song, onsets, np.random.default_rng(seed)).items():
            tempo = follow_band(song.score, points, onsets)
            misses[mix, kind].append(1e3 * np.abs(tempo.beat_s[: len(song.beat_s)] - song.beat_s))
        print(f"seed {seed} {mix}: {np.mean(misses[mix, FIVE][-1] < 10.0):.3f} within 10 ms", file=sys.stderr)
    print(table(misses))


FIVE = "five, exact"


def _spec(seed: int, length_s: float, mix: str) -> SongSpec:
    rng = np.random.default_rng(seed)
    bpm = float(rng.uniform(75.0, 175.0))
    drift = BandDrift(walk=float(rng.uniform(0.01, 0.035)), ritard=float(rng.choice([0.0, 0.2])))
    return SongSpec(seed, length_s, bpm, float(round(bpm)), drift, MIXES[mix])


def _heard(spec: SongSpec, seed: int) -> tuple[MadeSong, SoundOnsets]:
    """The song, and the onsets of its file once it is coded: what a codec delays is taken off the truth by nobody."""
    song = made_song(spec)
    ending = CODES[seed // len(MIXES) % len(CODES)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"song.{ending}"
        with soundfile.SoundFile(path, "w", RATE_HZ, 1) as file:
            for first in range(0, len(song.mono), RATE_HZ):  # libvorbis fails on minutes at once
                file.write(song.mono[first : first + RATE_HZ])
        return song, song_onsets(path, Path(folder))


def _points(song: MadeSong, onsets: SoundOnsets, rng: np.random.Generator) -> dict[str, Sequence[BandPoint]]:
    """The points of each kind of listener."""
    exact = {count: _on_bars(song, count) for count in (2, 5)}
    tapped = [BandPoint(p.tick, p.at_s + rng.normal(0.0, TAP_SD_S)) for p in exact[5]]
    taps_s = song.beat_s + rng.normal(-TAP_EARLY_S, TAP_SD_S, len(song.beat_s))
    return {
        FIVE: exact[5],
        "five, tapped": tapped,
        "five, tapped, drawn to onsets": [snapped(song.score, point, onsets) for point in tapped],
        "a tap on every beat": points_of_taps(taps_s.tolist(), 0),
        "two, exact": exact[2],
    }


def _on_bars(song: MadeSong, count: int) -> list[BandPoint]:
    beats = np.rint(np.linspace(0, len(song.beat_s) - 9, count) / 4).astype(int) * 4
    return [BandPoint(int(song.beat_ticks[beat]), float(song.beat_s[beat])) for beat in beats]


def table(misses: Mapping[tuple[str, str], Sequence[Floats]]) -> str:
    """A row for each mix and kind of points: what all the beats of its songs miss, in ms."""
    rows = ["| Band | Points | Songs | P50 | P95 | Most | Within 10 ms | Songs with 95 % within |", "|" + "---|" * 8]
    for (mix, kind), songs in sorted(misses.items(), key=lambda item: list(MIXES).index(item[0][0])):
        beats = np.concatenate(songs)
        share, good = 100 * np.mean(beats < 10.0), sum(bool(np.mean(song < 10.0) >= 0.95) for song in songs)
        figures = f"{np.median(beats):.1f} | {np.quantile(beats, 0.95):.1f} | {beats.max():.0f} | {share:.1f} %"
        rows.append(f"| {mix} | {kind} | {len(songs)} | {figures} | {good} of {len(songs)} |")
    return "\n".join(rows)


if __name__ == "__main__":
    main(sys.argv[1:])
