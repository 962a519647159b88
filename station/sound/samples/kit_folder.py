"""A kit from a folder of sound files: by their names alone, or by a small table, `kit.toml`, beside them.

By name: `snare_v40_r2.flac` is the snare's second take for velocities up to 40. Where the highest number of a sound's
layers is no more than `MOST_RANKS`, they are ranks and share the velocities evenly. The table (docs/sound.md):

    name = "Shed"
    loudness = "evened"            # or "recorded": the layers keep the loudness they were recorded with
    [sounds.snare]
    gain_db = -2.0
    pan = -0.1
    mute_group = 1
    layers = [{ to_velocity = 60, takes = ["a.wav", "b.wav"] }, { to_velocity = 127, takes = ["c.wav"], pitch = -1.0 }]
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path

import numpy as np

from station.core.errors import BadInput
from station.core.sound_names import SoundName
from station.core.sound_naming import FileName, file_named
from station.core.toml.schema import (
    Field,
    Fields,
    Reader,
    key_of,
    list_of,
    needed,
    number,
    one_of,
    optional,
    read,
    record,
    table_of,
    text,
    whole,
)
from station.core.toml.toml_faults import wrong
from station.core.toml.toml_source import read_source
from station.sound.drum_kit import LEVEL_LAW, MAX_VELOCITY, DrumKit, Frames, Layer, Sound, level_of
from station.sound.samples.audio_file import ENDINGS
from station.sound.samples.recordings import Recordings, balance_of, even, kit_of

TABLE_NAME = "kit.toml"
MAX_FILES = 4096
MOST_RANKS = 10
"""A hardest layer for velocities up to 10 alone makes no sense: such numbers count the layers (our choice)."""
_MOST_GROUPS = 1000
"""Of sounds that mute each other: more than a kit has sounds (our choice)."""


def folder_kit(folder: Path, rate_hz: int) -> DrumKit:
    """The kit in `folder` at `rate_hz`; raises `BadInput` that names the file and the fault."""
    files = audio_files(folder)
    recordings = Recordings(str(folder), rate_hz, files)
    table = folder / TABLE_NAME
    if table.exists():
        return _kit(read(read_source(table), KIT_TABLE), folder, rate_hz, recordings)
    return kit_of(folder.name, rate_hz, _sounds_by_name(folder, rate_hz, files, recordings))


def audio_files(folder: Path) -> dict[str, Path | bytes]:
    """The sound files in `folder` and the folders in it, by their path from it with forward slashes.

    Links that lead out of the folder are left alone. Raises `BadInput` for more than `MAX_FILES`.
    """
    home = folder.resolve()
    found: dict[str, Path | bytes] = {}
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() in ENDINGS and path.is_file() and path.resolve().is_relative_to(home):
            found[path.relative_to(folder).as_posix()] = path
            if len(found) > MAX_FILES:
                raise BadInput(folder, "", f"more than {MAX_FILES} sound files is no drum kit")
    return found


def _sounds_by_name(
    folder: Path, rate_hz: int, files: Mapping[str, Path | bytes], recordings: Recordings
) -> dict[SoundName, Sound]:
    named = [(meant, path) for path in files if (meant := file_named(Path(path).stem)) is not None]
    if not named:
        raise BadInput(folder, "", "no sound file here is named after a piece of a drum kit, such as snare.wav")
    named.sort()
    return {
        sound: _evened(_layers([*group], recordings), rate_hz)
        for sound, group in groupby(named, key=lambda entry: entry[0].sound)
    }


def _evened(layers: list[tuple[int, list[Frames]]], rate_hz: int) -> Sound:
    even([takes for _, takes in layers], rate_hz)
    return Sound(tuple(Layer(reach, tuple(takes)) for reach, takes in layers))


def _layers(named: list[tuple[FileName, str]], recordings: Recordings) -> list[tuple[int, list[Frames]]]:
    """Each layer's reach and takes, soft to hard; the hardest reaches `MAX_VELOCITY`."""
    reach_of = _reaches(sorted({name.layer for name, _ in named}))
    takes: dict[int, list[Frames]] = {}
    for name, path in named:
        takes.setdefault(reach_of[name.layer], []).append(recordings.load(path))
    return sorted(takes.items())


def _reaches(layers: list[int]) -> dict[int, int]:
    """The velocity up to which each layer reaches: its own number, or an even share where the numbers are ranks."""
    if layers[-1] <= MOST_RANKS or layers[-1] > MAX_VELOCITY:
        return {layer: round(MAX_VELOCITY * (rank + 1) / len(layers)) for rank, layer in enumerate(layers)}
    return {layer: layer if 0 < layer < layers[-1] else MAX_VELOCITY for layer in layers}


