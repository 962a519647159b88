"""Pictures as planes for video, and whole films, at the lowest quality and small.

Expected colours are computed by numpy from the picture itself after BT.709-6 (items 3.2, 3.3 and 3.4).
"""

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.framing import named
from station.render.picture import PictureMaker, Shot
from station.render.quality import QUALITIES
from station.scenes.film import FilmSpan, write_film, write_pictures
from station.scenes.pictures import picture_of
from station.scenes.soundtrack import Sounds
from tests.fakes.impulse_kit import impulse_mixer
from tests.unit.render.scores import rock
from tests.unit.render.test_png_file import decode

pytestmark = pytest.mark.gl

SIZE = (162, 90)  # neither a multiple of four
FPS = Fraction(25)
DRUMMER = Drummer(rock(1), load_kit(), figure_of())
TAKE = FilmSpan(-0.2, 20, FPS)
SHOT = Shot(SIZE, QUALITIES[0], named(NamedView.FRONT))
TIMES_S = (0.0, 0.3, 0.4, 0.75, 1.0)


@pytest.fixture(scope="module")
def maker() -> PictureMaker:
    return PictureMaker(SIZE, QUALITIES[0])


def luma_and_chroma(picture: NDArray[np.uint8]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Of a picture (h, w, 3): luma (h, w), and (h/2, w/2, 2) of Cb and Cr at the left of each block of two by two."""
    colour = picture / 255.0
    weights = np.array([0.2126, 0.7152, 0.0722])
    before = np.concatenate([colour[:, :1], colour[:, 1:-1:2]], axis=1)
    row_means = 0.25 * before + 0.5 * colour[:, 0::2] + 0.25 * colour[:, 1::2]
    mean = 0.5 * (row_means[0::2] + row_means[1::2])
    difference = (mean[..., [2, 0]] - (mean @ weights)[..., None]) / [1.8556, 1.5748]
    return 16 + 219 * (colour @ weights), 128 + 224 * difference


def test_planes_are_the_pictures_own_colours_in_order(maker: PictureMaker) -> None:
    shown = [picture_of(DRUMMER, at_s) for at_s in TIMES_S]
    filmed = list(maker.film(shown, SHOT.camera))
    assert len(filmed) == len(shown)
    for snapshot, planes in zip(shown, filmed, strict=True):
        luma, chroma = luma_and_chroma(maker.draw(snapshot, SHOT.camera))
        assert np.abs(planes[:90] - luma).max() <= 0.51  # rounding alone
        assert np.abs(planes[90:].reshape(45, 81, 2) - chroma).max() <= 0.51
    assert np.abs(filmed[0].astype(int) - filmed[2]).max() > 50


def test_a_smoothed_picture_is_filmed_as_it_is_drawn() -> None:
    fine = PictureMaker((64, 48), QUALITIES[1])
    snapshot = picture_of(DRUMMER, 0.5)
    *_, planes = fine.film([snapshot] * 2)  # the first picture brings the letters in
    assert np.abs(planes[:48] - luma_and_chroma(fine.draw(snapshot))[0]).max() <= 0.51


def test_a_film_given_up_in_the_middle_leaves_the_maker_ready(maker: PictureMaker) -> None:
    frames = maker.film(picture_of(DRUMMER, at_s) for at_s in TIMES_S)
    first = next(frames)
    frames.close()  # type: ignore[attr-defined] # a generator
    assert np.array_equal(next(iter(maker.film([picture_of(DRUMMER, TIMES_S[0])]))), first)


def test_a_film_given_up_may_end_after_its_maker() -> None:
    maker = PictureMaker((64, 48), QUALITIES[0])
    frames = maker.film(picture_of(DRUMMER, at_s) for at_s in TIMES_S)
    next(frames)
    maker.release()
    frames.close()  # type: ignore[attr-defined] # a generator, closed by whoever drops it last


def test_a_film_shows_and_sounds_what_the_drummer_plays(maker: PictureMaker, tmp_path: Path) -> None:
    av = pytest.importorskip("av", reason="av is not installed: pip install av")
    told: list[int] = []
    kit = impulse_mixer(ring_frames=960).kit
    write_film(DRUMMER, TAKE, SHOT, Sounds(kit, None), tmp_path / "x.mp4", told.append)
    assert told == list(range(1, 21))
    with av.open(str(tmp_path / "x.mp4")) as container:
        video, audio = container.streams.video[0], container.streams.audio[0]
        assert (video.width, video.height, video.frames, video.average_rate) == (*SIZE, 20, FPS)
        assert float(video.duration * video.time_base) == pytest.approx(0.8)
        assert float(audio.duration * audio.time_base) == pytest.approx(0.8, abs=1024 / 48_000)
        pictures = [frame.to_ndarray()[:90] for frame in container.decode(video)]
    for k in (0, 5, 12):
        luma, _ = luma_and_chroma(maker.draw(picture_of(DRUMMER, -0.2 + k / 25), SHOT.camera))
        off = [np.abs(picture - luma).mean() for picture in pictures]
        assert off[k] < 2.5  # what the encoder leaves of so small a picture
        assert int(np.argmin(off)) == k  # no neighbour is likelier: picture and time belong together
    with av.open(str(tmp_path / "x.mp4")) as container:
        blocks = list(container.decode(audio=0))
    sound = np.abs(np.concatenate([block.to_ndarray()[0] for block in blocks]))
    began_s = float(blocks[0].pts * blocks[0].time_base)
    starts = [k for k in np.flatnonzero(sound > 0.1) if sound[max(0, k - 4000) : k].max() <= 0.1]
    heard_s = [began_s + k / 48_000 for k in starts]
    assert heard_s == pytest.approx([0.2, 0.45, 0.7], abs=0.003)  # eighths at 120 bpm, 0.2 s in


def test_numbered_pictures_are_those_of_their_times(maker: PictureMaker, tmp_path: Path) -> None:
    paths = [tmp_path / "frames" / f"{k}.png" for k in range(3)]
    write_pictures(DRUMMER, FilmSpan(0.25, 3, Fraction(8)), SHOT, paths, lambda _: None)
    for k, path in enumerate(paths):
        drawn = maker.draw(picture_of(DRUMMER, 0.25 + k / 8), SHOT.camera)
        assert np.array_equal(decode(path.read_bytes()), drawn)
