"""A user's own kit as a TOML file: what differs from a preset, one file a kit, for maps vary within a model.

    title = "my TD-17"
    base = "roland-td-17"                 # a preset; all that is not said is as there
    notes.66 = { piece = "ride", zone = "edge" }          # articulation, openness too; piece = "none" for no stroke
    pedal = { controller = 4, open = 0, shut = 90, steps = [] }      # or { present = false }
    foot = { least_travel = 0.3, splash_ms = 90, by_controller = false }
    choke = { from = 1, grab_velocity = 20, notes.60 = { piece = "crash_1" } }
    positions.16 = { pieces = ["snare"] }
    channels.3.notes.36 = { piece = "cowbell" }           # where that note means another thing on channel 3
    pads.snare = { threshold = 5, mask_ms = 9, least_velocity = 12, curve = "light" }
    pads.kick = { curve = { softest = 8, loudest = 118, bend = 0.3 } }
    [[crosstalk]]
    source = "kick"
    victim = "snare"
    share = 0.3                           # within_ms, before_ms too

`station.devices.mapping.device_map` says what each means. A fault is `BadInput` with line and column.
"""

import re
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any

from station.core.disk.files import write_whole
from station.core.errors import BadInput
from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Piece, Zone
from station.core.settings import settings_path
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    choice,
    flag,
    list_of,
    members_by_label,
    needed,
    number,
    optional,
    read,
    record,
    said,
    table_of,
    text,
    whole,
    whole_key,
)
from station.core.toml.toml_faults import Faults, wrong
from station.core.toml.toml_source import read_source, text_source
from station.core.units import ns_from_ms
from station.devices.mapping.device_map import (
    CROSSTALK_BEFORE_NS,
    CROSSTALK_WITHIN_NS,
    Crosstalk,
    DeviceMap,
    Foot,
    Pad,
    PedalRange,
)
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, KNOWN_KITS, stable_name
from station.devices.mapping.velocity_curve import (
    LEAST_SPAN,
    LOUDEST_FROM,
    LOUDEST_TO,
    MOST_BEND,
    SHAPES,
    SOFTEST_FROM,
    SOFTEST_TO,
    VelocityCurve,
)

_NONE = "none"
_LONGEST_MS = 500.0
_LONGEST_NAME = 60
"""A file's name may have 255 bytes on most systems, and a letter up to four; JACK's ports have up to 320 letters."""


def kits_folder() -> Path:
    """Where this user's own kits live."""
    return settings_path().parent / "kits"


def own_kit_path(device: str, folder: Path | None = None) -> Path:
    """The file of the kit called `device`, whether there is one or not."""
    name = re.sub(r"[^\w.+-]+", "-", stable_name(device))[:_LONGEST_NAME].strip("-.") or "kit"
    return (folder or kits_folder()) / f"{name}.toml"


def own_kit(device: str, folder: Path | None = None) -> DeviceMap | None:
    """The user's own kit for `device`, None where there is none; raises `BadInput` where its file is at fault."""
    path = own_kit_path(device, folder)
    try:
        is_there = path.exists()
    except OSError as fault:  # the folder may not be looked into
        raise BadInput(path, "", fault.strerror or str(fault)) from fault
    return read_kit(path) if is_there else None


def read_kit(path: Path) -> DeviceMap:
    """The kit in the file at `path`; raises `BadInput`."""
    return read(read_source(path), kit_reader(path.stem))


def parse_kit(text: str, name: str) -> DeviceMap:
    """The kit in a text that `kit_text` wrote; raises `BadInput`."""
    return read(text_source(text, name), kit_reader(name))


def save_kit(kit: DeviceMap, device: str, folder: Path | None = None) -> Path:
    """Keep `kit` as the user's own for `device`; returns where. Raises `DeviceError` if the disk refuses."""
    path = own_kit_path(device, folder)
    write_whole(path, kit_text(kit).encode())
    return path


# --- reading ----------------------------------------------------------------------------------------------------------


