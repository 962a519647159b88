"""What does not move on a stage of two, kept for each camera and for each light at its end: in it, or out of it.

While light goes from one drummer to the other the pictures of both ends are mixed, which costs a copy, where to draw
what stands anew would cost some ten frames. A camera that comes again finds its pictures there.
"""

from collections import OrderedDict
from collections.abc import Callable

import moderngl

from station.render.gpu.cached_layer import CachedLayer

Lights = tuple[float, float]
"""How much light each of two drummers stands in, 0–1."""
MOST = 12
"""So many pictures are kept (our choice: four cameras with three lights; 7 MB each at 1280x720)."""
_LEAST = 1 / 64
"""A picture that has less part in a mix is left out: it changes no pixel by more than four steps of 255."""


def ends_of(lights: Lights) -> list[tuple[Lights, float]]:
    """The ends that a mix for `lights` is made of, and the part of each; the parts sum to one."""
    (a, b), ends = lights, (0.0, 1.0)
    parts = [((x, y), (a if x else 1 - a) * (b if y else 1 - b)) for x in ends for y in ends]
    seen = [(end, part) for end, part in parts if part >= _LEAST]
    total = sum(part for _, part in seen)
    return [(end, part / total) for end, part in seen]


class LightLayers:
    """Keeps the pictures that were used last."""

    def __init__(self, ctx: moderngl.Context) -> None:
        self._ctx = ctx
        self._layers: OrderedDict[tuple[object, ...], CachedLayer] = OrderedDict()

    def under(
        self,
        target: moderngl.Framebuffer,
        key: tuple[object, ...],
        lights: Lights,
        draw: Callable[[moderngl.Framebuffer, Lights], None],
        lay_over: Callable[[moderngl.Texture, float], None],
        samples: int,
    ) -> None:
        """Fill `target` with what `draw` draws under `lights`; `lay_over` lays a picture over it, that opaque."""
        laid = 0.0
        for end, part in ends_of(lights):
            kept = (key, end)
            layer = self._layer(kept)

            def drawn(into: moderngl.Framebuffer, end: Lights = end) -> None:
                draw(into, end)

            laid += part
            if laid == part:
                layer.under(target, kept, drawn, samples)
            else:
                picture = layer.picture(target.size, kept, drawn, samples)
                target.use()
                self._ctx.viewport = (0, 0, *target.size)
                lay_over(picture, part / laid)

    def _layer(self, key: tuple[object, ...]) -> CachedLayer:
        layer = self._layers.pop(key, None)
        if layer is None:
            layer = self._layers.popitem(last=False)[1] if len(self._layers) >= MOST else CachedLayer(self._ctx)
        self._layers[key] = layer
        return layer

    def release(self) -> None:
        """Give the memory back."""
        for layer in self._layers.values():
            layer.release()
        self._layers.clear()
