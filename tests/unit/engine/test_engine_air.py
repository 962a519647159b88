"""An engine that begins with an air kit, and pads that tell where a stick points. Expected: what was configured."""

from pathlib import Path

import pytest

from station.core.pieces import Limb, Piece, Zone
from station.core.settings import Settings
from station.engine.engine_config import EngineConfig
from station.engine.messages import SetAirDrums
from station.sync.air.air_file import air_path, save_air
from station.sync.air.air_zones import AirKit, AirZone

SNARE = AirZone(Limb.RIGHT_HAND, Piece.SNARE, Zone.HEAD, 0.0, 0.0, 0.1, 0.1)


@pytest.mark.parametrize("is_on", [True, False])
def test_an_engine_begins_with_the_air_kit_where_it_is_set(
    is_on: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    air_path().parent.mkdir(parents=True)
    save_air(AirKit((SNARE,)), air_path())
    asked = [
        command
        for command in EngineConfig.from_settings(Settings(air_drums=is_on)).first_commands
        if isinstance(command, SetAirDrums)
    ]
    assert [command.kit.zones[0].piece for command in asked if command.kit] == [Piece.SNARE] * is_on