def kit_reader(name: str) -> Reader[DeviceMap]:
    """The schema of the file of the kit called `name`; what it does not say is as in the preset that it is built on."""

    def read_file(raw: object) -> DeviceMap:
        said_base = raw.get("base") if isinstance(raw, dict) else None
        base = Faults().attempt(_preset, said_base, GENERAL_MIDI_PRESET)
        return record(lambda **values: _kit(name, base, values), _fields(base))(raw)

    return read_file


def _fields(base: DeviceMap) -> Fields:
    return {
        "title": optional(text),
        "base": Field(_preset, GENERAL_MIDI_PRESET),
        "notes": Field(table_of(_NOTE, _note), {}),
        "pedal": Field(_pedal(base.pedal), base.pedal),
        "foot": Field(_foot(base.foot), base.foot),
        "choke": Field(said(_CHOKE), {}),
        "positions": Field(table_of(_NOTE, _position), base.position_controllers),
        "channels": Field(table_of(whole_key(1, 16), _channel), {}),
        "pads": Field(said({key: optional(_pad(base.pad(piece))) for key, piece in _PIECES.items()}, "pad"), {}),
        "crosstalk": Field(list_of(_CROSSTALK, "an array of tables: [[crosstalk]]"), base.crosstalk),
    }


def _kit(name: str, base: DeviceMap, values: Mapping[str, Any]) -> DeviceMap:
    notes = {number: strike for number, strike in {**base.notes, **values["notes"]}.items() if strike is not None}
    channels = values["channels"].items()
    on_channel = {(channel, number): strike for channel, notes in channels for number, strike in notes.items()}
    choke, pads = values["choke"], {_PIECES[key]: pad for key, pad in values["pads"].items()}
    return DeviceMap(
        name=name,
        title=name if values["title"] is None else values["title"],
        base=base.name,
        reports=base.reports,
        notes=MappingProxyType(notes),
        channel_notes=MappingProxyType(on_channel),
        pedal=values["pedal"],
        choke_from=choke.get("from", base.choke_from),
        choke_notes=MappingProxyType(choke.get("notes", base.choke_notes)),
        grab_velocity=choke.get("grab_velocity", base.grab_velocity),
        position_controllers=MappingProxyType(values["positions"]),
        foot=values["foot"],
        pads=MappingProxyType({**base.pads, **pads}),
        crosstalk=values["crosstalk"],
    )


_preset = choice(KNOWN_KITS, "kit preset")
_PIECES = members_by_label(Piece)
_NOTE = whole_key(0, 127)
_PIECE = choice(_PIECES, "piece")
_VELOCITY = whole(1, 127)


def _ns(value: object) -> int:
    """A time that the file has in milliseconds, in nanoseconds."""
    return ns_from_ms(number(0.0, _LONGEST_MS)(value))


# --- what a note means ------------------------------------------------------------------------------------------------

_STRIKE: Fields = {
    "piece": needed(_PIECE, 'piece = "snare"'),
    "zone": Field(choice(members_by_label(Zone), "zone"), Zone.HEAD),
    "articulation": Field(choice(members_by_label(Articulation), "articulation"), Articulation.NORMAL),
    "openness": optional(number(0.0, 1.0)),
}
_ON_CHANNEL = table_of(_NOTE, record(NoteMeaning, _STRIKE))
_channel = record(lambda notes: notes, {"notes": needed(_ON_CHANNEL, 'notes.36 = { piece = "kick" }')})


def _strike(piece: Piece | None, zone: Zone, articulation: Articulation, openness: float | None) -> NoteMeaning | None:
    return None if piece is None else NoteMeaning(piece, zone, articulation, openness)


_PIECE_OR_NONE: Mapping[str, Piece | None] = {**_PIECES, _NONE: None}
_note = record(_strike, {**_STRIKE, "piece": needed(choice(_PIECE_OR_NONE, "piece"), 'piece = "snare"')})
_CHOKE: Fields = {
    "from": optional(_VELOCITY),
    "grab_velocity": optional(whole(0, 127)),
    "notes": optional(table_of(_NOTE, record(lambda piece: piece, {"piece": needed(_PIECE)}))),
}
_PIECES_THERE = list_of(_PIECE, 'pieces such as ["snare"]')


