"""Lessons played: chosen, practised, judged and drilled, on a kit, on keys, freely; what cannot begin says so."""

from dataclasses import replace

from imgui_bundle import imgui

from station.app.actions.settings_actions import SetView
from station.app.room_state import Stage
from station.gui.panels.export_panel import EXPORT, PLAYED_LABEL
from station.gui.panels.lessons.lesson_list import FREE_LABEL
from station.gui.panels.lessons.lesson_options import ADAPT_LABEL, FILM_LABEL, LISTEN_LABEL
from station.gui.panels.lessons.lesson_options import LESSON_LABEL as TAKE_LESSON_LABEL
from station.gui.panels.playback_row import STOP_LABEL as HITS_STOP
from station.gui.panels.playback_row import STUDENT_LABEL, TEACHER_LABEL
from station.gui.widgets.level_choice import LEVEL_LABEL
from station.music.formats.format_table import read_part
from station.render.notation.screen.score_place import ScoreForm
from tests.gui.drive import MOST_FRAMES, TIMEOUT_S, Drive, open_panel, open_popup, to_list, to_options


def practise(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A whole session, from the list to the results and back."""
    drive.choose(ctx, passes=1)
    drive.seen["suggested"] = str(drive.state.selection.level)
    to_options(ctx)
    open_popup(ctx, LEVEL_LABEL)
    ctx.item_click("//$FOCUSED/###advanced")
    ctx.yield_(2)
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    drive.seen["started"] = drive.room.stage.name
    drive.seen["frames"] = drive.wait_for(ctx, Stage.RESULT)
    drive.seen["asked"] = drive.room.question
    drive.seen["told before"] = drive.state.report is not None
    drive.answer(ctx)
    ctx.set_ref("//Transport")
    report = drive.state.report
    assert report is not None
    drive.seen["points"] = report.facts.words.points
    drive.seen["notes"] = len(report.facts.label)
    drive.seen["level"], drive.seen["told"] = report.document["level"], report.facts.words.subtitle
    drive.seen["title"] = report.facts.words.title
    ctx.item_click("Back to the lessons##back")
    ctx.yield_(2)
    drive.seen["after"] = drive.room.stage.name


def keys(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Strokes on the computer's keyboard, and Escape."""
    drive.choose(ctx, passes=2)
    ctx.item_click("Start##start")
    ctx.yield_(5)
    for key in (imgui.Key.f, imgui.Key.space, imgui.Key.d, imgui.Key.a):
        ctx.key_press(key)
        ctx.yield_(2)
    drive.seen["pieces"] = [hit.piece.name for hit in drive.engine.keys]
    drive.seen["rising"] = sorted({hit.at_ns for hit in drive.engine.keys}) == [hit.at_ns for hit in drive.engine.keys]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(3)
    drive.seen["after"] = drive.room.stage.name


def just_play(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A free take on the keys, and the take heard again."""
    to_list(ctx)
    ctx.item_click(f"**/{FREE_LABEL}")
    ctx.item_click("Start##start")
    ctx.yield_(8)
    for key in (imgui.Key.f, imgui.Key.space, imgui.Key.d):
        ctx.key_press(key)
        ctx.yield_(3)
    drive.seen["stage"] = drive.room.stage.name
    strip = drive.picture.strip
    assert strip is not None
    drive.seen["pieces"] = [hit.piece.name for hit in strip.played]
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(3)
    drive.seen["after"] = drive.room.stage.name
    to_options(ctx)
    ctx.item_click(LISTEN_LABEL)
    ctx.yield_(2)
    drive.seen["listening"] = drive.room.listening
    for _ in range(MOST_FRAMES):
        if drive.picture.strikes or not drive.room.listening:
            break
        ctx.yield_()
    drive.seen["lit"] = [strike.piece.name for strike in drive.picture.strikes]
    for _ in range(MOST_FRAMES):
        if not drive.room.listening:
            break
        ctx.yield_()
    drive.seen["ended"] = not drive.room.listening
    films = drive.station.parts.export
    ctx.item_click(FILM_LABEL)
    if films.process is not None:
        films.process.wait(TIMEOUT_S)
    ctx.yield_(3)
    capture = drive.room.take
    drive.seen["filmed"] = capture is not None and capture.with_suffix(".mp4").read_text() == str(capture)
    open_panel(ctx, EXPORT)
    ctx.item_click(f"//{EXPORT}/{PLAYED_LABEL}")
    drive.wait_until(ctx, lambda state: not state.export.is_writing)
    written = drive.state.export.written
    assert written is not None
    drive.seen["midi"] = [note.piece.name for note in read_part(written.path).score]
    open_panel(ctx, EXPORT)
    to_options(ctx)
    ctx.item_click(TAKE_LESSON_LABEL)
    drive.seen["lesson"] = drive.imported(ctx, "Just play")


def highway(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The highway while a virtual student plays: the last frame is looked at."""
    drive.choose(ctx, passes=4)
    ctx.key_press(imgui.Key.escape)
    drive.station.dispatch(SetView(replace(drive.state.view_settings, score=ScoreForm.HIGHWAY)))
    ctx.item_click("Start##start")
    for _ in range(MOST_FRAMES):
        ctx.yield_()
        if drive.picture.hud.judged > 15:
            break
    drive.seen["stage"] = drive.room.stage.name


def drill(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A bar of the result's heat map is clicked, and practised alone."""
    drive.choose(ctx, passes=1)
    to_options(ctx)
    ctx.item_uncheck(ADAPT_LABEL)
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    drive.wait_for(ctx, Stage.RESULT)
    drive.answer(ctx)
    report = drive.state.report
    assert report is not None
    drive.seen["cells"] = {f"{bar} {limb.name}": cell.notes for (bar, limb), cell in report.heat.cells.items()}
    ctx.yield_(3)
    by_ear(drive, ctx)
    ctx.set_ref("//Bars")
    ctx.item_click("**/2##bar2")
    ctx.yield_(3)
    drive.seen["stage"] = drive.room.stage.name
    kept = drive.station.close()
    assert kept is None, kept
    drilled = drive.state.report
    drive.seen["subtitle"] = None if drilled is None else drilled.facts.words.subtitle


def by_ear(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """The panel of every hit: its dots answer the mouse, and a bar of the teacher's and one's own is heard."""
    open_popup(ctx, "//Transport/Panels##panels")
    ctx.item_click("//$FOCUSED/Every hit")
    ctx.popup_close_all()
    ctx.yield_(3)
    ctx.set_ref("//Every hit")
    for label in (TEACHER_LABEL, STUDENT_LABEL):
        ctx.item_click(label)
        ctx.yield_(2)
        drive.seen[f"heard {label.split('#')[0]}"] = drive.room.listening
        double = drive.picture.double
        drive.seen[f"seen {label.split('#')[0]}"] = double is not None and double.is_compared
        ctx.item_click(HITS_STOP)
        ctx.yield_(2)
    drive.seen["quiet"] = not drive.room.listening
    panel, report = drive.window.pages.hits, drive.state.report
    assert report is not None
    x, y = panel.at[0].tolist()
    ctx.mouse_move_to_pos(imgui.ImVec2(x, y))
    ctx.yield_(2)
    drive.seen["pointed"] = panel.pointed
    x, y = min(panel.at[report.hits.dots["bar"] == 2].tolist(), key=lambda at: at[1])  # the lowest are scrolled away
    ctx.mouse_move_to_pos(imgui.ImVec2(x, y))
    ctx.yield_(2)
    ctx.mouse_click(0)
    ctx.yield_(2)
    drive.seen["clicked"] = panel.playback.bar


def fault(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """A session that cannot begin is said in one line, and nothing else happens."""
    drive.engine.refuses = "the engine has ended"
    ctx.set_ref("//Lessons")
    ctx.item_click("Start##start")
    ctx.yield_(2)
    drive.seen["news"] = drive.state.toast
    drive.seen["after"] = drive.room.stage.name
    drive.engine.refuses = ""
