"""What a report knows of a kit: its own file before the settings."""

from dataclasses import replace
from pathlib import Path
from types import MappingProxyType

import pytest

from station.core.pieces import Piece
from station.core.settings import Settings
from station.core.units import NS_PER_MS
from station.devices.mapping.device_file import own_kit_path, save_kit
from station.devices.mapping.device_map import Pad
from station.devices.mapping.presets import preset_named
from station.practice.records.report.session_report import kit_facts

SETTINGS = Settings(thresholds="snare=20 tom_1=15", mask_ms=7.0)


@pytest.fixture(autouse=True)
def own_settings(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("HOME", str(tmp_path))


def test_without_a_file_the_settings_say_it() -> None:
    for device in (None, "TD-17"):
        facts = kit_facts(SETTINGS, device)
        assert facts.threshold == {Piece.SNARE: 20, Piece.TOM_1: 15}
        assert facts.mask_ms == 7.0


def test_a_kits_own_file_goes_before_them() -> None:
    pads = {
        Piece.SNARE: Pad(threshold=5, mask_ns=12 * NS_PER_MS, least_velocity=9),
        Piece.KICK: Pad(threshold=30),
        Piece.RIDE: Pad(least_velocity=1),
    }
    save_kit(replace(preset_named("roland-td-17"), pads=MappingProxyType(pads)), "TD-17")
    facts = kit_facts(SETTINGS, "2- TD-17")
    assert facts.threshold == {Piece.SNARE: 9, Piece.TOM_1: 15, Piece.KICK: 30}
    assert facts.mask_ms == 12.0


def test_a_broken_file_is_as_none() -> None:
    path = own_kit_path("TD-17")
    path.parent.mkdir(parents=True)
    path.write_text("base = 3")
    assert kit_facts(SETTINGS, "TD-17").mask_ms == 7.0
