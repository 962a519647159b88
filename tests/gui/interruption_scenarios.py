"""A session in whose middle the window is closed, loses its monitor or its graphics."""

import moderngl
from imgui_bundle import imgui

from station.gui.display import GONE, Rectangle, home_for
from tests.gui.drive import MOST_FRAMES, SIZE, Drive


def closes(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The window is closed in mid-session."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    ctx.yield_(100)
    drive.seen["at_the_end"] = drive.room.stage.name


def unplugged(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A second monitor is unplugged in mid-session, and the window is on it."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    assert drive.monitors is not None, "the window is open"
    screen = drive.monitors.first
    drive.monitors.is_plugged = True
    screen.move(Rectangle(3100, 100, *SIZE))
    ctx.yield_(12)
    drive.seen["outside"] = home_for(screen.window(), [screen.area(name) for name in screen.monitors()]) is not None
    drive.seen["told before"] = drive.state.toast == GONE
    drive.monitors.is_plugged = False
    ctx.yield_(3)
    seen = [screen.window().shared(screen.area(name)) for name in screen.monitors()]
    drive.seen["shown"] = max(seen) / (SIZE[0] * SIZE[1])
    drive.seen["told"] = drive.state.toast
    drive.seen["stage"] = drive.room.stage.name


def lost(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The driver loses the window's context in mid-session."""
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    ctx.yield_(30)
    moderngl.Context.error = "GL_UNKNOWN_ERROR"  # what the library says of a context that its driver has lost
    ctx.yield_(MOST_FRAMES)
