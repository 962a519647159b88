"""What the lessons panel knows of courses: the list that chooses one, and the mark of progress beside a lesson."""

import math
from datetime import date

from imgui_bundle import icons_fontawesome_4 as icons
from imgui_bundle import imgui

from station.app.selection import Selection
from station.drills.course import Course
from station.gui import theme
from station.practice.records.lesson_progress import LessonProgress
from station.render import palette
from station.render.text.draw_list import Colour

ALL_LESSONS = "All lessons"
_RADIUS, _LINE = 7.0, 2.0
"""Design pixels of the mark."""


def course_picker(selection: Selection, width: float) -> Selection:
    """Draw the list of courses, `width` pixels wide, with how much of each is finished; returns what is chosen."""
    chosen, picked = selection.course, selection
    imgui.set_next_item_width(width)
    room = width - imgui.get_frame_height() - 2 * imgui.get_style().frame_padding.x
    preview = course_words(selection, chosen)
    if chosen is not None and imgui.calc_text_size(preview).x > room:
        preview = theme.one_line(chosen.title, room)
    if imgui.begin_combo("##course", preview, imgui.ComboFlags_.height_large):
        for course in (None, *selection.courses):
            label = f"{course_words(selection, course)}###course-{'' if course is None else course.name}"
            if imgui.selectable(label, course is chosen)[0]:
                picked = selection.follow(course)
            if course is not None:
                theme.tooltip(course_facts(selection, course))
        imgui.end_combo()
    about = "A course has lessons in the order in which a teacher gives them"
    theme.tooltip(course_facts(selection, chosen) if chosen else about)
    return picked


def course_words(selection: Selection, course: Course | None) -> str:
    """A course in a line, with how much of it is finished."""
    if course is None:
        return ALL_LESSONS
    return f"{course.title}: {selection.finished(course)} of {len(course.lessons)}"


def course_facts(selection: Selection, course: Course) -> str:
    """What it is about, what makes its lessons count, and the courses that should come first."""
    known = {each.name: each for each in selection.courses}
    first = [f"First: {course_words(selection, known[name])}" for name in course.prerequisites if name in known]
    held = f"A lesson is finished when you hold it at {course.mastery or 'any level'}"
    return "\n".join([course.about, *first, held])


def mark(progress: LessonProgress | None, today: date) -> None:
    """Beside the line that was drawn last: a ring that fills, a disc with a tick, a clock turned back when due."""
    if progress is None:
        return
    radius = theme.points(_RADIUS)
    low, high = imgui.get_item_rect_min(), imgui.get_item_rect_max()
    middle = imgui.ImVec2(high.x - radius - theme.points(8), (low.y + high.y) / 2)
    brush = imgui.get_window_draw_list()
    if progress.is_due(today):
        _icon(brush, middle, icons.ICON_FA_HISTORY, palette.BRAND)
    elif progress.is_mastered:
        _icon(brush, middle, icons.ICON_FA_CHECK_CIRCLE, palette.GOOD)
    else:  # no icon fills by degrees
        brush.add_circle(middle, radius, _ink(palette.INK_FAINT), 0, theme.points(_LINE))
        brush.path_arc_to(middle, radius, -math.pi / 2, (progress.shown_pct / 50.0 - 0.5) * math.pi)
        brush.path_stroke(_ink(palette.GOOD), theme.points(_LINE))


def mark_width() -> float:
    """Pixels that a mark takes at the right end of a line."""
    return theme.points(2 * _RADIUS + 8)


def _icon(brush: imgui.ImDrawList, middle: imgui.ImVec2, icon: str, colour: Colour) -> None:
    size = imgui.calc_text_size(icon)
    brush.add_text(imgui.ImVec2(middle.x - size.x / 2, middle.y - size.y / 2), _ink(colour), icon)


def _ink(colour: Colour) -> int:
    return int(imgui.get_color_u32(imgui.ImVec4(*theme.themed(colour))))
