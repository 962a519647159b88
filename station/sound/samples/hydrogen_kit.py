"""A drum kit of Hydrogen's, from its folder or its `.h2drumkit`, as a kit of ours.

What Hydrogen does in its mixer is done here once, at load: gains and pan are multiplied in, pitch is resampled, the
microphones of one stroke are added, attack and decay shape the take. The level is in proportion to the velocity, as it
is there. Each piece takes the instrument whose name, kind or MIDI note means it; the hi-hat's openings take the
instruments of its group by their controller ranges. Filters, effects and random pitch are left out.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath

import numpy as np

from station.core.errors import BadInput
from station.core.sound_names import HIHAT_STEPS, SoundName
from station.core.sound_naming import FAMILIES, are_chosen, sound_named, sound_of_instrument
from station.music.formats.safe_xml import MOST_XML_BYTES
from station.sound.drum_kit import MAX_VELOCITY, DrumKit, Frames, Layer, Sound
from station.sound.samples.hydrogen_xml import (
    HydrogenComponent,
    HydrogenInstrument,
    HydrogenKit,
    HydrogenLayer,
    parse_kit,
)
from station.sound.samples.kit_archive import unpacked
from station.sound.samples.kit_folder import audio_files
from station.sound.samples.recordings import Recordings, kit_of

KIT_FILE = "drumkit.xml"
ARCHIVE_ENDING = ".h2drumkit"
MAX_VELOCITY_LAYERS = 64
"""So many steps of velocity are kept apart; finer ones cannot be heard (our choice)."""
STRAIGHT = tuple(velocity / MAX_VELOCITY for velocity in range(MAX_VELOCITY + 1))
"""The level of each velocity in Hydrogen."""
_FULL = (1.0,) * (MAX_VELOCITY + 1)


def hydrogen_folder(folder: Path, rate_hz: int) -> DrumKit:
    """The kit in `folder` at `rate_hz`; raises `BadInput`."""
    source = folder / KIT_FILE
    try:
        with source.open("rb") as file:
            data = file.read(MOST_XML_BYTES + 1)
    except OSError as fault:
        raise BadInput(source, "", fault.strerror or str(fault)) from fault
    return built(parse_kit(data, str(source)), str(source), rate_hz, audio_files(folder))


def hydrogen_archive(path: Path, rate_hz: int) -> DrumKit:
    """The kit in the `.h2drumkit` at `rate_hz`; raises `BadInput`."""
    files = unpacked(path)
    found = next((name for name in sorted(files, key=len) if PurePosixPath(name).name == KIT_FILE), None)
    if found is None:
        raise BadInput(path, "", f"holds no {KIT_FILE}")
    home = PurePosixPath(found).parent
    inside = {
        PurePosixPath(name).relative_to(home).as_posix(): data
        for name, data in files.items()
        if PurePosixPath(name).is_relative_to(home)
    }
    return built(parse_kit(files[found], f"{path}: {found}"), str(path), rate_hz, inside)


def built(kit: HydrogenKit, source: str, rate_hz: int, files: Mapping[str, Path | bytes]) -> DrumKit:
    """The kit with its recordings read; raises `BadInput` where one is missing or none of it is a drum."""
    chosen = pieces_of(kit)
    if not chosen:
        raise BadInput(source, "", "none of its instruments is known as a piece of a drum kit")
    recordings = Recordings(source, rate_hz, files)
    made: dict[int, Sound] = {}
    sounds = {}
    for name, instrument in chosen.items():
        if id(instrument) not in made:
            made[id(instrument)] = _sound(instrument, recordings)
        sounds[name] = made[id(instrument)]
    return kit_of(kit.name, rate_hz, sounds)


# --- which instrument is which piece -----------------------------------------------------------------------------


def pieces_of(kit: HydrogenKit) -> dict[SoundName, HydrogenInstrument]:
    """The instrument of every sound that the kit has, the first of several that mean the same."""
    sounding = [instrument for instrument in kit.instruments if instrument.components]
    trusts_notes = are_chosen([one.midi_note for one in sounding])
    chosen: dict[SoundName, HydrogenInstrument] = {}
    for instrument in sounding:
        note = instrument.midi_note if trusts_notes else None
        name = sound_of_instrument(instrument.name, instrument.kind, note)
        free = [name] if name not in _FAMILY_OF else [n for n in _FAMILY_OF[name] if n not in chosen]
        if name is not None and free and free[0] is not None:
            wanted = name if name in free else free[0]
            chosen.setdefault(wanted, instrument)
    return chosen | _by_openness(sounding)


_FAMILY_OF: Mapping[SoundName | None, tuple[SoundName, ...]] = {name: family for family in FAMILIES for name in family}


def _by_openness(instruments: Sequence[HydrogenInstrument]) -> dict[SoundName, HydrogenInstrument]:
    """The hi-hat's openings by controller ranges, where instruments of one group divide them; else none.

    A pedal's controller says 127 for shut on most modules and 0 on some; which way a kit was made for is told by the
    names of its instruments, and 0 is shut where they do not tell.
    """
    for group in sorted({one.hihat_group for one in instruments if one.hihat_group is not None}):
        struck = [one for one in instruments if one.hihat_group == group and not _is_foot(one)]
        if len({(one.low_cc, one.high_cc) for one in struck}) < 2:
            continue
        last = len(HIHAT_STEPS) - 1
        is_turned = _falls_with_openness(struck)
        found = {}
        for step, name in enumerate(HIHAT_STEPS):
            controller = round(127 * (last - step if is_turned else step) / last)
            fitting = [one for one in struck if one.low_cc <= controller <= one.high_cc]
            if fitting:
                found[name] = fitting[0]
        return found
    return {}


def _is_foot(instrument: HydrogenInstrument) -> bool:
    return sound_named(instrument.name) in (SoundName.HIHAT_CHICK, SoundName.HIHAT_FOOT_SPLASH)


def _falls_with_openness(struck: Sequence[HydrogenInstrument]) -> bool:
    named = [(HIHAT_STEPS.index(name), one.low_cc + one.high_cc) for one in struck if (name := _hat_step(one))]
    if len(named) < 2:
        return False
    (_, first), (_, last) = min(named), max(named)
    return first > last


def _hat_step(instrument: HydrogenInstrument) -> SoundName | None:
    name = sound_named(instrument.name)
    return name if name in HIHAT_STEPS else None


# --- what an instrument sounds like ------------------------------------------------------------------------------


def _sound(instrument: HydrogenInstrument, recordings: Recordings) -> Sound:
    made: dict[_Parts, Frames] = {}
    layers = []
    low = 0
    for reach in _reaches(instrument.components):
        parts = _parts(instrument.components, (low + reach) / (2.0 * MAX_VELOCITY))
        for one in parts:
            if one not in made:
                made[one] = _mixed(one, instrument, recordings)
        layers.append(Layer(reach, tuple(made[one] for one in parts)))
        low = reach
    levels = STRAIGHT if instrument.follows_velocity else _FULL
    return Sound(tuple(layers), levels, instrument.mute_group)


def _reaches(components: Sequence[HydrogenComponent]) -> list[int]:
    """The velocities at which the layers change, rising, `MAX_VELOCITY` the last."""
    edges = {edge for one in components for layer in one.layers for edge in (layer.low, layer.high)}
    inner = sorted({round(edge * MAX_VELOCITY) for edge in edges} - {0, MAX_VELOCITY})
    return [*inner[:: -(-len(inner) // MAX_VELOCITY_LAYERS) or 1], MAX_VELOCITY]


_Parts = tuple[tuple[float, HydrogenLayer], ...]
"""What sounds at once: a layer of every microphone, with the microphone's gain."""


