"""The synthesised kits: drum kits made by rule, the same on every computer and at any sample rate.

No recording is bundled. Each sound is a recipe (`station.sound.synth`) of ringing modes and noise, made when the kit is
asked for and then kept; a sound's seed is its name, so that no sound changes when another is added.
"""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from types import MappingProxyType
from zlib import crc32

from station.core.sound_names import SoundName
from station.sound.drum_kit import DrumKit, Sound
from station.sound.synth import brush_recipes, cymbal_recipes, drum_recipes, electronic_recipes, percussion_recipes
from station.sound.synth.layers import make_sound
from station.sound.synth.recipe import Recipe

KIT_NAME = "acoustic"
RECIPES = MappingProxyType({**drum_recipes.RECIPES, **cymbal_recipes.RECIPES, **percussion_recipes.RECIPES})
"""The recipe of every sound the acoustic kit has; `station.core.sound_names.SUBSTITUTES` covers the rest."""

MODELS: Mapping[str, Mapping[SoundName, Recipe]] = MappingProxyType(
    {KIT_NAME: RECIPES, "brushes": brush_recipes.RECIPES, "electronic": electronic_recipes.RECIPES}
)
"""Every synthesised kit by its name."""

WORKERS = 4
"""numpy works on long arrays without the interpreter lock: several sounds are made at once."""


def synth_sound(name: SoundName, rate_hz: int, model: str = KIT_NAME) -> Sound:
    """One sound of a synthesised kit."""
    return make_sound(MODELS[model][name], rate_hz, crc32(name.encode()))


@lru_cache(maxsize=2)
def synth_kit(rate_hz: int = 48_000, model: str = KIT_NAME) -> DrumKit:
    """A synthesised kit at `rate_hz` (44 100 … 96 000); a second call for the same returns the same kit."""
    names = MODELS[model]
    with ThreadPoolExecutor(WORKERS) as pool:
        made = pool.map(lambda name: synth_sound(name, rate_hz, model), names)
        return DrumKit(model, rate_hz, MappingProxyType(dict(zip(names, made, strict=True))))
