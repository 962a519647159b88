"""The figure panel as a user has it: values typed, a style chosen, slots, a lane drawn, another hand that leads."""

from imgui_bundle import imgui

from station.core.settings import load_settings
from station.motion.style.style import JOINTS
from station.motion.style.style_file import load_style
from tests.gui.drive import Drive, open_popup


def figure(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Everything in one window; what was set last is what the settings keep."""
    seen = drive.seen
    ctx.set_ref("//Transport")
    open_popup(ctx, "Panels##panels")
    ctx.item_click("//$FOCUSED/Figure")
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    ctx.set_ref("//Figure")
    ctx.item_input_value("##figure/Arms/##amplitude_gain", 90.0)
    ctx.yield_(2)
    seen["gain"] = drive.state.style.options.value("amplitude_gain")
    seen["moves so"] = drive.station.parts.sessions.player.drummer.style.amplitude_gain
    ctx.item_click("1##keep1")
    open_popup(ctx, "##style")
    ctx.item_click("//$FOCUSED/jazz##jazz")
    ctx.yield_(2)
    seen["chosen"] = [drive.state.style.options.style.name, drive.state.style.options.is_changed]
    seen["kept"] = load_settings(drive.settings).style
    ctx.item_click("1##take1")
    ctx.yield_(2)
    seen["slot"] = drive.state.style.options.value("amplitude_gain")
    ctx.item_click("##figure/Arms/~##bars-amplitude_gain")
    ctx.yield_(3)
    ctx.mouse_move("##figure/Bars/##lane")
    ctx.yield_(3)
    draw(drive, ctx)
    seen["drawn"] = drive.state.style.options.lane("amplitude_gain")
    ctx.mouse_move_to_pos(in_lane(drive, 0.375, 0.5))
    ctx.mouse_down(0)
    ctx.mouse_move_to_pos(in_lane(drive, 0.375, 0.9))
    ctx.mouse_up(0)
    ctx.yield_(2)
    seen["dragged"] = drive.state.style.options.lane("amplitude_gain")
    ctx.mouse_move_to_pos(in_lane(drive, 0.5, 0.75))
    ctx.mouse_click(1)
    ctx.yield_(2)
    seen["lane"] = drive.state.style.options.lane("amplitude_gain")
    own_styles(drive, ctx)
    ctx.item_click("##figure/Hands")
    ctx.yield_(2)
    ctx.item_click("##figure/Hands/Left-handed##lead")
    ctx.yield_(2)
    ctx.yield_(drive.picture_every)  # the other kit is drawn meanwhile
    kept = load_settings(drive.settings)
    seen["hands"] = [kept.hands, drive.picture.kit.left_handed]
    seen["kept lane"] = load_style(kept.style).automation["amplitude_gain"]


def own_styles(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A style is saved by name, left for others and taken again from the list."""
    seen = drive.seen
    ctx.item_input_value("##style-name", "My own")
    ctx.item_click("Save##save-style")
    ctx.yield_(2)
    seen["saved"] = [
        load_settings(drive.settings).style,
        drive.state.style.options.style.name,
        drive.state.style.options.is_changed,
    ]
    ctx.item_click("##figure/Arms")
    ctx.item_check("##figure/Arms/each joint on its own")
    ctx.item_input_value("##figure/Arms/##amplitude_wrist", 80.0)
    ctx.yield_(2)
    seen["unconstrained"] = [drive.state.style.options.value(f"amplitude_{joint}") for joint in JOINTS]
    ctx.item_uncheck("##figure/Arms/each joint on its own")
    ctx.yield_(2)
    seen["shared"] = [round(drive.state.style.options.value(f"amplitude_{joint}"), 3) for joint in JOINTS]
    ctx.item_click("Reset##all")
    ctx.yield_(2)
    seen["reset"] = drive.state.style.options.is_changed
    ctx.item_click("From the score##propose")
    ctx.yield_(2)
    seen["proposed"] = drive.state.style.options.style.name
    open_popup(ctx, "##style")
    ctx.item_click(f"//$FOCUSED/your own: My own##{seen_path(drive)}")
    ctx.yield_(2)
    seen["again"] = drive.state.style.options.style.name


def seen_path(drive: Drive) -> str:
    """The file of the style that was saved, as imgui's paths write it."""
    saved = drive.seen["saved"]
    assert isinstance(saved, list)
    return str(saved[0]).replace("/", "\\/")


def draw(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Draw in the lane's picture, from a quarter of its bars up to the middle."""
    ctx.mouse_move_to_pos(in_lane(drive, 0.25, 0.25))
    ctx.mouse_down(0)
    ctx.mouse_move_to_pos(in_lane(drive, 0.5, 0.75))
    ctx.mouse_up(0)
    ctx.yield_(2)


def in_lane(drive: Drive, across: float, up: float) -> imgui.ImVec2:
    """A place in the lane's picture, as shares of its bars and of its values."""
    (left, low), (right, high) = drive.window.pages.figure.lanes.ends.tolist()
    return imgui.ImVec2(left + across * (right - left), low + up * (high - low))
