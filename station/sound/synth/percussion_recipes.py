"""Recipes of what else may stand beside a kit: cowbell, tambourine, clap and a wood block for anything unknown."""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.sound_names import SoundName
from station.sound.synth.recipe import Cloud, Noise, Recipe, Tone

LAYERS = (50, 90, 127)

_COWBELL = Recipe(
    rows=(
        Tone(562.0, -2.5, 0.34),
        Tone(846.0, -6.0, 0.30),
        Tone(1488.0, -14.0, 0.18),
        Tone(2236.0, -16.0, 0.14),
        Tone(3470.0, -19.0, 0.10),
        Noise(1500.0, 7000.0, -18.0, 0.022),
    ),
    loudness_db=-18.0,
    layers=LAYERS,
    tilt_db=2.0,
    pan=0.05,
    room_db=-14.0,
)

_TAMBOURINE = Recipe(
    rows=(
        Tone(236.0, -17.0, 0.09),
        Cloud(3800.0, 6500.0, 24, -9.0, 0.24),
        Cloud(6500.0, 10500.0, 36, -4.0, 0.28),
        Cloud(10500.0, 16000.0, 44, -7.0, 0.22),
        Noise(6000.0, 15000.0, -8.0, 0.09),
    ),
    loudness_db=-23.0,
    layers=LAYERS,
    tilt_db=0.8,
    pan=-0.15,
    width=0.3,
    room_db=-16.0,
    echoes=((0.013, 0.5), (0.031, 0.55), (0.058, 0.3), (0.090, 0.18)),  # the jingles fall back on one another
)

_CLAP = Recipe(
    rows=(
        Noise(650.0, 1200.0, -7.0, 0.045),
        Noise(1200.0, 2600.0, -3.0, 0.050),
        Noise(2600.0, 6500.0, -10.0, 0.040),
    ),
    loudness_db=-19.0,
    layers=LAYERS,
    tilt_db=1.2,
    width=0.5,
    room_db=-5.0,
    echoes=((0.009, 0.75), (0.018, 0.85), (0.026, 0.95)),  # several hands, not quite together
)

_WOOD_BLOCK = Recipe(
    rows=(
        Tone(905.0, -1.5, 0.10),
        Tone(1630.0, -8.0, 0.07),
        Tone(2790.0, -13.0, 0.05),
        Noise(1500.0, 6000.0, -14.0, 0.015),
    ),
    loudness_db=-20.5,
    layers=LAYERS,
    tilt_db=1.5,
    pan=0.1,
    room_db=-13.0,
)

RECIPES: Mapping[SoundName, Recipe] = MappingProxyType(
    {
        SoundName.COWBELL: _COWBELL,
        SoundName.TAMBOURINE: _TAMBOURINE,
        SoundName.CLAP: _CLAP,
        SoundName.PERCUSSION: _WOOD_BLOCK,
    }
)
