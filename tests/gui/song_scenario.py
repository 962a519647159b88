"""The scenario of the panel of songs: a part and a band are opened, pinned, and kept as a lesson."""

from pathlib import Path

from imgui_bundle import imgui

from station.app.actions.song_actions import SetPoint
from station.gui.panels.song_panel import OPEN_LABEL, PIN_LABEL, SAVE_LABEL, SONG
from tests.fakes.song_files import write_part
from tests.fakes.work_at_once import WorkAtOnce
from tests.gui.drive import Drive
from tests.unit.practice.test_song_sound import beats_s, write_band

BARS = 8


def song(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Three beats are pinned as they are and one half a beat off, the last one by hand; the song is kept."""
    times_s = beats_s(5, 4 * BARS + 1, wander=0.003)
    part, sound = write_part(Path(), BARS), Path("band.wav")
    write_band(sound, times_s)
    page = drive.station.parts.song
    page._start = WorkAtOnce  # what other processes do is asked in the page's own tests
    drive.window.params.docking_params.dockable_window_of_name(SONG).is_visible = True
    ctx.yield_(3)
    ctx.set_ref(f"//{SONG}")
    drive.window.pages.song.part, drive.window.pages.song.sound = str(part), str(sound)
    ctx.item_click(OPEN_LABEL)
    drive.wait_until(ctx, lambda state: state.song.opened is not None)
    for bar, beat in ((1, 0), (4, 12), (6, 21)):
        drive.station.dispatch(SetPoint(bar, 1, float(times_s[beat])))
    drive.window.pages.song.at_s, drive.window.pages.song.bar = float(times_s[28]), 8
    ctx.yield_(2)
    ctx.item_click(PIN_LABEL)
    drive.wait_until(ctx, lambda state: state.song.is_followed)
    drive.seen["pins"] = [one.point.bar for one in drive.state.song.points]
    drive.seen["off"] = [one.is_off for one in drive.state.song.points]
    drive.seen["unread"] = drive.unread(ctx)
    drive.window.pages.song.title = "Our song"
    ctx.yield_(2)
    ctx.item_click(SAVE_LABEL)
    drive.wait_until(ctx, lambda state: state.selection.card is not None and state.selection.card.title == "Our song")
    drive.seen["chosen"] = True
    ctx.yield_(3)
