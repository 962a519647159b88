"""The same letters and signs from another atlas: what was measured by outlines, drawn from a texture."""

import numpy as np
from numpy.typing import NDArray

from station.render.text.atlas import Atlas, Glyph
from station.render.text.draw_list import ShapeKind
from station.render.text.paper import OutlineAtlas


def on_atlas(shapes: NDArray[np.void], outlines: OutlineAtlas, atlas: Atlas) -> NDArray[np.void]:
    """`shapes` (n,), whose glyphs are of `outlines`, with those of `atlas` in the same places and sizes."""
    rows = np.flatnonzero(shapes["kind"] == ShapeKind.GLYPH)
    if not len(rows):
        return shapes
    found = shapes.copy()
    numbers, which = np.unique(np.rint(shapes["uv"][rows, 0]).astype(int), return_inverse=True)
    pairs = [outlines.twin(number, atlas) for number in numbers.tolist()]
    was, now = (_boxes([pair[k] for pair in pairs])[which] for k in (0, 1))
    uv = np.array([pair[1].uv for pair in pairs], np.float32)[which]
    scale = (shapes["half"][rows, 1] / was[:, 3])[:, None]
    is_mirrored = shapes["uv"][rows, 1] > shapes["uv"][rows, 3]
    way = np.column_stack([np.ones(len(rows)), np.where(is_mirrored, 1.0, -1.0)])
    found["centre"][rows] += (now[:, :2] - was[:, :2]) * scale * way
    found["half"][rows] = now[:, 2:] * scale
    found["uv"][rows] = np.where(is_mirrored[:, None], uv[:, [0, 3, 2, 1]], uv)
    return found


def _boxes(glyphs: list[Glyph]) -> NDArray[np.float64]:
    """Centre and half extents of glyphs, shape (n, 4)."""
    return np.array([(*glyph.centre, *glyph.half) for glyph in glyphs])
