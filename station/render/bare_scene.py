"""The scene's triangles with nothing round them, for comparison: the same buffers and shaders, drawn by bare moderngl.

One palette of bones is uploaded once; each call clears, draws the shadow pass and the picture pass where the painter
has its scene, and reads the picture back. What `painter` costs beyond this is what the station adds: posing, score,
words.
"""

import numpy as np

from station.core.named_view import NamedView
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render.framing import named
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.gl import RenderTarget, standalone_context
from station.render.notation.screen.score_place import SHARES, ScoreForm
from station.render.quality import Quality
from station.render.scene import Scene
from station.render.snapshot import Snapshot


class BareScene:
    """Draws the same frame again and again; raises `DeviceError` where there is no OpenGL."""

    def __init__(self, size: tuple[int, int], kit: Kit, figure: Figure, quality: Quality) -> None:
        self._ctx = standalone_context()
        with self._ctx:
            self._target = RenderTarget(self._ctx, size, quality.samples)
            self._scene = Scene(self._ctx, kit, figure, quality)
        score = round(size[1] * SHARES[ScoreForm.SCROLLING])
        self._area = (0, score, size[0], size[1] - score)

    @property
    def triangles(self) -> int:
        """How many a frame draws, shadows apart."""
        return self._scene.triangles

    def pose(self, snapshot: Snapshot) -> None:
        """Draw once as the station does, which sets every uniform and bone."""
        with self._ctx:
            self._scene.set(BoneFrame(snapshot.pose))
            self._scene.draw(self._target.framebuffer, named(NamedView.SHOULDER), self._area)

    def draw(self) -> int:
        """One frame; returns the sum of a few of its bytes, so that it is really there."""
        with self._ctx:
            self._scene.draw_shadows()
            self._target.framebuffer.use()
            self._ctx.viewport = self._area
            self._target.framebuffer.clear(depth=1.0)
            for part in self._scene.picture_parts:
                part.render()
            return int(np.sum(self._target.read()[::64, ::64]))
