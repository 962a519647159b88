"""The console where nothing can be written: a result is a fault in one line, words for people are lost."""

import io
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from station.cli.command_line import main
from station.cli.console import ask, is_attended, print_json, say
from station.core.errors import DeviceError

FULL = Path("/dev/full")
needs_full = pytest.mark.skipif(not FULL.exists(), reason="this system has no /dev/full")


@contextmanager
def full(monkeypatch: pytest.MonkeyPatch, stream: str) -> Iterator[None]:
    with FULL.open("w", encoding="utf-8") as file:
        monkeypatch.setattr(sys, stream, file)
        yield
        monkeypatch.undo()


@needs_full
@pytest.mark.parametrize("words", [("lesson", "new"), ("lesson", "list", "--json"), ("limbs", "rock-1"), ("--help",)])
def test_a_full_output_is_one_line(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with full(monkeypatch, "stdout"):
        assert main(words) == 2
    assert capsys.readouterr().err == "station: standard output: No space left on device\n"


@pytest.mark.parametrize("words", [("lesson", "new"), ("lesson", "list", "--json"), ("limbs", "rock-1")])
def test_a_closed_output_is_one_line(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    assert main(words) == 2
    assert capsys.readouterr().err == "station: standard output is closed\n"


def test_who_has_gone_is_told_nothing(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    class Gone(io.StringIO):
        def write(self, _: str) -> int:
            raise BrokenPipeError

    monkeypatch.setattr(sys, "stdout", Gone())
    assert main(["lesson", "new"]) == 1
    assert capsys.readouterr().err == ""


@needs_full
def test_words_for_people_are_lost_where_nobody_reads_them(monkeypatch: pytest.MonkeyPatch) -> None:
    with full(monkeypatch, "stderr"):
        assert main(["lesson", "show", "rokc-1"]) == 2


def test_words_for_people_never_go_into_the_result(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stderr", None)
    say("hello")
    assert capsys.readouterr().out == ""


def test_nobody_is_asked_where_nobody_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    assert not is_attended()


def test_an_answer_is_a_line(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", io.StringIO(" yes \nno\n"))
    assert (ask("really? "), ask("sure? "), ask("quite? ")) == ("yes", "no", "")
    assert capsys.readouterr().err == "really? sure? quite? "


def test_json_knows_no_nan() -> None:
    with pytest.raises(ValueError, match="JSON"):
        print_json({"x": float("nan")})


def test_a_closed_output_is_a_fault_of_the_world(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", None)
    with pytest.raises(DeviceError, match="closed"):
        print_json({})


@pytest.mark.parametrize(
    "words", [("practice", "rock-1", "--level"), ("practice", "rock-1", "--fold"), ("lesson", "list", "--kind")]
)
def test_a_long_wrong_word_is_shortened(words: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*words, "x" * 7_000]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert len(line) < 420
    assert line.startswith("station: ")
