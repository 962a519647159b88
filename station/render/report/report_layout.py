"""Where the parts of a result's page lie: as large as the picture allows, and rather fewer parts than smaller letters.

A page is laid out in units; letters are 14 to 48 units high, so that a unit of a pixel is read at arm's length and
more of them from the throne. A whole page needs `WHOLE` units. Where a picture is too small for that, the card alone
with points, counts and advice is drawn, and below it what there is room for.
"""

from dataclasses import dataclass

WHOLE = (900.0, 510.0)
"""Units that points, every stroke, pieces and technique take beside each other."""
SHORT = (560.0, 310.0)
"""Units that the points, the counts and what to do next take alone."""
_A_LITTLE = 0.8
"""By so much letters may be smaller for the pieces, or else the strokes, to be seen (our choice): above what comes next
lie 1370 × 607 pixels of a window of 1920 × 1080, whose least unit is 1.49, and the page's is 1.19."""
HEAD = 74.0
"""Units of the title above the cards."""
EDGE, BETWEEN = 20.0, 12.0
_CARD, _CARD_SHARE = 300.0, 0.33
"""The least width of the card beside the plots, and its share of a wide page: its words then are fewer lines."""
_PLOT, _PIECES = 180.0, 150.0
"""The least heights in which the plots can be read."""
_PLOT_SHARE = 0.42
"""The plot's share of the height that it has with the pieces."""
_SHORT_CARD = 244.0
PLOTTED = (SHORT[0], HEAD + _SHORT_CARD + BETWEEN + _PLOT + EDGE)
"""Units that these take with every stroke below."""


@dataclass(frozen=True, slots=True)
class ReportBox:
    """A part of the page in units, from its top left corner."""

    left: float
    top: float
    width: float
    height: float

    @property
    def right(self) -> float:
        """Its right edge."""
        return self.left + self.width

    @property
    def bottom(self) -> float:
        """Its lower edge."""
        return self.top + self.height


@dataclass(frozen=True, slots=True)
class ReportPage:
    """A page of `width` × `height` units of `unit` pixels; a part that has no room is None.

    A `wide` card has its words beside its numbers, any other below them.
    """

    unit: float
    width: float
    height: float
    card: ReportBox
    wide: bool
    plot: ReportBox | None
    pieces: ReportBox | None


def page_for(size: tuple[int, int], least_unit: float = 0.0) -> ReportPage:
    """The page that fills a picture of `size` pixels, with units of `least_unit` pixels or more where they fit."""
    whole = _unit(size, WHOLE)
    if whole >= _A_LITTLE * least_unit:
        return _whole_page(whole, size[0] / whole, size[1] / whole)
    unit, plotted = min(_unit(size, SHORT), least_unit), _unit(size, PLOTTED)
    if _A_LITTLE * least_unit <= plotted < unit:
        unit = plotted
    return _short_page(unit, size[0] / unit, size[1] / unit)


def _unit(size: tuple[int, int], needed: tuple[float, float]) -> float:
    return max(min(size[0] / needed[0], size[1] / needed[1]), 1e-3)


def _whole_page(unit: float, width: float, height: float) -> ReportPage:
    low = height - EDGE
    card = ReportBox(EDGE, HEAD, max(_CARD, _CARD_SHARE * width), low - HEAD)
    left = card.right + BETWEEN
    across = width - EDGE - left
    plot = ReportBox(left, HEAD, across, max(_PLOT, _PLOT_SHARE * card.height))
    top = plot.bottom + BETWEEN
    return ReportPage(unit, width, height, card, False, plot, ReportBox(left, top, across, low - top))


def _short_page(unit: float, width: float, height: float) -> ReportPage:
    low, across = height - EDGE, width - 2 * EDGE
    has_plot = height >= PLOTTED[1] - 1e-6
    has_pieces = low - HEAD >= _SHORT_CARD + _PLOT + _PIECES + 2 * BETWEEN
    card = ReportBox(EDGE, HEAD, across, _SHORT_CARD if has_plot else low - HEAD)
    below = low - card.bottom - BETWEEN
    plot = ReportBox(EDGE, card.bottom + BETWEEN, across, _PLOT if has_pieces else below) if has_plot else None
    if plot is None or not has_pieces:
        return ReportPage(unit, width, height, card, True, plot, None)
    top = plot.bottom + BETWEEN
    return ReportPage(unit, width, height, card, True, plot, ReportBox(EDGE, top, across, low - top))
