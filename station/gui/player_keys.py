"""The keys of the demonstration's player, which hold between sessions."""

from collections.abc import Callable, Mapping
from types import MappingProxyType

from imgui_bundle import imgui

from station.app.actions.action import Action
from station.app.actions.player_actions import (
    GoToFlag,
    KeepFlag,
    PlayOrStop,
    Seek,
    SetCountIn,
    SetDemoClick,
    SetReverse,
    SetSpeed,
    SetStep,
    StepOnce,
)
from station.app.actions.practice_actions import ChooseBars
from station.app.sessions.demo_picture import PlayerView
from station.gui.keyboard_kit import slot_pressed
from station.practice.demonstration.song_player import SongStep

SPEED_STEP_PERCENT = 5


def player_keys(view: PlayerView, dispatch: Callable[[Action], None]) -> int:
    """Do what the keys say that went down since the last frame; nobody types text. Returns which way a key winds."""
    io = imgui.get_io()
    slot = slot_pressed()
    if io.key_shift and slot is not None and not (io.key_alt or io.key_super):
        dispatch(KeepFlag(slot) if io.key_ctrl else GoToFlag(slot))
    if io.key_ctrl or io.key_alt or io.key_super or io.key_shift:
        return 0
    for key, action in _ACTIONS.items():
        if imgui.is_key_pressed(key, repeat=key in _REPEATED):
            dispatch(action(view))
    if not io.nav_visible:  # there they go from control to control
        if imgui.is_key_pressed(imgui.Key.home, repeat=False):
            dispatch(Seek(0))
        elif imgui.is_key_pressed(imgui.Key.end, repeat=False):
            dispatch(Seek(view.player.song.length_ns))
    _loop_keys(view, dispatch)
    return int(imgui.is_key_down(imgui.Key.right_bracket)) - int(imgui.is_key_down(imgui.Key.left_bracket))


def _loop_keys(view: PlayerView, dispatch: Callable[[Action], None]) -> None:
    bar = view.player.place(view.now_ns).bar
    first, last = view.player.loop or (0, view.player.song.bar_count - 1)
    if imgui.is_key_pressed(imgui.Key.i, repeat=False):
        dispatch(ChooseBars((bar, max(bar, last))))
    elif imgui.is_key_pressed(imgui.Key.o, repeat=False):
        dispatch(ChooseBars((min(bar, first), bar)))
    elif imgui.is_key_pressed(imgui.Key.u, repeat=False):
        dispatch(ChooseBars(None))


def _next_step(view: PlayerView) -> Action:
    steps = list(SongStep)
    return SetStep(steps[(steps.index(view.step) + 1) % len(steps)])


_ACTIONS: Mapping[imgui.Key, Callable[[PlayerView], Action]] = MappingProxyType(
    {
        imgui.Key.w: lambda _: PlayOrStop(),
        imgui.Key.r: lambda view: SetReverse(not view.player.reverse),
        imgui.Key.c: lambda view: SetDemoClick(not view.click),
        imgui.Key.q: lambda view: SetCountIn(not view.counts_in),
        imgui.Key.x: _next_step,
        imgui.Key.comma: lambda _: StepOnce(-1),
        imgui.Key.period: lambda _: StepOnce(1),
        imgui.Key.minus: lambda view: SetSpeed(view.player.speed_percent - SPEED_STEP_PERCENT),
        imgui.Key.equal: lambda view: SetSpeed(view.player.speed_percent + SPEED_STEP_PERCENT),
    }
)
_REPEATED = (imgui.Key.comma, imgui.Key.period, imgui.Key.minus, imgui.Key.equal)
