"""An air kit as a TOML file, `air.toml` beside the settings: what the player taught in a minute.

    normal_speed_m_s = 3.5                # the tip's in a usual stroke

    [[zones]]                             # a hand's first zone is where it finds itself again
    limb = "right_hand"
    piece = "snare"
    heading_deg = 12.0                    # counter-clockwise from above; only differences mean something
    elevation_deg = -8.0
    heading_sd_deg = 4.0                  # how far strokes scatter
    elevation_sd_deg = 5.0                # zone = "head" too

A fault is `BadInput` with line and column.
"""

from math import degrees, radians
from pathlib import Path

from station.core.disk.files import NoSuchFile, write_whole
from station.core.pieces import HAND_PIECES, Limb, Zone, word
from station.core.settings import settings_path
from station.core.toml.schema import Field, Fields, choice, list_of, members_by_label, needed, number, read, record
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.core.toml.toml_write import toml_text
from station.sync.air.air_swing import FULL_SPEED_M_S
from station.sync.air.air_zones import NORMAL_SPEED_M_S, AirKit, AirZone

FILE_NAME = "air.toml"
_LEAST_SD_DEG, _MOST_SD_DEG = 1.0, 45.0
"""Our choice: no hand aims better, and a zone that is wider is no direction."""
_SLOWEST_NORMAL_M_S = 0.5
"""Our choice: a usual stroke is one that `air_strokes` finds."""


def air_path() -> Path:
    """Where this user's air kit lives."""
    return settings_path().with_name(FILE_NAME)


def read_air(path: Path) -> AirKit:
    """The air kit in a file, without zones where there is none; raises `BadInput`."""
    try:
        source = read_source(path)
    except NoSuchFile:
        return AirKit(())
    return read(source, AIR_KIT)


def save_air(kit: AirKit, path: Path) -> None:
    """Write the air kit whole; raises `DeviceError` if the disk refuses."""
    write_whole(path, air_text(kit).encode())


def air_text(kit: AirKit) -> str:
    """The kit as the file has it; angles to a hundredth of a degree."""
    lines = [f"normal_speed_m_s = {kit.normal_speed_m_s:.3f}\n"]
    return "\n".join(lines + [_zone_text(zone) for zone in kit.zones])


def _zone_text(zone: AirZone) -> str:
    words = {"limb": word(zone.limb), "piece": word(zone.piece), "zone": word(zone.zone)}
    named = [f"{key} = {toml_text(value)}" for key, value in words.items()]
    angles = [f"{key} = {degrees(getattr(zone, name)):.2f}" for key, name in _ANGLES.items()]
    return "\n".join(["[[zones]]", *named, *angles]) + "\n"


# --- reading ----------------------------------------------------------------------------------------------------------

_ANGLES = {
    "heading_deg": "heading_rad",
    "elevation_deg": "elevation_rad",
    "heading_sd_deg": "heading_sd_rad",
    "elevation_sd_deg": "elevation_sd_rad",
}
_HANDS = {word(limb): limb for limb in Limb if limb.is_hand}
_SD = number(_LEAST_SD_DEG, _MOST_SD_DEG)
_ZONE: Fields = {
    "limb": needed(choice(_HANDS, "hand"), 'limb = "right_hand"'),
    "piece": needed(choice({word(piece): piece for piece in sorted(HAND_PIECES)}, "piece"), 'piece = "snare"'),
    "zone": Field(choice(members_by_label(Zone), "zone"), Zone.HEAD),
    "heading_deg": needed(number(-180.0, 180.0), "heading_deg = 12"),
    "elevation_deg": needed(number(-90.0, 90.0), "elevation_deg = -8"),
    "heading_sd_deg": needed(_SD, "heading_sd_deg = 4"),
    "elevation_sd_deg": needed(_SD, "elevation_sd_deg = 5"),
}


def _zone(limb: Limb, piece: object, zone: Zone, **angles_deg: float) -> AirZone:
    return AirZone(limb, piece, zone, **{_ANGLES[key]: radians(value) for key, value in angles_deg.items()})  # type: ignore[arg-type]


def _kit(normal_speed_m_s: float, zones: tuple[AirZone, ...]) -> AirKit:
    meant = [(zone.limb, zone.piece, zone.zone) for zone in zones]
    if len(set(meant)) < len(meant):
        raise wrong("a hand has the same zone twice", "zones")
    return AirKit(zones, normal_speed_m_s)


FIELDS: Fields = {
    "normal_speed_m_s": Field(number(_SLOWEST_NORMAL_M_S, FULL_SPEED_M_S), NORMAL_SPEED_M_S),
    "zones": Field(list_of(record(_zone, _ZONE), "an array of tables: [[zones]]"), ()),
}
AIR_KIT = record(_kit, FIELDS)
