"""Pictures without a window: a snapshot as pixels or as a PNG file."""

from collections.abc import Iterable, Iterator
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.render.camera import Camera
from station.render.files.png_file import write_png
from station.render.framing import named, stage_of
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.gpu.nv12 import Nv12Reader, Planes
from station.render.painter import Painter
from station.render.quality import QUALITIES, Quality
from station.render.snapshot import Snapshot


@dataclass(frozen=True, slots=True)
class Shot:
    """How a snapshot is pictured: `size` (width, height) in pixels, from `camera` (None: over the shoulder).

    A snapshot that asks for a view is seen from there.
    """

    size: tuple[int, int] = (1280, 720)
    quality: Quality = QUALITIES[1]
    camera: Camera | None = None
    with_score: bool = True


class PictureMaker:
    """Draws many snapshots of one size off screen; raises `DeviceError` where there is no OpenGL."""

    def __init__(
        self, size: tuple[int, int], quality: Quality = QUALITIES[1], ctx: moderngl.Context | None = None
    ) -> None:
        self.size = size
        self._ctx = ctx or standalone_context()
        with self._ctx:  # other makers may have contexts of their own
            self._target = RenderTarget(self._ctx, size, quality.samples)
            self._painter = Painter(self._ctx, quality)
        self._reader: Nv12Reader | None = None
        self._is_released = False

    def draw(self, snapshot: Snapshot, camera: Camera | None = None, with_score: bool = True) -> NDArray[np.uint8]:
        """The picture, shape (height, width, 3), top row first."""
        with self._ctx:
            self._paint(snapshot, camera, with_score)
            return self._target.read()

    def planes(self, snapshot: Snapshot, into: Planes, camera: Camera | None = None, with_score: bool = True) -> None:
        """Write the picture to `into` as planes for video; its size must be even."""
        with self._ctx:
            self._paint(snapshot, camera, with_score)
            picture = self._target.resolved()
            self._reader = self._reader or Nv12Reader(self._ctx, picture)
            self._reader.put()
            self._reader.read(into)

    def film(
        self, snapshots: Iterable[Snapshot], camera: Camera | None = None, with_score: bool = True
    ) -> Iterator[Planes]:
        """The pictures of consecutive `snapshots` as planes for video; each is read back while later ones are drawn.

        The size must be even. A film that is given up may be closed after the maker was released.
        """
        with self._ctx:
            reader = Nv12Reader(self._ctx, self._target.resolved())
        try:
            for snapshot in snapshots:
                with self._ctx:
                    ready = reader.read() if reader.is_full else None
                    self._paint(snapshot, camera, with_score)
                    self._target.resolved()
                    reader.put()
                if ready is not None:
                    yield ready
            while (last := self._read(reader)) is not None:
                yield last
        finally:
            if not self._is_released:
                with self._ctx:
                    reader.release()

    def _read(self, reader: Nv12Reader) -> Planes | None:
        with self._ctx:
            return reader.read()

    def _paint(self, snapshot: Snapshot, camera: Camera | None, with_score: bool) -> None:
        self._target.framebuffer.use()
        if snapshot.view is not None:
            mirrored = camera is not None and camera.mirrored
            camera = replace(named(snapshot.view, stage_of(snapshot)), mirrored=mirrored)
        self._painter.draw(snapshot, self._target.framebuffer, (0, 0, *self.size), camera, with_score)

    def release(self) -> None:
        """Give the driver its memory back."""
        self._is_released = True
        with self._ctx:
            if self._reader is not None:
                self._reader.release()
            self._target.release()
        self._ctx.release()


_USUAL = Shot()


class Artist:
    """Draws the pictures of a shot, as files or for video; raises `DeviceError` without OpenGL or disk."""

    def __init__(self, shot: Shot = _USUAL) -> None:
        self._shot = shot
        self._maker = PictureMaker(shot.size, shot.quality)

    def film(self, snapshots: Iterable[Snapshot]) -> Iterator[Planes]:
        """The pictures of consecutive `snapshots` as planes for video; the size must be even."""
        return self._maker.film(snapshots, self._shot.camera, self._shot.with_score)

    def planes(self, snapshot: Snapshot, into: Planes) -> None:
        """One picture as planes for video."""
        self._maker.planes(snapshot, into, self._shot.camera, self._shot.with_score)

    def png(self, snapshot: Snapshot, path: Path) -> None:
        """One picture as a file, whole or not at all."""
        write_png(self._maker.draw(snapshot, self._shot.camera, self._shot.with_score), path)

    def pngs(self, snapshots: Iterable[Snapshot], paths: Iterable[Path]) -> Iterator[Path]:
        """Write the picture of each snapshot to its path, and tell it."""
        for snapshot, path in zip(snapshots, paths, strict=True):
            self.png(snapshot, path)
            yield path

    def close(self) -> None:
        """Give the driver its memory back."""
        self._maker.release()


def draw_png(snapshot: Snapshot, path: Path, shot: Shot = _USUAL) -> None:
    """Write the picture of `snapshot` to `path`; raises `DeviceError` without OpenGL or if the disk refuses."""
    with closing(Artist(shot)) as artist:
        artist.png(snapshot, path)


def renderer_name() -> str:
    """What draws on this computer, in the driver's words; raises `DeviceError` without OpenGL."""
    ctx = standalone_context()
    name = f"{ctx.info['GL_RENDERER']}, OpenGL {ctx.version_code / 100:.1f}"
    ctx.release()
    return name