def _parts(components: Sequence[HydrogenComponent], velocity: float) -> list[_Parts]:
    """What may sound at `velocity` 0–1, in turn: as many takes as the microphone with the most has."""
    played = [(one.gain, _matching(one, velocity)) for one in components]
    count = max(len(layers) for _, layers in played)
    return [tuple((gain, layers[turn % len(layers)]) for gain, layers in played) for turn in range(count)]


def _matching(component: HydrogenComponent, velocity: float) -> list[HydrogenLayer]:
    """The layers that may sound at `velocity`: the nearest where there is a gap."""
    fitting = [layer for layer in component.layers if layer.low <= velocity <= layer.high]
    if not fitting:
        fitting = [min(component.layers, key=lambda layer: max(layer.low - velocity, velocity - layer.high))]
    return fitting if component.takes_turns else fitting[:1]


def _mixed(parts: _Parts, instrument: HydrogenInstrument, recordings: Recordings) -> Frames:
    played = [recordings.load(layer.filename, layer.pitch) for _, layer in parts]
    whole = np.zeros((max(len(take) for take in played), 2), np.float32)
    for (gain, layer), take in zip(parts, played, strict=True):
        whole[: len(take)] += np.float32(gain * layer.gain) * take
    whole *= np.array([instrument.gain * instrument.left, instrument.gain * instrument.right], np.float32)
    _shape(whole, instrument)
    return whole


def _shape(frames: Frames, instrument: HydrogenInstrument) -> None:
    """Attack and decay, in place: a straight rise, then a straight fall to the sustained level, which stays."""
    if instrument.attack <= 1.0 and (instrument.decay <= 1.0 or instrument.sustain >= 1.0):
        return
    attack = round(instrument.attack)
    corners = [0, max(1, attack), max(1, attack) + max(1, round(instrument.decay))]
    levels = [0.0 if attack > 1 else 1.0, 1.0, instrument.sustain]
    frames *= np.interp(np.arange(len(frames)), corners, levels).astype(np.float32)[:, None]
