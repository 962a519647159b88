"""Writes a kit as the TOML that `device_file` reads: only what differs from the preset that it is built on."""

from collections.abc import Iterator

from station.core.note_map import NoteMeaning
from station.core.pieces import Articulation, Zone, word
from station.core.toml.toml_write import toml_text
from station.core.units import ms_from_ns
from station.devices.mapping.device_map import PLAIN_PAD, Crosstalk, DeviceMap, Foot, Pad, PedalRange
from station.devices.mapping.presets import GENERAL_MIDI_PRESET, KNOWN_KITS
from station.devices.mapping.velocity_curve import SHAPES, VelocityCurve


def kit_text(kit: DeviceMap) -> str:
    """The file of `kit`; reading it gives an equal kit, but for its name and its ports."""
    base = KNOWN_KITS.get(kit.base or kit.name, GENERAL_MIDI_PRESET)
    lines = [f"title = {toml_text(kit.title)}", f"base = {toml_text(base.name)}"]
    lines += _notes(kit, base)
    lines += [f"channels.{at}.notes.{note} = {_strike(to)}" for (at, note), to in sorted(kit.channel_notes.items())]
    if kit.pedal != base.pedal:
        lines.append(f"pedal = {_pedal(kit.pedal)}")
    if kit.foot != base.foot:
        lines.append(f"foot = {_foot(kit.foot)}")
    lines += _chokes(kit, base)
    if kit.position_controllers != base.position_controllers:
        lines += _positions(kit)
    lines += [f"pads.{word(piece)} = {_pad(pad)}" for piece, pad in sorted(kit.pads.items())]
    if kit.crosstalk != base.crosstalk:
        lines += [line for rule in kit.crosstalk for line in _crosstalk(rule)] or ["crosstalk = []"]
    return "\n".join(lines) + "\n"


def _notes(kit: DeviceMap, base: DeviceMap) -> Iterator[str]:
    for number in sorted({*kit.notes, *base.notes}):
        strike = kit.notes.get(number)
        if strike != base.notes.get(number):
            yield f"notes.{number} = {_strike(strike)}"


def _strike(strike: NoteMeaning | None) -> str:
    if strike is None:
        return '{ piece = "none" }'
    parts = [f'piece = "{word(strike.piece)}"']
    if strike.zone is not Zone.HEAD:
        parts.append(f'zone = "{word(strike.zone)}"')
    if strike.articulation is not Articulation.NORMAL:
        parts.append(f'articulation = "{word(strike.articulation)}"')
    if strike.openness is not None:
        parts.append(f"openness = {float(strike.openness)!r}")
    return f"{{ {', '.join(parts)} }}"


def _pedal(pedal: PedalRange | None) -> str:
    if pedal is None:
        return "{ present = false }"
    steps = ", ".join(map(str, pedal.steps))
    return f"{{ controller = {pedal.controller}, open = {pedal.wide_open}, shut = {pedal.shut}, steps = [{steps}] }}"


def _foot(foot: Foot) -> str:
    by_controller = str(foot.by_controller).lower()
    travel, splash_ms = float(foot.least_travel), ms_from_ns(foot.splash_ns)
    return f"{{ least_travel = {travel!r}, splash_ms = {splash_ms!r}, by_controller = {by_controller} }}"


def _chokes(kit: DeviceMap, base: DeviceMap) -> Iterator[str]:
    if kit.choke_from != base.choke_from:
        yield f"choke.from = {kit.choke_from}"
    if kit.grab_velocity != base.grab_velocity:
        yield f"choke.grab_velocity = {kit.grab_velocity}"
    if kit.choke_notes != base.choke_notes:
        for number, piece in sorted(kit.choke_notes.items()):
            yield f'choke.notes.{number} = {{ piece = "{word(piece)}" }}'
        if not kit.choke_notes:
            yield "choke.notes = {}"


def _positions(kit: DeviceMap) -> Iterator[str]:
    for number, pieces in sorted(kit.position_controllers.items()):
        names = ", ".join(f'"{word(piece)}"' for piece in sorted(pieces))
        yield f"positions.{number} = {{ pieces = [{names}] }}"
    if not kit.position_controllers:
        yield "positions = {}"


def _pad(pad: Pad) -> str:
    said = {
        "threshold": pad.threshold if pad.threshold != PLAIN_PAD.threshold else None,
        "mask_ms": ms_from_ns(pad.mask_ns) if pad.mask_ns else None,
        "least_velocity": pad.least_velocity,
        "curve": _curve(pad.curve) if pad.curve != PLAIN_PAD.curve else None,
    }
    return f"{{ {', '.join(f'{key} = {value}' for key, value in said.items() if value is not None)} }}"


def _curve(curve: VelocityCurve) -> str:
    name = next((name for name, shape in SHAPES.items() if shape == curve), None)
    if name is not None:
        return toml_text(name)
    return f"{{ softest = {curve.softest!r}, loudest = {curve.loudest!r}, bend = {curve.bend!r} }}"


def _crosstalk(rule: Crosstalk) -> Iterator[str]:
    yield "\n[[crosstalk]]"
    yield f'source = "{word(rule.source)}"'
    yield f'victim = "{word(rule.victim)}"'
    yield f"share = {float(rule.share)!r}"
    yield f"within_ms = {ms_from_ns(rule.within_ns)!r}"
    yield f"before_ms = {ms_from_ns(rule.before_ns)!r}"
