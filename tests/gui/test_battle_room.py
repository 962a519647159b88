"""Whole battles as players have them, read in windows of three sizes."""

import json
from pathlib import Path

import pytest

from tests.gui.test_window import environment, run

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

__all__ = ["environment"]

ROUNDS = 3
"""Two, and the final."""


def test_both_modes_are_chosen_played_and_told(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("battle", environment, tmp_path)
    assert seen["offered"] == ["Begin", "What: Repeat", "Against: The steady one", "More"]
    called, answered = "Listen to the steady one", "Your turn: play it back"
    turns = [called, answered, called, "Count-in", called, answered, called, answered]
    assert seen["said of repeat"] == ["It begins at once", "Count-in", *turns], (
        "nothing stands between rounds, and a part comes whole"
    )
    headline, given, _ = seen["repeat"]
    assert headline == "You win against the steady one", "who strays by a few milliseconds repeats it well"
    assert [row[1] for row in given[1:]] == ["100 % right, won"] * ROUNDS
    assert seen["ways on"] == ["Again", "See the best bar", "Keep a video", "More"]
    assert seen["replay"], "the stage shows it once more, then the result comes back"
    assert seen["said of improvise"][:2] == ["It begins at once", "Count-in"]
    assert {"The steady one plays", "Your turn: the bars are yours"} < set(seen["said of improvise"])
    assert seen["evidence"] == ["Time", "Dynamics", "Vocabulary", "Development", "Kit", "Space"]
    for mode in ("repeat", "improvise"):
        assert seen[f"board of {mode}"]
    for part in ("the choice", "repeat", "improvise", "the result", "the improvised result"):
        assert seen[f"unread of {part}"] == [], part
    assert seen["after"] == ["CLOSED", "IDLE", False]
    documents = [json.loads(path.read_text()) for path in (tmp_path / "sessions").rglob("battle.json")]
    assert sorted(document["rules"]["mode"] for document in documents) == ["improvise", "repeat"]


def test_a_friend_on_the_network_is_hosted_joined_and_battled(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("friend", environment, tmp_path)
    assert seen["waits"][0] == "Waiting for your friend …"
    assert "They let their station join, and type " in seen["waits"][1]
    assert seen["called off"] == "CHOOSING"
    assert {"Ann plays", "Waiting for Ann.", "student: the bars are yours"} < set(seen["said"])
    assert seen["names"] == ["Ann", "student"]
    assert "it was played to its end; both stations have the same record" in seen["told"]
    assert seen["of both"][0] == seen["of both"][1]
    for part in ("hosting", "waiting", "joining", "the result"):
        assert seen[f"unread of {part}"] == [], part
    (document,) = (tmp_path / "sessions").rglob("battle.json")
    assert json.loads(document.read_text())["network"]["agree"]
