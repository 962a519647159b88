"""Drawn shapes as SVG within a page: vectors whose colours the page's own style sheet names.

Each outline stands in the page once, among its `definitions`, and is used in many places; upright boxes are rectangles
and round areas ellipses. A colour is a custom property of CSS (`--ink`, `--good` … of `palette.INK_NAMES`), so that one
drawing serves day and night. Source: Scalable Vector Graphics (SVG) 2, W3C Candidate Recommendation 2018: sections 5.5
(`use`), 7 (geometry), 8 (transforms) and 9.3 (paths).
"""

from collections.abc import Iterator
from html import escape

import numpy as np
from numpy.typing import NDArray

from station.render.palette import INK_NAMES, Theme, themed
from station.render.text.draw_list import Colour
from station.render.text.paper import DISC, SQUARE, Ink, OutlineAtlas, PaperSpot, Points, filled

_NAMES = {tuple(round(255 * value) for value in colour[:3]): name for name, colour in INK_NAMES.items()}
_HERE = PaperSpot((0.0, 0.0), 1.0)


class SvgPaths:
    """The shapes of one page, their letters and signs from `atlas`; `prefix` begins the names of its outlines."""

    def __init__(self, atlas: OutlineAtlas, prefix: str = "o") -> None:
        self.atlas = atlas
        self._prefix = prefix
        self._used: dict[int, None] = {}

    def areas(self, shapes: NDArray[np.void]) -> str:
        """The elements that paint `shapes` in order; times have been placed, or are nothing."""
        if not len(shapes):
            return ""
        ink = filled(shapes, self.atlas, _HERE)
        return "".join(self._painted(ink))

    def definitions(self) -> str:
        """The outlines that were used so far, to stand once in the page."""
        paths = (
            f'<path id="{self._prefix}{number}" d="{_path(self.atlas.outlines[number])}"/>' for number in self._used
        )
        return f'<svg class="outlines" width="0" height="0" aria-hidden="true"><defs>{"".join(paths)}</defs></svg>'

    def _painted(self, ink: Ink) -> Iterator[str]:
        """Runs of one colour, each a group."""
        colour, run = None, list[str]()
        for number, matrix, rgba in zip(ink.numbers.tolist(), ink.matrices.tolist(), ink.rgba.tolist(), strict=True):
            if tuple(rgba) != colour:
                yield from _group(colour, run)
                colour, run = tuple(rgba), []
            run.append(self._area(number, matrix))
        yield from _group(colour, run)

    def _area(self, number: int, matrix: list[float]) -> str:
        a, b, c, d, e, f = matrix
        is_upright = b == 0 and c == 0
        if number == SQUARE and is_upright:
            box = e - abs(a), f - abs(d), 2 * abs(a), 2 * abs(d)
            return '<rect x="{}" y="{}" width="{}" height="{}"/>'.format(*map(figures, box))
        if number == DISC and is_upright:
            return '<ellipse cx="{}" cy="{}" rx="{}" ry="{}"/>'.format(*map(figures, (e, f, abs(a), abs(d))))
        self._used[number] = None
        turn = " ".join(map(figures, matrix))
        return f'<use href="#{self._prefix}{number}" transform="matrix({turn})"/>'


def figures(value: float) -> str:
    """A length as short as two decimals allow, four where it is small: scales of letters are."""
    text = f"{value:.2f}" if abs(value) >= 2 else f"{value:.4f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def picture(paths: SvgPaths, shapes: NDArray[np.void], size: tuple[float, float], words: str) -> str:
    """A drawing of its own, `size` units wide and high, that a screen reader knows by `words`."""
    width, height = map(figures, size)
    return (
        f'<svg viewBox="0 0 {width} {height}" role="img" aria-label="{escape(words)}">'
        f"<title>{escape(words)}</title>{paths.areas(shapes)}</svg>"
    )


def style_of(theme: Theme) -> str:
    """The custom properties that a theme gives the colours."""
    return "".join(f"--{name}:{_hex(themed(colour, theme))};" for name, colour in INK_NAMES.items())


def _hex(colour: Colour) -> str:
    return "#" + "".join(f"{round(255 * value):02x}" for value in colour[:3])


def _group(rgba: tuple[int, ...] | None, run: list[str]) -> Iterator[str]:
    if rgba is None or not run:
        return
    name = _NAMES.get(rgba[:3])
    fill = f"var(--{name})" if name is not None else "#" + "".join(f"{value:02x}" for value in rgba[:3])
    faint = "" if rgba[3] == 255 else f' fill-opacity="{figures(rgba[3] / 255)}"'
    yield f'<g fill="{fill}"{faint}>{"".join(run)}</g>'


def _path(contours: tuple[Points, ...]) -> str:
    return "".join(f"M{'L'.join(f'{x:.4g} {y:.4g}' for x, y in contour.tolist())}Z" for contour in contours)
