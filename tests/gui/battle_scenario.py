"""Whole battles in the window, both modes, by a scripted player at a fake kit over the real engine."""

from collections.abc import Callable

from imgui_bundle import imgui

from station.app.actions.battle_actions import ChooseBattle
from station.app.actions.practice_actions import Pause
from station.app.battle.battle_shown import BattleStage
from station.app.room_state import Stage
from station.app.settings.chosen_battle import ChosenBattle
from station.app.window_state import State
from station.gui.display import Rectangle
from station.gui.panels.battle.battle_board import BOARD
from station.gui.panels.choice_panel import CHOICE, label_of
from station.gui.panels.lessons.lesson_list import BATTLE_LABEL
from station.practice.battle.battle_rules import BattleMode
from tests.gui.battle_student import BattleStudent, answer_of_the_call
from tests.gui.drive import MOST_FRAMES, Drive, to_list

Look = Callable[[str], None]
"""Looks at the window, in which one is there."""
OTHER_SIZES = ((760, 480), (1920, 1080))
SHORT = ChosenBattle(rounds=2, bars=1, seed=1)
"""Two rounds and the final."""


def battle(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look = lambda _: None) -> None:
    """From the list of lessons to both results and back; `look` is told where one is."""
    seen = drive.seen
    to_list(ctx)
    ctx.item_click(f"**/{BATTLE_LABEL}")
    drive.wait_until(ctx, lambda state: state.battle.stage is BattleStage.CHOOSING)
    ctx.yield_(5)
    seen["offered"] = _labels(drive.state)
    seen["unread of the choice"] = _unread_at_sizes(drive, ctx)
    look("chosen")
    drive.station.dispatch(ChooseBattle(SHORT))
    repeats(drive, ctx, look)
    ctx.set_ref("")
    seen["ways on"] = _labels(drive.state)
    ctx.item_click(f"//{CHOICE}/{label_of(1)}")  # the best of it
    drive.wait_until(ctx, lambda state: state.battle.replays)
    ctx.yield_(10)
    seen["replay"] = drive.picture.is_replay
    look("replay")
    drive.wait_until(ctx, lambda state: not state.battle.replays)
    ctx.yield_(3)
    ctx.key_press(imgui.Key.escape)
    drive.wait_until(ctx, lambda state: state.battle.stage is BattleStage.CHOOSING)
    trades(drive, ctx, look)
    for _ in range(2):
        ctx.key_press(imgui.Key.escape)
        ctx.yield_(3)
    seen["after"] = [drive.state.battle.stage.name, drive.room.stage.name, drive.room.free]


def repeats(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look) -> None:
    """A battle of repeating, begun by the mouse, by somebody who repeats well."""
    seen = drive.seen
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    played(drive, ctx, BattleStudent("pro,seed=4", answer_of_the_call), look)
    result = drive.state.battle.result
    assert result is not None
    seen["repeat"] = [result.headline, [row.given for row in result.rows], result.folder]
    seen["unread of the result"] = _unread_at_sizes(drive, ctx)
    look("repeated")


def trades(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look) -> None:
    """A battle of improvising, begun by two kicks' key, Enter."""
    seen = drive.seen
    setup = drive.state.battle.setup
    drive.station.dispatch(
        ChooseBattle(ChosenBattle(BattleMode.IMPROVISE, rounds=1, bars=2, opponent=setup.opponent, seed=1))
    )
    ctx.yield_(3)
    ctx.key_press(imgui.Key.enter)
    played(drive, ctx, BattleStudent("pro,seed=5,velocity_sd=14", answer_of_the_call), look)
    result = drive.state.battle.result
    assert result is not None
    seen["improvise"] = [result.headline, [row.given for row in result.rows]]
    seen["evidence"] = [part.title for part in result.rows[1].verdicts[0].evidence]
    seen["unread of the improvised result"] = _unread_at_sizes(drive, ctx)
    look("improvised")


def played(drive: Drive, ctx: imgui.test_engine.TestContext, student: BattleStudent, look: Look) -> None:
    """Play until the result is shown, looking at the board in every frame."""
    seen, mode = drive.seen, drive.state.battle.setup.mode.value
    drive.wait_for(ctx, Stage.PLAYING)
    said: list[str] = []
    looked = False
    while drive.room.stage is Stage.PLAYING:
        running = drive.station.parts.sessions.practice.battle
        assert running is not None
        drive.engine.will_play(student.strokes(running))
        board = drive.state.battle.board
        said += [board.headline] if said[-1:] != [board.headline] else []
        if board.verdicts and not looked:
            looked = True
            seen[f"board of {mode}"] = ctx.window_info(f"//{BOARD}").window is not None
            look(f"{mode} board")
            seen[f"unread of {mode}"] = _unread_in_a_pause(drive, ctx)
        ctx.yield_()
    seen[f"said of {mode}"] = said
    drive.wait_until(ctx, lambda state: state.battle.result is not None)
    ctx.yield_(5)


def _unread_in_a_pause(drive: Drive, ctx: imgui.test_engine.TestContext) -> list[str]:
    """What cannot be read of the board, looked at while the music stands; then it goes on."""
    drive.station.dispatch(Pause())
    drive.wait_until(ctx, lambda state: state.room.paused)
    unread = _unread_at_sizes(drive, ctx)
    drive.station.dispatch(Pause())
    return unread


def _unread_at_sizes(drive: Drive, ctx: imgui.test_engine.TestContext) -> list[str]:
    """What cannot be read in windows of other sizes, and in this one, which it is again then."""
    width, height = imgui.get_io().display_size
    unread: list[str] = []
    for size in (*OTHER_SIZES, (round(width), round(height))):
        assert drive.monitors is not None
        drive.monitors.move(Rectangle(0, 0, *size))
        for _ in range(MOST_FRAMES):
            ctx.yield_()
            if imgui.get_io().display_size.x == size[0]:
                break
        ctx.yield_(6)
        unread += drive.unread(ctx)
    return unread


def _labels(state: State) -> list[str]:
    return [] if state.choice is None else [option.label for option in state.choice.options]
