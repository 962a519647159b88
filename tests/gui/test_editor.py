"""The editor as a teacher has it, in a real window: a groove three ways, a kill in the middle, a drummer that follows.

The expected text is written by hand; the scenarios are in `editor_scenarios`.
"""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.gui.test_window import DRIVE, TIMEOUT_S, environment, run, run_in_turn

__all__ = ["environment"]

pytestmark = [pytest.mark.gui, pytest.mark.timeout(500)]

GROOVE = """title = "New lesson"
tempo_bpm = 80

[grid]
#          1e&a 2e&a 3e&a 4e&a   1e&a 2e&a 3e&a 4e&a
hihat = "| xx   xx   xx   xx   | xx   xx   xx   xx   |"
snare = "| ---- o--g ---- o--- | ---- o--- ---- o--g |"
kick  = "| o-   --   -o   --   | o--- ---- o--o ---- |"
"""
"""Eighths, a backbeat with a ghost before 3 and one before 1, kicks on 1, the "and" of 3, then 1, 3 and its "a"."""
LOST_AT_MOST_S = 1.0


def test_mouse_keyboard_and_kit_write_the_same_file(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run_in_turn(["by_mouse", "by_keyboard", "by_kit", "by_steps"], environment, tmp_path)
    assert seen["by_kit"]["records"]
    assert seen["by_kit"]["struck"] > GROOVE.count("x"), "strokes are seen as they land, before they are written"
    for way, one in seen.items():
        assert one["file"].strip() == GROOVE.strip(), way
        assert one["back"], "and the lessons are there again"
    assert {one["file"] for one in seen.values()} == {seen["by_mouse"]["file"]}, "byte for byte"
    assert [one["chosen"] for one in seen.values()] == ["mouse", "keyboard", "kit", "steps"]
    assert not list((tmp_path / "sessions" / "lessons").glob(".drafts/*")), "what is saved needs no draft"


def test_a_lesson_plays_on_while_it_is_changed(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("changes_what_plays", environment, tmp_path)
    assert seen["told"].startswith("a copy of Rock 2")
    assert [seen["plays"], seen["goes on"], seen["bars"]] == [True, True, 2]
    assert seen["more notes"] == 1
    assert seen["stands"]
    assert seen["left"] == [True, 1], "a draft that is not saved is offered again"


def test_escape_closes_what_lies_over_the_page_before_the_page(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("closes_by_escape", environment, tmp_path)
    assert seen["before"] == [True, True]
    assert seen["open"] == [[False, True, True], [False, False, True], [False, False, False]]


def test_a_kill_in_the_middle_costs_less_than_a_second(environment: dict[str, str], tmp_path: Path) -> None:
    sessions, told = tmp_path / "sessions", tmp_path / "sessions" / "edits.jsonl"
    command = [sys.executable, str(DRIVE), "edits_until_killed", str(sessions), str(tmp_path / "none.json")]
    words = tmp_path / "words.txt"
    with words.open("wb") as said:
        child = subprocess.Popen(command, env=environment, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=said)
    try:
        killed_at = _killed(child, told, words)
    finally:
        child.kill()
        child.wait()
    made = [json.loads(line) for line in told.read_text(encoding="utf-8").splitlines()]
    seen = run("finds_draft", environment, tmp_path)
    assert seen["text"] in [each["text"] for each in made if each["at"] >= killed_at - LOST_AT_MOST_S] or (
        seen["text"] == made[-1]["text"]
    ), "nothing older than a second is missing"
    assert not seen["saved"]
    assert [seen["left"], seen["kept"]] == [0, ["new-lesson.toml"]]
    assert (sessions / "lessons" / "new-lesson.toml").read_text(encoding="utf-8") == seen["text"]


def _killed(child: subprocess.Popen[bytes], told: Path, words: Path) -> float:
    """End the editing with SIGKILL once fifty edits were made; returns when."""
    deadline = time.monotonic() + TIMEOUT_S
    while not told.exists() or told.read_bytes().count(b"\n") < 50:
        assert child.poll() is None, words.read_text()[-2000:]
        assert time.monotonic() < deadline, "no edits are made"
        time.sleep(0.01)
    child.send_signal(signal.SIGKILL)
    return time.time()
