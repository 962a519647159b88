"""A battle with a friend on the network in the window: who hosts, the way there, the stage, the result of both."""

from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

from imgui_bundle import imgui

from station.app.actions.battle_actions import ChooseBattle
from station.app.battle.battle_shown import BattleStage
from station.app.settings.chosen_battle import People
from station.gui.panels.battle.battle_layer import BATTLE
from station.gui.panels.battle.battle_setup_page import CALL_OFF_LABEL
from station.gui.panels.battle.friend_lines import ADDRESS_LABEL
from station.gui.panels.choice_panel import CHOICE, label_of
from station.gui.panels.lessons.lesson_list import BATTLE_LABEL
from tests.fakes.friend_station import End
from tests.gui.battle_scenario import Look
from tests.gui.battle_student import BattleStudent, answer_of_the_call
from tests.gui.drive import Drive, to_list


def friend(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look = lambda _: None) -> None:
    """Host and call it off; then join a friend who hosts, and battle to the end."""
    to_list(ctx)
    ctx.item_click(f"**/{BATTLE_LABEL}")
    drive.wait_until(ctx, lambda state: state.battle.stage is BattleStage.CHOOSING)
    hosts(drive, ctx, look)
    with TemporaryDirectory() as folder:
        ann = End(Path(folder), "Ann")
        ann.begin()
        joins(drive, ctx, ann, look)
        ann.station.close()


def hosts(drive: Drive, ctx: imgui.test_engine.TestContext, look: Look) -> None:
    """The page says what the friend types, and takes it back."""
    seen = drive.seen
    setup = drive.state.battle.setup
    drive.station.dispatch(ChooseBattle(replace(setup, people=People.NETWORK, port="0")))
    ctx.yield_(5)
    seen["unread of hosting"] = drive.unread(ctx)
    look("host chosen")
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    drive.wait_until(ctx, lambda state: bool(state.battle.friend.waits))
    ctx.yield_(5)
    seen["waits"] = drive.state.battle.friend.waits
    seen["unread of waiting"] = drive.unread(ctx)
    look("waits")
    ctx.item_click(f"//{BATTLE}/{CALL_OFF_LABEL}")
    drive.wait_until(ctx, lambda state: not state.battle.friend.waits)
    seen["called off"] = drive.state.battle.stage.name


def joins(drive: Drive, ctx: imgui.test_engine.TestContext, ann: End, look: Look) -> None:
    """The address is typed, and the battle played to its end by both."""
    seen = drive.seen
    drive.station.dispatch(ChooseBattle(replace(drive.state.battle.setup, joins=True)))
    ctx.yield_(5)
    ctx.item_click(f"//{BATTLE}/{ADDRESS_LABEL}")
    ctx.key_chars(ann.address())
    ctx.yield_(5)
    seen["unread of joining"] = drive.unread(ctx)
    look("join chosen")
    ctx.item_click(f"//{CHOICE}/{label_of(0)}")
    student, said, looked = BattleStudent("pro,seed=4", answer_of_the_call), list[str](), False
    while drive.state.battle.stage is not BattleStage.OVER:
        ann.step(drive.clock.now_ns())
        running = drive.station.parts.sessions.practice.battle
        if running is not None and drive.state.battle.stage is BattleStage.PLAYING:
            drive.engine.will_play(student.strokes(running))
            headline = drive.state.battle.board.headline
            said += [headline] if said[-1:] != [headline] else []
            if headline == "Ann plays" and not looked:
                looked = True
                look("friend plays")
        ctx.yield_()
    seen["said"] = said
    for _ in range(30):
        ann.step(drive.clock.now_ns())
        ctx.yield_()
    result, theirs = drive.state.battle.result, ann.shown.result
    assert result is not None
    assert theirs is not None
    seen["told"], seen["names"] = result.told, result.names
    seen["of both"] = [result.headline, theirs.headline]
    seen["unread of the result"] = drive.unread(ctx)
    look("linked result")
