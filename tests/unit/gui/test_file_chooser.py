"""The system's file dialog, with a program of the test's own in the place of zenity; and what is pasted as a source."""

import sys
import time
from pathlib import Path

import pytest

from station.gui.file_chooser import FileChooser, has_file_chooser
from station.gui.panels.import_panel import source_of

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="other systems have a dialog of their own")
WITHIN_S = 30.0


def test_no_program_no_dialog(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    assert not has_file_chooser()


def test_what_is_chosen_comes_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """zenity writes a line for each file that was chosen (its manual, "File Selection")."""
    zenity = tmp_path / "zenity"
    zenity.write_text(f'#!/bin/sh\necho "$*" > {tmp_path}/asked\nprintf "/music/a.mid\\n/music/b c.gp5\\n"\n')
    zenity.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=":")
    assert has_file_chooser()
    chooser = FileChooser("Music to make lessons of", "Music", (".mid", ".gp5"))
    assert chooser.chosen() == [], "nobody has asked"
    chooser.ask()
    chosen, until = list[str](), time.monotonic() + WITHIN_S
    while not chosen and time.monotonic() < until:
        chosen = chooser.chosen()
        time.sleep(0.005)
    assert chosen == ["/music/a.mid", "/music/b c.gp5"]
    assert chooser.chosen() == []
    assert "*.mid *.gp5" in (tmp_path / "asked").read_text()


@pytest.mark.parametrize(
    ("typed", "meant"),
    [
        (" /music/a.mid\n", "/music/a.mid"),
        ("'/music/b c.gp5'", "/music/b c.gp5"),
        ("file:///music/b%20c.gp5", "/music/b c.gp5"),
        (
            "https://www.mikeslessons.com/groove/?TimeSig=4/4&Div=8",
            "https://www.mikeslessons.com/groove/?TimeSig=4/4&Div=8",
        ),
        ("~/a.mid", str(Path.home() / "a.mid")),
        ("  ", ""),
    ],
)
def test_a_source_is_meant_as_people_paste_it(typed: str, meant: str) -> None:
    assert source_of(typed) == meant
