"""Attacks in files: where they are is known, for the test has put them there."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.music.sound_onsets import OnsetBand, SoundOnsets
from station.simulation.bands.band_sound import RATE_HZ as SONG_HZ
from station.simulation.bands.band_sound import BandMix
from station.simulation.bands.band_timing import BandDrift
from station.simulation.bands.made_song import MadeSong, SongSpec, made_song
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.songs.song_onsets import onsets_of, song_onsets

EXACT = SongSpec(seed=5, length_s=16.0, stroke_s=0.0, strum_s=0.0, left_out=0.0, own=0.0, drift=BandDrift(jitter_s=0.0))
DRUMS_ALONE = replace(EXACT, mix=BandMix(bass=0.0, chords=0.0, pad=0.0, voice=0.0))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Callable[[SongSpec], tuple[MadeSong, Path]]:
    folder = tmp_path_factory.mktemp("songs")
    kept: dict[SongSpec, tuple[MadeSong, Path]] = {}

    def make(spec: SongSpec) -> tuple[MadeSong, Path]:
        if spec not in kept:
            song = made_song(spec)
            path = folder / f"{len(kept)}.wav"
            soundfile.write(path, song.mono, SONG_HZ)
            kept[spec] = song, path
        return kept[spec]

    return make


def misses_ms(onsets: SoundOnsets, song: MadeSong, piece: Piece, band: OnsetBand) -> NDArray[np.float64]:
    """How much later than each stroke of `piece` the nearest attack in `band` is found."""
    truth = song.seconds_at(song.score.notes["tick"][song.score.notes["piece"] == piece])
    found = onsets.at_s[onsets.band == band]
    misses: NDArray[np.float64] = 1e3 * np.array([found[np.argmin(np.abs(found - at_s))] - at_s for at_s in truth])
    return misses


@pytest.mark.parametrize(
    ("spec", "piece", "band", "share"),
    [
        (DRUMS_ALONE, Piece.KICK, OnsetBand.LOW, 0.95),
        (DRUMS_ALONE, Piece.SNARE, OnsetBand.HIGH, 0.95),
        (DRUMS_ALONE, Piece.HIHAT, OnsetBand.HIGH, 0.95),
        (EXACT, Piece.KICK, OnsetBand.LOW, 0.6),  # a bass note of the same pitch and level begins 2 ms later
        (EXACT, Piece.SNARE, OnsetBand.HIGH, 0.95),
        (EXACT, Piece.HIHAT, OnsetBand.HIGH, 0.95),
    ],
)
def test_attacks_are_found_where_they_were_put(
    made: Callable[[SongSpec], tuple[MadeSong, Path]],
    tmp_path: Path,
    spec: SongSpec,
    piece: Piece,
    band: OnsetBand,
    share: float,
) -> None:
    song, path = made(spec)
    misses = misses_ms(song_onsets(path, tmp_path), song, piece, band)
    assert len(misses) >= 8
    assert abs(float(np.median(misses))) < 3.0
    assert float(np.mean(np.abs(misses) < 8.0)) > share


def test_an_attack_stands_out_in_its_own_band(
    made: Callable[[SongSpec], tuple[MadeSong, Path]], tmp_path: Path
) -> None:
    song, path = made(DRUMS_ALONE)
    onsets = song_onsets(path, tmp_path)
    strokes = song.seconds_at(song.score.notes["tick"][song.score.notes["piece"] == Piece.KICK])
    at = np.rint(strokes / onsets.hop_s).astype(int)
    near = np.stack([onsets.strength[OnsetBand.LOW, at + i] for i in range(-2, 3)]).max(axis=0)
    assert float(np.median(near)) > 4 * float(onsets.strength[OnsetBand.LOW].mean())


def test_silence_and_a_steady_tone_have_no_attacks() -> None:
    silence = onsets_of(np.zeros(3 * RATE_HZ, np.float32))
    assert len(silence.at_s) == 0
    tone = onsets_of((0.3 * np.sin(2 * np.pi * 440 * np.arange(3 * RATE_HZ) / RATE_HZ)).astype(np.float32))
    assert not ((tone.at_s > 0.2) & (tone.at_s < 2.8)).any()


@pytest.mark.parametrize("length", [1, 100, 5000])
def test_the_shortest_sounds_are_heard_without_a_fault(length: int) -> None:
    assert onsets_of(np.ones(length, np.float32)).length_s == length / RATE_HZ


def test_what_was_found_is_kept_and_a_damaged_file_made_anew(
    made: Callable[[SongSpec], tuple[MadeSong, Path]], tmp_path: Path
) -> None:
    _, path = made(DRUMS_ALONE)
    first = song_onsets(path, tmp_path)
    (kept,) = tmp_path.iterdir()
    whole, made_ns = kept.read_bytes(), kept.stat().st_mtime_ns
    assert np.array_equal(song_onsets(path, tmp_path).at_s, first.at_s)
    assert kept.stat().st_mtime_ns == made_ns
    kept.write_bytes(whole[: len(whole) // 2])
    assert np.array_equal(song_onsets(path, tmp_path).at_s, first.at_s)
    assert kept.read_bytes() == whole


def test_what_is_no_sound_is_refused_by_name(tmp_path: Path) -> None:
    (tmp_path / "song.wav").write_bytes(b"RIFF is what it says, and nothing of it is true")
    for name in ("song.wav", "missing.ogg", "."):
        with pytest.raises(BadInput, match=name.replace(".", r"\.") if name != "." else "folder"):
            song_onsets(tmp_path / name, tmp_path / "kept")
