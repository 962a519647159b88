"""A piece of some sound files made ready to play along to: where it lies, how loud it is. Figures are by hand."""

from pathlib import Path

import numpy as np
import pytest
import soundfile
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.core.pieces import Piece
from station.sound.track import load
from station.sound.track_file import TrackRequest, prepare

RATE_HZ = 48_000


def file_of(folder: Path, name: str, sound: NDArray[np.float64]) -> Path:
    soundfile.write(folder / name, sound.astype(np.float32), RATE_HZ, subtype="FLOAT")
    return folder / name


def impulses(length_s: float, *at_s: float) -> NDArray[np.float64]:
    sound = np.zeros(round(length_s * RATE_HZ))
    sound[[round(second * RATE_HZ) for second in at_s]] = 0.5
    return sound


def heard_s(request: TrackRequest, folder: Path) -> list[float]:
    """When there is sound, in seconds from where the track starts."""
    track = load(prepare(request, folder))
    times_s: list[float] = ((np.flatnonzero(track.pcm[:, 0]) - track.start) / RATE_HZ).tolist()
    return times_s


def test_a_piece_has_what_the_files_have_there_and_silence_around_them(tmp_path: Path) -> None:
    low = file_of(tmp_path, "low.wav", impulses(4.0, 1.0, 3.0))
    high = file_of(tmp_path, "high.wav", impulses(6.0, 5.0))
    asked = TrackRequest(low, RATE_HZ, start_s=0.5, beside=(high,), piece_s=(-0.5, 8.0))
    assert heard_s(asked, tmp_path / "kept") == pytest.approx([0.5, 2.5, 4.5])
    track = load(prepare(asked, tmp_path / "kept"))
    assert len(track.pcm) == round(8.5 * RATE_HZ)
    later = TrackRequest(low, RATE_HZ, start_s=2.5, loop_s=(2.5, 3.5), piece_s=(2.0, 4.0))
    assert heard_s(later, tmp_path / "kept") == pytest.approx([0.5])
    assert prepare(later, tmp_path / "kept").loop == (round(0.5 * RATE_HZ), round(1.5 * RATE_HZ))


def test_a_quiet_piece_stays_as_quiet_as_it_is_in_the_whole(tmp_path: Path) -> None:
    noise = np.random.default_rng(1).normal(0.0, 0.2, 4 * RATE_HZ)
    noise[: 2 * RATE_HZ] *= 0.1
    song = file_of(tmp_path, "song.wav", noise)
    levels = []
    for piece_s in ((0.0, 2.0), (2.0, 4.0)):
        pcm = load(prepare(TrackRequest(song, RATE_HZ, start_s=piece_s[0], piece_s=piece_s), tmp_path / "k")).pcm
        levels.append(float(np.std(pcm.astype(float))))
    assert levels[1] / levels[0] == pytest.approx(10.0, rel=0.02)


@pytest.mark.parametrize(
    ("piece_s", "words"), [((5.0, 9.0), "has nothing from 5.0 to 9.0"), ((-3.0, -1.0), "has nothing from -3.0")]
)
def test_a_piece_of_nothing_is_refused(tmp_path: Path, piece_s: tuple[float, float], words: str) -> None:
    song = file_of(tmp_path, "song.wav", impulses(4.0, 1.0))
    with pytest.raises(BadInput, match=words):
        prepare(TrackRequest(song, RATE_HZ, start_s=piece_s[0], piece_s=piece_s), tmp_path / "kept")


def test_a_stem_that_is_missing_is_named(tmp_path: Path) -> None:
    song = file_of(tmp_path, "song.wav", impulses(4.0, 1.0))
    with pytest.raises(BadInput, match=r"drums\.ogg: no such file"):
        prepare(TrackRequest(song, RATE_HZ, beside=(tmp_path / "drums.ogg",), piece_s=(0.0, 1.0)), tmp_path / "kept")


def test_strokes_that_are_to_be_softer_are_softer_by_half_and_the_rest_stays(tmp_path: Path) -> None:
    """Bursts of noise over a tone: at 2 s and 4 s alike in the file, the one at 4 s turned down."""
    time_s = np.arange(6 * RATE_HZ) / RATE_HZ
    sound = 0.05 * np.sin(2 * np.pi * 500.0 * time_s)
    burst = np.random.default_rng(1).normal(0.0, 0.2, RATE_HZ // 10) * np.exp(-np.arange(RATE_HZ // 10) / 1000.0)
    for second in (2, 4):
        sound[second * RATE_HZ : second * RATE_HZ + len(burst)] += burst
    song = file_of(tmp_path, "song.wav", sound)
    asked = TrackRequest(song, RATE_HZ, start_s=1.0, piece_s=(1.0, 6.0), softer=((4.0, int(Piece.SNARE)),))
    heard = load(prepare(asked, tmp_path / "kept")).pcm[:, 0].astype(float)
    power = [float(np.square(heard[round(at * RATE_HZ) :][: RATE_HZ // 20]).mean()) for at in (1.0, 3.0, 4.5)]
    assert power[1] < power[0] / 4, "6 dB at least"
    assert power[2] == pytest.approx(np.square(heard[: RATE_HZ // 20]).mean(), rel=0.05), "the tone alone, as before"
