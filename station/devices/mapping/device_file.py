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
from enum import IntEnum
from pathlib import Path
from types import MappingProxyType
from typing import TypeVar

from station.core.errors import BadInput
from station.core.files import write_whole
from station.core.note_map import KitMap, NoteMeaning
from station.core.pieces import Articulation, Piece, Zone, word
from station.core.settings import settings_path
from station.core.toml_table import Table, located, parse_toml, read_toml
from station.core.units import ms_from_ns, ns_from_ms
from station.devices.mapping.device_map import (
    GHOST_BEFORE_NS,
    GHOST_WITHIN_NS,
    Crosstalk,
    DeviceMap,
    Foot,
    Pad,
    PedalRange,
    Sent,
)
from station.devices.mapping.device_writer import kit_text
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, preset_named, stable_name
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

_KEYS = {"title", "base", "notes", "pedal", "foot", "choke", "positions", "pads", "crosstalk", "channels"}
_NONE = "none"
_LONGEST_MS = 500.0
_LONGEST_NAME = 60
"""A file's name may have 255 bytes on most systems, and a letter up to four; JACK's ports have up to 320 letters."""
_Member = TypeVar("_Member", bound=IntEnum)


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
    with located(path):
        return _kit(Table(read_toml(path), path, ""), path.stem)


def parse_kit(text: str, name: str) -> DeviceMap:
    """The kit in a text that `kit_text` wrote; raises `BadInput`."""
    return _kit(Table(parse_toml(text.encode(errors="replace"), name), Path(name), ""), name)


def save_kit(kit: DeviceMap, device: str, folder: Path | None = None) -> Path:
    """Keep `kit` as the user's own for `device`; returns where. Raises `DeviceError` if the disk refuses."""
    path = own_kit_path(device, folder)
    write_whole(path, kit_text(kit).encode())
    return path


# --- reading ---------------------------------------------------------------------------------------------------------


def _kit(table: Table, name: str) -> DeviceMap:
    table.only(_KEYS)
    base = _base(table)
    choke = table.table("choke", {})
    choke.only({"from", "notes", "grab_velocity"})
    return DeviceMap(
        name=name,
        title=_text(table, "title", name),
        base=base.name,
        notes=_notes(table.table("notes", {}), base.notes),
        channel_notes=_channel_notes(table.table("channels", {})),
        pedal=_pedal(table.table("pedal", {}), base.pedal) if "pedal" in table.raw else base.pedal,
        choke_from=choke.whole("from", 1, 127, base.choke_from),
        choke_notes=_choke_notes(choke, base),
        grab_velocity=choke.whole("grab_velocity", 0, 127, base.grab_velocity),
        position_controllers=_positions(table, base),
        foot=_foot(table.table("foot", {}), base.foot),
        pads=_pads(table, base),
        crosstalk=tuple(map(_crosstalk, table.tables("crosstalk"))) if "crosstalk" in table.raw else base.crosstalk,
    )


def _text(table: Table, key: str, default: str) -> str:
    value = table.raw.get(key, default)
    if not isinstance(value, str):
        raise BadInput(table.source, key, f"expected a text in quotes, found {value!r}")
    return value


def _base(table: Table) -> DeviceMap:
    try:
        return preset_named(_text(table, "base", GENERAL_MIDI_PRESET.name))
    except BadInput as fault:
        raise BadInput(table.source, "base", fault.fault) from None


def _member(table: Table, key: str, kind: type[_Member], default: str = "") -> _Member:
    words = {word(member): member for member in kind}
    if key not in table.raw and not default:
        raise BadInput(table.source, f"{table.place}.{key}", "is missing")
    return words[table.word(key, tuple(words), default)]


def _notes(table: Table, base: KitMap) -> KitMap:
    notes = dict(base)
    for number, key in table.numbers(0, 127):
        entry = table.table(key)
        if entry.raw.get("piece") == _NONE:
            notes.pop(number, None)
        else:
            notes[number] = _strike(entry)
    return MappingProxyType(notes)


def _strike(entry: Table) -> NoteMeaning:
    entry.only({"piece", "zone", "articulation", "openness"})
    return NoteMeaning(
        _member(entry, "piece", Piece),
        _member(entry, "zone", Zone, "head"),
        _member(entry, "articulation", Articulation, "normal"),
        entry.number("openness", 0.0, 1.0) if "openness" in entry.raw else None,
    )


def _channel_notes(table: Table) -> Mapping[Sent, NoteMeaning]:
    found: dict[Sent, NoteMeaning] = {}
    for channel, key in table.numbers(1, 16):
        entry = table.table(key)
        entry.only({"notes"})
        notes = entry.table("notes")
        found |= {(channel, number): _strike(notes.table(name)) for number, name in notes.numbers(0, 127)}
    return MappingProxyType(found)


