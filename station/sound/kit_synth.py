"""The default kit: an acoustic drum kit made by rule, the same on every computer and at any sample rate.

No recording is bundled. Each sound is a recipe (`station.sound.synth`) of ringing modes and noise, made when the kit is
asked for and then kept; a sound's seed is its name, so that no sound changes when another is added.
"""

from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from types import MappingProxyType
from zlib import crc32

from station.sound.drum_kit import DrumKit
from station.sound.synth import cymbals, drums, percussion
from station.sound.synth.make import make_sound

KIT_NAME = "acoustic"
RECIPES = MappingProxyType({**drums.RECIPES, **cymbals.RECIPES, **percussion.RECIPES})
"""The recipe of every sound the kit has; `station.sound.sounds.SUBSTITUTES` covers the rest."""

WORKERS = 4
"""numpy works on long arrays without the interpreter lock: several sounds are made at once."""


@lru_cache(maxsize=2)
def synth_kit(rate_hz: int = 48_000) -> DrumKit:
    """The default kit at `rate_hz` (44 100 … 96 000); a second call for the same rate returns the same kit."""
    with ThreadPoolExecutor(WORKERS) as pool:
        made = pool.map(lambda name: make_sound(RECIPES[name], rate_hz, crc32(name.encode())), RECIPES)
        return DrumKit(KIT_NAME, rate_hz, MappingProxyType(dict(zip(RECIPES, made, strict=True))))
