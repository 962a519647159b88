"""Recipes of an electronic kit: few tones that fall in pitch, dry bands of noise, metal of a handful of oscillators.

After the analogue drum machines of around 1980, whose voices were swept sines, filtered noise and six square waves for
all cymbals; the figures are ours. There is no room and little width, and every layer differs mainly in brightness.
"""

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from station.core.sound_names import HIHAT_STEPS, SoundName
from station.sound.synth.recipe import Cloud, Glide, Noise, Recipe, Row, Tone

LAYERS = (50, 90, 127)
_HAT_PAN = -0.2

_KICK = Recipe(
    rows=(
        Tone(47.0, 0.0, 0.95),
        Tone(94.0, -16.0, 0.30),
        Noise(1500.0, 6000.0, -34.0, 0.012),  # the trigger's click
    ),
    loudness_db=-9.0,
    layers=LAYERS,
    glide=Glide(ratio=3.5, tau_s=0.018),
    tilt_db=3.0,
)

_SNARE = Recipe(
    rows=(
        Tone(185.0, -5.0, 0.20),
        Tone(330.0, -9.0, 0.16),
        Noise(1500.0, 4000.0, -8.0, 0.26),
        Noise(4000.0, 10000.0, -7.0, 0.28),
        Noise(9000.0, 16000.0, -12.0, 0.20),
    ),
    loudness_db=-14.0,
    layers=LAYERS,
    glide=Glide(ratio=0.5, tau_s=0.012),
    tilt_db=1.5,
)

_RIM_SHOT = Recipe(
    rows=(Tone(210.0, -6.0, 0.22), Tone(455.0, -6.0, 0.14), Tone(1740.0, -8.0, 0.10), *_SNARE.rows[2:]),
    loudness_db=-14.0,
    layers=LAYERS,
    glide=Glide(ratio=0.3, tau_s=0.010),
    tilt_db=1.5,
)

_CROSS_STICK = Recipe(
    rows=(Tone(455.0, -6.0, 0.050), Tone(1667.0, -3.0, 0.060), Noise(1500.0, 7000.0, -16.0, 0.020)),
    loudness_db=-19.0,
    layers=LAYERS,
    tilt_db=1.0,
)

_BUZZ = Recipe(
    rows=_SNARE.rows,
    loudness_db=-17.0,
    layers=LAYERS,
    tilt_db=1.5,
    echoes=tuple((0.021 * bounce, 0.85**bounce) for bounce in range(1, 8)),  # a machine's even roll
)


def _tom(pitch_hz: float, pan: float) -> Recipe:
    """A sine that falls by a fifth, with a breath of noise."""
    return Recipe(
        rows=(
            Tone(pitch_hz, 0.0, 0.55),
            Tone(2.0 * pitch_hz, -18.0, 0.22),
            Noise(300.0, 2500.0, -22.0, 0.12),
            Noise(2000.0, 6000.0, -26.0, 0.020),
        ),
        loudness_db=-13.0,
        layers=LAYERS,
        glide=Glide(ratio=0.55, tau_s=0.050),
        tilt_db=3.0,
        pan=pan,
    )


def _tom_rim(pitch_hz: float, pan: float) -> Recipe:
    """The tom an octave up and short, with a snap."""
    return Recipe(
        rows=(Tone(2.0 * pitch_hz, -2.0, 0.20), Tone(1100.0, -9.0, 0.06), Noise(2000.0, 9000.0, -12.0, 0.025)),
        loudness_db=-17.0,
        layers=LAYERS,
        glide=Glide(ratio=0.4, tau_s=0.030),
        tilt_db=1.5,
        pan=pan,
    )


_METAL = (
    Cloud(800.0, 2000.0, 4, -22.0, 1.0),
    Cloud(2000.0, 5200.0, 6, -14.0, 1.0),
    Cloud(5200.0, 9500.0, 10, -9.0, 1.0),
)
"""The mixture of oscillators that all cymbals share, at a ring of one second."""


def _metal(ring_s: float) -> tuple[Row, ...]:
    return tuple(replace(row, t60_s=ring_s) for row in _METAL)


def _hihat(openness: float) -> Recipe:
    """Metal and hiss; the opening only lengthens them."""
    ring_s = 0.075 * (0.75 / 0.075) ** openness
    return Recipe(
        rows=(*_metal(ring_s), Noise(7000.0, 12000.0, -6.0, ring_s), Noise(12000.0, 17000.0, -6.0, 0.8 * ring_s)),
        loudness_db=-25.0 + 3.0 * openness,
        layers=LAYERS,
        tilt_db=0.8,
        pan=_HAT_PAN,
        width=0.1,
    )


