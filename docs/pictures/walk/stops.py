"""The stops of the hour, in their order: what a new user does, and what they look at."""

from collections.abc import Callable

from imgui_bundle import imgui
from real_room import Context, RealRoom

from station.app.room_state import Stage

Stop = Callable[[RealRoom, Context], None]


def first_start(room: RealRoom, ctx: Context) -> None:
    """The questions, answered by the keyboard."""
    ctx.yield_(3)
    ctx.key_chars("Ann")


def lessons(room: RealRoom, ctx: Context) -> None:
    """The room behind them."""
    ctx.item_click("//Welcome/Begin##begin")
    ctx.yield_(5)


def first_pass(room: RealRoom, ctx: Context) -> None:
    """Somebody plays along."""
    ctx.key_press(imgui.Key.enter)
    room.wait_until(ctx, lambda state: state.snapshot is not None and state.snapshot.hud.judged > 10)


def result(room: RealRoom, ctx: Context) -> None:
    """What they are told."""
    room.wait_until(ctx, lambda state: state.room.stage is Stage.RESULT)


STOPS: tuple[Stop, ...] = (first_start, lessons, first_pass, result)
