"""What the window shows and how: viewpoints, the score's forms, colours, sizes, and whether all can be read."""

from dataclasses import replace

import numpy as np
from imgui_bundle import imgui

from station.app.actions.settings_actions import SetView
from station.app.settings.view_settings import view_settings_of
from station.core.named_view import NamedView
from station.core.settings import load_settings
from station.gui.display import Rectangle
from station.gui.keyboard_kit import VIEW_KEYS
from station.gui.panels.lessons.lesson_list import LIST
from station.gui.panels.player_controls import MORE_LABEL
from station.gui.panels.transport_bar import VIEW_LABEL
from station.gui.panels.view_popup import LEGEND_LABEL
from station.render.camera import VIEW_NAMES
from tests.fakes.stick_physics import FINE_HZ, Sensor, measured
from tests.gui.drive import MOST_FRAMES, Drive, open_popup
from tests.gui.key_chord import chord


def look(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Every viewpoint can be chosen, two from the list and the others by their keys, and the mouse turns it."""
    ctx.set_ref("//Transport")
    keys = {view: key for key, view in VIEW_KEYS.items()}
    for view in NamedView:
        if view in (NamedView.TOP, NamedView.FEET):
            ctx.combo_click(f"##view/{VIEW_NAMES[view]}")
        else:
            ctx.key_press(keys[view])
        ctx.yield_(2)
        drive.seen[view.name] = drive.window.viewport.view_settings.view.name
    mirrored = drive.window.viewport.camera.mirrored
    ctx.item_click("mirror")
    ctx.yield_(2)
    drive.seen["mirrored"] = drive.window.viewport.camera.mirrored is not mirrored
    before = drive.window.viewport.camera.azimuth_rad
    turn(ctx)
    drive.seen["turned"] = drive.window.viewport.camera.azimuth_rad - before
    pixels, start = drive.shot(ctx), ctx.item_info("//Lessons/Start##start").rect_full
    drive.seen["button"] = pixels[round(start.get_center().y), round(start.min.x) + 12].tolist()
    drive.seen["picture"] = float(pixels[100:200, 400:].std())
    drive.seen["cannot be read"] = drive.faults


def turn(ctx: imgui.test_engine.TestContext) -> None:
    """Drag in the picture."""
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    ctx.mouse_drag_with_delta(imgui.ImVec2(60, 0))


def viewpoints(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Views, mirror, second picture and own viewpoints by keys and in the popup; all is kept in the settings."""
    viewport = drive.window.viewport
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    for key, name in ((imgui.Key.f2, "FRONT"), (imgui.Key.f8, "LEFT_HAND"), (imgui.Key.f9, "RIGHT_HAND")):
        ctx.key_press(key)
        ctx.yield_(2)
        drive.seen[name] = viewport.view_settings.view.name
    ctx.key_press(imgui.Key.m)
    ctx.key_press(imgui.Key.p)
    turn(ctx)
    turned = viewport.camera
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_ctrl))
    ctx.yield_(2)
    drive.seen["told"] = drive.state.toast
    ctx.key_press(imgui.Key.f5)
    ctx.yield_(2)
    drive.seen["left"] = viewport.camera != turned
    ctx.set_ref("//Transport")
    open_popup(ctx, "Look##look")
    ctx.item_click("//$FOCUSED/3##go3")
    ctx.yield_(2)
    drive.seen["back"] = viewport.camera == turned
    ctx.item_click("//$FOCUSED/8##keep8")
    ctx.item_click("//$FOCUSED/Feet##Second picture")
    double = [viewport.view_settings.double.name]
    ctx.item_click("//$FOCUSED/Over##Your double")
    ctx.yield_(2)
    double += [viewport.view_settings.double.name, view_settings_of(load_settings(drive.settings)).double.name]
    drive.seen["slots"] = [
        slot for slot, camera in enumerate(viewport.view_settings.viewpoints, 1) if camera is not None
    ]
    kept = view_settings_of(load_settings(drive.settings))
    drive.seen["kept"] = [kept.view.name, kept.mirrored, kept.inset is NamedView.FEET]
    there = kept.viewpoints[2]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    ctx.key_press(imgui.Key.e)
    ctx.yield_(2)
    drive.seen["double"] = [*double, viewport.view_settings.double.name]
    drive.seen["kept_there"] = there is not None and abs(there.azimuth_rad - turned.azimuth_rad) < 1e-5


