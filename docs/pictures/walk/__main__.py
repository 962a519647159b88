"""An hour with the station, walked by a script: `python docs/pictures/walk [--size WxH] [--to DIR]`.

Run from the project's root; it needs Xvfb, and jackd for a sound card. Everything is the station's own, in real time:
window, engine in its process, a kit whose bytes come over a serial line. Somebody at the kit plays what is asked as
well as they can, and a hand at the mouse does the rest. At each stop a picture of the screen is kept; `--film FILE`
keeps the screen as a video.
"""

import argparse
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from imgui_bundle import imgui

ROOT = Path(__file__).parents[3]
sys.path.insert(0, str(ROOT))

from pty_student import PtyStudent  # noqa: E402
from real_room import Context, RealRoom  # noqa: E402
from stops import STOPS  # noqa: E402

from station.bench.rigs.devices.jack_server import JackServer, jackd_is_installed  # noqa: E402
from tests.gui.x_server import screen  # noqa: E402

_FRAMES_A_SECOND = 10


@contextmanager
def _filmed(size: str, path: Path | None) -> Iterator[None]:
    """Film the screen at `path`, if there is one, while the block lasts."""
    if path is None:
        yield
        return
    script = Path(__file__).with_name("screen_film.py")
    asked = [sys.executable, str(script), os.environ["DISPLAY"], size, str(_FRAMES_A_SECOND), str(path)]
    camera = subprocess.Popen(asked, stdin=subprocess.PIPE)
    try:
        yield
    finally:
        camera.communicate()


def walk(size: str, scale: float, folder: Path, film: Path | None, only: list[str]) -> None:
    """Walk on this screen, and keep a picture of every stop in `folder`."""
    width, height = map(int, size.split("x"))
    with tempfile.TemporaryDirectory() as home, PtyStudent(Path(home) / "ttyUSB0") as student:
        sessions = Path(home) / "sessions"
        sessions.mkdir()
        room = RealRoom(sessions, student, (width, height), scale)

        stumbles: list[str] = []

        def whole(room: RealRoom, ctx: Context) -> None:
            if only and only[0] != STOPS[0].__name__:
                ctx.key_press(imgui.Key.escape)
            for place, stop in enumerate(STOPS, 1):
                if only and stop.__name__ not in only:
                    continue
                sys.stderr.write(f"{place:02d} {stop.__name__}\n")
                try:
                    stop(room, ctx)
                except AssertionError as missed:  # the walk goes on, and says at its end where it stumbled
                    stumbles.append(f"{stop.__name__}: {missed}")
                room.keep(ctx, folder / f"{place:02d}-{stop.__name__.replace('_', '-')}")

        try:
            with _filmed(size, film):
                room.run([whole])
        finally:
            room.close()
        for seen in room.all_seen:
            if "traceback" in seen:
                raise SystemExit(str(seen["traceback"]))
        if stumbles:
            raise SystemExit("\n".join(stumbles))


def main() -> None:
    """Walk, on a screen of its own unless told that it is `--here`."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", default="1280x720")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--to", type=Path, default=Path(__file__).parents[1] / "hour")
    parser.add_argument("--film", type=Path)
    parser.add_argument("only", nargs="*", metavar="STOP", help="these alone; all by default")
    parser.add_argument("--here", action="store_true")
    asked = parser.parse_args()
    if asked.here:
        asked.to.mkdir(parents=True, exist_ok=True)
        walk(asked.size, asked.scale, asked.to, asked.film, asked.only)
        return
    for environment in screen(asked.size):
        with tempfile.TemporaryDirectory() as config, JackServer(period_frames=256, patient=True) as jack:
            assert jackd_is_installed()
            inside = {**environment, **jack.env, "DISPLAY": environment["DISPLAY"], "XDG_CONFIG_HOME": config}
            subprocess.run([sys.executable, *sys.argv, "--here"], env=inside, check=True)


if __name__ == "__main__":
    main()
