"""The editor's notation and its words in the real window: clicks on the staff and fields that are filled in."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.gui.staff_scenarios import BARE
from tests.gui.test_window import ROOT, run
from tests.gui.x_server import screen

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

HEAD = 'title = "Groove"\ntempo_bpm = 90\n\n[grid]\n#          1& 2& 3& 4&   1& 2& 3& 4&\n'
HIHAT = 'hihat = "| xx xx xx xx | xx xx xx xx |"\n'
SNARE = 'snare = "| -- o- -- o- | -- o- -- o- |"\n'
KICK = 'kick  = "| o- -- o- -- | o- -- oo -- |"\n'
"""Eighths on the hi-hat, the snare on two and four, the kick on one and three and on the "and" of the last three."""


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    for found in screen("1300x1320"):
        home = tmp_path_factory.mktemp("config")
        yield {**found, "PYTHONPATH": str(ROOT), "XDG_CONFIG_HOME": str(home), "XDG_DATA_HOME": str(home / "data")}


def test_a_groove_is_written_by_clicks_on_the_staff(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("clicks", environment, tmp_path)
    assert seen["written"] == HEAD + HIHAT + SNARE + KICK
    assert seen["erased"] == HEAD + HIHAT + SNARE + KICK.replace("oo", "o-")
    ghost = HEAD + HIHAT + SNARE.replace("o", "g", 1) + KICK.replace("oo", "o-")
    assert seen["ghost"] == ghost
    assert seen["selected"] == [0, 1]
    assert seen["after drag"] == ghost, "a drag writes nothing"


def test_words_are_filled_in_and_faults_stand_beside_them(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("words", environment, tmp_path)
    grid = BARE.partition("\n\n")[2]
    filled = seen["filled"]
    for line in ('title = "Groove 2"', "tempo_bpm = 104", 'tags = ["rock", "two bars"]', "level = 2"):
        assert line in filled.splitlines()
    assert filled.endswith(grid)
    assert len(filled.splitlines()) == len(BARE.splitlines()) + 2
    assert seen["emptied"] == filled.replace("level = 2\n", "")
    assert seen["refused"] == seen["emptied"]
    assert any("10 to 1000" in fault for fault in seen["faults"])
    assert seen["unread"] == []
