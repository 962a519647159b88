"""A folder in which a session or a battle begins holds neither before."""

from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.settings import Settings
from station.practice.battle.records.battle_folder import BattleFolder
from station.practice.records.save_session import SessionFolder


@pytest.mark.parametrize("name", ["session.capture", "report.json", "take.json", "battle.capture", "battle.json"])
def test_a_folder_that_holds_a_session_or_a_battle_takes_no_other(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "wanted"
    folder.mkdir()
    (folder / name).write_bytes(b"what was played")
    what = "battle" if name.startswith("battle") else "session"
    for begin in (SessionFolder.make, BattleFolder.make):
        with pytest.raises(BadInput, match=f"there is a {what} in this folder already"):
            begin(folder, Settings(), "rock-1")
    assert [path.name for path in folder.iterdir()] == [name]


def test_an_empty_folder_is_taken_and_one_that_was_made_goes_again(tmp_path: Path) -> None:
    (tmp_path / "theirs").mkdir()
    for begin in (SessionFolder.make, BattleFolder.make):
        for name in ("theirs", "ours"):
            with begin(tmp_path / name, Settings(), "rock-1") as folder:
                assert folder.path.is_dir()
            assert (tmp_path / name).is_dir() == (name == "theirs")
