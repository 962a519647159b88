"""What is chosen on the screen: the answer to a question, what comes next; by pad, key, mouse, never by chance."""

from imgui_bundle import imgui

from station.app.actions.practice_actions import EndSession
from station.app.room_state import Stage
from station.core.units import NS_PER_S
from station.gui.panels.choice_panel import CHOICE, label_of
from tests.gui.drive import Drive

KICK, SNARE, HIHAT, TOM = "99 24 5a", "99 26 5a", "99 2a 5a", "99 32 5a"
"""What a General MIDI kit sends."""


def choices(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A result with its question, and sessions that begin from it."""
    seen = drive.seen
    drive.choose(ctx, passes=1)
    ctx.item_click("Start##start")
    drive.wait_for(ctx, Stage.RESULT)
    drive.engine.plan = None  # nobody plays from here on
    _struck(drive, ctx, HIHAT, then_s=3.0)
    seen["answered by the music"] = drive.room.question == ""
    _struck(drive, ctx, HIHAT, then_s=1.0)
    seen["answered by a pad"] = drive.room.question == "" and drive.state.report is not None
    assert drive.state.choice is not None
    seen["options"] = [option.label for option in drive.state.choice.options]
    seen["pads"] = [sorted(pad.name for pad in option.pads) for option in drive.state.choice.options]
    seen["unread"] = drive.unread(ctx)
    for stroke in (KICK, SNARE, KICK, KICK, SNARE, HIHAT, KICK, KICK, KICK):
        _struck(drive, ctx, stroke, then_s=0.4)
    _let(drive, ctx, 3.0)
    seen["strays"] = drive.room.stage.name
    _struck(drive, ctx, TOM, then_s=0.3)
    seen["meant"] = drive.state.choice.meant
    seen["by pad"] = _begun(drive, ctx)
    ctx.key_press(imgui.Key._1)
    seen["by key"] = _begun(drive, ctx)
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    seen["by mouse"] = _begun(drive, ctx)
    ctx.key_press(imgui.Key.enter)
    seen["by enter"] = _begun(drive, ctx)
    _let(drive, ctx, 2.5)
    _struck(drive, ctx, KICK, then_s=0.4)
    _struck(drive, ctx, KICK, then_s=0.4)
    seen["by kicks"] = _begun(drive, ctx)


def _begun(drive: Drive, ctx: imgui.test_engine.TestContext) -> str:
    """Which lesson begins, at which tempo; it is ended at once."""
    drive.wait_for(ctx, Stage.PLAYING)
    plan = drive.station.parts.sessions.practice.session.plan
    drive.station.dispatch(EndSession())
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(2)
    return f"{plan.lesson.name} {plan.beats_a_minute:.0f}"


def _struck(drive: Drive, ctx: imgui.test_engine.TestContext, stroke: str, then_s: float) -> None:
    drive.engine.play_bytes(stroke)
    _let(drive, ctx, then_s)


def _let(drive: Drive, ctx: imgui.test_engine.TestContext, seconds: float) -> None:
    """Let so much of the played time go by, however many frames it takes."""
    until_ns = drive.clock.now_ns() + round(seconds * NS_PER_S)
    while drive.clock.now_ns() < until_ns:
        ctx.yield_()
    ctx.yield_(2)
