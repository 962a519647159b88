"""Videos of made-up pictures and sound, decoded again: what was put in, when, and nothing where it failed.

The decoder is FFmpeg's own, which is not ours; the colours' expected values are the levels that were put in.
"""

import os
import subprocess
import sys
import textwrap
from collections.abc import Iterable, Iterator
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.errors import DeviceError

av = pytest.importorskip("av", reason="av is not installed: pip install av")
from station.render.files.video_file import VideoFormat, video_file  # noqa: E402 - only where av is

SIZE = (96, 64)
RATE_HZ = 48_000
FPS = Fraction(30)
FORMAT = VideoFormat(SIZE, FPS, RATE_HZ)


def picture(luma: int, cb: int = 128, cr: int = 128) -> NDArray[np.uint8]:
    planes = np.full((SIZE[1] * 3 // 2, SIZE[0]), luma, np.uint8)
    planes[SIZE[1] :, 0::2], planes[SIZE[1] :, 1::2] = cb, cr
    return planes


def clap(frames: int, at: int) -> NDArray[np.float32]:
    """A tone of 1 kHz that begins at a frame and lasts 20 ms."""
    sound = np.zeros((frames, 2), np.float32)
    sound[at : at + 960] = 0.8 * np.sin(2 * np.pi * 1000 * np.arange(960) / RATE_HZ)[:, None]
    return sound


def heard(path: Path) -> tuple[float, NDArray[np.float32]]:
    """When the sound begins in seconds, and all of it, (n, 2)."""
    with av.open(str(path)) as container:
        blocks = list(container.decode(audio=0))
    sound = np.concatenate([block.to_ndarray() for block in blocks], axis=1).T
    return float(blocks[0].pts * blocks[0].time_base), sound


def write(path: Path, lumas: Iterable[int], video: VideoFormat = FORMAT) -> None:
    with video_file(path, video) as sink:
        for luma in lumas:
            sink.add_picture(picture(luma))
            if video.rate_hz is not None:
                sink.add_sound(np.zeros((round(video.rate_hz / video.fps), 2), np.float32))


def test_every_picture_is_there_at_its_time_with_its_luma(tmp_path: Path) -> None:
    lumas = [16 + 10 * k for k in range(20)]
    write(tmp_path / "x.mp4", lumas)
    with av.open(str(tmp_path / "x.mp4")) as container:
        stream = container.streams.video[0]
        assert (stream.average_rate, stream.frames, stream.duration * stream.time_base) == (FPS, 20, Fraction(20, 30))
        frames = list(container.decode(stream))
    assert [frame.pts * frame.time_base for frame in frames] == [k / FPS for k in range(20)]
    means = [frame.to_ndarray()[: SIZE[1]].mean() for frame in frames]
    assert means == pytest.approx(lumas, abs=1.5)


def test_odd_rates_keep_their_fraction(tmp_path: Path) -> None:
    write(tmp_path / "x.mp4", [50] * 10, VideoFormat(SIZE, Fraction(30000, 1001)))
    with av.open(str(tmp_path / "x.mp4")) as container:
        assert container.streams.video[0].average_rate == Fraction(30000, 1001)
        assert not container.streams.audio


def test_the_file_says_which_colours_its_numbers_mean(tmp_path: Path) -> None:
    with video_file(tmp_path / "x.mp4", VideoFormat(SIZE, FPS)) as sink:
        sink.add_picture(picture(63, 102, 240))  # BT.709's red, narrow range (SMPTE RP 219)
    with av.open(str(tmp_path / "x.mp4")) as container:
        context = container.streams.video[0].codec_context
        told = context.color_range, context.color_primaries, context.color_trc, context.colorspace
        frame = next(container.decode(video=0))
    assert told == (1, 1, 1, 1)
    red = frame.reformat(format="rgb24", src_colorspace="ITU709").to_ndarray().reshape(-1, 3).mean(axis=0)
    assert red == pytest.approx([255, 0, 0], abs=4)


@pytest.mark.parametrize("piece", [1600, 441, 4800])
def test_sound_begins_with_the_first_picture_to_the_frame(tmp_path: Path, piece: int) -> None:
    sound = clap(24_000, 12_000)
    with video_file(tmp_path / "x.mp4", FORMAT) as sink:
        for _ in range(15):
            sink.add_picture(picture(40))
        for begin in range(0, len(sound), piece):
            sink.add_sound(sound[begin : begin + piece])
    began_s, back = heard(tmp_path / "x.mp4")
    first = int(np.argmax(np.abs(back[:, 0]) > 0.2))
    assert began_s + first / RATE_HZ == pytest.approx(0.25, abs=0.002)
    inside = slice(12_200, 12_760)
    offset = round(began_s * RATE_HZ)
    likeness = np.corrcoef(sound[inside, 0], back[inside.start - offset : inside.stop - offset, 0])[0, 1]
    assert likeness > 0.99  # a frame's shift would be 7 degrees of the tone, ten 0.26 of its period


def interrupted() -> Iterator[int]:
    yield from range(20, 40)
    raise KeyboardInterrupt


def test_what_is_given_up_leaves_nothing_and_the_old_file_stays(tmp_path: Path) -> None:
    path = tmp_path / "x.mp4"
    path.write_bytes(b"old")
    with pytest.raises(KeyboardInterrupt):
        write(path, interrupted())
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["x.mp4"]


def test_a_picture_that_cannot_be_encoded_ends_the_work_and_nobody_waits(tmp_path: Path) -> None:
    def write_nonsense() -> None:
        with video_file(tmp_path / "x.mp4", FORMAT) as sink:
            for _ in range(100):
                sink.add_picture(np.zeros((7, 5), np.uint8))

    with pytest.raises(ValueError, match=r".+"):
        write_nonsense()
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there_is_made_and_a_device_is_refused(tmp_path: Path) -> None:
    write(tmp_path / "new" / "x.mp4", [30] * 3)
    assert (tmp_path / "new" / "x.mp4").stat().st_size > 500
    (tmp_path / "y.mp4").mkdir()
    with pytest.raises(DeviceError, match=r"y\.mp4: cannot be written: it is no plain file"):
        write(tmp_path / "y.mp4", [30])


@pytest.mark.skipif(os.name != "posix", reason="no limit of file sizes here")
@pytest.mark.parametrize("limit", [20_000, 200_000])
def test_a_disk_that_fills_up_is_one_clear_line_and_leaves_the_old_file(tmp_path: Path, limit: int) -> None:
    """A child process may write so many bytes a file: the disk fills up in the header's block, or in mid-video."""
    path = tmp_path / "x.mp4"
    path.write_bytes(b"old")
    script = textwrap.dedent(
        """
        import resource, signal, sys
        from fractions import Fraction
        from pathlib import Path
        import numpy as np
        from station.core.errors import DeviceError
        from station.render.files.video_file import VideoFormat, video_file
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[2]),) * 2)
        noise = np.random.default_rng(1).integers(16, 235, (30, 288, 256), np.uint8)
        try:
            with video_file(Path(sys.argv[1]), VideoFormat((256, 192), Fraction(30))) as sink:
                for planes in noise:
                    sink.add_picture(planes)
        except DeviceError as fault:
            print(fault)
        """
    )
    words = [sys.executable, "-c", script, str(path), str(limit)]
    child = subprocess.run(words, capture_output=True, text=True, check=True)
    assert child.stdout == f"{path}: cannot be written: File too large\n"
    assert path.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["x.mp4"]
