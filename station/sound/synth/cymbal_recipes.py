"""Recipes of the cymbals: hi-hat at five openings and by the foot, ride, crashes, splash, china.

A cymbal's modes are many and inharmonic; clouds of them carry the body, bands of noise the top, where modes lie closer
than the ear can tell apart. A hard stroke throws energy upwards (Rossing, Science of Percussion Instruments, ch. 9), so
the crash-like ones have a steep tilt. A stick's tip adds a short ping. Energies and decays: our choice, within what
recordings of acoustic cymbals show. Panned as the drummer sits.
"""

from collections.abc import Mapping
from types import MappingProxyType

from station.core.sound_names import HIHAT_STEPS, SoundName
from station.sound.synth.recipe import Cloud, Noise, Recipe

CYMBAL_LAYERS = (40, 70, 100, 127)
FOOT_LAYERS = (50, 90, 127)

_HAT_PAN = -0.35
_CLOSED_T60_S = 0.26
_OPEN_T60_S = 2.1


def _hihat(openness: float) -> Recipe:
    """The hi-hat struck by a stick; the opening lengthens it, brings up the middle and lets the cymbals rattle."""
    ring_s = _CLOSED_T60_S * (_OPEN_T60_S / _CLOSED_T60_S) ** openness
    rattle_db = -9.0 - 14.0 * abs(openness - 0.4)
    return Recipe(
        rows=(
            Cloud(280.0, 620.0, 12, -21.0 + 6.0 * openness, 0.8 * ring_s),
            Cloud(620.0, 1250.0, 20, -15.0 + 4.0 * openness, ring_s),
            Cloud(1250.0, 2500.0, 32, -17.0 + 3.0 * openness, ring_s),
            Cloud(2500.0, 5000.0, 60, -14.0 + 5.0 * openness, ring_s),
            Cloud(5000.0, 9000.0, 100, -10.0 + 2.0 * openness, 0.95 * ring_s),
            Noise(5000.0, 9000.0, -10.0, 0.80 * ring_s),
            Noise(9000.0, 13000.0, -7.0, 0.80 * ring_s),
            Noise(12500.0, 17500.0, -5.5 - 1.5 * openness, 0.65 * ring_s),
            Noise(3500.0, 12000.0, rattle_db, 0.7 * ring_s, attack_s=0.002 + 0.004 * openness),
            Noise(2500.0, 9000.0, -15.0 - 4.0 * openness, 0.022),  # the stick
        ),
        loudness_db=-25.0 + 4.0 * openness,
        layers=CYMBAL_LAYERS,
        tilt_db=1.8,
        pan=_HAT_PAN,
        width=0.35,
    )


_CHICK = Recipe(
    rows=(
        Noise(90.0, 260.0, -16.0, 0.09),
        Cloud(300.0, 1250.0, 20, -14.0, 0.14),
        Cloud(1250.0, 5000.0, 50, -12.0, 0.14),
        Noise(4000.0, 9000.0, -9.0, 0.11),
        Noise(9000.0, 16500.0, -4.0, 0.08),
    ),
    loudness_db=-29.0,
    layers=FOOT_LAYERS,
    tilt_db=1.5,
    pan=_HAT_PAN,
    width=0.3,
    room_db=-16.0,
)

_FOOT_SPLASH = Recipe(
    rows=(
        Noise(90.0, 260.0, -20.0, 0.09),
        Cloud(280.0, 620.0, 12, -13.0, 1.3),
        Cloud(620.0, 1250.0, 20, -9.0, 1.5),
        Cloud(1250.0, 2500.0, 32, -11.0, 1.5),
        Cloud(2500.0, 5000.0, 60, -7.0, 1.4),
        Cloud(5000.0, 9000.0, 100, -7.0, 1.2),
        Noise(6000.0, 11000.0, -8.0, 1.0),
        Noise(11000.0, 16500.0, -10.0, 0.7),
        Noise(3000.0, 12000.0, -12.0, 0.06),  # the clash
    ),
    loudness_db=-24.0,
    layers=FOOT_LAYERS,
    tilt_db=1.8,
    pan=_HAT_PAN,
    width=0.4,
)

_RIDE_PAN = 0.38

_RIDE_BOW = Recipe(
    rows=(
        Cloud(250.0, 520.0, 9, -15.0, 3.0, attack_s=0.003),
        Cloud(520.0, 1050.0, 14, -14.0, 3.2, attack_s=0.003),
        Cloud(1050.0, 2400.0, 26, -15.0, 3.0, attack_s=0.003),
        Cloud(2400.0, 5000.0, 44, -9.0, 2.7, attack_s=0.002),
        Cloud(5000.0, 9000.0, 70, -9.5, 2.0, attack_s=0.002),
        Cloud(9000.0, 13000.0, 80, -14.0, 1.1),
        Noise(8000.0, 15000.0, -16.0, 0.7),
        Noise(2000.0, 12000.0, -17.0, 0.010),  # the tip
        Noise(2500.0, 6000.0, -13.0, 0.045),  # and its ping
        Noise(6000.0, 11000.0, -10.0, 0.065),
        Noise(11000.0, 17500.0, -8.0, 0.090),
    ),
    loudness_db=-26.5,
    layers=CYMBAL_LAYERS,
    tilt_db=1.6,
    pan=_RIDE_PAN,
    width=0.35,
)

