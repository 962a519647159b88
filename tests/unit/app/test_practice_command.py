"""`station practice`: a session is kept whatever becomes of its words."""

import errno
import io
import sys
from pathlib import Path

import pytest

from station.cli.command_line import main

VIRTUAL = ["--headless", "--virtual-student", "pro", "--loops", "1", "--no-pictures"]


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nobody's own settings or sessions are touched."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


class FullDisk(io.StringIO):
    """A file on a disk that takes nothing more."""

    def write(self, text: str) -> int:
        raise OSError(errno.ENOSPC, "No space left on device")


@pytest.mark.parametrize("words", [["--json"], []])
def test_a_report_that_cannot_be_printed_is_kept_and_that_is_said(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "x"
    monkeypatch.setattr(sys, "stdout", FullDisk())
    assert main(["practice", "rock-1", *VIRTUAL, "--report", str(folder), *words]) == 2
    fault = f"the session is kept in {folder}, but not all could be printed: standard output: No space left on device"
    assert capsys.readouterr().err.splitlines()[-1] == f"station: {fault}"
    assert {"report.json", "report.txt", "pairs.csv"} <= {path.name for path in folder.iterdir()}
