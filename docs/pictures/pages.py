"""Keeps a screenshot of every page of the window: `python docs/pictures/pages.py [--size WxH] [--scale N] [--to DIR]`.

Run from the project's root; it needs Xvfb and takes some ten seconds a page without a graphics card. Pages share a
window where they can, driven by imgui's test engine as in `tests/gui`. What imgui has cut off or written over itself is
told; look at each picture all the same. 1280x720 at scale 1 is what `docs/window.md` shows; look at 760x480, 1920x1080
and 3840x2160 too. `--scale` is the user's own, beyond what the window's size gives (`station.gui.panel_size`): a dense
screen needs none.
"""

import argparse
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import date, datetime, timedelta
from pathlib import Path

import numpy as np
from imgui_bundle import imgui

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT))

from station.app.actions.file_actions import Export, Import  # noqa: E402
from station.app.actions.phase_actions import OpenMotion, SeekMotion  # noqa: E402
from station.app.actions.practice_actions import Begin  # noqa: E402
from station.app.actions.settings_actions import AskWhoPlays, SetView  # noqa: E402
from station.app.actions.style_actions import EditStyle  # noqa: E402
from station.app.room_state import Stage  # noqa: E402
from station.core.imu import Mounting  # noqa: E402
from station.core.pieces import Limb, Piece, Zone  # noqa: E402
from station.core.settings import load_settings  # noqa: E402
from station.devices.mapping.stick_file import save_stick  # noqa: E402
from station.drills.library import find_lesson  # noqa: E402
from station.drills.mastery.next_pass import new_item  # noqa: E402
from station.drills.mastery.practice_steps import item_of  # noqa: E402
from station.drills.mastery.probes import Probes  # noqa: E402
from station.drills.mastery.reviews import Review  # noqa: E402
from station.gui.panels.devices.calibration_part import DROP_LABEL, MEASURE_LABEL  # noqa: E402
from station.gui.panels.devices.devices_panel import DEVICES  # noqa: E402
from station.gui.panels.devices.pads_part import LEARN_LABEL as LEARN_PAD_LABEL  # noqa: E402
from station.gui.panels.devices.sticks_panel import GESTURE_LABEL, STICKS  # noqa: E402
from station.gui.panels.export_panel import EXPORT  # noqa: E402
from station.gui.panels.figure.style_panel import FIGURE  # noqa: E402
from station.gui.panels.hits_panel import HITS  # noqa: E402
from station.gui.panels.import_panel import IMPORT  # noqa: E402
from station.gui.panels.lessons.lesson_list import FREE_LABEL  # noqa: E402
from station.gui.panels.lessons.who_plays import WHO_LABEL  # noqa: E402
from station.gui.panels.phase_panel import PHASE  # noqa: E402
from station.gui.panels.playback_row import PREVIOUS_LABEL  # noqa: E402
from station.gui.panels.practice_panel import PRACTICE  # noqa: E402
from station.gui.panels.sound.sound_panel import CLICK_TAB, DRUMS_TAB, LEVELS_TAB, OUTPUT_TAB, SOUND, TRACK_TAB  # noqa: E402
from station.gui.panels.view_popup import LOOK_LABEL  # noqa: E402
from station.practice.history.old_mastery import mastery_row  # noqa: E402
from station.practice.history.session_files import session_name  # noqa: E402
from station.render.files.png_file import write_png  # noqa: E402
from station.render.gpu.moving_parts import DoublePlace  # noqa: E402
from station.store.opening import history_of  # noqa: E402
from station.store.rows import KeptSession, SessionRow  # noqa: E402
from station.sync.air.air_file import air_path, save_air  # noqa: E402
from station.sync.air.air_zones import AirKit, AirZone  # noqa: E402
from tests.fakes.stick_physics import Sensor, Stroke, measured, strokes_by_angle  # noqa: E402
from tests.fakes.walker_files import write_walker  # noqa: E402
from tests.gui.drive import NEWCOMER, Drive, Scenario, open_panel, press_view  # noqa: E402
from tests.gui.newcomer_scenario import begin  # noqa: E402
from tests.gui.x_server import screen  # noqa: E402

Context = imgui.test_engine.TestContext
STUDENT = "intermediate,seed=4"
GROOVE = (
    "https://www.mikeslessons.com/groove/?TimeSig=4/4&Div=16&Title=Half-time%20shuffle&Tempo=88&Measures=1"
    "&H=|x-x-x-x-x-x-x-x-|&S=|--g-O-g--gO-g-gg|&K=|o--o--o---o--o--|"
)
ENOUGH_JUDGED = 20
STROKES = ("99 26 50", "99 24 64", "99 26 0c", "99 2e 40", "99 33 5a", "99 24 58", "99 26 09", "99 31 6e", "99 26 61")


