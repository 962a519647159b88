"""Processes that draw pictures in turn: the same pictures as one alone draws, and what becomes of them when one ends.

What is expected was drawn in this process, picture by picture.
"""

import os
import signal
import sys
from collections.abc import Iterator
from contextlib import closing
from dataclasses import replace
from multiprocessing import active_children
from pathlib import Path
from subprocess import PIPE, STDOUT, Popen

import numpy as np
import pytest

from station.core.errors import DeviceError
from station.core.named_view import NamedView
from station.motion.drummer import Drummer
from station.motion.kinematics.figure import figure_of
from station.motion.kit.kit import load_kit
from station.render.framing import named
from station.render.picture import Artist, Shot, renderer_name
from station.render.quality import QUALITIES
from station.render.render_pool import RenderPool, artist
from station.render.snapshot import Snapshot
from station.scenes.pictures import picture_of
from tests.unit.render.scores import rock

pytestmark = pytest.mark.gl

DRUMMER = Drummer(rock(1), load_kit(), figure_of())
SHOT = Shot((162, 90), QUALITIES[0], named(NamedView.FRONT))
SHOWN = [picture_of(DRUMMER, -0.2 + k / 9) for k in range(15)]  # more than two processes are asked for at once
FAR = 120.0
"""Seconds that nothing here takes, however busy the machine is."""


@pytest.fixture(scope="module")
def drawers() -> Iterator[RenderPool]:
    with closing(RenderPool(SHOT, 2)) as two:
        yield two


@pytest.fixture(scope="module")
def alone() -> Iterator[Artist]:
    with closing(Artist(SHOT)) as one:
        yield one


def test_several_draw_what_one_draws_in_order(drawers: RenderPool, alone: Artist) -> None:
    expected = list(alone.film(SHOWN))
    assert len({planes.tobytes() for planes in expected}) == len(SHOWN)  # no picture stands for another
    drawn = list(drawers.film(SHOWN))
    assert len(drawn) == len(SHOWN)
    assert all(np.array_equal(ours, theirs) for ours, theirs in zip(drawn, expected, strict=True))


def test_several_write_the_files_that_one_writes(drawers: RenderPool, alone: Artist, tmp_path: Path) -> None:
    ours, theirs = ([tmp_path / who / f"{k}.png" for k in range(7)] for who in ("ours", "theirs"))
    assert list(drawers.pngs(SHOWN[:7], ours)) == ours
    list(alone.pngs(SHOWN[:7], theirs))
    assert [path.read_bytes() for path in ours] == [path.read_bytes() for path in theirs]


def test_a_drummer_who_leaves_and_another_score_are_drawn_too(drawers: RenderPool, alone: Artist) -> None:
    other = Drummer(rock(2), load_kit(), figure_of())
    nobody = Snapshot(DRUMMER.score, 0.5, DRUMMER.kit, DRUMMER.figure)
    shown = [SHOWN[0], nobody, picture_of(other, 0.5), nobody, SHOWN[1]]
    for ours, theirs in zip(drawers.film(shown), alone.film(shown), strict=True):
        assert np.array_equal(ours, theirs)


def test_a_disk_that_refuses_is_told_and_nobody_is_left(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("no folder")
    odd = replace(SHOT, size=(161, 91))  # files may have any size
    before = set(active_children())
    with closing(RenderPool(odd, 1)) as one, pytest.raises(DeviceError, match="cannot be written"):
        list(one.pngs(SHOWN[:2], [tmp_path / "file" / f"{k}.png" for k in range(2)]))
    assert set(active_children()) <= before


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_a_process_that_dies_is_told_and_nobody_is_left() -> None:
    before = set(active_children())
    with closing(RenderPool(SHOT, 2)) as two:
        pictures = two.film(SHOWN * 100)
        mine = set(active_children()) - before
        assert len(mine) == 2
        os.kill(next(iter(mine)).pid or 0, signal.SIGKILL)
        with pytest.raises(DeviceError, match=r"has ended \(exit code -9\)"):
            list(pictures)
    assert set(active_children()) <= before


def test_a_film_given_up_leaves_nobody() -> None:
    before = set(active_children())
    with closing(RenderPool(SHOT, 1)) as one:
        next(one.film(SHOWN))
    assert set(active_children()) <= before


ORPHANED = """
import sys
if __name__ == "__main__":
    from station.render.render_pool import RenderPool
    from station.render.picture import Shot
    two = RenderPool(Shot(), 2)
    print("begun", flush=True)
    sys.stdin.read()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such signal")
def test_who_is_orphaned_ends(tmp_path: Path) -> None:
    script = tmp_path / "orphaned.py"
    script.write_text(ORPHANED, encoding="utf-8")
    words, where = [sys.executable, str(script)], {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    with Popen(words, stdin=PIPE, stdout=PIPE, stderr=STDOUT, text=True, env=where) as parent:
        assert parent.stdout is not None
        assert parent.stdout.readline() == "begun\n"
        parent.kill()
        said, _ = parent.communicate(timeout=FAR)  # its end is there when all that hold it, the drawers too, have ended
    assert said == ""


def test_processes_draw_many_pictures_where_the_processor_draws() -> None:
    before = set(active_children())
    with artist(SHOT, 1) as who:
        assert isinstance(who, Artist)
    with artist(SHOT, 10_000) as who:
        crew = len(set(active_children()) - before)
        assert isinstance(who, RenderPool) == (crew > 0)
        cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1  # Linux alone
        if "llvmpipe" not in renderer_name() or cores == 1:
            assert crew == 0
        else:
            assert 2 <= crew <= cores
    assert set(active_children()) <= before