# --- the table --------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class LayerRow:
    """A layer as the table has it: the velocity it reaches, its files, its pitch in semitones and its gain."""

    to_velocity: int
    takes: tuple[str, ...]
    pitch: float
    gain_db: float


@dataclass(frozen=True, slots=True)
class SoundRow:
    """A sound as the table has it."""

    gain_db: float
    pan: float
    mute_group: int | None
    layers: tuple[LayerRow, ...]


@dataclass(frozen=True, slots=True)
class KitTable:
    """What a `kit.toml` says; an empty `name` is the folder's."""

    name: str
    loudness: str
    sounds: Mapping[SoundName, SoundRow]


def _layers_that_rise(raw: object) -> tuple[LayerRow, ...]:
    rows = _LAYERS(raw)
    reaches = [row.to_velocity for row in rows]
    if not rows:
        raise wrong(f"expected {_A_LIST}, found none")
    if reaches != sorted(set(reaches)) or reaches[-1] != MAX_VELOCITY:
        raise wrong(f"to_velocity rises from layer to layer, to {MAX_VELOCITY}")
    return rows


def _takes(raw: object) -> tuple[str, ...]:
    names = list_of(text, "a list of file names")(raw)
    if not names:
        raise wrong("expected a list of file names, found none")
    return names


def _kit_table(name: str, loudness: str, sounds: Mapping[SoundName, SoundRow]) -> KitTable:
    if not sounds:
        raise wrong("a kit needs at least one table such as [sounds.snare]", "sounds")
    return KitTable(name, loudness, sounds)


_A_LIST = "a list of layers"
_GAIN = Field(number(-60.0, 24.0), 0.0)
_LAYER: Fields = {
    "to_velocity": Field(whole(1, MAX_VELOCITY), MAX_VELOCITY),
    "takes": needed(_takes, 'takes = ["snare.wav"]'),
    "pitch": Field(number(-24.0, 24.0), 0.0),
    "gain_db": _GAIN,
}
_LAYERS = list_of(record(LayerRow, _LAYER), _A_LIST)
_SOUND: Fields = {
    "gain_db": _GAIN,
    "pan": Field(number(-1.0, 1.0), 0.0),
    "mute_group": optional(whole(0, _MOST_GROUPS)),
    "layers": needed(_layers_that_rise, 'layers = [{ takes = ["snare.wav"] }]'),
}
_SOUNDS = table_of(key_of({each.value: each for each in SoundName}, "sound"), record(SoundRow, _SOUND))
FIELDS: Fields = {
    "name": Field(text, ""),
    "loudness": Field(one_of(("evened", "recorded"), "loudness"), "evened"),
    "sounds": needed(_SOUNDS, "a table such as [sounds.snare]"),
}
KIT_TABLE: Reader[KitTable] = record(_kit_table, FIELDS)
"""The schema of the file."""


def _kit(table: KitTable, folder: Path, rate_hz: int, recordings: Recordings) -> DrumKit:
    """The kit that the table describes."""
    is_evened = table.loudness == "evened"
    sounds = {name: _sound(row, recordings, rate_hz if is_evened else None) for name, row in table.sounds.items()}
    return kit_of(table.name or folder.name, rate_hz, sounds)


def _sound(row: SoundRow, recordings: Recordings, even_at_hz: int | None) -> Sound:
    """One sound; its layers are made equally loud at the rate `even_at_hz`, or stay as recorded where that is None."""
    layers = [[recordings.load(name, layer.pitch) for name in layer.takes] for layer in row.layers]
    reaches = [layer.to_velocity for layer in row.layers]
    if even_at_hz is not None:
        even(layers, even_at_hz)
    for layer, takes in zip(row.layers, layers, strict=True):
        for take in takes:
            take *= np.float32(_gain(row) * _gain(layer)) * balance_of(row.pan)  # noqa: PLW2901 - in place
    levels = LEVEL_LAW if even_at_hz is not None else recorded_levels(reaches)
    made = tuple(Layer(reach, tuple(takes)) for reach, takes in zip(reaches, layers, strict=True))
    return Sound(made, levels, row.mute_group)


def _gain(row: SoundRow | LayerRow) -> float:
    return float(10.0 ** (row.gain_db / 20.0))


def recorded_levels(reaches: list[int]) -> tuple[float, ...]:
    """The level of each velocity 0–127 where a layer was recorded as loud as its greatest velocity sounds."""
    reach_of = [next(reach for reach in reaches if velocity <= reach) for velocity in range(MAX_VELOCITY + 1)]
    return tuple(LEVEL_LAW[velocity] / level_of(reach) for velocity, reach in enumerate(reach_of))
