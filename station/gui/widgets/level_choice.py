"""The list that chooses how strictly a lesson is judged: before it is played, and beside its result."""

from imgui_bundle import imgui

from station.drills.level_range import LevelRange
from station.gui import theme
from station.scoring.matching.hit_windows import Level

LEVEL_LABEL = "##level"


def level_choice(levels: LevelRange, level: Level, since: str = "") -> Level | None:
    """Draw it as wide as the line; `since` says when it holds. Returns the level that was chosen, None for none."""
    width = imgui.get_content_region_avail().x
    room = width - imgui.get_frame_height() - 2 * imgui.get_style().frame_padding.x
    forms = (f"judged as {level.words}", level.words, f"{level}")
    preview = next((form for form in forms if imgui.calc_text_size(form).x <= room), forms[-1])
    imgui.set_next_item_width(width)
    chosen = None
    is_open = imgui.begin_combo(LEVEL_LABEL, preview)
    if not is_open:
        theme.tooltip(
            f"{f'{since} you' if since else 'You'} are judged as {level.words} in this lesson: on time is within"
            f" {level.on_time_ms:g} ms, and a pass is clean at this level's mark; the score stays the same. When you"
            " hold the lesson at it, the next level holds from the next time on"
        )
        return None
    for each in levels.choices:
        if imgui.selectable(f"{each.words}###{each}", each is level)[0]:
            chosen = each
        theme.tooltip(f"On time is within {each.on_time_ms:g} ms")
    imgui.end_combo()
    return None if chosen is level else chosen