def _position_of(pieces: tuple[Piece, ...]) -> frozenset[Piece]:
    if not pieces:
        raise wrong('expected pieces such as ["snare"], found none', "pieces")
    return frozenset(pieces)


_position = record(_position_of, {"pieces": needed(_PIECES_THERE, 'pieces = ["snare"]')})


# --- pedal and pads ---------------------------------------------------------------------------------------------------


_STEPS = "values such as [0, 56, 127]"
_PEDAL: Fields = {
    "present": optional(flag),
    "controller": optional(whole(0, 127)),
    "open": Field(whole(0, 127), None, called="wide_open"),
    "shut": optional(whole(0, 127)),
    "steps": optional(list_of(whole(0, 127), _STEPS)),
}


def _pedal(base: PedalRange | None) -> Reader[PedalRange | None]:
    """The pedal's range; what is not said is as in `base`."""
    usual = base or PedalRange()
    table = said(_PEDAL)

    def read_pedal(raw: object) -> PedalRange | None:
        found = table(raw)
        if not found.pop("present", True):
            return None
        if {"wide_open", "shut"} & set(found):  # other ends are those of another way
            found.setdefault("steps", ())
        pedal = replace(usual, **found)
        if pedal.wide_open == pedal.shut:
            raise wrong(f"open and shut are both {pedal.shut}: the pedal tells nothing", "shut")
        if len(pedal.steps) == 1:
            raise wrong(f"expected {_STEPS}, found one", "steps")
        return pedal

    return read_pedal


def _foot(base: Foot) -> Reader[Foot]:
    fields: Fields = {
        "least_travel": Field(number(0.0, 1.0), base.least_travel),
        "splash_ms": Field(_ns, base.splash_ns, called="splash_ns"),
        "by_controller": Field(flag, base.by_controller),
    }
    return record(Foot, fields)


def _pad(usual: Pad) -> Reader[Pad]:
    fields: Fields = {
        "threshold": Field(_VELOCITY, usual.threshold),
        "mask_ms": Field(_ns, usual.mask_ns, called="mask_ns"),
        "least_velocity": Field(_VELOCITY, usual.least_velocity),
        "curve": Field(_curve, usual.curve),
    }
    return record(Pad, fields)


def _curve(raw: object) -> VelocityCurve:
    """A curve by its name, or by its numbers."""
    return _SHAPE(raw) if isinstance(raw, str) else _numbers(raw)


def _curve_of(softest: float, loudest: float, bend: float) -> VelocityCurve:
    if loudest < softest + LEAST_SPAN:
        raise wrong(f"expected {LEAST_SPAN:g} or more above softest", "loudest")
    return VelocityCurve(softest, loudest, bend)


_SHAPE = choice(SHAPES, "curve")
_numbers = record(
    _curve_of,
    {
        "softest": Field(number(SOFTEST_FROM, SOFTEST_TO), VelocityCurve().softest),
        "loudest": Field(number(LOUDEST_FROM, LOUDEST_TO), VelocityCurve().loudest),
        "bend": Field(number(-MOST_BEND, MOST_BEND), VelocityCurve().bend),
    },
)


def _crosstalk(source: Piece, victim: Piece, **values: Any) -> Crosstalk:  # noqa: ANN401 - the others as they are
    if source is victim:
        raise wrong("a pad is not its own crosstalk; its mask_ms is for that", "victim")
    return Crosstalk(source, victim, **values)


_CROSSTALK = record(
    _crosstalk,
    {
        "source": needed(_PIECE, 'source = "kick"'),
        "victim": needed(_PIECE, 'victim = "snare"'),
        "share": needed(number(0.0, 1.0), "share = 0.3"),
        "within_ms": Field(_ns, CROSSTALK_WITHIN_NS, called="within_ns"),
        "before_ms": Field(_ns, CROSSTALK_BEFORE_NS, called="before_ns"),
    },
)
KEYS = frozenset(_fields(GENERAL_MIDI_PRESET))
"""Every key of the top table."""