_RIDE_BELL = Recipe(
    rows=(
        Cloud(388.0, 396.0, 2, -12.0, 2.6),
        Cloud(780.0, 800.0, 2, -16.0, 2.4),
        Cloud(1150.0, 1175.0, 2, -14.0, 2.4),
        Cloud(2425.0, 2465.0, 3, -2.5, 2.2),
        Cloud(3300.0, 3330.0, 2, -9.0, 1.7),
        Cloud(4610.0, 4650.0, 2, -12.0, 1.3),
        Cloud(5890.0, 5950.0, 2, -15.0, 1.0),
        Cloud(2400.0, 5000.0, 40, -17.0, 2.2),
        Cloud(5000.0, 9000.0, 60, -17.0, 1.5),
        Noise(9000.0, 14000.0, -22.0, 0.5),
        Noise(3000.0, 9000.0, -15.0, 0.030),
        Noise(9000.0, 16000.0, -18.0, 0.060),
    ),
    loudness_db=-23.0,
    layers=CYMBAL_LAYERS,
    tilt_db=0.8,
    pan=_RIDE_PAN,
    width=0.25,
)


def _crash(size: float, ring: float, pan: float, loudness_db: float) -> Recipe:
    """A cymbal struck on its edge: `size` divides its frequencies, `ring` multiplies its decays (1: 16 inches)."""
    return Recipe(
        rows=(
            Cloud(280.0 / size, 600.0 / size, 14, -13.0, 3.3 * ring),
            Cloud(600.0 / size, 1200.0 / size, 24, -8.0, 3.0 * ring),
            Cloud(1200.0 / size, 2500.0 / size, 40, -9.5, 2.7 * ring),
            Cloud(2500.0 / size, 5000.0 / size, 70, -6.5, 2.4 * ring),
            Cloud(5000.0 / size, 9000.0 / size, 90, -8.5, 1.9 * ring),
            Noise(4000.0 / size, 9000.0 / size, -8.0, 1.2 * ring, attack_s=0.0015),
            Noise(9000.0 / size, 13500.0 / size, -11.0, 0.9 * ring, attack_s=0.0015),
            Noise(13500.0 / size, min(17500.0, 19000.0 / size), -16.0, 0.6 * ring, attack_s=0.0015),
            Noise(900.0, 7000.0, -15.0, 0.08),  # the shank
            Noise(3000.0, 12000.0, -12.0, 0.25),
        ),
        loudness_db=loudness_db,
        layers=CYMBAL_LAYERS,
        tilt_db=4.5,
        pan=pan,
        width=0.45,
    )


_CHINA = Recipe(
    rows=(
        Cloud(220.0, 480.0, 16, -11.0, 1.3),
        Cloud(480.0, 1000.0, 28, -6.0, 1.4),
        Cloud(1000.0, 2500.0, 46, -6.5, 1.3),
        Cloud(2500.0, 5000.0, 60, -8.0, 1.1),
        Noise(2000.0, 5000.0, -8.0, 0.9),
        Noise(5000.0, 10000.0, -8.0, 0.8),
        Noise(10000.0, 16000.0, -13.0, 0.5),
        Noise(700.0, 6000.0, -12.0, 0.12),
    ),
    loudness_db=-19.0,
    layers=CYMBAL_LAYERS,
    tilt_db=4.0,
    pan=0.55,
    width=0.4,
)

RECIPES: Mapping[SoundName, Recipe] = MappingProxyType(
    {
        **{name: _hihat(step / (len(HIHAT_STEPS) - 1)) for step, name in enumerate(HIHAT_STEPS)},
        SoundName.HIHAT_CHICK: _CHICK,
        SoundName.HIHAT_FOOT_SPLASH: _FOOT_SPLASH,
        SoundName.RIDE_BOW: _RIDE_BOW,
        SoundName.RIDE_BELL: _RIDE_BELL,
        SoundName.RIDE_EDGE: _crash(size=1.3, ring=1.35, pan=_RIDE_PAN, loudness_db=-19.0),
        SoundName.CRASH_1: _crash(size=1.0, ring=1.0, pan=-0.40, loudness_db=-18.0),
        SoundName.CRASH_2: _crash(size=1.17, ring=1.15, pan=0.42, loudness_db=-18.0),
        SoundName.SPLASH: _crash(size=0.68, ring=0.38, pan=-0.12, loudness_db=-18.5),
        SoundName.CHINA: _CHINA,
    }
)
