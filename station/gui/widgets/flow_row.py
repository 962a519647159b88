"""Controls side by side that go on in the next line where the panel ends, so that none is ever cut off."""

from imgui_bundle import imgui

from station.gui import theme

LINE_HEIGHT = 38.0
"""Design pixels of the strip's buttons and ruler (our choice: hit from a drummer's seat)."""


class FlowRow:
    """One line of controls; ask `place` before each, with the width that it takes."""

    def __init__(self, width: float | None = None, height: float = 0.0) -> None:
        """From here to `width` pixels to the right, None for all that the panel has.

        Buttons are `height` design pixels high, 0 for as high as fields and ticks.
        """
        room = imgui.get_content_region_avail().x if width is None else width
        self._right = imgui.get_cursor_screen_pos().x + room
        self._is_empty = True
        self._height = height

    def fits(self, width: float) -> bool:
        """Whether a control of `width` pixels has room beside the last one."""
        return self._is_empty or width <= self.left_px + 1

    def place(self, width: float) -> None:
        """Put the next control of `width` pixels beside the last one, or under it where there is no room."""
        if not self._is_empty and self.fits(width):
            imgui.same_line()
        self._is_empty = False

    def button(self, label: str, width: float) -> bool:
        """A button of `width` design pixels in the row; returns whether it was pressed."""
        size = imgui.ImVec2(theme.points(width), theme.points(self._height))
        self.place(size.x)
        return bool(imgui.button(label, size))

    @property
    def left_px(self) -> float:
        """What is left of the line, beside the last control if there is one."""
        if self._is_empty:
            return float(self._right - imgui.get_cursor_screen_pos().x)
        return float(self._right - imgui.get_item_rect_max().x - imgui.get_style().item_spacing.x)
