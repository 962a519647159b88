"""Double clicks: what the system is told, by the specifications of those who read it, and that it can be taken back."""

import configparser
import re
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

from station.app.equipment.file_endings import desktop_entry, mime_types, register, registry_rows, unregister

pytestmark = pytest.mark.skipif(sys.platform in ("win32", "darwin"), reason="these systems keep no such files")
SPACE = "{http://www.freedesktop.org/standards/shared-mime-info}"


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    return tmp_path


def test_the_entry_is_one_of_the_specification() -> None:
    """Its values are read as the Desktop Entry Specification says: backslashes first, then quotes, then %."""
    entry = configparser.RawConfigParser()
    entry.optionxform = str  # type: ignore[assignment, method-assign] # keys have capitals
    entry.read_string(desktop_entry(("/a b/50% $x/python", "-m", "station")))
    said = entry["Desktop Entry"]
    assert said["Type"] == "Application"
    run = said["Exec"].replace("\\\\", "\\")
    words = [re.sub(r'\\(["`$\\])', r"\1", word) for word in re.findall(r'"((?:[^"\\]|\\.)*)"', run)]
    assert [word.replace("%%", "%") for word in words] == ["/a b/50% $x/python", "-m", "station"]
    assert run.endswith('" %f')
    assert "application/x-drum-station-assignment;" in said["MimeType"]


def test_every_kind_has_its_ending() -> None:
    kinds = ElementTree.fromstring(mime_types())
    globs = {kind.get("type"): kind.find(f"{SPACE}glob") for kind in kinds}
    assert {name: glob.get("pattern") for name, glob in globs.items() if glob is not None} == {
        "application/x-drum-station-assignment": "*.drum-assignment",
        "application/x-drum-station-return": "*.drum-return",
        "application/x-drum-station-note": "*.drum-note",
        "application/x-drum-station-capture": "*.capture",
    }


def test_it_is_written_and_taken_back(data: Path) -> None:
    assert len([line for line in register() if line.startswith("written")]) == 2
    there = sorted(str(path.relative_to(data)) for path in data.rglob("*") if path.is_file())
    assert there == ["applications/drum-station.desktop", "mime/packages/drum-station.xml"]
    assert len([line for line in unregister() if line.startswith("removed")]) == 2
    assert not [path for path in data.rglob("*") if path.is_file()]
    assert unregister() == ["nothing was registered"]


def test_windows_runs_the_program_with_the_file_in_quotes() -> None:
    rows = dict(registry_rows(("C:\\Program Files\\py.exe", "-m", "station")))
    assert rows[".drum-note"] == "DrumStation.note"
    assert rows["DrumStation.note\\shell\\open\\command"] == '"C:\\Program Files\\py.exe" -m station "%1"'
