"""The bar below the picture: stop or go on, progress, where the user looks from, which panels are open."""

from collections.abc import Callable
from dataclasses import replace

from imgui_bundle import imgui

from station.app import theme
from station.app.look import Look
from station.app.model import RoomState, Stage
from station.app.panels.look_popup import LOOK_LABEL, POPUP, LookActions, look_popup
from station.practice.own_ear import Guess
from station.render.camera import VIEW_NAMES, View

VETO_LABEL = "As it was##veto"
STOP_LABEL = "Stop##stop"
AGAIN_LABEL = "Once more##again"
BACK_LABEL = "Back to the lessons##back"

_RIGHT_PART = 530
"""Design pixels that the viewpoint's controls take."""


def found(room: RoomState) -> str:
    """The kit and the sound card in words; without a kit, what plays instead."""
    return " · ".join(part for part in (room.kit or "no kit: the computer's keys play (F1)", room.sound) if part)


def transport_bar(
    room: RoomState,
    look: Look,
    actions: "dict[str, Callable[[], None]]",
    viewpoints: LookActions,
    tools: Callable[[], None],
) -> Look:
    """Stop or go on, progress, the `tools` to open, the viewpoint; returns the look that was chosen."""
    height = theme.points(38)
    if room.stage is Stage.PLAYING:
        if imgui.button(STOP_LABEL, imgui.ImVec2(theme.points(96), height)):
            actions["stop"]()
        theme.tooltip("End the session here; what was played is kept (Esc)")
        if room.can_veto:
            imgui.same_line()
            if imgui.button(VETO_LABEL, imgui.ImVec2(theme.points(110), height)):
                actions["veto"]()
            theme.tooltip(f"{room.why} Press to play the last pass once more instead")
    elif room.question:
        _asked(room.question, actions)
    elif room.stage is Stage.RESULT:
        if theme.main_button(AGAIN_LABEL, (theme.points(150), height)):
            actions["again"]()
        theme.tooltip("The same lesson, the same tempo (Enter)")
        imgui.same_line()
        if imgui.button(BACK_LABEL, imgui.ImVec2(theme.points(190), height)):
            actions["back"]()
        theme.tooltip("Choose another lesson (Esc)")
    if room.stage is not Stage.IDLE:
        imgui.same_line()
    if room.progress is not None:
        room_left = imgui.get_content_region_avail().x - theme.points(_RIGHT_PART)
        imgui.progress_bar(room.progress, imgui.ImVec2(max(room_left, 1.0), height), "")
        theme.tooltip("How much of the session is over")
        imgui.same_line()
    elif room.stage is Stage.IDLE:
        imgui.align_text_to_frame_padding()
        imgui.text_disabled(found(room))
        theme.tooltip("The kit and the sound card that were found")
        imgui.same_line()
    imgui.set_cursor_pos_x(imgui.get_window_width() - theme.points(_RIGHT_PART))
    tools()
    return _view_part(look, viewpoints)


def _view_part(look: Look, actions: LookActions) -> Look:
    _, mirrored = imgui.checkbox("mirror", look.mirrored)
    theme.tooltip("Left and right swapped, to learn face to face as from a mirror (M)")
    imgui.same_line()
    if imgui.button(LOOK_LABEL, imgui.ImVec2(theme.points(70), 0)):
        imgui.open_popup(POPUP)
    theme.tooltip("A second picture, pages or a highway for the score, viewpoints of your own")
    chosen = look_popup(look, actions)
    imgui.same_line()
    imgui.set_next_item_width(-1)
    changed, index = imgui.combo("##view", int(look.view), list(VIEW_NAMES.values()))
    theme.tooltip(
        "Where you look from (F2 to F9); drag in the picture to turn, right drag to shift, wheel to come nearer"
    )
    return replace(chosen, view=View(index) if changed else look.view, mirrored=bool(mirrored))


def _asked(question: str, actions: "dict[str, Callable[[], None]]") -> None:
    """A button for each answer, and the question."""
    for guess in Guess:
        if imgui.button(guess.value, imgui.ImVec2(theme.points(96), theme.points(38))):
            actions[guess.value]()
        theme.tooltip(question)
        imgui.same_line()
    imgui.align_text_to_frame_padding()
    imgui.text(question)
