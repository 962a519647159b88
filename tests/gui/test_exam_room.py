"""An exam as a student has it, in a window of its own."""

import json
from pathlib import Path

import pytest

from tests.gui.test_window import environment, run

pytestmark = [pytest.mark.gui, pytest.mark.timeout(400)]

__all__ = ["environment"]


def test_a_rubric_a_look_one_take_and_marks(environment: dict[str, str], tmp_path: Path) -> None:
    seen = run("exam", environment, tmp_path)
    assert seen["rubric"]
    assert 80 < seen["left_s"] < 90
    assert seen["whole piece"], "nothing is scrolled while somebody plays"
    assert seen["notes while playing"]
    assert seen["told while playing"] == [0, True]
    assert seen["question"] == ""
    assert seen["band"] == "distinction", "who strays by four milliseconds reads well"
    assert not seen["again"], "an exam is one take"
    for part in ("rubric", "notes", "marks"):
        assert seen[f"unread of the {part}"] == []
    assert (seen["after"], seen["lesson"]) == ("ASKED", "rock-1")
    (kept,) = (tmp_path / "sessions").rglob("exam.json")
    document = json.loads(kept.read_text())
    assert document["unseen"] == {"level": 2, "seed": 11}
    assert document["marks"]["total"] == pytest.approx(seen["total"], abs=1e-3)


def test_the_whole_piece_and_its_buttons_are_seen_in_a_small_window(
    environment: dict[str, str], tmp_path: Path
) -> None:
    seen = run("exam_in_a_small_window", environment, tmp_path)
    assert seen["whole piece"], "nothing is scrolled while somebody plays"
    assert seen["notes while playing"]
    assert seen["band"] == "distinction"
