"""Pictures in, a GIF out that loops for ever: FFmpeg's palette and GIF encoder (PyAV).

All pictures share one palette, chosen from some of them, and an ordered dither that stands still where the picture
does: what does not move costs nothing. GIF knows time in hundredths of a second. The file is written beside its place
and takes its name when it is complete.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import av
import numpy as np
from av.filter import Graph
from av.filter.context import FilterContext
from av.video.reformatter import Colorspace
from numpy.typing import NDArray

from station.core.disk.files import growing
from station.render.gpu.nv12 import Planes

Pixels = NDArray[np.uint8]
"""A picture, shape (height, width, 3), top row first."""

HUNDREDTH = Fraction(1, 100)
LEAST_DELAY = 2
"""Hundredths of a second: what is shown for less, browsers show for ten."""
_COLOURS = 256
_DITHER = "dither=bayer:bayer_scale=4:diff_mode=rectangle"
"""The finest ordered pattern but one: coarser ones show as a grid on skin and floor, as looked at (our choice)."""


@dataclass(frozen=True, slots=True)
class GifTimes:
    """When each picture begins, in hundredths of a second, rising from 0, and when the last ends."""

    begins: tuple[int, ...]
    end: int


def gif_times(length_s: float, fps: float) -> GifTimes:
    """So many pictures as `fps` asks for, evenly over `length_s` to the nearest hundredth, at least one."""
    end = max(LEAST_DELAY, round(100 * length_s))
    pictures = max(1, min(round(length_s * fps), end // LEAST_DELAY))
    return GifTimes(tuple(round(end * k / pictures) for k in range(pictures)), end)


def pixels_of(planes: Planes) -> Pixels:
    """The picture that was drawn for a video."""
    frame = av.VideoFrame.from_ndarray(planes, format="nv12")
    rgb = frame.reformat(format="rgb24", src_colorspace=Colorspace.ITU709, dst_colorspace=Colorspace.ITU709)
    return np.asarray(rgb.to_ndarray(), np.uint8)


def write_gif(path: Path, pictures: Iterable[Pixels], samples: Sequence[Pixels], times: GifTimes) -> Iterator[int]:
    """Write `pictures` at `times`, coloured as `samples` of them are; tells how many are done.

    Raises `DeviceError` where the disk or FFmpeg refuses; then, and if whoever takes the numbers ends early, an old
    file stays as it was.
    """
    with growing(path) as part:
        options = {"loop": "0", "final_delay": str(times.end - times.begins[-1])}
        with av.open(str(part), "w", format="gif", options=options) as container:
            height, width = samples[0].shape[:2]
            stream = container.add_stream("gif", rate=100)
            stream.width, stream.height, stream.pix_fmt = width, height, "pal8"
            stream.codec_context.time_base = HUNDREDTH
            printer = _Printer(samples)
            for done, (picture, begin) in enumerate(zip(pictures, times.begins, strict=True), 1):
                container.mux(stream.encode(printer.print(picture, begin)))
                yield done
            container.mux(stream.encode(None))


class _Printer:
    """Turns pictures into those of one palette."""

    def __init__(self, samples: Sequence[Pixels]) -> None:
        self._graph = Graph()
        self._pictures = _source(self._graph, samples[0])
        palette = _palette(samples)
        colours = self._graph.add_buffer(
            width=palette.width, height=palette.height, format=palette.format, time_base=HUNDREDTH, name="palette"
        )
        use = self._graph.add("paletteuse", _DITHER)
        self._sink = self._graph.add("buffersink")
        self._pictures.link_to(use, 0, 0)
        colours.link_to(use, 0, 1)
        use.link_to(self._sink)
        self._graph.configure()
        palette.pts = 0
        colours.push(palette)
        colours.push(None)

    def print(self, picture: Pixels, at: int) -> av.VideoFrame:
        """The picture in the palette's colours."""
        self._pictures.push(_frame(picture, at))
        return _video(self._sink)


def _palette(samples: Sequence[Pixels]) -> av.VideoFrame:
    graph = Graph()
    source, sink = _source(graph, samples[0]), graph.add("buffersink")
    choose = graph.add("palettegen", f"max_colors={_COLOURS}")
    source.link_to(choose)
    choose.link_to(sink)
    graph.configure()
    for at, sample in enumerate(samples):
        source.push(_frame(sample, at))
    source.push(None)
    return _video(sink)


def _source(graph: Graph, like: Pixels) -> FilterContext:
    height, width = like.shape[:2]
    return graph.add_buffer(width=width, height=height, format=av.VideoFormat("rgb24"), time_base=HUNDREDTH)


def _frame(picture: Pixels, at: int) -> av.VideoFrame:
    frame = av.VideoFrame.from_ndarray(np.ascontiguousarray(picture), format="rgb24")
    frame.pts, frame.time_base = at, HUNDREDTH
    return frame


def _video(sink: FilterContext) -> av.VideoFrame:
    frame = sink.pull()
    assert isinstance(frame, av.VideoFrame)
    return frame
