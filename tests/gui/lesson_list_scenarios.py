"""The lessons page: its list is searched, and music of one's own comes in."""

from pathlib import Path

from imgui_bundle import imgui

from station.core.settings import load_settings
from station.gui.panels.import_panel import IMPORT, IMPORT_LABEL, PASTE_LABEL, SOURCE_LABEL
from station.gui.panels.lessons_panel import ADD_LABEL
from station.gui.panels.lessons_panel import IMPORT_LABEL as OPEN_IMPORT_LABEL
from tests.gui.drive import Drive, open_panel
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
        ctx.item_click("##course")
        ctx.item_click(f"//$FOCUSED/{course}")
        ctx.yield_(2)
        kept = load_settings(drive.settings).course
        drive.seen[kept or "none"] = [card.name for card in drive.state.selection.visible()]
        drive.seen[f"chosen in {kept or 'none'}"] = drive.state.selection.card and drive.state.selection.card.name


def imports(drive: Drive, ctx: imgui.test_engine.TestContext) -> None:
    """Music comes in by a typed path, by what is dropped, as GLFW hands it over, and by what was copied."""
    folder = Path.cwd()
    tab = "Title: {}\nTempo: 90\nHH|x-x-x-x-x-x-x-x-|\nSD|----o-------o---|\n"
    for name in ("typed", "dropped", "copied"):
        (folder / f"{name}.tab").write_text(tab.format(name.title()))
    ctx.set_ref("//Lessons")
    ctx.item_click(ADD_LABEL)
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
