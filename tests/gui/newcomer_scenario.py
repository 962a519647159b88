"""The first start: three questions, and the first groove at once; the whole first minute on late equipment."""

from imgui_bundle import imgui

from station.app.help_topics import topic_of
from station.app.room_state import Stage
from station.core.settings import load_settings
from station.core.units import NS_PER_S
from station.engine.messages import SetLevel
from station.gui.panels.choice_panel import CHOICE, label_of
from tests.gui.drive import Drive


def newcomer(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The questions of the first start, answered by the keyboard alone; the last Enter begins the groove."""
    drive.seen["asked"] = drive.window.welcome is not None
    ctx.yield_(2)
    ctx.key_chars(" Ann  Lee ")
    for key in (imgui.Key.enter, imgui.Key.space, imgui.Key.down_arrow, imgui.Key.down_arrow, imgui.Key.right_arrow):
        ctx.key_press(key)
        ctx.yield_(2)
    ctx.key_press(imgui.Key.space)
    ctx.yield_(2)
    answers = drive.window.welcome.answers if drive.window.welcome is not None else None
    drive.seen["answers"] = str(answers)
    ctx.key_press(imgui.Key.down_arrow)
    ctx.key_press(imgui.Key.enter)
    ctx.yield_(3)
    drive.seen["gone"] = drive.window.welcome is None
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.student, kept.own_sound, kept.hands, kept.welcomed]
    drive.seen["levels"] = [[c.bus.name, c.level] for c in drive.engine.sent if isinstance(c, SetLevel)]
    drive.seen["keys"] = len(drive.engine.keys)
    drive.seen["left-handed"] = drive.picture.kit.left_handed
    drive.seen["stage"] = drive.room.stage.name
    drive.seen["told"] = drive.state.toast
    drive.seen["helped playing"] = helped(drive, ctx)
    ctx.key_press(imgui.Key.escape)
    drive.wait_for(ctx, Stage.RESULT)
    ctx.key_press(imgui.Key.escape)
    drive.wait_for(ctx, Stage.IDLE)
    drive.seen["helped"] = helped(drive, ctx)


def first_minute(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Who plays on equipment that is late hears a groove, plays it, is judged fairly, and takes the lag out."""
    ctx.set_ref("//Welcome")
    begin(ctx)
    ctx.yield_(2)
    drive.seen["stage"] = drive.room.stage.name
    begun_ns = drive.clock.now_ns()
    drive.wait_for(ctx, Stage.RESULT)
    drive.seen["seconds"] = (drive.clock.now_ns() - begun_ns) / NS_PER_S
    ctx.yield_(3)
    drive.seen["lag"], drive.seen["asked"] = drive.room.lag_ms, drive.room.question
    drive.seen["fair"] = points(drive)
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    ctx.yield_(3)
    drive.seen["answered"] = drive.room.lag_ms
    drive.seen["after"] = points(drive)
    drive.seen["toast"] = drive.state.toast


def begin(ctx: imgui.test_engine.TestContext) -> None:
    """Press the button of the first page."""
    ctx.item_click("**/###begin")


def points(drive: Drive) -> float | None:
    """The score that the result shows."""
    assert drive.state.report is not None
    return drive.state.report.facts.words.points


def helped(drive: Drive, ctx: imgui.test_engine.TestContext) -> str:
    """Which page F1 explains; it is closed again."""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(3)
    shown = ctx.window_info("//Help").window
    topic = topic_of(drive.room, drive.state.selection.free).value if shown is not None else ""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(2)
    return topic
