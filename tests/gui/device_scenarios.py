"""Kits and sticks: pads learnt, sensors put in a hand, latency measured, gestures learnt from the kit."""

from imgui_bundle import imgui

from station.core.measured_latency import load_calibration
from station.core.pieces import Piece
from station.core.settings import load_settings
from station.devices.mapping.device_file import own_kit
from station.devices.mapping.stick_file import own_stick
from station.engine.messages import WatchRawBytes, WatchSensors
from station.gui.panels.devices.calibration_part import ANYWAY_LABEL, MEASURE_LABEL
from station.gui.panels.devices.devices_panel import DEVICES
from station.gui.panels.devices.pads_part import LEARN_LABEL as LEARN_PAD_LABEL
from station.gui.panels.devices.pads_part import UNDO_LABEL
from station.gui.panels.devices.sticks_panel import (
    FOLLOW_LABEL,
    GESTURE_LABEL,
    LOOK_LABEL,
    PORTS_LABEL,
    SOUND_LABEL,
    STICKS,
)
from station.gui.panels.devices.velocity_part import LEARN_LABEL as TOUCH_LABEL
from station.gui.panels.export_panel import EXPORT, SHEET_LABEL, music_label
from station.gui.panels.practice_panel import LEARN_LABEL, PRACTICE
from station.music.formats.smf.midi_part import MIDI
from tests.fakes.stick_physics import Sensor, Stroke, measured, strokes_by_angle
from tests.gui.drive import MOST_FRAMES, Drive, open_panel, open_popup
from tests.gui.room import KIT


