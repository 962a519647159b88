"""The first start: three questions, help, and a session."""

from imgui_bundle import imgui

from station.app.help_topics import topic_of
from station.core.settings import load_settings
from station.engine.messages import SetLevel
from tests.gui.drive import Drive


def newcomer(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The questions of the first start, answered by the keyboard alone; then a session is one Enter away."""
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
    drive.seen["helped"] = helped(drive, ctx)
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    ctx.yield_(2)
    drive.seen["stage"] = drive.room.stage.name
    drive.seen["helped playing"] = helped(drive, ctx)


def helped(drive: Drive, ctx: imgui.test_engine.TestContext) -> str:
    """Which page F1 explains; it is closed again."""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(3)
    shown = ctx.window_info("//Help").window
    topic = topic_of(drive.room, drive.state.selection.free).value if shown is not None else ""
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(2)
    return topic
