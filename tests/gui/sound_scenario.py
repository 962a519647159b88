"""The page of sounds: what is set is kept, heard while it is set, and can be read on every leaf."""

from imgui_bundle import imgui

from station.core.settings import load_settings
from station.engine.messages import Play, SetLevel, SetMaster, SetPiece, SetSounds
from station.gui.panels.import_panel import IMPORT
from station.gui.panels.sound.click_part import COUNT_LABEL
from station.gui.panels.sound.sound_panel import (
    CLICK_TAB,
    DRUMS_TAB,
    IMPORT_LABEL,
    LEVELS_TAB,
    OUTPUT_TAB,
    SOUND,
    TRACK_TAB,
)
from station.sound.songs.onset_strength import RATE_HZ
from station.sound.wav_file import write_wav
from tests.fakes.virtual_band import rock_track
from tests.gui.drive import MOST_FRAMES, Drive, open_panel
from tests.gui.dropped_files import drop_files


def sound(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Every leaf is used once, and looked at."""
    open_panel(ctx, SOUND)
    drive.wait_until(ctx, lambda state: state.sound.shelf is not None)
    ctx.set_ref(f"//{SOUND}")
    drive.seen["unread"] = []
    _click(drive, ctx)
    _levels(drive, ctx)
    _drums(drive, ctx)
    _track(drive, ctx)
    _silent(drive, ctx)
    ctx.item_click(IMPORT_LABEL)
    ctx.yield_(3)
    drive.seen["import"] = drive.window.pages.is_open(IMPORT)
    kept = load_settings(drive.settings)
    drive.seen["kept"] = [kept.click_pattern, kept.levels, kept.drums, kept.heard, kept.with_track]


def _leaf(drive: Drive, ctx: imgui.test_engine.TestContext, name: str) -> None:
    drive.window.pages.sound.leaf = name
    ctx.yield_(3)


def _read(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    seen = drive.seen["unread"]
    assert isinstance(seen, list)
    seen += drive.unread(ctx)


def _click(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    _leaf(drive, ctx, CLICK_TAB)
    for press in ("**/###beat2", "**/###beat3", "**/###beat3"):
        ctx.item_click(press)
        ctx.yield_(2)
    ctx.item_input_value("**/##parts", 2)
    ctx.item_click(f"**/{COUNT_LABEL}")
    ctx.yield_(2)
    drive.seen["heard"] = any(isinstance(command, Play) for command in drive.engine.sent)
    _read(drive, ctx)


def _levels(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    _leaf(drive, ctx, LEVELS_TAB)
    drive.engine.sent.clear()
    ctx.item_input_value("**/##level-click", 50)
    ctx.item_click("**/M##mute-student")
    ctx.item_click("**/S##solo-kick")
    ctx.yield_(2)
    told = [command for command in drive.engine.sent if isinstance(command, SetLevel | SetPiece)]
    drive.seen["levels"] = [[type(each).__name__, each.level] for each in told[:2]]
    drive.seen["alone"] = sum(isinstance(each, SetPiece) for each in told)
    ctx.item_click("**/S##solo-kick")
    _read(drive, ctx)


def _drums(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    _leaf(drive, ctx, DRUMS_TAB)
    ctx.mouse_move("**/brushes##kit-brushes")
    drive.wait_until(ctx, lambda state: state.sound.tried == "brushes")
    for _ in range(MOST_FRAMES):
        if drive.room.listening:
            break
        ctx.yield_()
    drive.seen["tried"] = [drive.room.listening, drive.state.settings.drums]
    ctx.mouse_move("**/Look again##kit")
    drive.wait_until(ctx, lambda state: not state.sound.tried)
    ctx.item_click("**/electronic##kit-electronic")
    ctx.yield_(2)
    drive.seen["sounds"] = [command.drums for command in drive.engine.sent if isinstance(command, SetSounds)]
    _read(drive, ctx)
    _leaf(drive, ctx, OUTPUT_TAB)
    _read(drive, ctx)


def _track(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    _leaf(drive, ctx, CLICK_TAB)
    path = drive.settings.parent / "song.wav"
    write_wav(rock_track(100.0, 1.0), RATE_HZ, path)
    drop_files([path])
    drive.wait_until(ctx, lambda state: bool(state.settings.track))
    ctx.yield_(3)
    settings = drive.state.settings
    drive.seen["track"] = [drive.window.pages.sound.leaf == TRACK_TAB, settings.track_bpm, settings.track_start_s]
    ctx.item_click("**/+10##nudge")
    ctx.yield_(2)
    drive.seen["nudged"] = drive.state.settings.track_start_s - settings.track_start_s
    _read(drive, ctx)


def _silent(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    drive.engine.sent.clear()
    ctx.item_click("nothing##heard")
    ctx.yield_(2)
    drive.seen["silent"] = [command.level for command in drive.engine.sent if isinstance(command, SetMaster)]
    _leaf(drive, ctx, CLICK_TAB)
    ctx.item_click("**/Hear a bar##click")
    for _ in range(MOST_FRAMES):
        if drive.state.flash.strength:
            break
        ctx.yield_()
    drive.seen["flashes"] = drive.state.flash.strength > 0.0
