"""What the Look button opens: the second picture, the score's form, the user's viewpoints, colours and size."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from imgui_bundle import imgui

from station.app import theme
from station.app.look import INSETS, Look
from station.app.panels.slots import Use, popup_grid, slot_rows
from station.render.camera import VIEW_NAMES
from station.render.painter import DoublePlace
from station.render.palette import THEME_NAMES, Theme
from station.render.score_view import ScoreForm

LOOK_LABEL = "Look##look"
POPUP = "##look-popup"
_NO_INSET = "None"
_FORMS = {
    ScoreForm.SCROLLING: ("Scrolling", "The notes pass a line that stands still"),
    ScoreForm.PAGED: ("Pages", "The line crosses bars that stand still"),
    ScoreForm.HIGHWAY: ("Highway", "A lane for every piece, for those who do not read music"),
}
_DOUBLES = {
    DoublePlace.NOWHERE: ("None", "The demonstrator alone"),
    DoublePlace.OVER: ("Over", "You, translucent, over the demonstrator: a limb glows where it parts from his"),
    DoublePlace.BESIDE: ("Beside", "You on a kit of your own beside the demonstrator's, both seen from the same place"),
}
_THEMES_TOLD = {
    Theme.NIGHT: "Light on dark, for a dim room",
    Theme.DAY: "Dark on light, for a bright room",
    Theme.CONTRAST: "White on black, and the strongest colours",
    Theme.APART: "Judgements in colours that everybody tells apart; each has a shape of its own besides",
}


@dataclass(frozen=True, slots=True)
class LookActions:
    """What the user does with viewpoints: `keep` the present one as a slot (from 0), `go` to a slot's."""

    keep: Callable[[int], None]
    go: Callable[[int], None]


def look_popup(look: Look, actions: LookActions) -> Look:
    """Draw the popup where it is open; returns the look that was chosen."""
    if not imgui.begin_popup(POPUP):
        return look
    theme.heading("Look", 20)
    theme.soft("Second picture")
    for view in INSETS:
        name = _NO_INSET if view is None else VIEW_NAMES[view]
        if imgui.radio_button(f"{name}##inset", look.inset is view):
            look = replace(look, inset=view)
        theme.tooltip("Hands or feet in a corner of the picture, whatever the picture itself shows (P)")
        imgui.same_line()
    imgui.new_line()
    theme.soft("Score")
    for form, (name, words) in _FORMS.items():
        if imgui.radio_button(f"{name}##score", look.score is form):
            look = replace(look, score=form)
        theme.tooltip(f"{words} (N)")
        imgui.same_line()
    imgui.new_line()
    theme.soft("Your double")
    for place, (name, words) in _DOUBLES.items():
        if imgui.radio_button(f"{name}##double", look.double is place):
            look = replace(look, double=place)
        theme.tooltip(f"{words} (E)")
        imgui.same_line()
    imgui.new_line()
    theme.soft("Your own viewpoints")
    _slots(look, actions)
    look = _worn(look)
    imgui.end_popup()
    return look


def _worn(look: Look) -> Look:
    """The colours and the size of the panels."""
    theme.soft("Colours")
    for worn, name in THEME_NAMES.items():
        if imgui.radio_button(f"{name}##theme", look.theme is worn):
            look = replace(look, theme=worn)
        theme.tooltip(_THEMES_TOLD[worn])
        imgui.same_line()
    imgui.new_line()
    theme.soft("Size of the panels")
    for label, steps, told in (("Smaller##scale", -1, "Ctrl+−"), ("Larger##scale", 1, "Ctrl+=")):
        imgui.begin_disabled(look.scaled(steps) == look)
        if imgui.button(label, imgui.ImVec2(theme.points(96), 0)):
            look = look.scaled(steps)
        imgui.end_disabled()
        theme.tooltip(f"Letters, buttons and lists ({told}); the picture keeps its size")
        imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(f"{look.scale:.0%}")
    return look


def _slots(look: Look, actions: LookActions) -> None:
    cameras = look.viewpoints

    def told(slot: int) -> str:
        is_there = cameras[slot] is not None
        return f"Viewpoint {slot + 1} ({slot + 1})" if is_there else f"Viewpoint {slot + 1} is not kept yet"

    def told_of_keeping(slot: int) -> str:
        return f"Keeps where you look from now as viewpoint {slot + 1} (Ctrl+{slot + 1})"

    uses = (
        Use("Go to", "go", actions.go, told, needs_filled=True),
        Use("Keep as", "keep", actions.keep, told_of_keeping),
    )
    slot_rows(uses, [camera is not None for camera in cameras], popup_grid(len(cameras)))
