"""Recipes of a kit played with brushes: a fan of wires instead of a stick, and everything softer and slower.

The fan's wires land over some milliseconds, so nothing begins sharply, and there is no stick's knock. The snare's wires
answer as strongly as its head. A buzz is the sweep over the coated head. Pedals and shells are the acoustic kit's.
Energies and decays: our choice, by ear and by what recordings of brushes show.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from station.core.sound_names import SoundName
from station.sound.synth import cymbal_recipes, drum_recipes, percussion_recipes
from station.sound.synth.recipe import Cloud, Glide, Noise, Recipe, Row, Tone

FAN_ATTACK_S = 0.005
"""The wires of a fan land within about so long."""
SOFTER_DB = 5.0
"""A brush moves a drum less than a stick does."""

_FAN: tuple[Row, ...] = (
    Noise(1200.0, 4000.0, -15.0, 0.050, attack_s=FAN_ATTACK_S),
    Noise(4000.0, 12000.0, -13.0, 0.060, attack_s=FAN_ATTACK_S),
)
_HEAD: tuple[Row, ...] = (
    Tone(178.0, -7.0, 0.20),
    Tone(318.0, -16.0, 0.17),
    Tone(406.0, -19.0, 0.15),
)
_LAYERS = (40, 80, 127)

_SNARE = Recipe(
    rows=(
        *_HEAD,
        Noise(500.0, 1000.0, -15.0, 0.22, attack_s=FAN_ATTACK_S),
        Noise(1000.0, 2000.0, -11.0, 0.26, attack_s=FAN_ATTACK_S),
        Noise(2000.0, 4000.0, -8.0, 0.28, attack_s=FAN_ATTACK_S),
        Noise(4000.0, 8000.0, -7.5, 0.26, attack_s=FAN_ATTACK_S),
        Noise(8000.0, 15000.0, -10.0, 0.22, attack_s=FAN_ATTACK_S),
    ),
    loudness_db=-18.0,
    layers=_LAYERS,
    glide=Glide(ratio=0.05, tau_s=0.015),
    tilt_db=1.5,
    pan=-0.05,
    width=0.25,
    room_db=-12.0,
)

_RIM_SHOT = replace(_SNARE, rows=(Tone(441.0, -12.0, 0.20), Tone(792.0, -14.0, 0.16), *_SNARE.rows), loudness_db=-16.5)

_SWEEP = Recipe(
    rows=(
        Noise(900.0, 2500.0, -14.0, 0.50, attack_s=0.090),
        Noise(2500.0, 6000.0, -7.0, 0.55, attack_s=0.080),
        Noise(6000.0, 14000.0, -8.0, 0.50, attack_s=0.070),
    ),
    loudness_db=-23.0,
    layers=(50, 90, 127),
    tilt_db=1.0,
    pan=-0.05,
    width=0.35,
    room_db=-14.0,
)

_CROSS_STICK = replace(drum_recipes.RECIPES[SoundName.SNARE_CROSS_STICK], loudness_db=-25.0, tilt_db=2.5)
"""The brush's handle, lighter than a stick."""


def _slowed(row: Row) -> Row:
    """The row as a fan excites it: what is no tone rises no faster than the wires land."""
    return row if isinstance(row, Tone) else replace(row, attack_s=max(row.attack_s, FAN_ATTACK_S))


def _is_knock(row: Row) -> bool:
    """Whether the row is the stick's own short noise."""
    return isinstance(row, Noise) and row.t60_s < 0.08


def _brushed(recipe: Recipe) -> Recipe:
    """A drum or cymbal of the acoustic kit under a brush."""
    rows = tuple(_slowed(row) for row in recipe.rows if not _is_knock(row))
    louder = recipe.loudness_db - SOFTER_DB
    return replace(recipe, rows=(*rows, *_FAN), loudness_db=louder, tilt_db=recipe.tilt_db + 0.5)


_FEET = frozenset({SoundName.KICK, SoundName.HIHAT_CHICK, SoundName.HIHAT_FOOT_SPLASH})

_KICK = replace(
    drum_recipes.RECIPES[SoundName.KICK],
    loudness_db=-14.0,
    rows=(
        Tone(58.0, -1.0, 0.60),
        Tone(92.0, -8.0, 0.34),
        Tone(138.0, -13.0, 0.20),
        Noise(300.0, 1000.0, -27.0, 0.08),
        Noise(1000.0, 3000.0, -30.0, 0.025, attack_s=0.002),  # a felt beater
    ),
)

RECIPES: Mapping[SoundName, Recipe] = MappingProxyType(
    {
        **{name: recipe if name in _FEET else _brushed(recipe) for name, recipe in drum_recipes.RECIPES.items()},
        **{name: recipe if name in _FEET else _brushed(recipe) for name, recipe in cymbal_recipes.RECIPES.items()},
        **percussion_recipes.RECIPES,
        SoundName.KICK: _KICK,
        SoundName.SNARE: _SNARE,
        SoundName.SNARE_RIM_SHOT: _RIM_SHOT,
        SoundName.SNARE_BUZZ: _SWEEP,
        SoundName.SNARE_CROSS_STICK: _CROSS_STICK,
        SoundName.RIDE_BELL: replace(
            cymbal_recipes.RECIPES[SoundName.RIDE_BELL],
            loudness_db=-27.0,
            rows=(*cymbal_recipes.RECIPES[SoundName.RIDE_BELL].rows, Cloud(2400.0, 5000.0, 20, -18.0, 1.0)),
        ),
    }
)
