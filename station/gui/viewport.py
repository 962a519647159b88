"""The picture behind the panels: the practice room or the results page, its viewpoint, and its quality.

It keeps where one looks from; how the picture is shown follows the look of each frame (`follow`). The room is drawn
in two steps: `begin` draws all that moves, the longest part, and what it returns the rest, which may know of strokes
that were heard meanwhile.

The quality is what the user has fixed, or what the machine holds (`render.quality_choice`). While somebody plays
nothing is rebuilt.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from time import perf_counter

import moderngl
import numpy as np
from imgui_bundle import imgui
from numpy.typing import NDArray

from station.app.room_state import ShownResult
from station.app.settings.view_settings import ViewSettings
from station.core.errors import DeviceError
from station.core.named_view import NamedView
from station.gui import theme
from station.gui.flat_canvas import FlatCanvas
from station.gui.panel_size import WORDS
from station.render.camera import Camera
from station.render.framing import Stage, named, stage_of
from station.render.gpu.gl import GL_VERSION, RenderTarget
from station.render.hud import FreeLine, band_height, corners, free_line
from station.render.notation.screen.score_place import halves
from station.render.painter import Area, Arrangement, Painter, form_of
from station.render.palette import NIGHT, themed
from station.render.quality import QUALITIES
from station.render.quality_choice import QualityChoice, first_choice
from station.render.report.report_layout import ReportPage, page_for
from station.render.report.report_picture import report_shapes, report_sheet
from station.render.snapshot import Hud, Snapshot

_GONE = "GL_UNKNOWN_ERROR"
"""What moderngl calls GL_CONTEXT_LOST (KHR_robustness), which OpenGL 3.3 has no number for yet."""
_LOST = "the graphics driver has lost the window: start the station again; what was played is kept"
_MIN_TEXT_SIZE = 0.9
"""How large a result's letters are at the least, of the panels' own (our choice)."""
_LEAST_AREA = 16
"""Pixels of the free middle's shorter side below which nothing is drawn there (our choice)."""
_ORBIT_PER_PIXEL, _PAN_PER_PIXEL, _ZOOM_PER_STEP = 0.006, 0.0022, 1.12

Finish = Callable[[Snapshot], None]
"""Draws the rest of a picture, with what has been struck since it was begun."""


