"""`station battle` as it is typed."""

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from station.cli.command_line import main
from station.practice.battle.opponents.opponent import OPPONENTS

SHORT = ["--headless", "--rounds", "1", "--no-final", "--bars", "1", "--tempo", "150"]


def document(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, Any]:
    assert main(["battle", *words, "--json"]) == 0
    said: dict[str, Any] = json.loads(capsys.readouterr().out)
    return said


@pytest.mark.parametrize("mode", ["repeat", "improvise"])
@pytest.mark.parametrize("opponent", list(OPPONENTS))
def test_every_opponent_plays_both_modes(
    opponent: str, mode: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--mode", mode, "--opponent", opponent, *SHORT, "--virtual-student", "pro", "--report", str(tmp_path)]
    said = document(capsys, *words)
    assert said["schema"] == "drum-station/battle/1"
    assert [turn["kind"] for turn in said["rounds"][0]["turns"]] == ["call", "answer"]
    assert json.loads((tmp_path / "battle.json").read_text()) == said
    assert (tmp_path / "battle.txt").read_text().startswith("Virtual pro against ")


def test_the_same_seed_is_the_same_battle_and_judging_it_again_gives_it_once_more(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--mode", "improvise", *SHORT, "--virtual-student", "beginner,seed=4"]
    first = document(capsys, *words, "--report", str(tmp_path / "a"))
    assert document(capsys, *words, "--report", str(tmp_path / "b")) == first
    assert (tmp_path / "a" / "battle.json").read_bytes() == (tmp_path / "b" / "battle.json").read_bytes()
    assert document(capsys, *words, "--seed", "2", "--report", str(tmp_path / "c")) != first
    assert document(capsys, "--judge-again", str(tmp_path / "a")) == first


def test_a_battle_is_judged_again_by_its_number_where_its_folder_is_gone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    first = document(capsys, *SHORT, "--virtual-student", "beginner,seed=4", "--student", "Ann")
    assert document(capsys, "--judge-again", "last", "--student", "Ann") == first
    assert main(["history", "--json", "--student", "Ann"]) == 0
    (kept,) = json.loads(capsys.readouterr().out)["sessions"]
    shutil.rmtree(kept["folder"])
    assert document(capsys, "--judge-again", str(kept["number"])) == first


def test_people_are_measured_against_themselves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = document(capsys, "--players", "Ann,Ben", "--handicap", *SHORT, "--report", str(tmp_path))
    assert [score["lives"] for score in said["scores"]] == [None, None, None]
    assert all(0 <= score["handicapped"] <= 100 for score in said["scores"][1:])


def test_with_a_handicap_each_has_phrases_of_their_own_step_to_the_end(capsys: pytest.CaptureFixture[str]) -> None:
    """Of two battles of one history: whoever misses all goes down, whoever plays all goes up, the final with them."""
    words = ["--players", "Ann,Ben", "--handicap", "--headless", "--rounds", "2", "--tempo", "150"]
    words += ["--virtual-student", "miss_pct=60,seed=1", "--virtual-student", "sd_ms=1,miss_pct=0,seed=2"]
    document(capsys, *words)
    final = document(capsys, *words)["rounds"][-1]
    assert final["final"]
    steps = {turn["name"]: turn["step"] for turn in final["turns"] if turn["kind"] == "answer"}
    assert steps["Ann"] <= 1
    assert steps["Ben"] >= 4


def test_a_battle_of_virtual_players_begins_at_the_step_of_the_level_whatever_went_before(
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = [*SHORT, "--student", "Cleo", "--virtual-student", "sd_ms=1,miss_pct=0,seed=1", "--rounds", "5"]
    first = document(capsys, *words)
    assert first["rules"]["level"] == "beginner"
    assert [first["rounds"][0]["step"], first["rounds"][-1]["step"] > 3] == [1, True]
    assert document(capsys, *words) == first, "the same for the same seed"
    assert document(capsys, *words, "--first-step", "0")["rounds"][0]["step"] == 0
    others = [document(capsys, *SHORT, "--level", level)["rounds"][0]["step"] for level in ("intermediate", "studio")]
    assert 1 < others[0] < others[1]


def test_a_battle_that_was_cut_off_is_recovered(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    first = document(capsys, *SHORT, "--report", str(tmp_path))
    (tmp_path / "battle.json").unlink()
    assert document(capsys, "--recover", str(tmp_path)) == first
    assert json.loads((tmp_path / "battle.json").read_text()) == first


@pytest.mark.parametrize(
    ("words", "fault"),
    [
        (["--opponent", "pockett"], "pocket"),
        (["--mode", "sing"], "sing"),
        (["--bars", "3"], "1, 2, 4, 8"),
        (["--lives", "0"], "lives"),
        (["--target", "120%"], "target"),
        (["--tempo", "1"], "tempo"),
        (["--meter", "4/5"], "4/5"),
        (["--first-step", "99"], "24"),
        (["--handicap"], "two players"),
        (["--players", "Ann,ann"], "one name"),
        (["--players", "Ann=TD,Ben"], "for every player"),
        (["--players", "A,B", "--virtual-student", "pro", "--virtual-student", "pro", "--virtual-student", "pro"], "3"),
        (["--judge-again", "nowhere"], "nowhere"),
        (["--recover", "nowhere"], "nowhere"),
    ],
)
def test_what_cannot_be_is_one_line_and_status_2(
    words: list[str], fault: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["battle", *words, *SHORT[:1]]) == 2
    said = capsys.readouterr().err.strip()
    assert said.count("\n") == 0
    assert fault in said