def _lessons(drive: Drive, ctx: Context) -> None:
    ctx.yield_(2)


def _learnt(drive: Drive) -> None:
    """Somebody is in the middle of a course: a lesson mastered, one due again today, one begun."""
    today, settings = date.today(), load_settings(drive.settings)
    for name, probes, review in (
        ("rock-1", Probes(70.0, 100.0, 2), Review(today, 0, today + timedelta(days=3))),
        ("single-stroke-roll", Probes(70.0, 100.0, 2), Review(today - timedelta(days=1), 0, today)),
        ("rock-2", Probes(70.0, 85.0), Review()),
    ):
        lesson = find_lesson(name)
        state = replace(new_item(item_of(lesson), today), probes=probes, review=review)
        history_of(settings).remember(settings.student, [mastery_row(state)])


def _courses(drive: Drive, ctx: Context) -> None:
    ctx.set_ref("//Lessons")
    ctx.item_click("##course")
    ctx.item_click("//$FOCUSED/###course-first-beats")
    ctx.yield_(3)


def _who(drive: Drive, ctx: Context) -> None:
    """Three who practised here, and the one who plays."""
    settings = load_settings(drive.settings)
    for name, day in (("Ann Lee", 1), ("Bea", 2), ("Cem", 9)):
        started = datetime.now() - timedelta(days=day)
        row = SessionRow(name, session_name(started, "rock-1"), started, "", lesson="rock-1")
        history_of(settings).keep(KeptSession(row))
    ctx.item_click(f"//Lessons/{WHO_LABEL}")
    ctx.yield_(20)


def _look(drive: Drive, ctx: Context) -> None:
    press_view(ctx, LOOK_LABEL)
    ctx.yield_(3)


def _help(drive: Drive, ctx: Context) -> None:
    ctx.key_press(imgui.Key.f1)
    ctx.yield_(3)


def _playing(drive: Drive, ctx: Context) -> None:
    drive.choose(ctx, passes=4)
    ctx.item_click("Start##start")
    for _ in range(1000):
        ctx.yield_()
        if drive.picture.hud.judged > ENOUGH_JUDGED:
            break


def _first_groove(drive: Drive, ctx: Context) -> None:
    begin(ctx)
    ctx.yield_(60)  # 6 s: in the demonstration


def _first_result(drive: Drive, ctx: Context) -> None:
    begin(ctx)
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(3)


def _result(drive: Drive, ctx: Context) -> None:
    drive.choose(ctx, passes=1)
    ctx.item_click("Start##start")
    drive.wait_for(ctx, Stage.RESULT)
    drive.answer(ctx)
    ctx.set_ref("//Transport")
    ctx.yield_(1)


def _question(drive: Drive, ctx: Context) -> None:
    drive.choose(ctx, passes=1)
    ctx.item_click("Start##start")
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(12)


def _compared(drive: Drive, ctx: Context) -> None:
    _result(drive, ctx)
    drive.station.dispatch(Begin())
    drive.wait_for(ctx, Stage.RESULT)
    ctx.yield_(3)
    ctx.set_ref("//Bars")
    ctx.item_click(f"**/{PREVIOUS_LABEL}")
    ctx.yield_(14)


def _just_play(drive: Drive, ctx: Context) -> None:
    ctx.set_ref("//Lessons")
    ctx.item_click(f"**/{FREE_LABEL}")
    ctx.yield_(3)


def _devices(drive: Drive, ctx: Context) -> None:
    open_panel(ctx, DEVICES)
    for text in STROKES:
        ctx.yield_(8)
        drive.engine.play_bytes(text)
    ctx.yield_(3)


def _touch(drive: Drive, ctx: Context) -> None:
    _devices(drive, ctx)
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click("##pads/snare##pad-snare")
    ctx.item_click("light##shape")
    ctx.yield_(2)
    ctx.mouse_move_to_pos(imgui.ImVec2(0, 0))
    ctx.yield_(2)


