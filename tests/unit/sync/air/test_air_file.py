"""An air kit's file."""

from math import radians
from pathlib import Path

import pytest

from station.core.errors import BadInput
from station.core.pieces import Limb, Piece, Zone
from station.sync.air.air_file import air_text, read_air, save_air
from station.sync.air.air_zones import AirKit, AirZone

ZONE = """
[[zones]]
limb = "right_hand"
piece = "snare"
heading_deg = 12
elevation_deg = -8
heading_sd_deg = 4
elevation_sd_deg = 5
"""


def written(folder: Path, text: str) -> Path:
    path = folder / "air.toml"
    path.write_text(text)
    return path


def test_a_file_is_read(tmp_path: Path) -> None:
    kit = read_air(written(tmp_path, "normal_speed_m_s = 2.5\n" + ZONE))
    assert kit.normal_speed_m_s == 2.5
    (zone,) = kit.zones
    assert (zone.limb, zone.piece, zone.zone) == (Limb.RIGHT_HAND, Piece.SNARE, Zone.HEAD)
    assert (zone.heading_rad, zone.elevation_sd_rad) == pytest.approx((radians(12), radians(5)))


def test_no_file_is_a_kit_without_zones(tmp_path: Path) -> None:
    assert read_air(tmp_path / "air.toml") == AirKit(())


def test_what_is_saved_is_read_again(tmp_path: Path) -> None:
    zones = tuple(
        AirZone(limb, piece, zone, radians(h), radians(-3.25), radians(6.0), radians(8.0))
        for limb, piece, zone, h in (
            (Limb.RIGHT_HAND, Piece.RIDE, Zone.BELL, -179.99),
            (Limb.LEFT_HAND, Piece.FLOOR_TOM_1, Zone.HEAD, 90.5),
        )
    )
    save_air(AirKit(zones, 4.125), tmp_path / "air.toml")
    again = read_air(tmp_path / "air.toml")
    assert again.normal_speed_m_s == 4.125
    for before, after in zip(zones, again.zones, strict=True):
        assert (after.limb, after.piece, after.zone) == (before.limb, before.piece, before.zone)
        assert after.heading_rad == pytest.approx(before.heading_rad, abs=1e-4)
    assert air_text(again) == air_text(AirKit(zones, 4.125))


@pytest.mark.parametrize(
    ("text", "place", "fault"),
    [
        (ZONE.replace("right_hand", "right_foot"), "line 3", "right_foot"),
        (ZONE.replace('"snare"', '"kick"'), "line 4", "kick"),
        (ZONE.replace("= 12", "= 400"), "line 5", "400"),
        (ZONE.replace("heading_sd_deg = 4\n", ""), "line 2", "heading_sd_deg"),
        (ZONE + ZONE, "zones", "twice"),
        ("tempo = 3\n", "line 1", "tempo"),
        ("normal_speed_m_s = 0\n", "line 1", "0"),
    ],
)
def test_faults_are_named_with_their_place(tmp_path: Path, text: str, place: str, fault: str) -> None:
    with pytest.raises(BadInput) as caught:
        read_air(written(tmp_path, text))
    assert "air.toml" in str(caught.value)
    assert fault in str(caught.value)
    assert place.rsplit(maxsplit=1)[-1] in str(caught.value)
