"""GIFs of made-up pictures, read again: bytes by the GIF89a specification, pictures by FFmpeg's decoder."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

av = pytest.importorskip("av", reason="av is not installed: pip install av")
from station.render.files.gif_file import GifTimes, gif_times, pixels_of, write_gif  # noqa: E402 - only where av is

COLOURS = ((200, 30, 40), (20, 180, 60), (30, 60, 220))


def picture(colour: tuple[int, int, int]) -> NDArray[np.uint8]:
    return np.full((32, 48, 3), colour, np.uint8)


def written(path: Path, times: GifTimes) -> list[int]:
    pictures = [picture(colour) for colour in COLOURS]
    return list(write_gif(path, pictures, pictures, times))


def test_every_picture_has_its_time_and_colour_and_it_loops_for_ever(tmp_path: Path) -> None:
    assert written(tmp_path / "x.gif", GifTimes((0, 7, 20), 45)) == [1, 2, 3]
    data = (tmp_path / "x.gif").read_bytes()
    assert data.startswith(b"GIF89a")
    # application extension: 3 bytes follow, 1 is the loop's, then how often (0: for ever), then the end
    assert data[data.index(b"NETSCAPE2.0") :][11:16] == bytes((3, 1, 0, 0, 0))
    controls = [at for at in range(len(data)) if data[at : at + 3] == b"\x21\xf9\x04"]
    delays = [int.from_bytes(data[at + 4 : at + 6], "little") for at in controls]
    assert delays == [7, 13, 25], "the last one too: the loop is as long as the music"
    with av.open(str(tmp_path / "x.gif")) as container:
        shown = [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
    for frame, colour in zip(shown, COLOURS, strict=True):
        assert np.abs(frame.astype(int) - colour).max() <= 12, "a palette's colours are near, not exact"


def test_who_ends_early_leaves_what_was_there(tmp_path: Path) -> None:
    path = tmp_path / "x.gif"
    path.write_bytes(b"old")
    pictures = [picture(colour) for colour in COLOURS]
    for _ in (writing := write_gif(path, pictures, pictures, GifTimes((0, 5, 10), 15))):
        break
    writing.close()  # type: ignore[attr-defined] # a generator
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["x.gif"]


@given(st.floats(0.01, 60), st.floats(1, 1000))
def test_times_fill_the_length_evenly(length_s: float, fps: float) -> None:
    times = gif_times(length_s, fps)
    steps = np.diff([*times.begins, times.end])
    assert times.begins[0] == 0
    assert steps.min() >= 2, "browsers show what is shorter for a tenth of a second"
    assert steps.max() - steps.min() <= 1
    assert times.end == max(2, round(100 * length_s))


def test_twenty_a_second_are_five_hundredths_each() -> None:
    assert gif_times(6.0, 20.0) == GifTimes(tuple(range(0, 600, 5)), 600)


def test_a_video_s_planes_have_their_colours_again() -> None:
    planes = np.empty((48, 48), np.uint8)
    planes[:32], planes[32:, 0::2], planes[32:, 1::2] = 63, 102, 240  # BT.709's red in the narrow range (H.273)
    assert np.abs(pixels_of(planes).astype(int) - (255, 0, 0)).max() <= 3
