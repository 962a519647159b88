"""Paints a snapshot: words above, the scene under them, the score below. Window and off-screen picture share it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import moderngl
import numpy as np
from numpy.typing import NDArray

from station.core.named_view import NamedView
from station.motion.kinematics.figure import Figure
from station.motion.kit.kit import Kit
from station.render import hud
from station.render.camera import Camera
from station.render.framing import named, stage_of
from station.render.gpu.bone_palette import BoneFrame
from station.render.gpu.cached_layer import CachedLayer
from station.render.gpu.edge_smoothing import EdgeSmoother
from station.render.gpu.gl import RenderTarget, give_back
from station.render.gpu.light_layers import LightLayers, Lights
from station.render.gpu.moving_parts import DoublePlace, frames_of
from station.render.gpu.shape_renderer import ShapeRenderer, Transform
from station.render.notation.screen.score_place import ScoreForm, halves
from station.render.notation.screen.score_view import ScorePaper, ScoreView
from station.render.palette import INK_FAINT, NIGHT, PAPER, Theme, over_picture, themed
from station.render.quality import QUALITIES, Quality
from station.render.scene import Scene
from station.render.snapshot import Hud, Snapshot
from station.render.text.atlas import Atlas
from station.render.text.draw_list import SHAPE_DTYPE

Area = tuple[int, int, int, int]
"""Left, lower, width, height in pixels from the lower left corner, as OpenGL counts."""

INSET_SHARE = 0.36
"""The second picture's share of the scene's width or height, whichever is less (our choice: hands at arm's length)."""
_STILL_SAMPLES = 4
"""A pixel of what is drawn once for each camera; fewer for one that moves."""
_INSET_MARGIN = 0.03
_INSET_EDGE = 2
"""Pixels of the line round the second picture."""


def inset_area(scene: Area) -> Area:
    """Where the second picture lies: the lower right corner of the scene."""
    left, low, width, height = scene
    inset_width = round(min(width * INSET_SHARE, height * INSET_SHARE * 16 / 9))
    inset_height = round(inset_width * 9 / 16)
    margin = round(height * _INSET_MARGIN)
    return left + width - inset_width - margin, low + margin, inset_width, inset_height


@dataclass(frozen=True, slots=True)
class Arrangement:
    """What else a picture has: the camera of a second, small picture in its corner, and the score's form.

    `has_legend`: beside a staff stands which piece is which. `is_rough`: the camera moves, so that at the lowest
    quality the room may be drawn more simply. `double`: where the student's double is, where the snapshot has one.
    `letters` is how large the words are, as `hud.scale` has it.
    """

    inset: Camera | None = None
    form: ScoreForm = ScoreForm.SCROLLING
    is_rough: bool = False
    double: DoublePlace = DoublePlace.NOWHERE
    has_legend: bool = False
    letters: float | None = None


class Painter:
    """Draws snapshots with one OpenGL context, in the colours of `theme`; keeps what consecutive snapshots share."""

    def __init__(self, ctx: moderngl.Context, quality: Quality = QUALITIES[1]) -> None:
        self._ctx = ctx
        ctx.gc_mode = "context_gc"  # `give_back` releases what is dropped, while this context is the current one
        self.quality = quality
        self.theme = Theme.NIGHT
        self.atlas = Atlas()
        self.printer = ShapeRenderer(ctx, self.atlas)
        self._score = ScoreView(self.printer, self.atlas)
        self._scene: Scene | None = None
        self._lit_still = LightLayers(ctx)
        self._still, self._worded, self._inset_still = CachedLayer(ctx), CachedLayer(ctx), CachedLayer(ctx)
        self._smoother, self._inset_smoother = EdgeSmoother(ctx), EdgeSmoother(ctx)
        self._inset: RenderTarget | None = None
        self._lines = _Kept(lambda words, page: hud.hud_lines(words, self.atlas, page.size, page.letters))
        self._calls = _Kept(lambda words, page: hud.hud_calls(words, self.atlas, page.size, page.letters))
        self._named = _Page((0, 0)), np.empty(0, SHAPE_DTYPE)
        self._played: _Players | None = None

    def draw_at(self, quality: Quality) -> None:
        """Draw at another quality from now on; the scene is built anew if it is made of other things."""
        if replace(quality, is_layered=False) != replace(self.quality, is_layered=False):
            self._played = None
        self.quality = quality

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
        self.begin(snapshot, target, area, camera, with_score, arrangement)(snapshot)

    def begin(
        self,
        snapshot: Snapshot,
        target: moderngl.Framebuffer,
        area: Area,
        camera: Camera | None = None,
        with_score: bool = True,
        arrangement: Arrangement = Arrangement(),
    ) -> Callable[[Snapshot], None]:
        """Draw all that moves, the longest part; returns what draws the rest: strokes that glow, the score, the words.

        That takes `snapshot`, or one of the same scene that knows of more strokes.
        """
        self.printer.theme = self.theme
        seen = self._seen(
            snapshot, area, camera, form_of(snapshot, arrangement.form) if with_score else None, arrangement
        )
        self._draw_moving_parts(seen, target)

        def finish(newest: Snapshot) -> None:
            newest = newest if newest.score is snapshot.score and newest.kit is snapshot.kit else snapshot
            self._finish(seen, newest, target, arrangement)

        return finish

    def _seen(
        self, snapshot: Snapshot, area: Area, camera: Camera | None, form: ScoreForm | None, arrangement: Arrangement
    ) -> "_Seen":
        """All that a picture's parts are drawn from."""
        left, low, width, height = area
        cut = halves((width, height), form)
        page = _page(snapshot.hud, cut.scene[2:], arrangement.letters)
        scene_area = (left + cut.scene[0], low + height - cut.scene[3], cut.scene[2], cut.scene[3] - page.band)
        paper = None if form is None else self._score.paper(snapshot, cut.score, form, arrangement.has_legend)
        scene = self._scene_of(snapshot)
        camera = camera or snapshot.camera or named(NamedView.SHOULDER, stage_of(snapshot))
        frames = frames_of(snapshot, arrangement.double, self.theme)
        scene.set(frames[0])
        places = _side_by_side(scene_area, len(frames))
        return _Seen(snapshot, scene, camera, area, places, frames, page, paper, arrangement.is_rough)

    def _draw_moving_parts(self, seen: "_Seen", target: moderngl.Framebuffer) -> None:
        """Draw the scene, whole or in layers, and under the score its paper."""
        if not self.quality.is_layered:
            seen.each(seen.scene.draw, target)
            self._lay_paper(seen)
            return
        corners = hud.corners(seen.snapshot.hud)
        key = (*seen.stands, self.theme, seen.paper, seen.lights, corners)
        self._worded.under(target, key, partial(self._lay_words, seen, corners))
        seen.each(partial(_draw_moving, seen.scene, self._smoother), target)

    def _lay_words(self, seen: "_Seen", corners: Hud, into: moderngl.Framebuffer) -> None:
        """Lay what stands still, and over it the upper lines."""
        samples = 0 if seen.is_rough else _STILL_SAMPLES
        if seen.lights is None:
            key = (*seen.stands, self.theme, seen.paper)
            self._still.under(into, key, partial(self._lay_still, seen), samples)
            into.use()
        else:
            key, over = (*seen.stands, self.theme), self.printer.picture
            self._lit_still.under(into, key, seen.lights, partial(self._lay_lit, seen), over, samples)
            into.use()
            self._lay_paper(seen)
        self._ctx.viewport = seen.area
        self._lay_lines(self._lines.of(corners, seen.page), seen.size)

    def _lay_still(self, seen: "_Seen", into: moderngl.Framebuffer) -> None:
        into.clear(*themed(NIGHT, self.theme), depth=1.0)
        seen.each(partial(seen.scene.draw_still, is_rough=seen.is_rough), into)
        self._lay_paper(seen)

    def _lay_lit(self, seen: "_Seen", into: moderngl.Framebuffer, lights: Lights) -> None:
        into.clear(*themed(NIGHT, self.theme), depth=1.0)
        seen.scene.draw_still(into, seen.camera, seen.places[0], seen.is_rough, lights)

    def _lay_paper(self, seen: "_Seen") -> None:
        """Lay the papers of the score and of the upper lines."""
        self._ctx.viewport = seen.area
        if seen.paper is not None:
            self._score.draw_paper(seen.snapshot, seen.paper, seen.size)
        self._fill_band(seen.page, seen.size)

    def _finish(self, seen: "_Seen", newest: Snapshot, target: moderngl.Framebuffer, arrangement: Arrangement) -> None:
        """Draw what glows, the score and the words of the `newest` snapshot of the same scene."""
        if self.quality.is_layered:
            if newest is not seen.snapshot and len(seen.frames) == 1:
                seen = replace(seen, frames=frames_of(newest, arrangement.double, self.theme)[:1])
            seen.each(seen.scene.draw_glow, target)
        if arrangement.inset is not None:
            self._draw_inset(seen.scene, target, arrangement.inset, seen.places[0])
        self._ctx.viewport = seen.area
        if seen.paper is not None:
            self._score.draw(newest, seen.paper, seen.size)
        self._print_words(newest.hud, seen.size, seen.page, len(seen.frames) > 1)

    def _print_words(self, shown: Hud, size: tuple[int, int], page: "_Page", has_names: bool) -> None:
        """Print what stands over the picture, and in its band where that is not kept with what stands still."""
        self.printer.theme = over_picture(self.theme)
        if has_names:
            self.printer.draw(self._names(page), Transform(size))
        if not self.quality.is_layered:
            self.printer.draw(self._lines.of(hud.corners(shown), page), Transform(size))
        self.printer.draw(self._calls.of(shown, page), Transform(size))

    def _fill_band(self, page: "_Page", size: tuple[int, int]) -> None:
        """The paper of the upper lines, above the scene."""
        if page.band:
            self.printer.theme = over_picture(self.theme)
            self.printer.fill((0.0, 0.0, float(page.size[0]), float(page.band)), (PAPER, PAPER), Transform(size))
            self.printer.theme = self.theme

    def _lay_lines(self, lines: NDArray[np.void], size: tuple[int, int]) -> None:
        """Print the upper lines."""
        self.printer.theme = over_picture(self.theme)
        self.printer.draw(lines, Transform(size))
        self.printer.theme = self.theme

    def _names(self, page: "_Page") -> NDArray[np.void]:
        """Who is who in two pictures side by side."""
        if page != self._named[0]:
            self._named = page, hud.name_shapes(self.atlas, page.size, page.band, page.letters)
        return self._named[1]

    def _draw_inset(self, scene: Scene, target: moderngl.Framebuffer, camera: Camera, scene_area: Area) -> None:
        """A second, small picture over the scene, and a line round it."""
        place = inset_area(scene_area)
        left, low, width, height = place
        edge = _INSET_EDGE
        if self.quality.is_layered:
            picture = self._small_picture(scene, camera, (width, height))
            target.use()
        self._ctx.viewport = (left - edge, low - edge, width + 2 * edge, height + 2 * edge)
        frame = (width + 2 * edge, height + 2 * edge)
        self.printer.fill((0.0, 0.0, float(frame[0]), float(frame[1])), (INK_FAINT, INK_FAINT), Transform(frame))
        if self.quality.is_layered:
            self._ctx.viewport = place
            self.printer.picture(picture)
        else:
            scene.draw(target, camera, place)

    def _small_picture(self, scene: Scene, camera: Camera, size: tuple[int, int]) -> moderngl.Texture:
        """The scene in layers of its own."""
        if self._inset is None or self._inset.size != size:
            if self._inset is not None:
                self._inset.release()
            self._inset = RenderTarget(self._ctx, size)
        whole, into = (0, 0, *size), self._inset.framebuffer
        key = (scene, camera, scene.shows_figure)
        self._inset_still.under(into, key, lambda still: scene.draw_still(still, camera, whole), _STILL_SAMPLES)
        _draw_moving(scene, self._inset_smoother, into, camera, whole)
        scene.draw_glow(into, camera, whole)
        return self._inset.resolved()

    def _scene_of(self, snapshot: Snapshot) -> Scene:
        """The scene of the snapshot's kits and figures; the same ones, even if read anew, are not built anew."""
        rival = snapshot.rival
        wanted = ((snapshot.kit, snapshot.figure), *([] if rival is None else [(rival.kit, rival.figure)]))
        if self._scene is None or self._played is None or not _same(wanted, self._played):
            self._scene = None
            for still in (self._still, self._worded, self._inset_still, self._lit_still):
                still.release()
            give_back(self._ctx)
            self._scene = Scene(self._ctx, *wanted[0], self.quality, *wanted[1:])
        self._played = wanted
        return self._scene


@dataclass(frozen=True, eq=False)
class _Seen:
    """One picture: the `scene` in each of `frames`, at its of `places`, from `camera`; `paper` None for no score."""

    snapshot: Snapshot
    scene: Scene
    camera: Camera
    area: Area
    places: list[Area]
    frames: list[BoneFrame]
    page: "_Page"
    paper: ScorePaper | None
    is_rough: bool

    @property
    def size(self) -> tuple[int, int]:
        """Of the whole picture."""
        return self.area[2:]

    @property
    def lights(self) -> Lights | None:
        """The light that two drummers stand in, in whole steps; None where there is one."""
        snapshot = self.snapshot
        if snapshot.rival is None:
            return None
        return round(snapshot.light * _STEPS) / _STEPS, round(snapshot.rival.light * _STEPS) / _STEPS

    @property
    def stands(self) -> tuple[object, ...]:
        """What the picture of what does not move depends on."""
        band, count = self.page.band, len(self.frames)
        return self.scene, self.camera, self.area, band, self.scene.shows_figure, count, self.is_rough

    def each(self, draw: Callable[[moderngl.Framebuffer, Camera, Area], None], into: moderngl.Framebuffer) -> None:
        """Draw every frame at its place; the demonstrator's stays set."""
        for frame, window in zip(self.frames[::-1], self.places[::-1], strict=True):
            self.scene.set(frame)
            draw(into, self.camera, window)


@dataclass(frozen=True, slots=True)
class _Page:
    """Where words stand: scene and `band` together have `size` pixels; `letters` as in `Arrangement`."""

    size: tuple[int, int]
    letters: float | None = None
    band: int = 0


def _page(words: Hud, size: tuple[int, int], letters: float | None) -> _Page:
    return _Page(size, letters, hud.band_height(words, size, letters))


class _Kept:
    """Remembers the last shapes that `made` of words for a page."""

    def __init__(self, made: Callable[[Hud, _Page], NDArray[np.void]]) -> None:
        self._made = made
        self._last = (Hud(), _Page((0, 0))), np.empty(0, SHAPE_DTYPE)

    def of(self, words: Hud, page: _Page) -> NDArray[np.void]:
        """The shapes, made anew only if the words or the page are others."""
        if (words, page) != self._last[0]:
            self._last = (words, page), self._made(words, page)
        return self._last[1]


def _draw_moving(scene: Scene, smoother: EdgeSmoother, into: moderngl.Framebuffer, camera: Camera, place: Area) -> None:
    """Draw what moves over what stands still, its edges smooth."""
    scene.draw_moving(into, camera, place)
    smoother.smooth(into, scene.moving_tiles(camera, place), place)


_Players = tuple[tuple[Kit, Figure], ...]
_STEPS = 32
"""In so many steps light goes from one drummer to the other where what stands is kept (our choice: none is seen)."""


def _same(some: _Players, others: _Players) -> bool:
    """Whether they are the very same, or alike in all that is drawn."""
    return len(some) == len(others) and all(
        (one[0] is other[0] and one[1] is other[1]) or one == other for one, other in zip(some, others, strict=True)
    )


def form_of(snapshot: Snapshot, form: ScoreForm) -> ScoreForm:
    """How the snapshot's score is shown: what nobody has written rolls by, below the room."""
    return form if snapshot.strip is None else ScoreForm.SCROLLING


def _side_by_side(scene: Area, count: int) -> list[Area]:
    """The scene's place cut into `count` equal ones, from left to right."""
    left, low, width, height = scene
    edges = [left + round(width * k / count) for k in range(count + 1)]
    return [(edges[k], low, edges[k + 1] - edges[k], height) for k in range(count)]
