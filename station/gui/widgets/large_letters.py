"""Letters of any size, drawn where they are wanted: what is read from the throne grows with the picture.

Sizes and places are the screen's pixels, widths too.
"""

from imgui_bundle import imgui

MOST_LINES = 2
"""Of a label (our choice)."""


def width_of(text: str, size: float) -> float:
    """How wide the text is."""
    imgui.push_font(None, size / grown())
    width = float(imgui.calc_text_size(text).x)
    imgui.pop_font()
    return width


def grown() -> float:
    """By how much imgui grows the sizes that fonts are asked for in."""
    style = imgui.get_style()
    return float(style.font_scale_main * style.font_scale_dpi)


def draw_text(text: str, at: imgui.ImVec2, size: float, colour: int) -> None:
    """Write it on the present window, its upper left corner at `at`."""
    imgui.get_window_draw_list().add_text(imgui.get_font(), size, at, colour, text)


def cut(text: str, width: float, size: float) -> str:
    """As much of the text as `width` holds, with dots where it goes on."""
    while text and width_of(text, size) > width:
        text = text[:-2].rstrip() + "…" if len(text) > 2 else ""
    return text


def broken(text: str, width: float, size: float) -> list[str]:
    """The text in lines no wider than `width`."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and width_of(longer, size) <= width:
            lines[-1] = longer
        else:
            lines.append(cut(word, width, size))
    return lines


def fitted(text: str, width: float, large: float, height: float) -> tuple[list[str], float]:
    """The label in at most two lines and the largest letters in which it fits, cut where it never does."""
    size, least = large, 0.6 * large
    while True:
        lines = broken(text, width, size)
        if len(lines) <= MOST_LINES and 1.12 * size * len(lines) <= height:
            return lines, size
        if size <= least:
            return [*lines[: MOST_LINES - 1], cut(" ".join(lines[MOST_LINES - 1 :]), width, size)], size
        size = max(0.9 * size, least)
