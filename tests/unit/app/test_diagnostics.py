"""What the doctor says of settings."""

from pathlib import Path

import pytest

from station.app.diagnostics import check_settings


@pytest.mark.parametrize(
    ("line", "finding"),
    [
        ('drums = "nokit"', "nokit: no such drum kit"),
        ('sessions = "~no-such-user/x"', "no such user's home"),
        ("kti = 1", "did you mean kit?"),
    ],
)
def test_a_setting_that_means_nothing_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, line: str, finding: str
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setenv("HOME", str(tmp_path))
    settings = tmp_path / "drum-station" / "settings.toml"
    settings.parent.mkdir()
    settings.write_text('kit = "TD-17"\n')
    assert check_settings().works
    settings.write_text(f"{line}\n")
    check = check_settings()
    assert not check.works
    assert finding in check.finding