def _cymbal(ring_s: float, hiss_db: float, pan: float, loudness_db: float) -> Recipe:
    """A long mixture with a bright start."""
    return Recipe(
        rows=(
            *_metal(ring_s),
            Noise(3500.0, 8000.0, hiss_db, 0.8 * ring_s),
            Noise(8000.0, 16000.0, hiss_db - 1.0, 0.6 * ring_s),
            Noise(2500.0, 12000.0, -16.0, 0.05),
        ),
        loudness_db=loudness_db,
        layers=LAYERS,
        tilt_db=2.0,
        pan=pan,
        width=0.3,
    )


_RIDE_BELL = Recipe(
    rows=(Tone(540.0, -8.0, 0.9), Tone(810.0, -5.0, 1.0), Tone(2430.0, -6.0, 0.8), *_metal(0.9)),
    loudness_db=-22.0,
    layers=LAYERS,
    tilt_db=0.8,
    pan=0.25,
    width=0.2,
)

_COWBELL = Recipe(
    rows=(Tone(540.0, -3.0, 0.30), Tone(800.0, -3.0, 0.34), Tone(1080.0, -14.0, 0.16), Tone(1600.0, -12.0, 0.18)),
    loudness_db=-18.0,
    layers=LAYERS,
    tilt_db=1.0,
)

_CLAP = Recipe(
    rows=(Noise(700.0, 1600.0, -4.0, 0.08), Noise(1600.0, 5000.0, -10.0, 0.06)),
    loudness_db=-17.0,
    layers=LAYERS,
    tilt_db=1.0,
    width=0.3,
    room_db=-6.0,
    echoes=((0.010, 0.9), (0.020, 0.9), (0.030, 1.0)),
)

_TAMBOURINE = Recipe(
    rows=(Cloud(5000.0, 9000.0, 12, -6.0, 0.16), Noise(7000.0, 15000.0, -4.0, 0.12)),
    loudness_db=-23.0,
    layers=LAYERS,
    tilt_db=0.8,
    echoes=((0.018, 0.5),),
)

_BLIP = Recipe(
    rows=(Tone(2500.0, -1.0, 0.050), Tone(5000.0, -16.0, 0.030)),
    loudness_db=-21.0,
    layers=LAYERS,
    tilt_db=1.0,
    pan=0.1,
)

_TOMS = (
    (SoundName.TOM_1, SoundName.TOM_1_RIM, 165.0, -0.3),
    (SoundName.TOM_2, SoundName.TOM_2_RIM, 131.0, -0.1),
    (SoundName.TOM_3, SoundName.TOM_3_RIM, 110.0, 0.1),
    (SoundName.TOM_4, SoundName.TOM_4_RIM, 98.0, 0.2),
    (SoundName.FLOOR_TOM_1, SoundName.FLOOR_TOM_1_RIM, 82.0, 0.35),
    (SoundName.FLOOR_TOM_2, SoundName.FLOOR_TOM_2_RIM, 65.0, 0.45),
)
"""Head, rim, where the pitch settles in Hz, pan."""

RECIPES: Mapping[SoundName, Recipe] = MappingProxyType(
    {
        SoundName.KICK: _KICK,
        SoundName.SNARE: _SNARE,
        SoundName.SNARE_RIM_SHOT: _RIM_SHOT,
        SoundName.SNARE_CROSS_STICK: _CROSS_STICK,
        SoundName.SNARE_BUZZ: _BUZZ,
        **{head: _tom(pitch_hz, pan) for head, _, pitch_hz, pan in _TOMS},
        **{rim: _tom_rim(pitch_hz, pan) for _, rim, pitch_hz, pan in _TOMS},
        **{name: _hihat(step / (len(HIHAT_STEPS) - 1)) for step, name in enumerate(HIHAT_STEPS)},
        SoundName.HIHAT_CHICK: _hihat(-0.2),
        SoundName.HIHAT_FOOT_SPLASH: _hihat(0.6),
        SoundName.RIDE_BOW: _cymbal(1.3, -14.0, 0.25, -25.0),
        SoundName.RIDE_EDGE: _cymbal(2.0, -7.0, 0.25, -20.0),
        SoundName.RIDE_BELL: _RIDE_BELL,
        SoundName.RIDE_2: _cymbal(1.1, -12.0, 0.4, -25.0),
        SoundName.CRASH_1: _cymbal(2.2, -5.0, -0.3, -19.0),
        SoundName.CRASH_2: _cymbal(1.8, -4.0, 0.35, -19.0),
        SoundName.SPLASH: _cymbal(0.7, -5.0, -0.1, -19.0),
        SoundName.CHINA: _cymbal(1.2, -2.0, 0.45, -19.5),
        SoundName.COWBELL: _COWBELL,
        SoundName.TAMBOURINE: _TAMBOURINE,
        SoundName.CLAP: _CLAP,
        SoundName.PERCUSSION: _BLIP,
    }
)
