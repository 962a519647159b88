"""The lessons page: its list is searched, and music of one's own comes in."""

from pathlib import Path

from imgui_bundle import imgui

from station.app.sessions.who_plays import QUESTION
from station.core.settings import load_settings
from station.gui.panels.import_panel import IMPORT, IMPORT_LABEL, PASTE_LABEL, SOURCE_LABEL
from station.gui.panels.lessons.lesson_list import FREE_LABEL
from station.gui.panels.lessons.who_plays import NEW_NAME, WHO_LABEL
from station.gui.panels.lessons_panel import ADD_LABEL
from station.gui.panels.lessons_panel import IMPORT_LABEL as OPEN_IMPORT_LABEL
from station.gui.widgets.level_choice import LEVEL_LABEL
from station.store.opening import history_of
from tests.gui.drive import Drive, open_panel, open_popup, to_list, to_options
from tests.gui.dropped_files import drop_files


def search(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Letters typed into the search field play nothing, and narrow the list."""
    ctx.set_ref("//Lessons")
    ctx.item_click("##search")
    ctx.key_chars("paradiddle")
    ctx.yield_(2)
    drive.seen["keys"] = len(drive.engine.keys)
    drive.seen["shown"] = [card.title for card in drive.state.selection.visible()]
    for course in ("###course-funk", "###course-"):
        open_popup(ctx, "##course")
        ctx.item_click(f"//$FOCUSED/{course}")
        ctx.yield_(2)
        kept = load_settings(drive.settings).course
        drive.seen[kept or "none"] = [card.name for card in drive.state.selection.visible()]
        drive.seen[f"chosen in {kept or 'none'}"] = drive.state.selection.card and drive.state.selection.card.name


def whose(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Another student is written down and plays, a pad lets the first one play again; Start is always at one place."""
    history_of(drive.state.settings).remember("Cem", levels={"rock-1": "beginner"})
    drive.choose(ctx, passes=3)
    places = drive.seen["start"] = [place_of_start(ctx)]
    to_options(ctx)
    open_popup(ctx, LEVEL_LABEL)
    ctx.item_click("//$FOCUSED/###studio")
    ctx.yield_(2)
    drive.seen["levels"] = [str(drive.state.selection.level)]
    ctx.item_click(f"//Lessons/{WHO_LABEL}")
    ctx.yield_(2)
    drive.seen["unread"] = drive.unread(ctx)
    ctx.set_ref(f"//{QUESTION}")
    ctx.item_input_value(NEW_NAME, "  Bea   Bell ")
    drive.wait_until(ctx, lambda state: not state.students.asks)
    ctx.yield_(2)
    drive.seen["plays"] = [drive.state.settings.student]
    drive.seen["levels"].append(str(drive.state.selection.level))  # type: ignore[attr-defined] # a list
    places.append(place_of_start(ctx))
    drive.engine.play_bytes("b0 40 7f")  # a foot switch: the kit asks
    drive.wait_until(ctx, lambda state: state.students.hears)
    drive.seen["listed"] = [[line.name, line.pad] for line in drive.state.students.lines]
    drive.engine.play_bytes("99 32 50")  # the high tom is the second student's
    drive.wait_until(ctx, lambda state: not state.students.asks)
    ctx.yield_(2)
    drive.seen["plays"].append(drive.state.settings.student)  # type: ignore[attr-defined] # a list
    drive.seen["levels"].append(str(drive.state.selection.level))  # type: ignore[attr-defined] # a list
    to_list(ctx)
    ctx.item_input_value("##search", "")
    for name in ("", "##free"):
        choose_row(ctx, name)
        places.append(place_of_start(ctx))


def choose_row(ctx: imgui.test_engine.TestContext, name: str) -> None:
    """Press a line of the list, empty for the first lesson."""
    to_list(ctx)
    ctx.item_click(f"**/{FREE_LABEL}" if name else "**/###rock-1")
    ctx.yield_(3)


def place_of_start(ctx: imgui.test_engine.TestContext) -> list[float]:
    """Where Start is on the screen: left, top, right, bottom."""
    whole = ctx.item_info("//Lessons/Start##start").rect_full
    return [whole.min.x, whole.min.y, whole.max.x, whole.max.y]


def imports(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Music comes in by a typed path, by what is dropped, as GLFW hands it over, and by what was copied."""
    folder = Path.cwd()
    tab = "Title: {}\nTempo: 90\nHH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\n"
    for name in ("typed", "dropped", "copied"):
        (folder / f"{name}.tab").write_text(tab.format(name.title()))
    ctx.set_ref("//Lessons")
    open_popup(ctx, ADD_LABEL)
    ctx.item_click(f"//$FOCUSED/{OPEN_IMPORT_LABEL}")
    ctx.yield_(3)
    ctx.set_ref(f"//{IMPORT}")
    ctx.item_input_value(SOURCE_LABEL, str(folder / "typed.tab"))
    ctx.item_click(IMPORT_LABEL)
    drive.seen["typed"] = drive.imported(ctx, "Typed")
    drop_files([folder / "dropped.tab", folder / "none.mid"])
    drive.seen["dropped"] = drive.imported(ctx, "Dropped")
    drive.wait_until(ctx, lambda state: bool(state.imports.fault))
    drive.seen["fault"] = drive.state.imports.fault
    imgui.set_clipboard_text((folder / "copied.tab").as_uri())
    ctx.item_click(f"//{IMPORT}/{PASTE_LABEL}")
    drive.seen["copied"] = drive.imported(ctx, "Copied")
    open_panel(ctx, IMPORT)  # and close it again
