"""The keys of the demonstration's player, which hold between sessions."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.demo_player import DemoPlayer
from station.gui.keyboard_kit import slot_pressed
from station.gui.panels.player_controls import PlayerControls, play_or_stop, to_end, to_start
from station.gui.panels.ruler import Bars
from station.practice.demonstration.song_player import SongPlayer, SongStep

SPEED_STEP_PERCENT = 5


def player_keys(deck: DemoPlayer, controls: PlayerControls, choose: Callable[[Bars], None]) -> None:
    """Do what the keys say that went down since the last frame; nobody types text."""
    io = imgui.get_io()
    controls.key_wind = 0
    slot = slot_pressed()
    if io.key_shift and slot is not None and not (io.key_alt or io.key_super):
        keeps = io.key_ctrl
        deck.do(lambda p, now_ns: p.flagged(now_ns, slot) if keeps else p.at_flag(now_ns, slot))
    if io.key_ctrl or io.key_alt or io.key_super or io.key_shift:
        return
    controls.key_wind = int(imgui.is_key_down(imgui.Key.right_bracket)) - int(imgui.is_key_down(imgui.Key.left_bracket))
    for key, action in _ACTIONS.items():
        if imgui.is_key_pressed(key, repeat=key in _REPEATED):
            action(deck)
    if not io.nav_visible:  # there they go from control to control
        if imgui.is_key_pressed(imgui.Key.home, repeat=False):
            deck.do(to_start)
        elif imgui.is_key_pressed(imgui.Key.end, repeat=False):
            deck.do(to_end)
    _loop_keys(deck, choose)


def _loop_keys(deck: DemoPlayer, choose: Callable[[Bars], None]) -> None:
    player = deck.player
    bar = player.place(deck.now_ns).bar
    first, last = player.loop or (0, player.song.bar_count - 1)
    if imgui.is_key_pressed(imgui.Key.i, repeat=False):
        choose((bar, max(bar, last)))
    elif imgui.is_key_pressed(imgui.Key.o, repeat=False):
        choose((min(bar, first), bar))
    elif imgui.is_key_pressed(imgui.Key.u, repeat=False):
        choose(None)


def _stepped(way: int) -> Callable[[DemoPlayer], None]:
    return lambda deck: deck.do(lambda player, now_ns: player.stepped(now_ns, deck.step, way))


def _faster(percent: int) -> Callable[[DemoPlayer], None]:
    def change(player: SongPlayer, now_ns: int) -> SongPlayer:
        return player.at_speed(now_ns, player.speed_percent + percent)

    return lambda deck: deck.do(change)


def _next_step(deck: DemoPlayer) -> None:
    steps = list(SongStep)
    deck.step = steps[(steps.index(deck.step) + 1) % len(steps)]


_ACTIONS: dict[imgui.Key, Callable[[DemoPlayer], None]] = {
    imgui.Key.w: lambda deck: deck.do(play_or_stop),
    imgui.Key.r: lambda deck: deck.do(lambda player, now_ns: player.reversed(now_ns, not player.reverse)),
    imgui.Key.c: lambda deck: deck.set_click(not deck.click),
    imgui.Key.q: lambda deck: deck.count_in(not deck.counts_in),
    imgui.Key.x: _next_step,
    imgui.Key.comma: _stepped(-1),
    imgui.Key.period: _stepped(1),
    imgui.Key.minus: _faster(-SPEED_STEP_PERCENT),
    imgui.Key.equal: _faster(SPEED_STEP_PERCENT),
}
_REPEATED = (imgui.Key.comma, imgui.Key.period, imgui.Key.minus, imgui.Key.equal)
