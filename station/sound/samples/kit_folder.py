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
from itertools import groupby
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from station.core.did_you_mean import did_you_mean
from station.core.errors import BadInput
from station.core.toml_table import parse_toml
from station.sound.drum_kit import LEVEL_LAW, MAX_VELOCITY, DrumKit, Frames, Layer, Sound, level_of
from station.sound.samples.audio_file import ENDINGS
from station.sound.samples.recordings import Recordings, balance_of, even, kit_of
from station.sound.samples.sound_naming import FileName, file_named
from station.sound.sound_names import SoundName

TABLE_NAME = "kit.toml"
MAX_FILES = 4096
MAX_TABLE_BYTES = 2**20
MOST_RANKS = 10
"""A hardest layer for velocities up to 10 alone makes no sense: such numbers count the layers (our choice)."""
_KIT_KEYS = frozenset({"name", "loudness", "sounds"})
_SOUND_KEYS = frozenset({"gain_db", "pan", "mute_group", "layers"})
_LAYER_KEYS = frozenset({"to_velocity", "takes", "pitch", "gain_db"})
_GAIN_DB = (-60.0, 24.0)
_PITCH = (-24.0, 24.0)


def folder_kit(folder: Path, rate_hz: int) -> DrumKit:
    """The kit in `folder` at `rate_hz`; raises `BadInput` that names the file and the fault."""
    files = audio_files(folder)
    recordings = Recordings(str(folder), rate_hz, files)
    table = folder / TABLE_NAME
    if table.exists():
        return _Table(table, rate_hz, recordings).kit()
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
    named = [(did_you_mean, path) for path in files if (did_you_mean := file_named(Path(path).stem)) is not None]
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
        takes.setdefault(reach_of[name.layer], []).append(recordings.take(path))
    return sorted(takes.items())


def _reaches(layers: list[int]) -> dict[int, int]:
    """The velocity up to which each layer reaches: its own number, or an even share where the numbers are ranks."""
    if layers[-1] <= MOST_RANKS or layers[-1] > MAX_VELOCITY:
        return {layer: round(MAX_VELOCITY * (rank + 1) / len(layers)) for rank, layer in enumerate(layers)}
    return {layer: layer if 0 < layer < layers[-1] else MAX_VELOCITY for layer in layers}


class _Row(NamedTuple):
    """A layer as the table has it: the velocity it reaches, its takes, and the factor on them."""

    reach: int
    takes: list[Frames]
    gain: float


