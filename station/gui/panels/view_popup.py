"""What the Look button opens: the second picture, the score's form, the user's viewpoints, colours and size."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TypeVar

from imgui_bundle import imgui

from station.app.settings.view_settings import INSETS, ViewSettings
from station.gui import theme
from station.gui.widgets.slots import Use, popup_grid, slot_rows
from station.render.camera import VIEW_NAMES
from station.render.gpu.moving_parts import DoublePlace
from station.render.notation.screen.score_place import ScoreForm
from station.render.palette import THEME_NAMES, Theme

T = TypeVar("T")

_HIGH, _TITLE_WIDTH = 600, 150
"""Design pixels that the popup is high, and that its titles take beside its rows."""
LOOK_LABEL = "Look##look"
LEGEND_LABEL = "Name the lines of the staff##legend"
POPUP = "##look-popup"
_INSET_TIP = "Hands or feet in a corner of the picture, whatever the picture itself shows (P)"
_INSETS = {view: ("None" if view is None else VIEW_NAMES[view], _INSET_TIP) for view in INSETS}
_FORMS = {
    ScoreForm.PAGED: ("Pages", "The line crosses bars that stand still, and what comes next stands beside them (N)"),
    ScoreForm.SCROLLING: ("Scrolling", "The notes pass a line that stands still (N)"),
    ScoreForm.HIGHWAY: ("Highway", "A lane for every piece, for those who do not read music (N)"),
    ScoreForm.FALLING: ("Falling", "The highway upright: notes fall, beside the picture (N)"),
}
_DOUBLES = {
    DoublePlace.NOWHERE: ("None", "The demonstrator alone (E)"),
    DoublePlace.OVER: ("Over", "You, translucent, over the demonstrator: a limb glows where the two part (E)"),
    DoublePlace.BESIDE: (
        "Beside",
        "You on a kit of your own beside the demonstrator's, seen from the same place (E)",
    ),
}
_AUTOMATIC_TIP = "The finest that this computer holds at 60 pictures a second"
_QUALITIES: dict[int | None, tuple[str, str]] = {
    0: ("Swift", "Round rims; light falls corner by corner on what moves: for computers without a graphics card"),
    1: ("Fine", "Light and soft shadows on every pixel"),
    2: ("Finest", "The softest shadows, and the finest figure and grooves"),
}
_THEMES = {
    Theme.NIGHT: (THEME_NAMES[Theme.NIGHT], "Light on dark, for a dim room"),
    Theme.DAY: (THEME_NAMES[Theme.DAY], "Dark on light, for a bright room"),
    Theme.CONTRAST: (THEME_NAMES[Theme.CONTRAST], "White on black, and the strongest colours"),
    Theme.APART: (
        THEME_NAMES[Theme.APART],
        "Judgements in colours that everybody tells apart; each has a shape of its own besides",
    ),
}


@dataclass(frozen=True, slots=True)
class ViewActions:
    """What the user does with viewpoints: `keep` the present one as a slot (from 0), `go` to a slot's.

    `quality` says at which level the picture is drawn now.
    """

    keep: Callable[[int], None]
    go: Callable[[int], None]
    quality: Callable[[], int] = lambda: 0


def view_settings_popup(view_settings: ViewSettings, actions: ViewActions) -> ViewSettings:
    """Draw the popup where it is open; returns the look that was chosen."""
    if not imgui.begin_popup(POPUP):
        return view_settings
    if not _is_low():
        theme.heading("Look", 20)
    view_settings = replace(view_settings, inset=_one_of("Second picture", _INSETS, view_settings.inset))
    view_settings = replace(view_settings, score=_one_of("Score", _FORMS, view_settings.score))
    _, legend = imgui.checkbox(LEGEND_LABEL, view_settings.legend)
    theme.tooltip("Left of the clef: which line and head is which piece, for the pieces of this lesson")
    view_settings = replace(view_settings, legend=legend)
    view_settings = replace(view_settings, double=_one_of("Your double", _DOUBLES, view_settings.double))
    if not _is_low():
        theme.soft("Your own viewpoints")
    _slots(view_settings, actions)
    view_settings = _colours_and_size(view_settings)
    automatic = f"Automatic: {_QUALITIES[actions.quality()][0].lower()}", _AUTOMATIC_TIP
    qualities = {None: automatic, **_QUALITIES}
    view_settings = replace(view_settings, quality=_one_of("Quality", qualities, view_settings.quality))
    imgui.end_popup()
    return view_settings


def _colours_and_size(view_settings: ViewSettings) -> ViewSettings:
    """The colours and the size of the panels."""
    view_settings = replace(view_settings, theme=_one_of("Colours", _THEMES, view_settings.theme))
    _title("Size of the panels")
    for label, steps, tip in (("Smaller##scale", -1, "Ctrl+−"), ("Larger##scale", 1, "Ctrl+=")):
        imgui.begin_disabled(view_settings.scaled(steps) == view_settings)
        if imgui.button(label, imgui.ImVec2(theme.points(96), 0)):
            view_settings = view_settings.scaled(steps)
        imgui.end_disabled()
        theme.tooltip(f"Letters, buttons and lists ({tip}); they also grow with the window")
        imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(f"{view_settings.scale:.0%}")
    return view_settings


def _one_of(title: str, choices: Mapping[T, tuple[str, str]], chosen: T) -> T:
    """A row of buttons, one for each choice (its name, and what the tooltip says); returns the one that is chosen."""
    _title(title)
    for choice, (name, words) in choices.items():
        if imgui.radio_button(f"{name}##{title}", choice is chosen):
            chosen = choice
        theme.tooltip(words)
        imgui.same_line()
    imgui.new_line()
    return chosen


def _is_low() -> bool:
    """Whether the screen has no room for a line above each row."""
    return bool(imgui.get_io().display_size.y < theme.points(_HIGH))


def _title(words: str) -> None:
    """What a row is about: above it, or before it where there is little room."""
    if not _is_low():
        theme.soft(words)
        return
    imgui.align_text_to_frame_padding()
    theme.soft(words)
    imgui.same_line(theme.points(_TITLE_WIDTH))


def _slots(view_settings: ViewSettings, actions: ViewActions) -> None:
    cameras = view_settings.viewpoints

    def tip(slot: int) -> str:
        is_there = cameras[slot] is not None
        return f"Viewpoint {slot + 1} ({slot + 1})" if is_there else f"Viewpoint {slot + 1} is not kept yet"

    def keep_tip(slot: int) -> str:
        return f"Keeps where you look from now as viewpoint {slot + 1} (Ctrl+{slot + 1})"

    uses = (
        Use("Go to", "go", actions.go, tip, needs_filled=True),
        Use("Keep as", "keep", actions.keep, keep_tip),
    )
    slot_rows(uses, [camera is not None for camera in cameras], popup_grid(len(cameras)))