def _sticks(drive: Drive, ctx: Context) -> None:
    """A pair: the right one strikes, the left one lies; both have made the gesture, and an air kit is learnt."""
    kit = AirKit(
        tuple(
            AirZone(limb, piece, Zone.HEAD, 0.4 * place, 0.0, 0.1, 0.14)
            for limb, pieces in (
                (Limb.RIGHT_HAND, (Piece.SNARE, Piece.HIHAT, Piece.RIDE)),
                (Limb.LEFT_HAND, (Piece.SNARE, Piece.TOM_1)),
            )
            for place, piece in enumerate(pieces)
        )
    )
    save_air(kit, air_path())
    drive.station.parts.sticks.begin()
    open_panel(ctx, STICKS)
    for device, limb, rate_hz in (("x-IMU3 4711", Limb.RIGHT_HAND, 400.0), ("x-IMU3 4712", Limb.LEFT_HAND, 200.0)):
        save_stick(Mounting(limb, learnt=True), device)
        drive.engine.plug_stick(device)
        angle, _, _ = strokes_by_angle([Stroke(0.5)] * 4, rest_s=2.0)
        if limb is Limb.LEFT_HAND:
            angle = np.full(len(angle), 0.0)
        drive.engine.move_stick(device, measured(angle, Sensor(rate_hz)))
    ctx.yield_(8)


def _gesture(drive: Drive, ctx: Context) -> None:
    _sticks(drive, ctx)
    ctx.item_click(f"//{STICKS}/{GESTURE_LABEL}")
    ctx.yield_(75)


def _phase(drive: Drive, ctx: Context) -> None:
    """A body that nobody was: what the database has may not be passed on."""
    walker = write_walker(Path())
    open_panel(ctx, PHASE)
    drive.station.dispatch(OpenMotion(walker, walker))
    while drive.state.phase.scene is None:
        ctx.yield_(2)
    drive.station.dispatch(SeekMotion(4.0))
    ctx.yield_(8)


def _which_pad(drive: Drive, ctx: Context) -> None:
    _devices(drive, ctx)
    drive.engine.play_bytes("99 0e 40")
    ctx.yield_(2)
    ctx.item_click(f"//{DEVICES}/{LEARN_PAD_LABEL}")
    ctx.yield_(3)


def _calibration(drive: Drive, ctx: Context) -> None:
    open_panel(ctx, DEVICES)
    ctx.set_ref(f"//{DEVICES}")
    ctx.item_click("Strike##by")
    ctx.item_click(MEASURE_LABEL)
    ctx.yield_(6)
    ctx.mouse_move(DROP_LABEL)


def _double(drive: Drive, ctx: Context) -> None:
    drive.station.dispatch(SetView(replace(drive.state.view_settings, double=DoublePlace.BESIDE)))
    _playing(drive, ctx)


def _lanes(drive: Drive, ctx: Context) -> None:
    open_panel(ctx, FIGURE)
    lane = ((1.0, 30.0), (1.75, 45.0), (2.0, 85.0), (3.0, 60.0))
    drive.station.dispatch(EditStyle(drive.state.style.options.draw_lane("amplitude_gain", lane)))
    ctx.set_ref(f"//{FIGURE}")
    ctx.item_click("##figure/Bars")


def _imported(drive: Drive, ctx: Context) -> None:
    """A groove as people send it; its title is its own."""
    open_panel(ctx, IMPORT)
    drive.station.dispatch(Import(GROOVE))
    drive.wait_until(ctx, lambda state: state.imports.kept is not None)
    ctx.yield_(8)


def _exported(drive: Drive, ctx: Context) -> None:
    open_panel(ctx, EXPORT)
    drive.station.dispatch(Export(".chart"))
    drive.wait_until(ctx, lambda state: state.export.written is not None)
    ctx.yield_(8)


def _sound(tab: str) -> Callable[[Drive, Context], None]:
    def prepare(drive: Drive, ctx: Context) -> None:
        open_panel(ctx, SOUND)
        drive.wait_until(ctx, lambda state: state.sound.shelf is not None)
        drive.window.pages.sound.leaf = tab
        ctx.yield_(4)

    return prepare


def _track(drive: Drive, ctx: Context) -> None:
    """A track whose beat was found."""
    settings = {"track": "~/Music/slow-blues.ogg", "with_track": True, "track_bpm": 96.0, "track_start_s": 1.437}
    drive.station.parts.store.update(lambda before: replace(before, **settings))
    _sound(TRACK_TAB)(drive, ctx)


def _tool(name: str) -> Callable[[Drive, Context], None]:
    return lambda drive, ctx: open_panel(ctx, name)


def _beside_a_result(name: str) -> Callable[[Drive, Context], None]:
    def prepare(drive: Drive, ctx: Context) -> None:
        _result(drive, ctx)
        open_panel(ctx, name)

    return prepare


