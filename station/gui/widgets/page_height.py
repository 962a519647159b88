"""How high a page below the picture is: its share of the window, and all of it where that is low."""

from imgui_bundle import imgui

from station.gui import theme

_SHARE, _LEAST_PICTURE, _BELOW = 0.62, 90.0, 122.0
"""The page's share of the window without the strip (`_BELOW` design pixels), and what the picture needs at least: in a
low window there is none (our choice)."""


class PageHeight:
    """Fits a docked page that needs `least` design pixels to every new size of the window."""

    def __init__(self, least: float) -> None:
        self._least = least
        self._fitted = 0.0, 0.0, 0

    def fit(self) -> None:
        """Take its share of a window that is new, docked anew or of another size; between, users drag its edge."""
        window = imgui.get_main_viewport().size.y
        fitted = window, theme.points(1.0), theme.times_docked()
        if fitted == self._fitted:
            return
        self._fitted = fitted
        free = window - theme.points(_BELOW)
        high = min(max(free * _SHARE, theme.points(self._least)), free)
        theme.fit_height(free if free - high < theme.points(_LEAST_PICTURE) else high)