def devices(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The devices page: live lines, a threshold and a rule set by looking, kept and taken by the engine."""
    open_panel(ctx, DEVICES)
    desk = drive.station.parts.mapping
    for text in ("99 26 50", "99 24 64", "99 26 0a", "99 2e 40"):
        drive.engine.play_bytes(text)
        ctx.yield_(2)
    drive.seen["pads"] = [piece.name for piece in desk.pads]
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_input_value("**/##threshold-snare", 30)
    ctx.yield_(2)
    drive.engine.play_bytes("99 26 0a")
    ctx.yield_(3)
    drive.seen["raw"] = desk.seen.lines[-1].raw
    drive.seen["held back"] = [stroke.why is not None for stroke in desk.seen.strokes[Piece.SNARE]]
    ctx.item_click("Save##save-kit")
    ctx.yield_(2)
    kept = own_kit(KIT)
    drive.seen["kept"] = None if kept is None else kept.pad(Piece.SNARE).threshold
    drive.seen["taken"] = [type(command).__name__ for command in drive.engine.sent]
    drive.seen["told"] = drive.state.toast
    pads_are_learnt(drive, ctx)
    open_panel(ctx, DEVICES)  # and close it again
    ctx.yield_(2)
    drive.seen["still listens"] = [command.on for command in drive.engine.sent if isinstance(command, WatchRawBytes)]


def pads_are_learnt(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """An unknown note gets a name, a pad is learnt with one hit and undone, Esc gives up, ten strokes make a curve."""
    desk = drive.station.parts.mapping
    drive.engine.play_bytes("99 0e 40")
    ctx.yield_(2)
    drive.seen["unknown"] = desk.unknown
    open_popup(ctx, "What is it?##10-14")
    ctx.item_click("//$FOCUSED/##pads/rim##tom_1\\/rim")
    ctx.yield_(2)
    drive.seen["named"] = desk.learnt
    open_popup(ctx, LEARN_PAD_LABEL)
    ctx.item_click("//$FOCUSED/##pads/bell##ride\\/bell")
    ctx.yield_(2)
    drive.seen["asks"] = desk.asks
    drive.engine.play_bytes("99 24 60")
    ctx.yield_(6)
    drive.seen["learnt"] = [desk.learnt, drive.room.stage.name]
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click(UNDO_LABEL)
    ctx.yield_(2)
    drive.seen["undone"] = desk.kit.strike(10, 0x24).piece.name
    ctx.item_click("**/snare##pad-snare")
    ctx.yield_(2)
    ctx.item_click(TOUCH_LABEL)
    ctx.yield_(2)
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    drive.seen["given up"] = desk.learns
    ctx.item_click(TOUCH_LABEL)
    for velocity in (0x10, 0x12, 0x11, 0x13, 0x14, 0x50, 0x52, 0x51, 0x53, 0x54):
        drive.engine.play_bytes(f"99 26 {velocity:02x}")
        ctx.yield_(2)
    ctx.yield_(3)
    kept = own_kit(KIT)
    drive.seen["touch"] = None if kept is None else [kept.pad(Piece.SNARE).curve.table[v] for v in (0x12, 0x52)]


def sticks(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The sticks page: a sensor is seen, its hand chosen and kept, the gesture begun and given up, the air switched."""
    device = "x-IMU3 1"
    open_panel(ctx, STICKS)
    drive.engine.plug_stick(device)
    angle, _, _ = strokes_by_angle([Stroke(0.5)] * 2, rest_s=1.0)
    drive.engine.move_stick(device, measured(angle, Sensor(200)))
    ctx.yield_(3)
    (stick,) = drive.state.sticks.sticks
    drive.seen["facts"], drive.seen["drawn"] = stick.facts, stick.turn is not None
    ctx.set_ref(f"//{STICKS}")
    ctx.item_click(f"left##{device}")
    ctx.yield_(2)
    drive.seen["hand"] = own_stick(device).limb.name
    drive.seen["shown"] = drive.state.sticks.sticks[0].limb.name
    ctx.yield_(25)  # it falls silent, and says so
    drive.seen["silent"] = drive.state.sticks.sticks[0].troubles
    ctx.item_click(GESTURE_LABEL)
    ctx.yield_(3)
    drive.seen["asks"] = drive.state.sticks.lesson and drive.state.sticks.lesson.asks
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(2)
    drive.seen["given up"] = drive.state.sticks.lesson is None
    ctx.item_click(f"**/{FOLLOW_LABEL}")
    ctx.yield_(2)
    drive.seen["follows"] = load_settings(drive.settings).follow_phase
    ctx.item_click(f"**/{SOUND_LABEL}")
    ctx.yield_(2)
    drive.seen["sounds"] = load_settings(drive.settings).sound_phase
    ctx.item_input_value(f"**/{PORTS_LABEL}", "serial:/dev/ttyUSB0@fast")
    ctx.item_click(f"**/{LOOK_LABEL}")
    ctx.yield_(2)
    drive.seen["refused"] = drive.state.toast
    open_panel(ctx, STICKS)  # and close it again
    ctx.yield_(2)
    drive.seen["watched"] = [command.on for command in drive.engine.sent if isinstance(command, WatchSensors)]


def habits(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The practice panel: a tick, a gesture taken away, another learnt from the kit; the settings keep them."""
    open_panel(ctx, PRACTICE)
    ctx.set_ref(f"//{PRACTICE}")
    ctx.item_uncheck("the kit starts")
    ctx.item_click("×##no-cc=64")
    ctx.item_click(LEARN_LABEL)
    drive.engine.play_bytes("99 31 50 99 33 50")
    ctx.yield_(4)
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.kicks_start, kept.pause]
    drive.engine.play_bytes("99 24 50")
    ctx.yield_(5)
    drive.engine.play_bytes("99 24 50")
    ctx.yield_(2)
    drive.seen["stage"] = drive.room.stage.name
    ctx.item_click(LEARN_LABEL)
    ctx.yield_(2)
    drive.seen["learns"] = drive.state.learns_pause
    open_panel(ctx, PRACTICE)  # and close it again
    ctx.yield_(2)
    drive.seen["learns unseen"] = drive.state.learns_pause
    open_panel(ctx, EXPORT)
    ctx.set_ref(f"//{EXPORT}")
    ctx.item_click(music_label(MIDI))
    drive.wait_until(ctx, lambda state: state.export.written is not None)
    drive.seen["taken"] = drive.state.toast
    ctx.item_click(SHEET_LABEL)
    drive.wait_until(ctx, lambda state: not state.export.is_writing)
    drive.seen["printed"] = drive.state.toast
    open_panel(ctx, EXPORT)


def calibration(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Latency is measured on the devices page; what is found is kept only when it is asked for, doubts are said."""
    open_panel(ctx, DEVICES)
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click("Strike##by")
    ctx.item_click(MEASURE_LABEL)
    drive.seen["rests"] = [drive.state.calibration.runs, drive.room.kit]
    for _ in range(MOST_FRAMES):
        if not drive.state.calibration.runs:
            break
        ctx.yield_()
    ctx.yield_(6)
    drive.seen["found"] = [drive.state.calibration.runs, drive.room.kit, drive.state.calibration.trusted]
    drive.seen["kept unasked"] = bool(load_calibration().kits)
    ctx.item_click(ANYWAY_LABEL)
    ctx.yield_(3)
    kept = load_calibration().kits[KIT].kit
    drive.seen["kept"] = [kept.latency_ms, kept.by, kept.doubts]
    drive.seen["told"] = drive.state.toast
    open_panel(ctx, DEVICES)  # and close it again
