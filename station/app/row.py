"""Controls side by side that go on in the next line where the panel ends, so that none is ever cut off."""

from imgui_bundle import imgui


class Row:
    """One line of controls; ask `place` before each, with the width that it takes."""

    def __init__(self) -> None:
        self._right = imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x
        self._is_empty = True

    def place(self, width: float) -> None:
        """Put the next control of `width` pixels beside the last one, or under it where there is no room."""
        if not self._is_empty:
            end = imgui.get_item_rect_max().x + imgui.get_style().item_spacing.x
            if end + width <= self._right + 1:
                imgui.same_line()
        self._is_empty = False

    @property
    def left_px(self) -> float:
        """What is left of the line beside the last control."""
        return float(self._right - imgui.get_item_rect_max().x - imgui.get_style().item_spacing.x)
