"""The question before the result, at a terminal: two texts that say they are one."""

import io

import pytest

from station.cli.input.self_estimate_question import ask_first
from station.practice.session.self_estimate import TYPED_QUESTION

REPORT = {"session": {"complete": True, "click": True}, "timing": {"mean_signed_asynchrony_ms": -14.2, "strokes": 100}}


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


def said(monkeypatch: pytest.MonkeyPatch, typed: str, report: dict[str, dict[str, bool]] | None = None) -> str:
    """What is said on standard error to whoever types `typed`."""
    page = Terminal()
    monkeypatch.setattr("sys.stdin", Terminal(typed))
    monkeypatch.setattr("sys.stderr", page)
    ask_first({**REPORT, **(report or {})})
    return page.getvalue()


def test_an_opinion_is_asked_for_and_answered(monkeypatch: pytest.MonkeyPatch) -> None:
    answer = "You said rushed, and you were 14 ms early on average: your ear is right.\n"
    assert said(monkeypatch, "r\n") == TYPED_QUESTION + answer


@pytest.mark.parametrize("typed", ["\n", ""])
def test_who_has_no_opinion_is_told_nothing(monkeypatch: pytest.MonkeyPatch, typed: str) -> None:
    assert said(monkeypatch, typed) == TYPED_QUESTION


def test_what_nobody_can_answer_is_not_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    assert said(monkeypatch, "r\n", {"session": {"complete": False, "click": True}}) == ""


def test_no_terminal_no_question(capsys: pytest.CaptureFixture[str]) -> None:
    ask_first(REPORT)
    assert capsys.readouterr() == ("", "")