PAGES: Mapping[str, Callable[[Drive, Context], None]] = {
    "welcome": _lessons,
    "first-groove": _first_groove,
    "first-result": _first_result,
    "lessons": _lessons,
    "who": _who,
    "look": _look,
    "help": _help,
    "figure": _tool(FIGURE),
    "graph": _tool("Graph"),
    "practice": _tool(PRACTICE),
    "take-along": _exported,
    "import": _imported,
    "devices": _devices,
    "touch": _touch,
    "which-pad": _which_pad,
    "sticks": _sticks,
    "gesture": _gesture,
    "sound": _sound(CLICK_TAB),
    "sound-levels": _sound(LEVELS_TAB),
    "sound-drums": _sound(DRUMS_TAB),
    "sound-track": _track,
    "sound-output": _sound(OUTPUT_TAB),
    "phase": _phase,
    "calibration": _calibration,
    "figure-bars": _lanes,
    "courses": _courses,
    "just-play": _just_play,
    "playing": _playing,
    "question": _question,
    "result": _result,
    "hits": _beside_a_result(HITS),
    "compared": _compared,
    "double": _double,
}
"""What is done before each picture is taken."""
_STUDENTS = {
    "welcome": NEWCOMER,
    **dict.fromkeys(("first-groove", "first-result"), f"{NEWCOMER},seed=2,sd_ms=30,bias_ms=95"),
    "courses": None,
    **dict.fromkeys(("playing", "question", "result", "hits", "compared", "double"), STUDENT),
}
"""Who plays on pages that need a window of their own: they leave something behind, or need it."""


def draw(pages: Sequence[str], size: tuple[int, int], scale: float, folder: Path) -> None:
    """Open a window of `size`, go to each of `pages` and keep its picture in `folder`."""
    with tempfile.TemporaryDirectory() as sessions:
        drive = Drive(Path(sessions), _STUDENTS.get(pages[0]), size=size)
        drive.station.dispatch(SetView(replace(drive.state.view_settings, scale=scale)))
        if "courses" in pages:
            _learnt(drive)
        drive.run([_shown(page, size, folder / f"{page}.png") for page in pages])
        drive.station.close()
        for page, seen in zip(pages, drive.all_seen, strict=False):
            if "traceback" in seen:
                raise SystemExit(f"{page}: {seen['traceback']}")


def _shown(page: str, size: tuple[int, int], path: Path) -> Scenario:
    def show(drive: Drive, ctx: Context) -> None:
        _close_tools(drive)
        PAGES[page](drive, ctx)
        ctx.mouse_move_to_pos(imgui.ImVec2(size[0] - 3, 3))
        write_png(drive.shot(ctx), path)
        if page == "help":
            ctx.key_press(imgui.Key.f1)
        for fault in drive.faults:
            sys.stderr.write(f"{path.stem}: {fault}\n")

    return show


def _close_tools(drive: Drive) -> None:
    drive.station.dispatch(AskWhoPlays(on=False))
    for page in drive.window.pages.tools:
        drive.window.params.docking_params.dockable_window_of_name(page.name).is_visible = False


def _windows(pages: Sequence[str]) -> Iterator[list[str]]:
    """The pages of each window."""
    shared = [page for page in pages if page not in _STUDENTS]
    yield from [shared] if shared else []
    yield from ([page] for page in pages if page in _STUDENTS)


def main() -> None:
    """Draw the pages that were named, all by default, one window after the other."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="*", default=[*PAGES], metavar="PAGE", help=f"of {', '.join(PAGES)}")
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--to", type=Path, default=Path(__file__).with_name("pages"))
    parser.add_argument("--here", action="store_true", help="on this screen, in one window")
    wish = parser.parse_args()
    width, height = map(int, wish.size.split("x"))
    wish.to.mkdir(parents=True, exist_ok=True)
    if wish.here:
        draw(wish.pages, (width, height), wish.scale, wish.to)
        return
    for environment in screen(wish.size):
        with tempfile.TemporaryDirectory() as config:
            for pages in _windows(wish.pages):
                asked = [
                    sys.executable,
                    __file__,
                    *pages,
                    "--size",
                    wish.size,
                    "--scale",
                    str(wish.scale),
                    "--here",
                    "--to",
                ]
                inside = {**environment, "XDG_CONFIG_HOME": config, "XDG_DATA_HOME": config}
                subprocess.run([*asked, str(wish.to.absolute())], env=inside, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
