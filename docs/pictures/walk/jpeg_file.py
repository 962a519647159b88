"""Writes a JPEG by FFmpeg's encoder: a screen of 3840×2160 takes a tenth of what a PNG of it takes."""

from fractions import Fraction
from pathlib import Path

import av
import numpy as np
from numpy.typing import NDArray

_FINEST = "3"
"""FFmpeg's quantiser, 2 to 31; our choice: small letters show no rings."""


def write_jpeg(pixels: NDArray[np.uint8], path: Path) -> None:
    """Keep `pixels`, shape (height, width, 3), at `path`."""
    height, width, _ = pixels.shape
    codec = av.CodecContext.create("mjpeg", "w")
    codec.width, codec.height, codec.pix_fmt = width, height, "yuvj444p"
    codec.time_base = Fraction(1, 1)
    codec.options = {"qmin": _FINEST, "qmax": _FINEST}
    codec.flags |= 2  # AV_CODEC_FLAG_QSCALE: the quantiser as it is asked for
    frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(pixels), format="rgb24").reformat(format="yuvj444p")
    frame.pts = 0
    path.write_bytes(b"".join(bytes(packet) for packet in [*codec.encode(frame), *codec.encode(None)]))
