"""A drum kit as the mixer plays it: sounds, each in velocity layers, each layer in takes that are played in turn.

Frames are float32 of shape (n, 2), left and right, at the kit's sample rate; the stroke falls on frame 0. A layer's
takes are recorded (or made) as loud as velocity 127 would be; `Sound.levels` then sets the level of every velocity, so
that loudness rises smoothly while the timbre changes from layer to layer. Where a kit lacks a sound, the substitute of
`station.core.sound_names` plays, and the lookup never fails for a kit that has kick, snare and closed hi-hat.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from station.core.note_map import NoteMeaning
from station.core.sound_names import SUBSTITUTES, SoundName, choose_sound

Frames = NDArray[np.float32]
"""Stereo sound: float32 of shape (n, 2), full scale ±1."""

MAX_VELOCITY = 127


def level_of(velocity: float) -> float:
    """The amplitude factor of a velocity 1–127: 40·log10(v/127) dB, the law of most drum modules (Dannenberg 2006)."""
    return (velocity / MAX_VELOCITY) ** 2


LEVEL_LAW = tuple(level_of(velocity) for velocity in range(MAX_VELOCITY + 1))


@dataclass(frozen=True, slots=True, eq=False)
class Layer:
    """The takes that sound for velocities up to and including `to_velocity`."""

    to_velocity: int
    takes: tuple[Frames, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Sound:
    """One sound: layers from soft to hard (the last reaches 127) and the level of each velocity 0–127.

    A stroke stops what else rings of its `mute_group`, as an electronic kit's closed hi-hat stops the open one.
    """

    layers: tuple[Layer, ...]
    levels: tuple[float, ...] = LEVEL_LAW
    mute_group: int | None = None

    def __post_init__(self) -> None:
        reaches = [layer.to_velocity for layer in self.layers]
        assert reaches == sorted(set(reaches)), "layers go from soft to hard"
        assert reaches[-1] >= MAX_VELOCITY, "the hardest layer reaches velocity 127"
        assert len(self.levels) == MAX_VELOCITY + 1, "a level for every velocity"

    def level(self, velocity: float) -> float:
        """The level of `velocity` 1 ≤ v < 128: straight between two whole ones that are of one layer."""
        whole = int(velocity)
        level = self.levels[whole]
        if velocity > whole and whole < MAX_VELOCITY and self._layer(whole) is self._layer(whole + 1):
            level += (velocity - whole) * (self.levels[whole + 1] - level)
        return level

    def frames_for(self, velocity: float, count: int) -> Frames:
        """The frames to play for `velocity` (1–127), the `count`-th time in turn."""
        takes = self._layer(velocity).takes
        return takes[count % len(takes)]

    def _layer(self, velocity: float) -> Layer:
        return next((layer for layer in self.layers if velocity <= layer.to_velocity), self.layers[-1])


@dataclass(frozen=True, slots=True, eq=False)
class DrumKit:
    """A named set of sounds at one sample rate."""

    name: str
    rate_hz: int
    sounds: Mapping[SoundName, Sound]
    _resolved: dict[SoundName, SoundName] = field(init=False, repr=False)

    def __post_init__(self) -> None:
        for needed in (SoundName.KICK, SoundName.SNARE, SoundName.HIHAT_CLOSED):
            assert needed in self.sounds, f"a kit needs a {needed}"
        object.__setattr__(self, "_resolved", {name: self._resolve(name) for name in SoundName})

    def _resolve(self, name: SoundName) -> SoundName:
        """`name` itself, or the nearest substitute that this kit has; the snare where there is none."""
        candidates = (name, *SUBSTITUTES.get(name, ()))
        return next((candidate for candidate in candidates if candidate in self.sounds), SoundName.SNARE)

    def playing(self, name: SoundName) -> SoundName:
        """The sound that is heard for `name`: itself, or what stands in for it."""
        return self._resolved[name]

    def choose(self, strike: NoteMeaning) -> tuple[SoundName, Sound, float]:
        """The sound's name, the sound, and the factor on the velocity that chooses its layer."""
        wanted, timbre = choose_sound(strike)
        name = self._resolved[wanted]
        return name, self.sounds[name], timbre

    @property
    def bytes_held(self) -> int:
        """Memory that the frames take; frames that several layers share count once."""
        takes = {id(take): take.nbytes for s in self.sounds.values() for layer in s.layers for take in layer.takes}
        return sum(takes.values())