def _pedal(table: Table, base: PedalRange | None) -> PedalRange | None:
    table.only({"present", "controller", "open", "shut", "steps"})
    if not table.flag("present", True):
        return None
    usual = base or PedalRange()
    wide_open, shut = table.whole("open", 0, 127, usual.wide_open), table.whole("shut", 0, 127, usual.shut)
    if wide_open == shut:
        raise BadInput(table.source, f"{table.place}.shut", f"open and shut are both {shut}: the pedal tells nothing")
    usual_steps = () if {"open", "shut"} & set(table.raw) else usual.steps  # other ends are those of another way
    steps = table.raw.get("steps", list(usual_steps))
    if not isinstance(steps, list) or len(steps) == 1 or not all(type(s) is int and 0 <= s <= 127 for s in steps):
        raise BadInput(table.source, f"{table.place}.steps", f"expected values such as [0, 56, 127], found {steps!r}")
    return PedalRange(wide_open, shut, table.whole("controller", 0, 127, usual.controller), tuple(steps))


def _foot(table: Table, base: Foot) -> Foot:
    table.only({"least_travel", "splash_ms", "by_controller"})
    return Foot(
        least_travel=table.number("least_travel", 0.0, 1.0, base.least_travel),
        splash_ns=_ns(table, "splash_ms", base.splash_ns),
        by_controller=table.flag("by_controller", base.by_controller),
    )


def _ns(table: Table, key: str, default_ns: int) -> int:
    return ns_from_ms(table.number(key, 0.0, _LONGEST_MS, ms_from_ns(default_ns)))


def _choke_notes(choke: Table, base: DeviceMap) -> Mapping[int, Piece]:
    if "notes" not in choke.raw:
        return base.choke_notes
    notes = choke.table("notes")
    found = {}
    for number, key in notes.numbers(0, 127):
        entry = notes.table(key)
        entry.only({"piece"})
        found[number] = _member(entry, "piece", Piece)
    return MappingProxyType(found)


def _positions(table: Table, base: DeviceMap) -> Mapping[int, frozenset[Piece]]:
    if "positions" not in table.raw:
        return base.position_controllers
    positions = table.table("positions")
    found = {}
    for number, key in positions.numbers(0, 127):
        entry = positions.table(key)
        entry.only({"pieces"})
        found[number] = frozenset(_pieces(entry))
    return MappingProxyType(found)


def _pieces(entry: Table) -> list[Piece]:
    words, names = {word(piece): piece for piece in Piece}, entry.raw.get("pieces")
    if not isinstance(names, list) or not names or not all(name in words for name in names):
        raise BadInput(entry.source, f"{entry.place}.pieces", f'expected pieces such as ["snare"], found {names!r}')
    return [words[name] for name in names]


def _pads(table: Table, base: DeviceMap) -> Mapping[Piece, Pad]:
    words, pads = {word(piece): piece for piece in Piece}, dict(base.pads)
    found = table.table("pads", {})
    found.only(set(words))
    for name in found.raw:
        entry, usual = found.table(name), base.pad(words[name])
        entry.only({"threshold", "mask_ms", "least_velocity", "curve"})
        least = entry.whole("least_velocity", 1, 127, 1) if "least_velocity" in entry.raw else usual.least_velocity
        threshold = entry.whole("threshold", 1, 127, usual.threshold)
        curve = _curve(entry) if "curve" in entry.raw else usual.curve
        pads[words[name]] = Pad(threshold, _ns(entry, "mask_ms", usual.mask_ns), least, curve)
    return MappingProxyType(pads)


def _curve(entry: Table) -> VelocityCurve:
    """A curve by its name, or by its numbers."""
    if isinstance(entry.raw["curve"], str):
        return SHAPES[entry.word("curve", tuple(SHAPES), "")]
    table = entry.table("curve")
    table.only({"softest", "loudest", "bend"})
    usual = VelocityCurve()
    softest = table.number("softest", SOFTEST_FROM, SOFTEST_TO, usual.softest)
    loudest = table.number("loudest", LOUDEST_FROM, LOUDEST_TO, usual.loudest)
    if loudest < softest + LEAST_SPAN:
        raise BadInput(table.source, f"{table.place}.loudest", f"expected {LEAST_SPAN:g} or more above softest")
    return VelocityCurve(softest, loudest, table.number("bend", -MOST_BEND, MOST_BEND, usual.bend))


def _crosstalk(entry: Table) -> Crosstalk:
    entry.only({"source", "victim", "share", "within_ms", "before_ms"})
    source, victim = _member(entry, "source", Piece), _member(entry, "victim", Piece)
    if source is victim:
        raise BadInput(entry.source, f"{entry.place}.victim", "a pad is not its own crosstalk; its mask_ms is for that")
    share = entry.number("share", 0.0, 1.0)
    within_ns, before_ns = _ns(entry, "within_ms", GHOST_WITHIN_NS), _ns(entry, "before_ms", GHOST_BEFORE_NS)
    return Crosstalk(source, victim, share, within_ns, before_ns)
