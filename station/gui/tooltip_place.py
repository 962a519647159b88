"""Where a tooltip stands: beside what it explains, never over it, and outside the panel where it can.

Rectangles are left, top, right, bottom in pixels of the window, y down.
"""

from collections.abc import Iterator

Box = tuple[float, float, float, float]
Pair = tuple[float, float]
"""Two lengths in pixels: x and y, or width and height."""


def tooltip_place(item: Box, panel: Box, size: Pair, window: Pair, gap: float, far: float) -> Pair:
    """The upper left corner for a tooltip of `size` about `item`, which lies in `panel`.

    Beside the panel, or above it, if its edge is no farther than `far` from the item: there nothing of the panel is
    hidden. Else above, below or beside the item. What fits nowhere stands where it is least outside, within `window`.
    """
    places = [*_places(item, panel, size, gap, far)]
    x, y = next((place for place in places if _is_inside(place, size, window)), places[-1])
    return max(min(x, window[0] - size[0]), 0.0), max(min(y, window[1] - size[1]), 0.0)


def _places(item: Box, panel: Box, size: Pair, gap: float, far: float) -> Iterator[Pair]:
    """From the best to the worst."""
    (left, top, right, bottom), (width, height) = item, size
    if panel[2] - right <= far:
        yield panel[2] + gap, top
    if left - panel[0] <= far:
        yield panel[0] - gap - width, top
    if top - panel[1] <= far:
        yield left, panel[1] - gap - height
    yield left, top - gap - height
    yield right - width, top - gap - height
    yield left, bottom + gap
    yield right - width, bottom + gap
    yield right + gap, top
    yield left - gap - width, top
    yield right + gap, bottom - height
    yield left - gap - width, bottom - height


def _is_inside(place: Pair, size: Pair, window: Pair) -> bool:
    return all(at >= 0.0 and at + length <= most for at, length, most in zip(place, size, window, strict=True))
