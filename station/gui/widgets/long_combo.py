"""A list to choose one of, whose chosen words end in dots where the box is too narrow for them."""

from collections.abc import Sequence

from imgui_bundle import imgui

from station.gui import theme


def long_combo(label: str, at: int, titles: Sequence[str]) -> int:
    """Draw it as wide as the next item is to be; returns which of the `titles` is chosen now, from 0.

    A title may end in `##` and what tells it from one with the same words.
    """
    width = imgui.calc_item_width() - imgui.get_frame_height() - 2 * imgui.get_style().frame_padding.x
    shown = theme.one_line(titles[at].partition("##")[0], max(width, 1.0))
    chosen = at
    if imgui.begin_combo(label, shown, imgui.ComboFlags_.height_large):
        for number, title in enumerate(titles):
            if imgui.selectable(title, number == at)[0]:
                chosen = number
            if number == at:
                imgui.set_item_default_focus()
        imgui.end_combo()
    return chosen
