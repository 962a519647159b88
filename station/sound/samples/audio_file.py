"""Sound files as frames at the wanted rate: WAV, FLAC, OGG, MP3 and what else libsndfile reads.

A file's own claims (length, channels, rate) are checked before memory is taken for it. One channel goes to both ears;
of several the odd ones go left and the even ones right. Rates are converted by soxr, a windowed-sinc resampler whose
"HQ" keeps aliases below −120 dB.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from math import isclose
from pathlib import Path

import numpy as np
import soundfile
import soxr
from numpy.typing import NDArray

from station.core.errors import BadInput
from station.sound.drum_kit import Frames

MIN_RATE_HZ, MAX_RATE_HZ = 4_000, 768_000
"""Beyond these a file's rate is a mistake (our choice: telephone sound halved, the highest converters)."""
MAX_CHANNELS = 64
LOUDEST = 16.0
"""Floating-point files may exceed full scale; by more than a kit's levels are ever lowered (24 dB) it is a mistake."""
_PIECE_FRAMES = 65_536
"""What is read at once: a file of many channels is never in memory as a whole."""
ENDINGS = frozenset({".wav", ".flac", ".ogg", ".oga", ".opus", ".mp3", ".aif", ".aiff", ".au", ".w64", ".caf"})
"""The endings, in small letters, that count as sound files where a folder is searched."""


@contextmanager
def opened(source: Path | bytes, name: str) -> Iterator[soundfile.SoundFile]:
    """The file, or the file's bytes, open for reading and found sane; raises `BadInput` that names it `name`."""
    if isinstance(source, Path) and not source.is_file():  # libsndfile would speak of a "System error"
        raise BadInput(name, "", "is a folder; expected a sound file" if source.is_dir() else "no such file")
    try:
        with soundfile.SoundFile(BytesIO(source) if isinstance(source, bytes) else source) as file:
            if not (MIN_RATE_HZ <= file.samplerate <= MAX_RATE_HZ and 1 <= file.channels <= MAX_CHANNELS):
                raise BadInput(name, "header", f"{file.samplerate} Hz and {file.channels} channels is no sound")
            yield file
    except soundfile.SoundFileError as fault:
        raise BadInput(name, "", f"cannot be read as sound: {getattr(fault, 'error_string', fault)}") from fault
    except OSError as fault:
        raise BadInput(name, "", fault.strerror or str(fault)) from fault


def read_audio(source: Path | bytes, name: str, rate_hz: float, max_s: float, pitch: float = 0.0) -> Frames:
    """At most the first `max_s` of a sound file at `rate_hz`, raised by `pitch` semitones (and shortened with it).

    Returns float32 (n, 2), n ≥ 1. Raises `BadInput` for what is no sound, is empty, or holds numbers that are none.
    """
    with opened(source, name) as file:
        pieces = [_checked(piece, name) for piece in _pieces(file, round(max_s * file.samplerate))]
        from_hz = file.samplerate * 2.0 ** (pitch / 12.0)
    if not pieces:
        raise BadInput(name, "", "holds no sound")
    return resampled(np.concatenate(pieces), from_hz, rate_hz)


def _pieces(file: soundfile.SoundFile, most: int) -> Iterator[NDArray[np.float32]]:
    """Up to `most` frames, piece by piece, to where the file really ends: a header may promise more than follows."""
    while most > 0:
        piece = file.read(min(_PIECE_FRAMES, most), "float32", always_2d=True)
        if not len(piece):
            return
        yield piece
        most -= len(piece)


def _checked(raw: NDArray[np.float32], name: str) -> Frames:
    if not np.isfinite(raw).all():
        raise BadInput(name, "", "holds numbers that are no sound (infinite, or none at all)")
    loudest = float(np.abs(raw).max(initial=0.0))
    if loudest > LOUDEST:
        raise BadInput(name, "", f"holds numbers up to {loudest:g}, and full scale is 1: no sound")
    return to_stereo(raw)


def to_stereo(raw: NDArray[np.float32]) -> Frames:
    """Any number of channels (n, c) as (n, 2): one on both sides, of several the means of the odd and the even ones."""
    if raw.shape[1] == 1:
        return np.repeat(raw, 2, axis=1)
    if raw.shape[1] == 2:
        return raw
    return np.column_stack([raw[:, 0::2].mean(axis=1), raw[:, 1::2].mean(axis=1)]).astype(np.float32)


def resampled(frames: Frames, from_hz: float, to_hz: float) -> Frames:
    """`frames` (n, 2) of rate `from_hz` at `to_hz`: about n · to/from frames, at least one."""
    if isclose(from_hz, to_hz, rel_tol=1e-9):
        return np.ascontiguousarray(frames)
    converted = soxr.resample(frames, from_hz, to_hz, quality="HQ").astype(np.float32, copy=False)
    return np.ascontiguousarray(converted) if len(converted) else np.zeros((1, 2), np.float32)
