"""Films a whole battle in the window: `python docs/pictures/battle_film.py [--size WxH] [--to FOLDER] --film FILE.mp4`.

Run from the project's root; it needs Xvfb, and jackd for a sound card. Everything is the station's own, in real time:
window, engine in its process, a kit whose bytes come over a serial line. Somebody at that kit chooses by pads, repeats
what is called, then trades bars; pictures of the stops are kept in FOLDER.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from imgui_bundle import imgui

ROOT, WALK = Path(__file__).parents[2], Path(__file__).with_name("walk")
sys.path[:0] = [str(ROOT), str(WALK)]

from pty_student import SNARE, PtyStudent  # noqa: E402
from real_room import Context, RealRoom  # noqa: E402

from station.app.actions.battle_actions import ChooseBattle  # noqa: E402
from station.app.battle.battle_shown import BattleStage  # noqa: E402
from station.app.room_state import Stage  # noqa: E402
from station.app.settings.chosen_battle import ChosenBattle  # noqa: E402
from station.bench.rigs.devices.jack_server import JackServer  # noqa: E402
from station.gui.panels.lessons.lesson_list import BATTLE_LABEL  # noqa: E402
from station.practice.battle.battle_rules import BattleMode  # noqa: E402
from station.render.snapshot import Snapshot  # noqa: E402
from tests.gui.battle_student import BattleStudent, answer_of_the_call  # noqa: E402
from tests.gui.drive import to_list  # noqa: E402
from tests.gui.x_server import screen  # noqa: E402

_FRAMES_A_SECOND = 10
_REPEATS = ChosenBattle(rounds=2, seed=4)
_TRADES = replace(ChosenBattle().against("pocket"), mode=BattleMode.IMPROVISE, rounds=1, bars=2, seed=4)


class BattleKit(PtyStudent):
    """The fake kit, at which somebody battles."""

    def battle(self, room: RealRoom) -> None:
        """Look at what is called, and make up one's mind."""
        battle = room.station.parts.sessions.practice.battle
        if battle is None or room.room.stage is not Stage.PLAYING:
            self.drummer = BattleStudent("pro,seed=4,velocity_sd=12", answer_of_the_call)
            return
        self._play(self.drummer.strokes(battle))


class BattleRoom(RealRoom):
    """The walk's room, whose student battles."""

    def _frame_is_shown(self, snapshot: Snapshot | None) -> bool:
        assert isinstance(self.student, BattleKit)
        self.student.battle(self)
        return super()._frame_is_shown(snapshot)


def battles(room: BattleRoom, ctx: Context, folder: Path) -> None:
    """Both modes, begun by the snare."""
    ctx.key_press(imgui.Key.escape)
    ctx.yield_(3)
    to_list(ctx)
    ctx.item_click(f"**/{BATTLE_LABEL}")
    room.wait_until(ctx, lambda state: state.battle.stage is BattleStage.CHOOSING)
    room.wait_until(ctx, lambda state: bool(state.room.kit))
    for chosen in (_REPEATS, _TRADES):
        name, sides = chosen.mode.value, 2 if chosen.mode is BattleMode.IMPROVISE else 1
        room.station.dispatch(ChooseBattle(chosen))
        room.wait_until(ctx, lambda state: state.choice is not None and state.choice.hears)
        room.keep(ctx, folder / f"{name}-1-chosen")
        assert isinstance(room.student, BattleKit)
        room.student.strike(SNARE)
        room.wait_until(ctx, lambda state: state.room.stage is Stage.PLAYING)
        room.wait_until(ctx, lambda state, sides=sides: len(state.battle.board.verdicts) == sides)
        room.keep(ctx, folder / f"{name}-2-played")
        room.wait_until(ctx, lambda state: state.battle.result is not None)
        ctx.yield_(10)
        room.keep(ctx, folder / f"{name}-3-over")
        ctx.key_press(imgui.Key._2)
        room.wait_until(ctx, lambda state: state.battle.replays)
        ctx.yield_(20)
        room.keep(ctx, folder / f"{name}-4-replay")
        room.wait_until(ctx, lambda state: not state.battle.replays)
        ctx.key_press(imgui.Key.escape)
        room.wait_until(ctx, lambda state: state.battle.stage is BattleStage.CHOOSING)


def film(size: str, folder: Path, path: Path) -> None:
    """Play on this screen, and keep it as a video."""
    width, height = map(int, size.split("x"))
    asked = [
        sys.executable,
        str(WALK / "screen_film.py"),
        os.environ["DISPLAY"],
        size,
        f"{_FRAMES_A_SECOND}",
        str(path),
    ]
    with tempfile.TemporaryDirectory() as home, BattleKit(Path(home) / "ttyUSB0") as student:
        sessions = Path(home) / "sessions"
        sessions.mkdir()
        room = BattleRoom(sessions, student, (width, height), 1.0)
        camera = subprocess.Popen(asked, stdin=subprocess.PIPE)
        try:
            room.run([lambda room, ctx: battles(room, ctx, folder)])
        finally:
            room.close()
            camera.communicate()
        for seen in room.all_seen:
            if "traceback" in seen:
                raise SystemExit(str(seen["traceback"]))


def main() -> None:
    """Film, on a screen of its own unless told that it is `--here`."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--to", type=Path, default=Path(tempfile.gettempdir()))
    parser.add_argument("--film", type=Path, required=True)
    parser.add_argument("--here", action="store_true")
    asked = parser.parse_args()
    if asked.here:
        asked.to.mkdir(parents=True, exist_ok=True)
        film(asked.size, asked.to, asked.film)
        return
    for environment in screen(asked.size):
        with tempfile.TemporaryDirectory() as config, JackServer(period_frames=256, patient=True) as jack:
            inside = {
                **environment,
                **jack.env,
                "DISPLAY": environment["DISPLAY"],
                "XDG_CONFIG_HOME": config,
                "XDG_DATA_HOME": config,
            }
            subprocess.run([sys.executable, *sys.argv, "--here"], env=inside, check=True)


if __name__ == "__main__":
    main()