def score(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The score's four forms by key and in the popup, and the names of the staff's lines."""
    ctx.mouse_move_to_pos(imgui.ImVec2(600, 200))
    forms = []
    for _ in range(4):
        ctx.key_press(imgui.Key.n)
        ctx.yield_(2)
        forms.append(drive.window.viewport.view_settings.score.name)
    drive.seen["by_key"] = forms
    ctx.set_ref("//Transport")
    open_popup(ctx, "Look##look")
    ctx.item_click("//$FOCUSED/Falling##Score")
    ctx.item_uncheck(f"//$FOCUSED/{LEGEND_LABEL}")
    ctx.yield_(2)
    chosen, kept = drive.window.viewport.view_settings, load_settings(drive.settings)
    drive.seen["chosen"] = [chosen.score.name, chosen.legend]
    drive.seen["kept"] = [kept.score, kept.legend]


def worn(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The panels' colours in the popup and their size by keys; both are kept."""
    ctx.set_ref("//Transport")
    open_popup(ctx, "Look##look")
    ctx.item_click("//$FOCUSED/Day##Colours")
    ctx.yield_(2)
    paper = imgui.get_style().color_(imgui.Col_.window_bg)
    drive.seen["light"] = min(paper.x, paper.y, paper.z) > 0.8
    ctx.popup_close_all()
    ctx.key_press(chord(imgui.Key.equal, imgui.Key.mod_ctrl))
    ctx.key_press(chord(imgui.Key.equal, imgui.Key.mod_ctrl))
    ctx.yield_(3)
    behind_buttons(drive, ctx)
    ctx.key_press(chord(imgui.Key.minus, imgui.Key.mod_ctrl))
    ctx.yield_(3)
    drive.seen["letters"] = imgui.get_style().font_scale_main
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.theme, kept.panel_scale]
    drive.seen["panels"] = round(_width_of(ctx, "//Lessons") / imgui.get_io().display_size.x, 2)


def behind_buttons(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Panels so large that the strip has no room for all: views and the player's rest are reached by two buttons."""
    strip = ctx.window_info("//Transport").window
    assert strip is not None
    drive.seen["strip"] = strip.size.y / imgui.get_style().font_scale_main
    ctx.set_ref("//Transport")
    open_popup(ctx, VIEW_LABEL)
    ctx.item_click("//$FOCUSED/mirror")
    ctx.yield_(2)
    drive.seen["mirrored"] = drive.window.viewport.view_settings.mirrored
    ctx.popup_close_all()
    open_popup(ctx, MORE_LABEL)
    ctx.item_input_value("//$FOCUSED/##speed", 70)
    ctx.yield_(2)
    drive.seen["speed"] = drive.state.player.player.speed_percent
    ctx.popup_close_all()


def resized(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The window is made larger and small again while it is open: letters, panels, Start, what is read, the help."""
    assert drive.monitors is not None
    for width, height in ((1280, 720), (760, 480)):
        drive.monitors.move(Rectangle(0, 0, width, height))
        for _ in range(MOST_FRAMES):
            ctx.yield_()
            if imgui.get_io().display_size.x == width:
                break
        ctx.yield_(6)
        size: dict[str, object] = {}
        drive.seen[f"{width}"] = size
        size["letters"] = imgui.get_style().font_scale_main
        size["lessons"] = _width_of(ctx, "//Lessons") / width
        unread = drive.unread(ctx)
        ctx.key_press(imgui.Key.f1)
        ctx.yield_(3)
        ctx.item_click("//Help/##leaves/Keys")
        for scale in (1.0, 2.5, 0.75):
            drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=scale)))
            ctx.yield_(6)
            help_window = ctx.window_info("//Help").window
            assert help_window is not None
            size[f"help {scale:g}"] = _inside(help_window, width, height)
            lessons = ctx.window_info(f"//Lessons/{LIST}").window
            assert lessons is not None
            size[f"list {scale:g}"] = [lessons.rect().max.y - lessons.rect().min.y, lessons.rect().max.y]
            size[f"start {scale:g}"] = ctx.item_info("//Lessons/Start##start").rect_full.min.y
            unread += [line for line in drive.unread(ctx) if line.startswith("Help")]
        size["unread"] = unread
        drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=1.0)))
        ctx.key_press(imgui.Key.f1)
        ctx.yield_(3)


def _inside(window: imgui.internal.Window, width: int, height: int) -> bool:
    """Whether the whole of it is seen."""
    low, high = window.pos, (window.pos.x + window.size.x, window.pos.y + window.size.y)
    return bool(min(low.x, low.y) >= -1 and high[0] <= width + 1 and high[1] <= height + 1)


def _width_of(ctx: imgui.test_engine.TestContext, panel: str) -> float:
    window = ctx.window_info(panel).window
    assert window is not None, panel
    return float(window.size.x)


def legible(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Every tool is opened, at both ends of the usual sizes, and what cannot be read in it is told."""
    docking = drive.window.params.docking_params
    drive.engine.plug_stick("x-IMU3 1")
    drive.engine.move_stick("x-IMU3 1", measured(np.full(FINE_HZ, 0.2), Sensor(100)))
    for scale in (1.0, 2.0):
        drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=scale)))
        for page in drive.window.pages.tools:
            tool = docking.dockable_window_of_name(page.name)
            tool.is_visible = True
            ctx.yield_(5)
            drive.seen[f"{page.name} at {scale:g}"] = drive.unread(ctx)
            tool.is_visible = False
