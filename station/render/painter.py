"""Paints a snapshot: scene above, score below, words over the scene. The window and the off-screen picture share it."""

from collections.abc import Iterable
from dataclasses import dataclass

import moderngl
import numpy as np

from station.core.pieces import Piece
from station.motion.figure import Figure
from station.motion.kit import Kit
from station.motion.pose import Pose
from station.render import hud
from station.render.atlas import Atlas
from station.render.camera import Camera, View, named
from station.render.ink_printer import InkPrinter, Sheet
from station.render.palette import BRAND, GOOD, INK_FAINT, NIGHT, Theme, over_picture
from station.render.scene import QUALITIES, Glow, Quality, Scene
from station.render.score_view import Place, ScoreForm, ScoreView
from station.render.snapshot import Snapshot, Strike

Area = tuple[int, int, int, int]
"""Left, lower, width, height in pixels from the lower left corner, as OpenGL counts."""

SCORE_SHARE = 0.30
"""The score's share of the picture's height."""
INSET_SHARE = 0.36
"""The second picture's share of the scene's width or height, whichever is less (our choice: hands at arm's length)."""
_INSET_MARGIN = 0.03
_INSET_EDGE = 2
"""Pixels of the line round the second picture."""
_GLOW_FADE_S = 0.16
"""How fast a struck piece stops glowing (our choice)."""
_DEMONSTRATOR_GLOW, _STUDENT_GLOW = 0.35, 1.1


def inset_area(scene: Area) -> Area:
    """Where the second picture lies: the lower right corner of the scene."""
    left, low, width, height = scene
    inset_width = round(min(width * INSET_SHARE, height * INSET_SHARE * 16 / 9))
    inset_height = round(inset_width * 9 / 16)
    margin = round(height * _INSET_MARGIN)
    return left + width - inset_width - margin, low + margin, inset_width, inset_height


@dataclass(frozen=True, slots=True)
class Arrangement:
    """What else a picture has: the camera of a second, small picture in its corner, and the score's form."""

    inset: Camera | None = None
    form: ScoreForm = ScoreForm.SCROLLING


class Painter:
    """Draws snapshots with one OpenGL context, in the colours of `theme`; keeps what consecutive snapshots share."""

    def __init__(self, ctx: moderngl.Context, quality: Quality = QUALITIES[1]) -> None:
        self._ctx = ctx
        ctx.gc_mode = "context_gc"  # what is dropped is given back by `gc`, while this context is the current one
        self.quality = quality
        self.theme = Theme.NIGHT
        self.atlas = Atlas()
        self.printer = InkPrinter(ctx, self.atlas)
        self._score = ScoreView(self.printer, self.atlas)
        self._scene: Scene | None = None
        self._played: tuple[Kit, Figure] | None = None

    def draw(
        self,
        snapshot: Snapshot,
        target: moderngl.Framebuffer,
        area: Area,
        camera: Camera | None = None,
        with_score: bool = True,
        arrangement: Arrangement = Arrangement(),
    ) -> None:
        """Draw `snapshot` into `area` of `target`, over what is there."""
        self.printer.theme = self.theme
        left, low, width, height = area
        score_height = round(height * SCORE_SHARE) if with_score else 0
        scene_area = (left, low + score_height, width, height - score_height)
        scene = self._scene_of(snapshot)
        scene.draw(
            target, camera or named(View.SHOULDER, snapshot.kit.left_handed), snapshot.pose, scene_area, _glow(snapshot)
        )
        if arrangement.inset is not None:
            self._draw_inset(scene, target, arrangement.inset, snapshot.pose is not None, scene_area)
        self._ctx.viewport = area
        if with_score:
            place = Place(0.0, float(height - score_height), float(width), float(score_height))
            self._score.draw(snapshot, place, (width, height), arrangement.form)
        self.printer.theme = over_picture(self.theme)
        words = hud.hud_shapes(snapshot.hud, self.atlas, (float(width), float(height - score_height)))
        veil = (0.0, 0.0, float(width), hud.VEIL_HEIGHT * hud.scale(height - score_height))
        self.printer.fill(veil, hud.VEIL, Sheet((width, height)))
        self.printer.draw(words, Sheet((width, height)))

    def _draw_inset(
        self, scene: Scene, target: moderngl.Framebuffer, camera: Camera, with_figure: bool, scene_area: Area
    ) -> None:
        place = inset_area(scene_area)
        left, low, width, height = place
        edge = _INSET_EDGE
        self._ctx.viewport = (left - edge, low - edge, width + 2 * edge, height + 2 * edge)
        frame = (width + 2 * edge, height + 2 * edge)
        self.printer.fill((0.0, 0.0, float(frame[0]), float(frame[1])), (INK_FAINT, INK_FAINT), Sheet(frame))
        scene.draw_again(target, camera, with_figure, place)

    def _scene_of(self, snapshot: Snapshot) -> Scene:
        """The scene of the snapshot's kit and figure; the same ones, even if read anew, are not built anew."""
        wanted = (snapshot.kit, snapshot.figure)
        if self._scene is None or self._played is None or not _same(wanted, self._played):
            self._scene = None
            self._ctx.gc()
            self._scene = Scene(self._ctx, *wanted, self.quality)
        self._played = wanted
        return self._scene

    @property
    def background(self) -> tuple[float, float, float, float]:
        """The colour of what no picture covers."""
        return NIGHT


def _same(one: tuple[Kit, Figure], other: tuple[Kit, Figure]) -> bool:
    """Whether both are the very same, or alike in all that is drawn."""
    return (one[0] is other[0] and one[1] is other[1]) or one == other


def _glow(snapshot: Snapshot) -> Glow:
    """How brightly each piece glows, in linear light: the demonstrator's strokes warm, the student's blue."""
    warm, blue = np.square(BRAND[:3]), np.square(GOOD[:3])
    glow: Glow = {}
    for piece, light in _demonstrated(snapshot.kit, snapshot.pose):
        glow[piece] = glow.get(piece, np.zeros(3)) + _DEMONSTRATOR_GLOW * light * warm
    for piece, light in _struck(snapshot.kit, snapshot.strikes):
        glow[piece] = glow.get(piece, np.zeros(3)) + _STUDENT_GLOW * light * blue
    return glow


def _demonstrated(kit: Kit, pose: Pose | None) -> Iterable[tuple[Piece, float]]:
    if pose is not None:
        yield from zip(kit.pieces, pose.flash.tolist(), strict=True)


def _struck(kit: Kit, strikes: Iterable[Strike]) -> Iterable[tuple[Piece, float]]:
    for strike in strikes:
        if strike.student and strike.age_s >= 0:
            yield (
                kit.stand_in(strike.piece),
                float(np.exp(-strike.age_s / _GLOW_FADE_S)) * (0.35 + strike.velocity / 195),
            )
