"""What is watched and heard: the demonstration, its graph, the phase of a motion."""

from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.practice_actions import EndSession
from station.engine.messages import Play
from station.gui.panels.phase_panel import MODEL_LABEL, MOTION_LABEL, OPEN_LABEL, PHASE, PLAY_LABEL, STOP_LABEL
from station.gui.panels.player_controls import COUNT_IN_LABEL
from tests.fakes.walker_files import write_walker
from tests.gui.drive import MOST_FRAMES, Drive, open_popup
from tests.gui.key_chord import chord


def player(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The demonstration is watched, stepped through, reversed, slowed down and looped; Start practises the loop."""
    deck, engine, seen = drive.station.parts.sessions.player, drive.engine, drive.seen

    def at_ms() -> int:
        return round(deck.player.position_ns(deck.now_ns) / 1e6)

    ctx.set_ref("//Transport")
    ctx.item_click("###play")
    ctx.yield_(6)
    seen["plays"], seen["moves"] = deck.player.playing, at_ms() > 300
    ctx.key_press(imgui.Key.w)
    ctx.yield_(2)
    seen["stands"] = not deck.player.playing
    stepped = []
    for button in ("###start", "###step", "###step", "###back", "###end"):
        ctx.item_click(button)
        ctx.yield_(1)
        stepped.append(at_ms())
    seen["stepped"] = stepped
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_ctrl, imgui.Key.mod_shift))
    ctx.item_click("###reverse")
    ctx.key_press(imgui.Key.w)
    ctx.yield_(4)
    seen["back"] = at_ms() < stepped[-1]
    ctx.key_press(imgui.Key.r)
    ctx.key_press(imgui.Key.w)
    ctx.item_input_value("##speed", 50)
    ctx.yield_(1)
    ctx.key_press(chord(imgui.Key._3, imgui.Key.mod_shift))
    ctx.yield_(1)
    seen["flag"], seen["speed"] = at_ms(), deck.player.speed_percent
    low, high = ctx.item_info("##ruler").rect_full.min, ctx.item_info("##ruler").rect_full.max
    y, width = (low.y + high.y) / 2, high.x - low.x
    ctx.mouse_move_to_pos(imgui.ImVec2(low.x + 0.6 * width, y))
    ctx.mouse_drag_with_delta(imgui.ImVec2(0.3 * width, 0))
    ctx.yield_(3)
    seen["loop"] = deck.player.loop
    request = drive.state.selection.request()
    seen["bars"] = None if request is None else request.bars
    ctx.mouse_move_to_pos(imgui.ImVec2(low.x + 0.75 * width, y))
    ctx.mouse_click(0)
    ctx.yield_(2)
    seen["sought"] = at_ms()
    plays = [command for command in engine.sent if isinstance(command, Play)]
    seen["cues"] = len(plays[0].cues)
    ctx.item_click(COUNT_IN_LABEL)
    ctx.key_press(imgui.Key.w)
    ctx.mouse_move_to_pos(imgui.ImVec2(900, 30))
    ctx.yield_(4)
    seen["counts"] = [deck.counts_in, deck.snapshot().hud.phase]
    ctx.key_press(imgui.Key.q)
    ctx.yield_(4)
    seen["counts no more"] = deck.counts_in


def graph(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The graph is opened, follows the play line, is zoomed by wheel, its line dragged; a result shows there."""
    panel, deck, seen = drive.window.pages.graph, drive.station.parts.sessions.player, drive.seen
    ctx.set_ref("//Transport")
    open_popup(ctx, "Panels##panels")
    ctx.item_click("//$FOCUSED/Graph")
    ctx.popup_close_all()
    ctx.yield_(3)
    ctx.item_click("###start")
    low, high = panel.span_s
    ctx.item_click("###step")
    ctx.yield_(2)
    seen["beat"] = deck.player.at_ns % 1_500_000_000
    seen["middle"] = sum(panel.span_s) / 2 - deck.player.at_ns / 1e9
    place = imgui.internal.find_window_by_name("Graph").inner_rect
    middle = (place.min.x + place.max.x) / 2
    ctx.mouse_move_to_pos(imgui.ImVec2(middle, (place.min.y + place.max.y) / 2))
    ctx.mouse_wheel_y(3.0)
    ctx.yield_(2)
    seen["zoomed"] = (panel.span_s[1] - panel.span_s[0]) / (high - low)
    before = deck.player.at_ns
    ctx.mouse_move_to_pos(imgui.ImVec2(panel.line_x, (place.min.y + place.max.y) / 2))
    ctx.mouse_drag_with_delta(imgui.ImVec2(60, 0))
    ctx.yield_(2)
    width = ctx.item_info("//Graph/##angles").rect_full.get_width()
    seen["dragged"] = (deck.player.at_ns - before) / 1e9 / (panel.span_s[1] - panel.span_s[0]) * width
    drive.choose(ctx, passes=1)
    ctx.item_click("Start##start")
    ctx.yield_(4)
    seen["during"] = drive.room.stage.name
    drive.station.dispatch(EndSession())
    ctx.yield_(4)
    curves = drive.state.curves
    seen["result"] = curves is not None and curves.played is not None


def phase(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A motion is opened in the phase panel, heard, and its line dragged."""
    motion = write_walker(Path())  # a short name, for the fields show no more
    drive.window.params.docking_params.dockable_window_of_name(PHASE).is_visible = True
    ctx.yield_(3)
    ctx.set_ref(f"//{PHASE}")
    for label in (MOTION_LABEL, MODEL_LABEL):
        ctx.item_input_value(label, str(motion))
    ctx.item_click(OPEN_LABEL)
    for _ in range(MOST_FRAMES):
        if drive.state.phase.scene is not None:
            break
        ctx.yield_()
    drive.seen["opened"] = drive.state.phase.motion
    ctx.yield_(2)
    ctx.item_click(PLAY_LABEL)
    ctx.yield_(20)
    drive.seen["plays"], drive.seen["at_s"] = drive.state.phase.plays, drive.state.phase.at_s
    drive.seen["unread"] = drive.unread(ctx)
    ctx.item_click(STOP_LABEL)
    ctx.yield_(2)
    drive.seen["stopped"] = not drive.state.phase.plays