class _Table:
    """Reads `kit.toml`; every fault names the key."""

    def __init__(self, path: Path, rate_hz: int, recordings: Recordings) -> None:
        self._path = path
        self._rate_hz = rate_hz
        self._recordings = recordings
        self._raw = self._load()
        self._check_keys(self._raw, _KIT_KEYS, "")
        self._is_evened = self._choice("loudness", ("evened", "recorded")) == "evened"

    def kit(self) -> DrumKit:
        """The kit that the table describes."""
        sounds = self._raw.get("sounds")
        if not isinstance(sounds, dict) or not sounds:
            raise self._fault("sounds", "a kit needs at least one table such as [sounds.snare]")
        name = self._raw.get("name", self._path.parent.name)
        if not isinstance(name, str):
            raise self._fault("name", "expected a text")
        return kit_of(name, self._rate_hz, {self._sound_name(key): self._sound(key, sounds[key]) for key in sounds})

    def _load(self) -> dict[str, Any]:
        try:
            data = self._path.read_bytes()
            if len(data) > MAX_TABLE_BYTES:
                raise self._fault("", f"larger than {MAX_TABLE_BYTES} bytes is no table of a kit")
            return parse_toml(data, self._path)
        except OSError as fault:
            raise self._fault("", fault.strerror or str(fault)) from fault

    def _sound_name(self, key: str) -> SoundName:
        if key not in set(SoundName):
            raise self._fault(f"sounds.{key}", f"no such sound{did_you_mean(key, SoundName)}")
        return SoundName(key)

    def _sound(self, key: str, raw: object) -> Sound:
        place = f"sounds.{key}"
        table = self._table(raw, place)
        self._check_keys(table, _SOUND_KEYS, place)
        rows = table.get("layers")
        if not isinstance(rows, list) or not rows:
            raise self._fault(f"{place}.layers", "expected a list of layers")
        layers = [self._layer(row, f"{place}.layers[{index}]") for index, row in enumerate(rows)]
        reaches = [layer.reach for layer in layers]
        if reaches != sorted(set(reaches)) or reaches[-1] != MAX_VELOCITY:
            raise self._fault(f"{place}.layers", f"to_velocity rises from layer to layer, to {MAX_VELOCITY}")
        group = table.get("mute_group")
        if group is not None and (type(group) is not int or group < 0):
            raise self._fault(f"{place}.mute_group", "expected a number from 0")
        levels = LEVEL_LAW if self._is_evened else recorded_levels(reaches)
        if self._is_evened:
            even([layer.takes for layer in layers], self._rate_hz)
        gain = self._gain(table, place)
        pan = self._number(table, "pan", (-1.0, 1.0), place)
        for layer in layers:
            for take in layer.takes:
                take *= np.float32(gain * layer.gain) * balance_of(pan)  # noqa: PLW2901 - in place
        return Sound(tuple(Layer(layer.reach, tuple(layer.takes)) for layer in layers), levels, group)

    def _layer(self, raw: object, place: str) -> "_Row":
        table = self._table(raw, place)
        self._check_keys(table, _LAYER_KEYS, place)
        reach = table.get("to_velocity", MAX_VELOCITY)
        if type(reach) is not int or not 1 <= reach <= MAX_VELOCITY:
            raise self._fault(f"{place}.to_velocity", f"expected 1 to {MAX_VELOCITY}")
        names = table.get("takes")
        if not isinstance(names, list) or not names or not all(isinstance(name, str) for name in names):
            raise self._fault(f"{place}.takes", "expected a list of file names")
        pitch = self._number(table, "pitch", _PITCH, place)
        return _Row(reach, [self._recordings.take(name, pitch) for name in names], self._gain(table, place))

    def _gain(self, table: dict[str, Any], place: str) -> float:
        return float(10.0 ** (self._number(table, "gain_db", _GAIN_DB, place) / 20.0))

    def _choice(self, key: str, choices: tuple[str, ...]) -> str:
        value = self._raw.get(key, choices[0])
        if value not in choices:
            raise self._fault(key, f"expected one of {', '.join(choices)}")
        return str(value)

    def _number(self, table: dict[str, Any], key: str, within: tuple[float, float], place: str) -> float:
        value = table.get(key, 0.0)
        if type(value) not in (int, float) or not within[0] <= value <= within[1]:
            raise self._fault(f"{place}.{key}", f"expected {within[0]:g} to {within[1]:g}")
        return float(value)

    def _table(self, raw: object, place: str) -> dict[str, Any]:
        if not isinstance(raw, dict):
            raise self._fault(place, "expected a table")
        return raw

    def _check_keys(self, table: Mapping[str, object], known: frozenset[str], place: str) -> None:
        for key in table:
            if key not in known:
                raise self._fault(f"{place}.{key}".lstrip("."), f"no such key{did_you_mean(key, sorted(known))}")

    def _fault(self, place: str, fault: str) -> BadInput:
        return BadInput(self._path, place, fault)


def recorded_levels(reaches: list[int]) -> tuple[float, ...]:
    """The level of each velocity 0–127 where a layer was recorded as loud as its greatest velocity sounds."""
    reach_of = [next(reach for reach in reaches if velocity <= reach) for velocity in range(MAX_VELOCITY + 1)]
    return tuple(LEVEL_LAW[velocity] / level_of(reach) for velocity, reach in enumerate(reach_of))
