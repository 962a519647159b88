"""A sonified recording as a sound, as a film of the body that walks beside its phase, or as one picture of that."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from station.core.events import Hit
from station.core.units import NS_PER_S
from station.engine.messages import CUE_DTYPE, Bus
from station.render.files.png_file import write_png
from station.render.flat_picture import FlatPictures, flat_pictures
from station.render.phase.phase_plot import PlotAxes
from station.scenes.film import ShowProgress, encoder
from station.scenes.phase_view import PAGE, WalkingScene
from station.scenes.soundtrack import Sounds, Soundtrack
from station.sound.drum_kit import Frames

if TYPE_CHECKING:
    from station.render.files.video_file import VideoFormat

RING_S = 1.0
"""The sound goes on so long after the recording, so that what rings is heard (our choice)."""


def cues_of(hits: Iterable[Hit], start_s: float) -> NDArray[np.void]:
    """The hits as cues that count from `start_s` of the recording, (n,) of `CUE_DTYPE`."""
    start_ns = round(start_s * NS_PER_S)
    rows = [
        (
            hit.at_ns - start_ns,
            Bus.DEMONSTRATION,
            hit.piece,
            hit.zone,
            hit.articulation,
            hit.velocity,
            np.nan if hit.openness is None else hit.openness,
        )
        for hit in hits
    ]
    return np.array(rows, CUE_DTYPE)


def sound_of(hits: Iterable[Hit], span_s: tuple[float, float], sounds: Sounds) -> Frames:
    """What the hits sound like from the recording's first second to its last, and as long as it rings: (n, 2)."""
    start_s, end_s = span_s
    return Soundtrack(cues_of(hits, start_s), sounds).until(end_s - start_s + RING_S)


def write_phase_picture(scene: WalkingScene, words: str, at_s: float, size: tuple[int, int], path: Path) -> None:
    """A PNG of one instant; raises `DeviceError` without OpenGL or disk."""
    with flat_pictures(size, _unit(size)) as maker:
        still, axes = scene.still(maker.atlas, words)
        write_png(maker.picture(np.concatenate([still, scene.moving(maker.atlas, axes, at_s)])), path)


def write_phase_film(
    scene: WalkingScene, words: str, soundtrack: Soundtrack, video: "VideoFormat", path: Path, show: ShowProgress
) -> None:
    """A film with sound in the recording's own time; raises `DeviceError` without OpenGL, disk or encoder."""
    encoder()
    from station.render.files.video_file import video_file

    start_s, end_s = scene.trace.span_s
    times_s = start_s + np.arange(round((end_s - start_s) * video.fps)) / float(video.fps)
    with flat_pictures(video.size, _unit(video.size)) as maker, video_file(path, video) as sink:
        still, axes = scene.still(maker.atlas, words)
        for done, planes in enumerate(maker.film(_pictures(scene, maker, still, axes, times_s)), 1):
            sink.add_picture(planes)
            sink.add_sound(soundtrack.until(float(done / video.fps)))
            show(done)


def _pictures(
    scene: WalkingScene,
    maker: FlatPictures,
    still: NDArray[np.void],
    axes: PlotAxes,
    times_s: NDArray[np.float64],
) -> Iterable[NDArray[np.void]]:
    return (np.concatenate([still, scene.moving(maker.atlas, axes, at_s)]) for at_s in times_s.tolist())


def _unit(size: tuple[int, int]) -> float:
    """Pixels a unit, so that the whole page is seen."""
    return min(size[0] / PAGE[0], size[1] / PAGE[1])
