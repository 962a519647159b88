"""The help page that F1 opens: what the keys play and do."""

from itertools import zip_longest

from imgui_bundle import imgui

from station.app import theme
from station.app.keyboard import COMMANDS, KEYS


def keys_help(frame_ms: float) -> None:
    """What the keys play, and how exactly."""
    theme.heading("Keys", 22)
    theme.soft(
        f"Without a kit, play on these keys. They are looked at once a frame, now every {frame_ms:.0f} ms,"
        " so their timing is that coarse: a kit is measured far better."
    )
    strokes = [(stroke.cap, stroke.words) for stroke in KEYS.values()]
    if imgui.begin_table("##keys", 4, imgui.TableFlags_.sizing_fixed_fit):
        for played, done in zip_longest(strokes, COMMANDS, fillvalue=("", "")):
            imgui.table_next_row()
            for cap, words in (played, done):
                imgui.table_next_column()
                imgui.text(cap)
                imgui.table_next_column()
                imgui.text_disabled(words)
        imgui.end_table()