class Viewport:
    """Draws with the window's own OpenGL context, which it takes over at the first frame."""

    def __init__(self, quality: int | None, view_settings: ViewSettings) -> None:
        self._fixed = quality
        self._choice = QualityChoice()
        self.may_rebuild = True
        """Whether the quality may change now: nobody plays."""
        self._painter: Painter | None = None
        self._ctx: moderngl.Context | None = None
        self._target: RenderTarget | None = None
        self.canvas = FlatCanvas(self._ready)
        """What panels draw notation with."""
        self._samples = 0
        self._words: tuple[Hud, tuple[int, int], float] | None = None
        self._page: tuple[ShownResult, ReportPage, NDArray[np.void]] | None = None
        self.view_settings = view_settings
        self._stage: Stage | None = None
        self._asked: NamedView | None = None
        self.camera = self._named(None)
        self._seen_from = self.camera

    def follow(self, view_settings: ViewSettings, asked: NamedView | None = None) -> None:
        """Show the picture so; another named view, or the other side, turns it, and what is so already stays turned.

        A view that the lesson has `asked` for is gone to once, and left where it asks no more; between, users turn it.
        """
        if view_settings.view is not self.view_settings.view:
            self.camera = named(view_settings.view, self._stage)
        if asked is not self._asked:
            self._asked = asked
            self.camera = named(view_settings.view if asked is None else asked, self._stage)
        self.view_settings = view_settings
        self.camera = replace(self.camera, mirrored=view_settings.mirrored)

    def go(self, slot: int) -> bool:
        """Look from the viewpoint `slot`, from 0; returns whether it was kept."""
        camera = self.view_settings.viewpoints[slot]
        if camera is not None:
            self.camera = replace(camera, mirrored=self.view_settings.mirrored)
        return camera is not None

    def back_to(self, view: NamedView) -> None:
        """Go to a named view, even where it was turned."""
        self.view_settings = replace(self.view_settings, view=view)
        self._back_to_the_view()

    @property
    def _inset(self) -> Camera | None:
        """The camera of the second picture."""
        if self.view_settings.inset is None:
            return None
        return replace(named(self.view_settings.inset, self._stage), mirrored=self.view_settings.mirrored)

    def _back_to_the_view(self) -> None:
        self.camera = self._named(self._stage)

    def _named(self, stage: Stage | None) -> Camera:
        return replace(named(self.view_settings.view, stage), mirrored=self.view_settings.mirrored)

    def steer(self, io: imgui.IO) -> None:
        """Turn, shift or approach with the mouse; a double click goes back to the named view."""
        dx, dy = io.mouse_delta
        way = -1 if self.camera.mirrored else 1
        if imgui.is_mouse_dragging(imgui.MouseButton_.left):
            self.camera = self.camera.orbited(dx * way * _ORBIT_PER_PIXEL, dy * _ORBIT_PER_PIXEL)
        elif imgui.is_mouse_dragging(imgui.MouseButton_.right):
            self.camera = self.camera.panned(-dx * way * _PAN_PER_PIXEL, dy * _PAN_PER_PIXEL)
        if io.mouse_wheel:
            self.camera = self.camera.zoomed(_ZOOM_PER_STEP**io.mouse_wheel)
        if imgui.is_mouse_double_clicked(imgui.MouseButton_.left):
            self._back_to_the_view()

    def begin(self, snapshot: Snapshot, area: Area, with_score: bool = True) -> Finish:
        """Draw all that moves in the room; returns what draws the rest of the picture.

        `area` is what the panels leave free; `with_score` is false where a panel shows the music. Both raise
        `DeviceError` if OpenGL fails.
        """
        ctx, painter = self._ready()
        screen, whole = self.clear()
        painter.theme = self.view_settings.theme
        if min(area[2:]) < _LEAST_AREA:
            self._words = None
            return lambda _: None
        self._follow_stage(stage_of(snapshot))
        began = perf_counter()
        target = self._target_for(painter, ctx, whole)
        camera = self._camera_for(snapshot)
        is_rough = camera != self._seen_from and snapshot.camera is None  # a stage's cameras are few, and prepared
        look, letters = self.view_settings, _letters()
        arrangement = Arrangement(self._inset, look.score, is_rough, look.double, look.legend, letters)
        form = form_of(snapshot, look.score) if with_score else None
        self._words = corners(snapshot.hud), halves(area[2:], form).scene[2:], letters
        self._seen_from = camera
        with self._watched():
            rest = painter.begin(snapshot, target.framebuffer, area, camera, with_score, arrangement)
            if painter.quality.is_layered:
                ctx.finish()  # else what is drawn would still be to do when the engine is asked what it has heard

        def finish(newest: Snapshot) -> None:
            with self._watched():
                rest(newest)
                target.show(screen)
                screen.use()  # the panels are drawn into what is bound
                self._measure(began)
                ctx.viewport = (0, 0, *whole)

        return finish

    def free_line(self) -> FreeLine | None:
        """Where the band above the room has no words, in pixels of the picture; None where there is no band."""
        if self._painter is None or self._words is None or not band_height(*self._words):
            return None
        hud, size, letters = self._words
        return free_line(hud, self._painter.atlas, size, letters)

    def _camera_for(self, snapshot: Snapshot) -> Camera:
        """The user's own camera; where they have turned nothing, the one that the snapshot asks for."""
        is_turned = self.camera != self._named(self._stage)
        return self.camera if is_turned or snapshot.camera is None else snapshot.camera

    def _follow_stage(self, stage: Stage) -> None:
        """Frame another kit or player; where the user has turned the picture only another side turns it back."""
        before, self._stage = self._stage, stage
        is_turned = self.camera != self._named(before)
        if stage != before and not (is_turned and before and stage.kit.left_handed == before.kit.left_handed):
            self._back_to_the_view()

    def draw_report(self, report: ShownResult, area: Area) -> None:
        """Draw a result in place of the room; raises `DeviceError` if OpenGL fails."""
        ctx, painter = self._ready()
        self._words = None
        _, whole = self.clear()
        painter.theme = self.view_settings.theme
        if min(area[2:]) < _LEAST_AREA:
            return
        with self._watched():
            self._draw_report(report, painter, ctx, area)
            ctx.viewport = (0, 0, *whole)

    @contextmanager
    def _watched(self) -> Iterator[None]:
        """Raises `DeviceError` where OpenGL fails or the driver has lost the window."""
        try:
            yield
        except moderngl.Error as fault:
            raise DeviceError(f"{_LOST} ({fault})") from fault
        if self._ctx is not None and self._ctx.error == _GONE:
            raise DeviceError(_LOST)

    def clear(self) -> tuple[moderngl.Framebuffer, tuple[int, int]]:
        """Make the window's framebuffer dark; returns it and its size in pixels."""
        ctx, _ = self._ready()
        screen = ctx.detect_framebuffer(0)
        screen.use()
        size = imgui.get_io().display_size
        scale = imgui.get_io().display_framebuffer_scale
        whole = (round(size.x * scale.x), round(size.y * scale.y))
        ctx.viewport = (0, 0, *whole)
        ctx.scissor = None
        screen.clear(*themed(NIGHT, self.view_settings.theme), depth=1.0)
        return screen, whole

    def release(self) -> None:
        """Give the driver its memory back before the window goes."""
        self.canvas.release()
        self._drop_target()

    def _drop_target(self) -> None:
        if self._target is not None:
            self._target.release()
            self._target = None

    def _ready(self) -> tuple[moderngl.Context, Painter]:
        if self._ctx is None or self._painter is None:
            try:
                self._ctx = moderngl.create_context(require=GL_VERSION)
            except Exception as fault:
                raise DeviceError(f"the window has no OpenGL 3.3: {fault}") from fault
            self._choice = first_choice(self._ctx.info["GL_RENDERER"], len(QUALITIES))
            self._painter = Painter(self._ctx, QUALITIES[self.quality])
        return self._ctx, self._painter

    def _target_for(self, painter: Painter, ctx: moderngl.Context, whole: tuple[int, int]) -> RenderTarget:
        """Where the picture is made: off the screen, with as many samples a pixel as the quality asks for."""
        if self._target is not None and self._target.size != whole:
            self._choice = replace(first_choice(ctx.info["GL_RENDERER"], len(QUALITIES)), level=self._choice.level)
        if self._target is None or self._target.size != whole or self._samples != painter.quality.samples:
            self._drop_target()
            self._samples = painter.quality.samples
            self._target = RenderTarget(ctx, whole, self._samples)
        if not painter.quality.is_layered:
            self._target.framebuffer.clear(*themed(NIGHT, painter.theme), depth=1.0)
        return self._target

    @property
    def quality(self) -> int:
        """The level at which the picture is drawn: the one that was fixed, or that the machine holds."""
        fixed = self.view_settings.quality if self._fixed is None else self._fixed
        return self._choice.level if fixed is None else fixed

    def _measure(self, began: float) -> None:
        """Let the choice know what the picture took, where it asks, and draw the next as it says."""
        if self._ctx is None or self._painter is None:
            return
        took_ms = None
        if self._choice.wants_time:
            self._ctx.finish()
            took_ms = (perf_counter() - began) * 1000
        if self._fixed is None and self.view_settings.quality is None:
            self._choice = self._choice.drawn(took_ms, self.may_rebuild)
        if self._painter.quality is not QUALITIES[self.quality]:
            self._painter.draw_at(QUALITIES[self.quality])

    def _draw_report(self, report: ShownResult, painter: Painter, ctx: moderngl.Context, area: Area) -> None:
        text_size = theme.points(_MIN_TEXT_SIZE) * imgui.get_io().display_framebuffer_scale.y
        page = page_for(area[2:], text_size)
        if self._page is None or self._page[0] is not report or self._page[1] != page:
            self._page = report, page, report_shapes(report.facts, painter.atlas, page)
        ctx.viewport = area
        painter.printer.theme = painter.theme
        painter.printer.draw(self._page[2], report_sheet(area[2:], page))


def _letters() -> float:
    """How large the picture's words are beside the panels', in pixels a design pixel (`hud.scale`)."""
    return theme.points(WORDS) * float(imgui.get_io().display_framebuffer_scale.y)
